#!/usr/bin/env bash
# What shards of two tables take, against one pass: a table of Markdown for docs/scale.md. `shards.sh FOLDER` works in an empty folder, with `taceva` on
# the path. It fails where the three ways do not give the same bytes. `ROWS` says of how many rows, a million otherwise.
set -eu -o pipefail
cd "$1"
rows=${ROWS:-1000000}
TIMEFORMAT='%U %S'

# Seconds of the processor.
processor() { { time bash -e -c "$1" >> said.txt 2>&1; } 2>&1 | awk '{ print $1 + $2 }'; }

awk -v rows="$rows" 'BEGIN {
    print "point_id,Px,Py,Pz,Fz" > "truth.csv"
    print "Px,Py,Pz,Fz" > "pred.csv"
    for (row = 0; row < rows; row++) {
        x = row % 10 - 4.5
        y = int(row / 10) % 10 - 4.5
        depth = 0.2 + 0.1 * (row % 4)
        force = depth * (1 + 0.02 * x)
        error = 0.01 * (row * 7919 % 13) - 0.06
        printf "p%d,%.1f,%.1f,%.1f,%.17g\n", row % 37, x, y, depth, force > "truth.csv"
        printf "%.17g,%.17g,%.17g,%.17g\n", x + error, y - error, depth + error / 9, force - error / 7 > "pred.csv"
    }
}'
cat > shards.toml << 'END'
sweep_version = 1
[score]
truth = "truth.csv"
pred = "pred.csv"
shards = 2
END
score="taceva score --truth truth.csv --pred pred.csv --jobs 1 -q"
one=$(processor "$score --format json > one.json")
two=$(processor "$score --shard 1/2 --state-out 1.state; $score --shard 2/2 --state-out 2.state
    taceva merge 1.state 2.state --format json -q > two.json")
sweep=$(processor "taceva sweep shards.toml --jobs 1 -q")
cmp one.json two.json
cmp one.json shards.sweep/score.json
case $(command -v taceva) in
    */release/*) build=release ;;
    *) build=debug ;;
esac
megabytes=$(cat truth.csv pred.csv | wc -c | awk '{ print $1 / 1e6 }')
printf 'Processor time of the %s build, one thread, one run each:\n\n' "$build"
echo "$one $two $sweep $megabytes $rows" | awk '{
    count = $5
    while (match(count, /[0-9][0-9][0-9][0-9]($|,)/)) count = substr(count, 1, RSTART) "," substr(count, RSTART + 1)
    printf "| %s rows of four channels, %.0f MB of CSV | processor time | relative to one pass |\n|---|---|---|\n", count, $4
    printf "| one pass | %.2f s | 1 |\n", $1
    printf "| two shards by hand, and `merge` | %.2f s | %.2f |\n", $2, $2 / $1
    printf "| a sweep of two shards, planned, scored and joined | %.2f s | %.2f |\n", $3, $3 / $1
    printf "| 1e8 rows in a sweep of any number of shards, computed | %.0f s | |\n", $3 * 1e8 / $5 }'
