#!/bin/sh
# Times and sizes of bundles, catalogues, budgets and gauge studies, each with its limit. Fails beyond a limit.
#   benches/bundles/limits.sh [RUN]      RUN: the folder of `taceva run`; without it, the default run is made first
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failed=0

# limited WHAT LIMIT_MS COMMAND...
limited() {
    what=$1 limit=$2
    shift 2
    begin=$(date +%s%N)
    "$@" >"$folder/said" 2>&1 || { cat "$folder/said" && exit 1; }
    held "$what" "$((($(date +%s%N) - begin) / 1000000))" "$limit" ms
}

# held WHAT FOUND MOST UNIT
held() {
    printf '%-52s %10s %s, at most %s\n' "$1" "$2" "$4" "$3"
    [ "$2" -le "$3" ] || failed=1
}

run=${1:-}
if [ -z "$run" ]; then
    run=$folder/run
    taceva run --out "$run" -q
fi
limited "bundle of a run" 3000 taceva bundle "$run" --draft --out "$folder/run.tar.gz" -q
held "size of that bundle" "$(wc -c <"$folder/run.tar.gz")" 5000000 bytes
taceva bundle verify "$folder/run.tar.gz"

# Eight sources, no one of which is normal, so that the draws decide.
{
    printf 'budget_version = 1\nmeasurand = "Fz"\nat = ["1 N"]\n'
    for source in 1 2 3 4 5 6 7 8; do
        printf '[[source]]\nname = "s%s"\nhalf_width = "%s mN"\nshape = "rectangular"\n' "$source" "$source"
    done
} >"$folder/budget.toml"
limited "10^6 draws of 8 sources on one core" 500 taceva budget "$folder/budget.toml" --mc 1000000 --jobs 1 -q

awk 'BEGIN { srand(7); print "part,unit,trial,Fz"
    for (part = 0; part < 1000; part++) for (unit = 0; unit < 10; unit++) for (trial = 0; trial < 100; trial++)
        printf "%d,%d,%d,%.6f\n", part, unit, trial, 0.01 * part + 0.002 * unit + 0.01 * rand() }' >"$folder/gauge.csv"
limited "gauge study of 10^6 rows" 1000 \
    taceva gauge "$folder/gauge.csv" --part part --by unit --trial trial --channels Fz -q

printf 'model = "Foo"\n' >"$folder/sensor.toml"
awk 'BEGIN { print "id,point_id,Fz"; for (row = 0; row < 120; row++) printf "%d,p%d,%g\n", row, row % 12, 0.2 + row % 5 / 10 }' \
    >"$folder/truth.csv"
number=0
while [ "$number" -lt 30 ]; do
    number=$((number + 1))
    awk -v error="$number" 'BEGIN { print "id,Fz"
        for (row = 0; row < 120; row++) printf "%d,%g\n", row, 0.2 + row % 5 / 10 + error * (row * 7919 % 13 - 6) / 1e4 }' >"$folder/pred.csv"
    set -- --truth "$folder/truth.csv" --pred "$folder/pred.csv"
    taceva score "$@" --sensor "$folder/sensor.toml" --format json --out "$folder/r$number.json" --state-out "$folder/r$number.state" -q
    taceva bundle "$folder/r$number.json" --state "$folder/r$number.state" "$@" --author Ada --licence CC-BY-4.0 --out "$folder/b$number" -q
done
catalogued() {
    for bundle in "$folder"/b[0-9]*; do
        taceva catalogue add "$bundle" --to "$folder/catalogue" -q
    done
    taceva catalogue check "$folder/catalogue" -q
    taceva catalogue site "$folder/catalogue" --out "$folder/site" -q
}
limited "30 bundles added, checked and shown" 5000 catalogued
exit "$failed"
