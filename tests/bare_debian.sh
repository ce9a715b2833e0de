#!/usr/bin/env bash
# The two commands of the README as a new user runs them: on a bare Debian, made with debootstrap into a folder, from a
# clone of this checkout's commit.  Takes root, debootstrap and about 5 GB.
#   tests/bare_debian.sh bookworm|trixie [--keep] [COMMAND...]
# Without a COMMAND: experiments/run.sh, then tests/run.sh.  --keep leaves the folder for a look; else it is removed.
set -euo pipefail
root=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.." && pwd -P)
release=${1:?usage: tests/bare_debian.sh bookworm|trixie [--keep] [COMMAND...]}
shift
keep=
[[ ${1:-} != --keep ]] || { keep=yes && shift; }
[[ $# -gt 0 ]] || set -- experiments/run.sh '&&' tests/run.sh
[[ $(id -u) == 0 ]] || { echo "tests/bare_debian.sh makes a system of its own: it takes root" >&2 && exit 2; }
command -v debootstrap >/dev/null || { echo "tests/bare_debian.sh needs debootstrap" >&2 && exit 2; }

# Under /proc and /dev of the folder is the machine's own: they are mounted in a name space that ends with the command,
# so that nothing is mounted there when the folder is removed.
bare=$(mktemp -d "${TMPDIR:-/var/tmp}/hysteron-$release-XXXXXX")
remove() { if [[ -n $keep ]]; then echo "kept: $bare"; else rm -rf --one-file-system "$bare"; fi; }
trap remove EXIT

debootstrap --variant=minbase "$release" "$bare" >"$bare.log" || { tail "$bare.log" && exit 1; }
rm -f "$bare.log"
git clone -q "$root" "$bare/root/hysteron"
unshare --mount --pid --fork bash -c '
  set -e
  mount -t proc proc "$0/proc"
  mount --bind /dev "$0/dev"
  cp /etc/resolv.conf "$0/etc/resolv.conf"
  exec chroot "$0" /usr/bin/env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin TERM=dumb \
    bash -c "cd /root/hysteron && time { $1; }"' "$bare" "$*"
