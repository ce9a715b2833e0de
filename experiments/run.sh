#!/usr/bin/env bash
# Leads from a fresh Debian or Ubuntu to pictures: installs missing packages, builds, runs an experiment.
#   experiments/run.sh                     drape of cotton broad into out/drape
#   experiments/run.sh --quick             the same with further options
#   experiments/run.sh swing --seconds 2   another experiment of `hysteron`
set -euo pipefail
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/setup.sh"

# out_of ARGUMENT... prints the folder given with --out, if any.
out_of() {
  while [[ $# -gt 0 ]]; do
    case $1 in
      --out) printf '%s' "${2:-}" ;;
      --out=*) printf '%s' "${1#--out=}" ;;
    esac
    shift
  done
}

install_missing program_packages optional_program_packages
# A new build folder needs no tests; an existing one keeps them.
if [[ -f $build_folder/CMakeCache.txt ]]; then configure; else configure -DHYSTERON_TESTS=OFF; fi
build --target hysteron

[[ $# -gt 0 ]] || set -- drape --fabric cotton-broad
[[ $1 != -* ]] || set -- drape "$@"
case $1 in
  list | law | fit | diff | report) exec "$build_folder/hysteron" "$@" ;;
esac

[[ -n $(out_of "$@") ]] || set -- "$@" --out "$root/out/$1"
exec "$build_folder/hysteron" "$@"
