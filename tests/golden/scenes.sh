# shellcheck shell=bash disable=SC2034
# Sourced by check.sh and accept.sh: the runs of which a picture is kept, NAME.png in this folder.

golden_folder=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")" && pwd -P)

# Early moments, in which neighbouring solutions stay together (single precision in place of double moves at most
# 0.001 % of the pixels), of coarse meshes, so that all of them take seconds: folds that begin, a strip's first
# swing, a pleat that was pulled straight and let go.
declare -A golden_runs=(
  [drape]="drape --fabric cotton-broad-k50 --drape.lowering 0.6 --triangles 2000 --seconds 0.2 --fps 5"
  [swing]="swing --fabric cotton-broad-k50 --fabric.damping 1e-5 --triangles 400 --seconds 0.3 --fps 10 --look friction"
  [crease]="crease --fabric cotton-broad-k50 --crease.fold pleat --crease.recovery 0.1 --triangles 200 --fps 5"
  [fold]="fold --fabric cotton-broad-k50 --quick --fold.cycles 1 --triangles 200 --fps 5"
  [crumple]="crumple --fabric cotton-broad-k50 --quick --triangles 400 --seconds 0.2 --fps 10"
  [cantilever]="cantilever --fabric cotton-broad-k50 --quick --triangles 60"
  [buckle]="buckle --quick --triangles 60"
  [sheet]="compare swing --fabric cotton-broad-k50 --laws linear,prandtl --triangles 100 --seconds 0.3 --fps 10 --compare.rows 2"
  [plot]="kes --fabric cotton-broad-k50 --law linear,prandtl"
)
golden_runs[page]=${golden_runs[sheet]} # as a page has it
golden_size=480x270
# The file of a run that is kept; of others the last picture of frames/.  A page is seen in Chromium.
declare -A golden_files=([sheet]=sheet.png [plot]=plot_loops.png [page]=report.html)
golden_window=800,1400
# Browsers and gnuplot of another Debian set letters by fractions of a pixel elsewhere.
declare -A golden_limits=([plot]="--limits $golden_folder/plots.toml" [page]="--limits $golden_folder/pages.toml")
golden_default_limits="--limits pictures"
