#!/usr/bin/env bash
# A study on a Slurm of one node, from Debian's packages, whose node dies twice: the second time the scheduler's client,
# Snakemake, dies with it and is started again.  The table must be that of `hysteron sweep`, but for the runs' times.
#   tests/slurm.sh [--install] [--hysteron PROGRAM] [STUDY [OUT]]
# STUDY is one of assets/studies or a file, bending-length unless named; OUT keeps the results.  Needs root.
# 77 (skipped) without the packages, which --install installs.
set -euo pipefail

here=$(cd "$(dirname "$(readlink -f "$0")")" && pwd -P)
packages=(slurmctld slurmd slurm-client munge snakemake)
hysteron=$here/../build/hysteron study=bending-length out=
while [[ $# -gt 0 ]]; do
  case $1 in
    --install) apt-get install -y -q --no-install-recommends "${packages[@]}" >&2 ;;
    --hysteron) hysteron=$(readlink -f "$2") && shift ;;
    *) if [[ -z ${named-} ]]; then study=$1 named=1; else out=$(readlink -f "$1"); fi ;;
  esac
  shift
done
for program in slurmctld slurmd sbatch munged snakemake; do
  command -v "$program" >/dev/null || { echo "$program is missing (apt-get install ${packages[*]}): skipped"; exit 77; }
done
[[ $(id -u) == 0 ]] || { echo "not root: skipped"; exit 77; }

scratch=$(mktemp -d)
out=${out:-$scratch/out}
export SLURM_CONF=$scratch/slurm.conf USER=${USER:-root}
controller='' node='' munge='' client=''

say() { echo "$(date +%T) $*"; }
stop_all() {
  for process in $client $node $controller $munge; do kill -9 "$process" 2>/dev/null || true; done
  wait 2>/dev/null || true
  rm -rf "$scratch"
}
trap stop_all EXIT

start_munge() {
  munge -n >/dev/null 2>&1 && return
  install -d -o munge -g munge /run/munge
  setpriv --reuid munge --regid munge --clear-groups munged --foreground --force >"$scratch/munged.log" 2>&1 &
  munge=$!
}

configure() {
  local memory cores host
  memory=$(($(free -m | awk '/^Mem/ {print $2}') * 3 / 4)) cores=$(nproc) host=$(hostname -s)
  mkdir "$scratch"/{state,spool}
  cat >"$SLURM_CONF" <<EOF
ClusterName=one
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
AuthType=auth/munge
StateSaveLocation=$scratch/state
SlurmdSpoolDir=$scratch/spool
SlurmctldPidFile=$scratch/slurmctld.pid
SlurmdPidFile=$scratch/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU_Memory
ReturnToService=2
SlurmdTimeout=10
InactiveLimit=0
MinJobAge=86400
SchedulerParameters=sched_interval=2
SlurmdParameters=config_overrides
NodeName=$host NodeAddr=127.0.0.1 CPUs=$cores RealMemory=$memory State=UNKNOWN
PartitionName=all Nodes=$host Default=YES MaxTime=INFINITE State=UP
EOF
}

# The node is a world of processes of its own, which dies as a whole.
start_node() {
  unshare --pid --fork --kill-child --mount-proc slurmd -D -L "$scratch/slurmd.log" >/dev/null 2>&1 &
  node=$!
}
kill_node() {
  kill -9 "$node"
  wait "$node" 2>/dev/null || true
}

wait_for() {  # SECONDS WHAT COMMAND...
  local seconds=$1 what=$2
  shift 2
  for ((i = 0; i < seconds; ++i)); do "$@" && return; sleep 1; done
  say "$what: not within $seconds s"
  tail -n 5 "$scratch"/*.log
  exit 1
}
node_is_up() { [[ $(sinfo -h -o %T 2>/dev/null) =~ ^(idle|mixed|allocated)$ ]]; }
finished() { find "$out/runs" -name outcome.json 2>/dev/null | wc -l; }
have_finished() { (($(finished) >= $1)) || ! kill -0 "$client" 2>/dev/null; }

start_client() {
  (cd "$scratch/flow" && exec snakemake --profile slurm) >>"$scratch/snakemake.log" 2>&1 &
  client=$!
}
# A client that was killed leaves its lock, and jobs whose end nobody would see.
restart_client() {
  scancel --user=root
  (cd "$scratch/flow" && snakemake --unlock) >/dev/null 2>&1
  start_client
}

without_times() { python3 -c '
import csv, sys
rows = list(csv.DictReader(open(sys.argv[1])))
for row in rows:
    print({key: value for key, value in row.items() if key != "wall_s"})' "$1"; }

start_munge
configure
slurmctld -D -L "$scratch/slurmctld.log" >/dev/null 2>&1 &
controller=$!
start_node
wait_for 60 "the node is up" node_is_up
sinfo

"$hysteron" sweep "$study" --out "$out" --snakemake "$scratch/flow"
jobs=$(python3 -c 'import json, sys; print(len(json.load(open(sys.argv[1]))["jobs"]))' "$scratch/flow/config.json")
runs=$("$hysteron" sweep "$study" --out "$out" --snakemake "$scratch/flow" | awk '{print $1}')
say "$runs runs in $jobs jobs"
start=$SECONDS
start_client
wait_for 3000 "a third of the runs" have_finished $((runs / 3))
say "$(finished) runs have ended: the node dies"
kill_node
sleep 3
start_node
wait_for 120 "the node is back" node_is_up
wait_for 3000 "two thirds of the runs" have_finished $((runs * 2 / 3))
say "$(finished) runs have ended: the node and Snakemake die"
kill -9 "$client"
kill_node
start_node
wait_for 120 "the node is back" node_is_up
restart_client
code=0
wait "$client" || code=$?
client=''
say "Snakemake ended with $code after $((SECONDS - start)) s, $(finished) runs have ended"
[[ $code == 0 ]] || { tail -n 40 "$scratch/snakemake.log"; exit 1; }
squeue -h --states=all -o '%T' | sort | uniq -c

"$hysteron" sweep "$study" --out "$scratch/alone" --no-images --quiet >/dev/null
say "sweep alone, on $(nproc) cores:$(grep overhead "$scratch/alone/manifest.json")"
diff <(without_times "$scratch/alone/table.csv") <(without_times "$out/table.csv")
say "the table is that of hysteron sweep: $(wc -l <"$out/table.csv") lines"
