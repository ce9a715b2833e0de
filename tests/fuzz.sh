#!/usr/bin/env bash
# tests/fuzz.sh [COUNT [FIRST]]: COUNT changed files of each format (default 10000) from number FIRST on (default 1)
# through the readers, with the program in build/ (another folder: HYSTERON_BUILD).  Exits 1 at the first that is
# neither read nor refused in one line; its file is kept, and the output says where.
set -euo pipefail
root="$(dirname "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")")"
for format in toml obj ply csv png json; do
  "${HYSTERON_BUILD:-$root/build}/fuzz" "$format" "$root/tests/fuzz/seeds" "${1:-10000}" "${2:-1}" || exit 1
done
