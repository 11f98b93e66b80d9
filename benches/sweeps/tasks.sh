#!/usr/bin/env bash
# What a sweep takes beside its tasks: a table of Markdown for docs/scale.md. `tasks.sh FOLDER` works in an empty folder, from the workspace, with
# `taceva` and `make_recording` on the path.
set -eu -o pipefail
sweep=$PWD/examples/sweeps/which-model.toml
cd "$1"
TIMEFORMAT='%R %U %S'

# Seconds of the wall, of the program and of the system.
timed() { { time "$@" >> said.txt 2>&1; } 2>&1; }

# The numbers of a sweep with the seeds 1 to $1, a line each.
column() {
    sed "s/\"1-3\"/\"1-$1\"/" "$sweep" > "$1.toml"
    local whole again collect seconds sets bytes tasks
    whole=$(timed taceva sweep "$1.toml" --jobs 2 -q)
    again=$(timed taceva sweep "$1.toml" --jobs 2 -q)
    collect=$(timed taceva sweep collect "$1.toml" -q)
    seconds=$(tail -n +2 "$1.sweep/times.csv" | cut -d, -f 6 | awk '{ sum += $1 } END { print sum / 2 }')
    sets=$(ls "$1".sweep/cache/*/features | wc -l)
    bytes=$(cat "$1".sweep/results/* "$1".sweep/evaluations/* | wc -c)
    tasks=$(ls "$1.sweep/results" | wc -l)
    echo "$whole $again $collect $seconds $sets $bytes $tasks" | awk '{
        printf "%d tasks\n---\n%.1f s\n%.1f s\n%.1f ms\n", $13, $1, $10, ($1 - $10) * 1000 / $13
        printf "%.2f s (processor time %.2f s)\n%.2f s\n", $7, $8 + $9, $4
        printf "%d\n%.1f MB\n%.0f MB\n", $11, $12 / 1e6, $12 / $13 / 100 }'
}

make_recording monday 40 1 > made.txt
make_recording tuesday 40 2 >> made.txt
column 3 > few.txt
column 30 > many.txt
cat > what.txt << 'END'
measured
---
the whole sweep
tasks only (`times.csv`), divided by two workers
other time of the sweep, per task
`sweep collect` only: table, pages, tests
the same command again
sets of features computed
results and evaluations on disk
the same for 10,000 tasks, computed from these
END
case $(command -v taceva) in
    */release/*) build=release ;;
    *) build=debug ;;
esac
printf 'Measured with the %s build on %d processors, two tasks at once, one run each:\n\n' "$build" "$(nproc)"
paste -d '|' what.txt few.txt many.txt | sed 's/|/ | /g; s/^/| /; s/$/ |/; s/ --- /---/g'
