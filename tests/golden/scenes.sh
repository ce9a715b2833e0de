# shellcheck shell=bash disable=SC2034
# Sourced by check.sh and accept.sh: the runs whose last picture is kept, NAME.png in this folder.

golden_folder=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")" && pwd -P)

# Early moments, in which neighbouring solutions stay together (single precision in place of double moves at most
# 0.001 % of the pixels), of coarse meshes, so that all of them take seconds: folds that begin, a strip's first
# swing, a pleat that was pulled straight and let go.
declare -A golden_runs=(
  [drape]="drape --fabric cotton-broad-k50 --drape.lowering 0.6 --triangles 2000 --seconds 0.2 --fps 5"
  [swing]="swing --fabric cotton-broad-k50 --fabric.damping 1e-5 --triangles 400 --seconds 0.3 --fps 10 --look friction"
  [crease]="crease --fabric cotton-broad-k50 --crease.fold pleat --crease.recovery 0.1 --triangles 200 --fps 5"
)
golden_size=480x270
golden_limits=(--limits pictures)
