#!/usr/bin/env bash
# The same sweep of two shards as `shards.sh FOLDER`, in whose folder this works afterwards, on a Slurm of two virtual nodes that it starts on loopback:
# `nodes.sh FOLDER`, as root, with `taceva`, Slurm and `munge` on the path. It fails where the nodes do not give the same bytes, and prints seconds of the
# processor of planning, of both tasks and of collecting.
set -eu -o pipefail
cluster=$(mktemp -d)
slurm=$(cd "$(dirname "$0")/../../tests/slurm" && pwd)
trap 'bash "$slurm/down.sh" "$cluster"; rm -rf "$cluster"' EXIT
bash "$slurm/up.sh" "$cluster" 26817 </dev/null >/dev/null 2>&1
export SLURM_CONF=$cluster/slurm.conf
cd "$1"
rm -rf nodes.sweep
{ cat shards.toml; printf '[slurm]\npartition = "main"\ntime = "00:30:00"\nmemory = "200M"\n'; } > nodes.toml
TIMEFORMAT='%U %S'
processor() { { time bash -e -c "$1" >> said.txt 2>&1; } 2>&1 | awk '{ print $1 + $2 }'; }

# Submitted to a partition that starts nothing, so that the scripts can say what they took.
scontrol update PartitionName=main State=DOWN
plan=$(processor "taceva sweep nodes.toml --on slurm -q")
scancel --partition=main --state=PENDING
scontrol update PartitionName=main State=UP
{ sed 's/^exec //' nodes.sweep/slurm/tasks-1.sh; echo 'times > nodes.$SLURM_ARRAY_TASK_ID'; } > tasks.sh
sbatch --wait --exclusive tasks.sh >> said.txt
tasks=$(cat nodes.sweep/nodes.* | awk 'NR % 2 == 0' | tr 'ms' '  ' | awk '{ sum += 60 * $1 + $2 + 60 * $3 + $4 } END { print sum }')
collect=$(processor "taceva sweep collect nodes.sweep -q")
cmp shards.sweep/score.json nodes.sweep/score.json
echo "$plan $tasks $collect" | awk '{ printf "plan %.2f s, two tasks on two nodes %.2f s, collect %.2f s: %.2f s of the processor\n", $1, $2, $3, $1 + $2 + $3 }'
cut -d , -f 1,6,8 nodes.sweep/times.csv
