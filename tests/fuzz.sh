#!/usr/bin/env bash
# tests/fuzz.sh [SECONDS [FORMAT...]]: libFuzzer on the readers of each format (default: all of them, two at a time) for
# so many seconds (default 600), with AddressSanitizer and UndefinedBehaviorSanitizer.  Builds them in build-fuzz/ with
# clang (Debian: clang-14 libclang-rt-14-dev).  What it learns stays in build-fuzz/corpus, what ends a reader, or takes
# it 5 s or 2 GiB, in build-fuzz/found, to be put into tests/fuzz/refused or seeds once it is mended.  Exits 1 where
# there is any.
set -euo pipefail
tests="$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")"
build="$tests/../build-fuzz"
seconds="${1:-600}"
formats=("${@:2}")
[[ ${#formats[@]} -gt 0 ]] || formats=(toml study obj ply pc2 mdd csv png manifest checkpoint)

cmake -S "$tests/.." -B "$build" -G Ninja -DCMAKE_CXX_COMPILER="${CXX:-clang++}" -DHYSTERON_FUZZ=ON \
      -DHYSTERON_CUDA=OFF -DHYSTERON_PYTHON=OFF >/dev/null
cmake --build "$build" --target "${formats[@]/#/fuzz_}"
TMPDIR="$(mktemp -d -p /dev/shm)"  # readers take files
export TMPDIR
trap 'rm -r "$TMPDIR"' EXIT

fuzz() {
  mkdir -p "$build/corpus/$1" "$build/found/$1"
  local folders=("$build/corpus/$1")
  for folder in "$tests/fuzz/seeds/$1" "$tests/fuzz/refused/$1"; do [[ ! -d $folder ]] || folders+=("$folder"); done
  local log="$build/$1.log"
  "$build/fuzz_$1" -max_total_time="$seconds" -max_len=16384 -timeout=5 -rss_limit_mb=2048 -close_fd_mask=1 \
                   -print_final_stats=1 -artifact_prefix="$build/found/$1/" "${folders[@]}" &>"$log" ||
    { echo "$1: ended, see $log"; return 1; }
  echo "$1: $(grep -o 'number_of_executed_units: .*' "$log"), $(grep -o 'cov: [0-9]* ft: [0-9]*' "$log" | tail -n 1)"
}
export -f fuzz
export tests build seconds
printf '%s\n' "${formats[@]}" | xargs -P 2 -I{} bash -c 'fuzz {}'
