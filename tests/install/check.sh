#!/usr/bin/env bash
# install/check.sh BUILD_FOLDER: installs into a temporary folder; tests/examples/consumer is built on that, and runs.
set -euo pipefail
build=$1
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
prefix=$folder/prefix

cmake --install "$build" --prefix "$prefix" >"$folder/install.log"

# The binary finds the assets that were installed with it, not those of its source tree.  (grep reads all of it: with -q it
# would end first, and the binary could not write.)
fabrics=$prefix/share/hysteron/assets/fabrics
sed 's/^name = .*/name = "installed"/' "$fabrics/cotton-broad.toml" >"$fabrics/installed.toml"
env -u HYSTERON_ASSETS "$prefix/bin/hysteron" list fabrics | grep '^installed' >/dev/null

cmake -S "$here/../examples/consumer" -B "$folder/consumer" -G Ninja -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_PREFIX_PATH="$prefix" >"$folder/configure.log"
cmake --build "$folder/consumer" >"$folder/build.log" || { cat "$folder/build.log"; exit 1; }
HYSTERON_ASSETS=$prefix/share/hysteron/assets "$folder/consumer/sag"
"$folder/consumer/hinges"
