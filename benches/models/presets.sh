#!/usr/bin/env bash
# What presets take and give on a recording: a table of Markdown for docs/models.md, a line for each: processor seconds of the fit (user and system),
# the mean R² on the validation part, by which alone a preset may be chosen, and R² with intervals on the test part.
#
#     presets.sh RECORDING SPLIT CHANNELS MODEL…      presets.sh tactip chronological Fx,Fy,Fz fast default best auto
#
# `taceva` and `table_row` (`cargo build --release -p taceva-cli -p taceva-tests --bins`) are on the path. A model with settings is one word, `cnn:epochs=67`.
set -eu -o pipefail
recording=$1 split=$2 channels=$3
shift 3
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
TIMEFORMAT='%U %S'
read -ra scores <<<"r2:${channels//,/ r2:}"

echo "| model | processor s | validation, mean R² |$(printf ' R² %s |' ${channels//,/ })"
echo "|---|---|---|$(printf -- '---|%.0s' ${channels//,/ })"
for model in "$@"; do
    read -ra settings <<<"$(tr ':,' '  ' <<<"$model" | sed 's/ \([^ ]*=\)/ --set \1/g')"
    { time taceva fit "$recording" --no-cache --quiet --split "$split" --channels "$channels" --out "$out/$model.model" \
        --model "${settings[@]}" >"$out/fit.txt" 2>"$out/error.txt" || { cat "$out/error.txt" >&2; exit 1; }; } 2>"$out/time.txt"
    seconds=$(awk '{ printf "%.0f", $1 + $2 }' "$out/time.txt")
    # `| R² with its interval | …`
    row() { taceva evaluate "$recording" --no-cache --quiet --format csv --metrics r2 --with "$out/$model.model" "$@" | table_row x "${scores[@]}" | sed 's/^| x //'; }
    # Not every division leaves a validation part.
    validation=$({ row --part validation 2>/dev/null || true; } | tr '|' '\n' | awk 'NF { sum += $1; n++ } END { if (n) printf "%.3f", sum / n; else printf "–" }')
    echo "| \`$model\` | $seconds | $validation $(row)"
done
