#!/usr/bin/env bash
# Draws the chapter's figures and the comparisons that it announces, by one command:
#   experiments/figures.sh                  into out/figures, with index.html over all of them
#   experiments/figures.sh --quick          small versions
#   experiments/figures.sh drape crease     only these: laws crumple sleeve swing drape crease fold
#   experiments/figures.sh --out DIR ...    other options, KEY=VALUE in one word, go to every run (--device=cuda,
#                                           --fabric=wool-tropical)
# Each figure is a PNG, each plot also an SVG; captions of the laws are in README.md beside them and on the page.  The
# sleeve's film is film.mp4 and, of at most 4 MB, film.webp; it needs ffmpeg, which this script does not install.
set -euo pipefail
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/setup.sh"

all_parts=(laws crumple sleeve swing drape crease fold)
out=$root/out/figures
quick=() more=() parts=()
while [[ $# -gt 0 ]]; do
  case $1 in
    --out) out=$2 && shift ;;
    --out=*) out=${1#--out=} ;;
    --quick) quick=(--quick) ;;
    --*) more+=("$1") ;;
    *)
      [[ " ${all_parts[*]} " == *" $1 "* ]] || { echo "no such part: $1; there are: ${all_parts[*]}" >&2; exit 2; }
      parts+=("$1")
      ;;
  esac
  shift
done
[[ ${#parts[@]} -gt 0 ]] || parts=("${all_parts[@]}")

if [[ -n ${HYSTERON:-} ]]; then
  program=$HYSTERON # a program built elsewhere
else
  install_missing program_packages optional_program_packages
  if [[ -f $build_folder/CMakeCache.txt ]]; then configure; else configure -DHYSTERON_TESTS=OFF; fi
  build --target hysteron
  program=$build_folder/hysteron
fi

hysteron() {
  say "hysteron $*"
  command "$program" "$@"
}

# Prints fabric.damping=SECONDS with which a linear strip, matched in stiffness, loses as much to viscosity in its
# first 0.4 s as the hysteretic one to friction.
tuned_damping() {
  command "$program" compare swing --quick --no-images --quiet --triangles 100 --out "$out/.tuning" \
    --laws linear,prandtl --compare.tune fabric.damping=1e-5:1e-2 \
    --compare.tune-metric viscous_J=bending_friction_J "${more[@]}" | grep '^fabric\.damping='
}

# Laws are matched in the work of bending; narain, whose yield is at k0 = 8/m, would be made 52 times as stiff, so
# terzopoulos is the plastic law.

# Figures 4.2(b), 4.3 and 4.4 show laws alone.
draw_laws() { hysteron figures --quiet --out "$out/chapter-figures"; }

# Figure 4.1 shows permanent wrinkles by existing methods and ours.
draw_crumple() {
  hysteron compare crumple --laws linear,pabst,terzopoulos,prandtl --light raking "$@" --out "$out/compare-crumple"
}

# The elbow of a sleeve bends and straightens: it is drawn before, bent and after, and as a film.  The laws are elastic,
# plastic, hysteretic, and hysteretic with the permanent set of the fabric cotton-broad-creasing beside friction.
# The picture shows the elbow's inside; parts of the arm that no cloth reaches go on beyond its border.
draw_sleeve() {
  local set=fabric.bending.set.yield=500+fabric.bending.set.hardening=7.98e-6 small=()
  [[ ${#quick[@]} -eq 0 ]] || small=(--triangles 600)
  hysteron compare crumple --scene sleeve --laws "linear,terzopoulos,prandtl,prandtl+$set" \
    --compare.names "linear,terzopoulos,prandtl,prandtl with set" \
    --compare.title "A sleeve whose elbow is bent by 110° and straightened" --fps 25 \
    --compare.times 0.28,1.56,3.2 --compare.no-outlines --compare.video mp4,webp --light raking \
    --camera.direction "0 0.35 1" --camera.box "-0.205 -0.085 -0.09 0.205 0.2 0.08" --size 672x520 \
    "${small[@]}" "$@" --out "$out/compare-sleeve"
}

# The damping of oscillations by viscosity, tuned for one swing, is compared with that by friction in bending.
draw_swing() {
  local damping
  say "tuning fabric.damping of the strip with viscosity"
  damping=$(tuned_damping)
  rm -rf "$out/.tuning"
  hysteron compare swing --laws "linear,linear+$damping,pabst,obrien,prandtl" "$@" \
    --out "$out/compare-swing"
}

# Drapes with hysteresis and without are compared, with the difference of their curvatures.
draw_drape() {
  hysteron compare drape --laws linear,pabst,terzopoulos,prandtl --compare.to linear --compare.difference curvature \
    --compare.rows 2 "$@" --out "$out/compare-drape"
}

# Crease angles are compared.
draw_crease() {
  hysteron compare crease --laws linear,terzopoulos,prandtl --crease.fold rod "$@" --out "$out/compare-crease"
}

# Fatigue is shown over cycles.
draw_fold() { hysteron fold "$@" --out "$out/fold"; }

mkdir -p "$out"
for part in "${parts[@]}"; do "draw_$part" "${quick[@]}" "${more[@]}"; done
hysteron report "$out"
say "figures: $out/index.html"
