#!/usr/bin/env bash
# tests/races.sh: ThreadSanitizer on short runs with two threads, with and without pictures.  Builds in build-tsan/ with
# clang: its OpenMP tells the sanitizer, by the library Archer, where threads wait for each other, which g++'s does not
# (Debian: clang-14 libomp-14-dev libclang-rt-14-dev).  Exits 1 where there is a race.
set -euo pipefail
tests="$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")"
build="$tests/../build-tsan"
compiler="${CXX:-clang++}"
archer="$(readlink -f "$("$compiler" -print-resource-dir)/../..")/libarcher.so"
[[ -f $archer ]] || { echo "races.sh: no $archer: install libomp-14-dev" >&2; exit 1; }

cmake -S "$tests/.." -B "$build" -G Ninja -DCMAKE_CXX_COMPILER="$compiler" -DHYSTERON_SANITIZE=thread \
      -DHYSTERON_CUDA=OFF -DHYSTERON_PYTHON=OFF -DHYSTERON_TESTS=OFF >/dev/null
cmake --build "$build" --target hysteron
out="$(mktemp -d)"
trap 'rm -r "$out"' EXIT
export OMP_TOOL_LIBRARIES="$archer" TSAN_OPTIONS="ignore_noninstrumented_modules=1 exitcode=66"

found=0
check() {  # WORDS...: of the program
  local code=0
  "$build/hysteron" "$@" --threads 2 --device cpu --quiet --out "$out/run" &>"$out/log" || code=$?
  if [[ $code == 0 ]]; then echo "no race: $*"; else found=1; echo "exit code $code: $*"; cat "$out/log"; fi
}
# Loops of fewer than 2048 vertices, faces or edges do not share their work (sim/device/cpu.h).
check drape --quick --seconds 0.05 --no-images
check crumple --quick --triangles 4500 --seconds 0.05 --no-images
check swing --quick --triangles 4500 --seconds 0.1 --checkpoint 1 --size 160x120 --renderer osmesa
check compare swing --quick --triangles 300 --seconds 0.05 --laws linear,prandtl --compare.jobs 2 --size 160x120
exit "$found"
