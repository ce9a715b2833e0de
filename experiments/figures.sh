#!/usr/bin/env bash
# The chapter's figures and the comparisons that it announces, by one command:
#   experiments/figures.sh                  into out/figures, with index.html over all of them
#   experiments/figures.sh --quick          small versions
#   experiments/figures.sh --out DIR ...    other options go to every run (--device cuda, --fabric wool-tropical)
set -euo pipefail
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/setup.sh"

out=$root/out/figures
quick=() more=()
while [[ $# -gt 0 ]]; do
  case $1 in
    --out) out=$2 && shift ;;
    --out=*) out=${1#--out=} ;;
    --quick) quick=(--quick) ;;
    *) more+=("$1") ;;
  esac
  shift
done

if [[ -n ${HYSTERON:-} ]]; then
  program=$HYSTERON # built elsewhere
else
  install_missing program_packages optional_program_packages
  if [[ -f $build_folder/CMakeCache.txt ]]; then configure; else configure -DHYSTERON_TESTS=OFF; fi
  build --target hysteron
  program=$build_folder/hysteron
fi

hysteron() {
  say "hysteron $*"
  "$program" "$@"
}

# lost ARGUMENT...: what friction and viscosity in bending have taken in a small swing [J].
lost() {
  "$program" swing --quick --no-images --quiet --json --triangles 100 --out "$out/.tuning" "$@" "${more[@]}" |
    awk -F'[:,]' '/"(bending_friction|viscous)_J"/ { sum += $2 } END { printf "%.9g", sum }'
}

# The viscosity with which a linear strip loses as much in its first 0.4 s as the hysteretic one: bisection in
# the logarithm of fabric.damping [s].
tuned_damping() {
  local wanted low=1e-5 high=1e-1 middle
  wanted=$(lost --law prandtl)
  for _ in $(seq 9); do
    middle=$(awk "BEGIN { printf \"%.4g\", sqrt($low * $high) }")
    if awk "BEGIN { exit !($(lost --law linear --fabric.damping "$middle") < $wanted) }"; then
      low=$middle
    else
      high=$middle
    fi
  done
  printf '%s' "$middle"
}

mkdir -p "$out"
# 4.2(b), 4.3, 4.4: laws alone.
hysteron figures --quiet --out "$out/chapter-figures"
# 4.1: permanent wrinkles, an existing method and ours.
hysteron compare crumple --laws linear,pabst,narain,prandtl --light raking "${quick[@]}" "${more[@]}" --out "$out/compare-crumple"
# Damping of oscillations: viscosity tuned for one swing against friction in bending.
damping=$(tuned_damping)
rm -rf "$out/.tuning"
hysteron compare swing --laws "linear,linear+fabric.damping=$damping,pabst,obrien,prandtl" "${quick[@]}" "${more[@]}" --out "$out/compare-swing"
# Drape with hysteresis and without.
hysteron compare drape --laws linear,pabst,prandtl "${quick[@]}" "${more[@]}" --out "$out/compare-drape"
# Crease angles; fatigue over cycles.
hysteron compare crease --laws linear,narain,prandtl --crease.fold rod "${quick[@]}" "${more[@]}" --out "$out/compare-crease"
hysteron fold "${quick[@]}" "${more[@]}" --out "$out/fold"
# What a step costs, by law.
hysteron bench --laws --json "${quick[@]}" "${more[@]}" --out "$out/bench" >"$out/cost.json"
hysteron report "$out"
say "figures: $out/index.html"
