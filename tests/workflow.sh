#!/usr/bin/env bash
# Snakemake on workflows of the program's: all of results/ is planned, two small recorded runs are repeated to the bit.
#   tests/workflow.sh HYSTERON RESULTS
# 77 (skipped) without Snakemake.
set -euo pipefail

hysteron=$1 results=$2
command -v snakemake >/dev/null || { echo "snakemake is missing (apt-get install snakemake): skipped"; exit 77; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
export XDG_CACHE_HOME=$scratch/cache

"$hysteron" rerun "$results" --out "$scratch/again" --snakemake "$scratch/plan" >"$scratch/said"
planned=$(awk '/ runs, / {print $1}' "$scratch/said")
(cd "$scratch/plan" && snakemake --dry-run --cores 4 --quiet) >"$scratch/dry" 2>&1
jobs=$(awk '$1 == "job" && $2 != "count" {print $2}' "$scratch/dry")
[[ $planned -gt 0 && $jobs == "$planned" ]] || { cat "$scratch/said" "$scratch/dry"; exit 1; }
[[ ! -e $scratch/again ]]

for law in linear prandtl; do
  "$hysteron" drape --quick --triangles 120 --seconds 0.05 --law $law --threads 1 --device cpu --no-images --quiet \
    --out "$scratch/runs/$law" >/dev/null
done
"$hysteron" rerun "$scratch/runs" --out "$scratch/runs-again" --snakemake "$scratch/flow" >/dev/null
(cd "$scratch/flow" && snakemake --cores 2 --quiet) >"$scratch/log" 2>&1 || { cat "$scratch/log"; exit 1; }
for law in linear prandtl; do
  diff <(grep state_hash "$scratch/runs/$law/manifest.json") <(grep state_hash "$scratch/runs-again/$law/manifest.json")
done
[[ -s $scratch/runs-again/index.html ]]
echo "$planned runs planned, 2 repeated to the bit"
