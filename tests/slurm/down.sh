#!/usr/bin/env bash
# Ends the Slurm that `up.sh FOLDER PORT` started, by process ids.
folder=$1
pids() {
    for file in "$folder"/slurmd-*.pid "$folder"/slurmctld.pid "$folder"/munge/pid; do
        if [ -s "$file" ]; then cat "$file"; fi
    done
}
all=$(pids)
for pid in $all; do kill "$pid" 2>/dev/null; done
for _ in $(seq 40); do
    left=
    for pid in $all; do if kill -0 "$pid" 2>/dev/null; then left="$left $pid"; fi; done
    [ -z "$left" ] && exit 0
    sleep 0.25
done
for pid in $left; do kill -9 "$pid" 2>/dev/null; done
exit 0
