#!/usr/bin/env bash
# Records the runs in runs/ that ctest repeats (`hysteron verify tests/golden/runs`; a build for x86-64-v3 to the bit), after a change that
# is meant to change numbers:
#   tests/golden/record_runs.sh PROGRAM
set -euo pipefail
program=$(readlink -f "$1")
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")"

declare -A runs=(
  [swing]="swing --quick --triangles 200"
  [crease]="crease --crease.fold pleat --crease.recovery 0.1 --triangles 100"
  [fold]="fold --quick --triangles 100 --fold.cycles 2"
  [hanging-square]="run hanging-square --triangles 300"
)
written=$(mktemp -d)
trap 'rm -rf "$written"' EXIT
for name in "${!runs[@]}"; do
  # The table holds words.
  # shellcheck disable=SC2086
  "$program" ${runs[$name]} --no-images --device cpu --threads 1 --quiet --out "$written/$name" >"$written/$name.txt"
  mkdir -p "runs/$name"
  sed "s|$written|out|" "$written/$name/manifest.json" >"runs/$name/manifest.json"
done
