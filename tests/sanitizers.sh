#!/usr/bin/env bash
# tests/sanitizers.sh [--clang] [TEST...]: tests of the simulation with AddressSanitizer and UndefinedBehaviorSanitizer,
# built by the preset asan in build-asan/, or by clang++, in half the time, in build-asan-clang/ (Debian: clang
# libclang-rt-14-dev libomp-14-dev).  TEST is a program of tests/CMakeLists.txt; unless named, all of those below sim/.
# GTEST_FILTER chooses among their tests.  Exits 1 where one fails or a sanitizer finds something.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.."

build=$PWD/build-asan options=()
if [[ ${1:-} == --clang ]]; then
  build=$PWD/build-asan-clang options=(-DCMAKE_CXX_COMPILER=clang++)
  shift
fi
tests=("$@")
[[ $# -gt 0 ]] || tests=(test_base test_mesh test_scene test_elements test_bending_laws test_linear test_time
                         test_identification test_reference)

cmake --preset asan -B "$build" "${options[@]}" >/dev/null
cmake --build "$build" --target "${tests[@]}"

at_once=$(nproc)  # nproc itself follows OMP_NUM_THREADS
# A finding of either sanitizer ends the test program.
export OMP_NUM_THREADS=1 ASAN_OPTIONS=detect_stack_use_after_return=1 UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1
shards=8  # of each program, so that every core has work to the end
# check TEST SHARD
check() {
  local log=$build/$1-$2.log
  if ! GTEST_TOTAL_SHARDS=$shards GTEST_SHARD_INDEX=$2 "$build/$1" --gtest_brief=1 &>"$log"; then
    echo "$1: failed, see $log"
    grep -E 'ERROR: |runtime error: |^\[  FAILED  \]' "$log" | head -n 20
    return 1
  fi
}
export -f check
export build shards
for test in "${tests[@]}"; do
  for ((shard = 0; shard < shards; ++shard)); do printf '%s %d\0' "$test" "$shard"; done
done | xargs -0 -P "$at_once" -I{} bash -c 'check {}' || exit 1
for test in "${tests[@]}"; do
  echo "$test: $(sed -n 's/^\[  PASSED  \] \([0-9]*\) test.*/\1/p' "$build/$test"-[0-9]*.log |
    awk '{n += $1} END {print n}') tests passed"
done
