#!/usr/bin/env bash
# install/laws.sh: the laws alone in another project, by add_subdirectory and installed.  Takes no build and no package
# but Eigen.
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
root=$(readlink -f "$here/../..")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# logged COMMAND...: shows what it says where it fails.
logged() { "$@" >"$folder/log" 2>&1 || { cat "$folder/log" && exit 1; }; }

# build NAME OPTION...: the example's program, which runs.
build() {
  logged cmake -S "$here/../examples/subproject" -B "$folder/$1" -G Ninja -DCMAKE_BUILD_TYPE=Debug \
    -DCMAKE_CXX_FLAGS_DEBUG= "${@:2}"  # a debugger's tables take the compiler a third longer
  logged cmake --build "$folder/$1"
  "$folder/$1/laws"
}

# Nothing comes with them: no test, and nothing to install.
build below -DCMAKE_DISABLE_FIND_PACKAGE_hysteron=ON
[[ $(ctest --test-dir "$folder/below" -N 2>&1) == *"Total Tests: 0"* ]] || { echo "tests in a subproject" && exit 1; }
logged cmake --install "$folder/below" --prefix "$folder/nothing"
[[ ! -e $folder/nothing ]] || { echo "installed from a subproject:" && find "$folder/nothing" && exit 1; }

# The installed headers are all that they need; those of compiled functions are not among them.
logged cmake -S "$root" -B "$folder/alone" -G Ninja -DHYSTERON_ONLY_LAWS=ON
logged cmake --install "$folder/alone" --prefix "$folder/prefix"
[[ ! -e $folder/prefix/include/hysteron/sim/base && ! -e $folder/prefix/bin ]]
build beside -DCMAKE_PREFIX_PATH="$folder/prefix" -DCMAKE_REQUIRE_FIND_PACKAGE_hysteron=ON
