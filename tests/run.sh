#!/usr/bin/env bash
# Installs what is missing, builds everything, runs every test.  Arguments go to ctest: tests/run.sh -R Drape
# The output ends with ctest's summary; tests that cannot run here (no GPU) are listed there as skipped.
set -euo pipefail
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../experiments/setup.sh"

test_packages=("${program_packages[@]}" "libgtest-dev|GoogleTest")
optional_test_packages=("${optional_program_packages[@]}" "clang-format-14|checks the style"
  "chromium|opens pages of results, without a display"
  "python3-dev|headers of Python, for its package"
  "pybind11-dev|C++ and Python in one module"
  "python3-numpy|arrays in Python"
  "libxml2-utils|checks JUnit files")

# .ci/run has clang-tidy read for so many seconds what the last commit has changed; a warning is an error.
[[ -z ${HYSTERON_TIDY_SECONDS:-} ]] || optional_test_packages+=("clang-tidy-14|reads what a commit has changed")
install_missing test_packages optional_test_packages
configure -DHYSTERON_TESTS=ON
build
if [[ -n ${HYSTERON_TIDY_SECONDS:-} ]]; then
  "$root/tests/tidy.sh" --seconds "$HYSTERON_TIDY_SECONDS" || [[ $? == 77 ]]
fi
# Some tests wait, for a browser or a killed run: one more than there are cores.  None needs a second thread for itself.
at_once=$(($(nproc) + 1))  # nproc itself follows OMP_NUM_THREADS
export OMP_NUM_THREADS=1
exec ctest --test-dir "$build_folder" --output-on-failure --parallel "$at_once" "$@"
