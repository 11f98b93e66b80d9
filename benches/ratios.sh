#!/usr/bin/env bash
# Every target of speed as a ratio, of this program to an earlier one or to a peer, both in turn.
#
#   benches/ratios.sh EARLIER [ROW...]     EARLIER: the program of the commit to compare with, `-` for none; without ROW, all rows
#
# Rows: study, paper, build, training, single, slip, gpu, score, update, wheel, sums, video. A row whose program or peer is absent prints what it
# needs. ROUNDS (3) rounds each. Rounds that differ by more than 10 % are printed as a range marked `busy`: such a figure belongs in no document.
# The rows of the last call stand in $CARGO_TARGET_DIR/ratios.tsv; the column `last` shows them. EARLIER is built by
#
#   git worktree add ../earlier 9ba5d130 && (cd ../earlier && cargo build --release -p taceva-cli)
set -euo pipefail
cd "$(dirname "$0")/.."

earlier=${1:?the program of the commit to compare with, or - for none}
shift
rows=${*:-study paper build training single slip gpu score update wheel sums video}
rounds=${ROUNDS:-3}
target=${CARGO_TARGET_DIR:-target}
mkdir -p "$target"
kept=$target/ratios.tsv
[ "$earlier" = - ] || earlier=$(realpath "$earlier")
cargo build --release --quiet -p taceva-cli
program=$(realpath "$target")/release/taceva
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# row WHAT RELATION TARGET VALUE...: one line, RELATION `<=` or `>=`, a value each round.
row() {
    local what=$1 relation=$2 wanted=$3
    shift 3
    local last
    last=$(awk -F '\t' -v what="$what" '$1 == what { print $2 }' "$kept" 2>/dev/null || true)
    printf '%s\n' "$@" | sort -g | awk -v what="$what" -v relation="$relation" -v wanted="$wanted" -v last="${last:--}" -v kept="$kept.new" '
        { value[NR] = $1 }
        END {
            middle = value[int((NR + 1) / 2)]; least = value[1]; most = value[NR]
            busy = most > 1.1 * least
            met = relation == "<=" ? middle <= wanted : middle >= wanted
            printf "%-58s %8.2f  %-22s %s %-6s %-4s last %s\n", what, middle, sprintf("(%.2f to %.2f)%s", least, most, busy ? " busy" : ""), relation, wanted, met ? "met" : "not", last
            printf "%s\t%.2f\n", what, middle >> kept
        }'
}

absent() { printf '%-58s %s\n' "$1" "not measured: $2"; }

# used COMMAND...: its processor time, user and system, s. What the command prints is dropped.
used() {
    local TIMEFORMAT='%U %S'
    { time "$@" >/dev/null 2>&1; } 2>&1 | awk '{ print $1 + $2 }'
}

over() { awk -v one="$1" -v other="$2" 'BEGIN { print one / other }'; }

# Mean logarithmic width of the intervals of MAE: all sensors by Pz, Fz, Pxy, Fxy.
width() {
    python3 - "$1/results.json" <<'PYTHON'
import json, math, sys
widths = []
for study in json.load(open(sys.argv[1]))["studies"]:
    for channel in ("Pz", "Fz", "Pxy", "Fxy"):
        ends = study["metrics"].get("mae", {}).get(channel, {}).get("ci95")
        if ends and ends[0] > 0:
            widths.append(math.log(ends[1] / ends[0]))
print(sum(widths) / len(widths))
PYTHON
}

study() {
    if [ "$earlier" = - ]; then absent "default study" "no earlier program"; return; fi
    local times=() widths=() equal=() sizes=()
    local round ours theirs narrower
    for round in $(seq "$rounds"); do
        rm -rf "$folder/ours" "$folder/theirs"
        ours=$(used env XDG_CACHE_HOME="$folder/ours/cache" "$program" run --out "$folder/ours/run" -q)
        theirs=$(used env XDG_CACHE_HOME="$folder/theirs/cache" "$earlier" run --out "$folder/theirs/run" -q)
        times+=("$(over "$ours" "$theirs")")
        narrower=$(over "$(width "$folder/ours/run")" "$(width "$folder/theirs/run")")
        widths+=("$narrower")
        # A width falls with the root of the number of places, and time grows with that number.
        equal+=("$(awk -v time="${times[-1]}" -v width="$narrower" 'BEGIN { print time * width * width }')")
        sizes+=("$(du -sm "$folder/ours" | cut -f 1)")
    done
    row "default study: processor time" '<=' 1 "${times[@]}"
    row "default study: logarithmic width of intervals of MAE" '<=' 0.5 "${widths[@]}"
    row "default study: processor time at the earlier width" '<=' 0.35 "${equal[@]}"
    row "default study: disk with its cache, MB" '<=' 80 "${sizes[@]}"
}

paper() {
    local times=() round
    for round in $(seq "$rounds"); do
        times+=("$(used "$program" run paper --no-cache --out "$folder/paper" -q)")
        rm -rf "$folder/paper"
    done
    row "run paper: processor time, s" '<=' 430 "${times[@]}"
}

build() {
    if [ "$earlier" = - ]; then absent "build from a bare clone" "no earlier program"; return; fi
    local there times=() round ours theirs
    there=$(git -C "$(dirname "$earlier")" rev-parse --show-toplevel 2>/dev/null || true)
    if [ -z "$there" ] || [ "$there" = "$PWD" ]; then absent "build from a bare clone" "EARLIER does not lie in the clone that made it"; return; fi
    for round in $(seq "$rounds"); do
        ours=$(used env CARGO_TARGET_DIR="$folder/build" cargo build --release --locked -p taceva-cli)
        rm -rf "$folder/build"
        theirs=$(cd "$there" && used env CARGO_TARGET_DIR="$folder/build" cargo build --release --locked -p taceva-cli)
        rm -rf "$folder/build"
        times+=("$(over "$ours" "$theirs")")
    done
    row "build from a bare clone: processor time" '<=' 0.5 "${times[@]}"
}

# wall NAME: images per second by the clock, of the line that begins with NAME.
wall() { awk -v name="$1" 'index($0, name) { for (at = 1; at <= NF; at++) if ($at == "images/s") { print $(at - 1); exit } }'; }

with_torch() { python3 -c 'import torch, onnxruntime' 2>/dev/null; }

training() {
    if ! with_torch; then absent "training : PyTorch" "python3 has no torch or onnxruntime"; return; fi
    local side threads pins round here there wanted
    for side in 64 112; do
        for threads in 1 2; do
            local steps=() batches=()
            pins=0; [ "$threads" = 1 ] || pins=0,1
            for round in $(seq "$rounds"); do
                here=$(taskset -c "$pins" cargo bench --quiet -p taceva-network -- "$side" "$threads" 4 mixed 2>/dev/null)
                there=$(taskset -c "$pins" python3 benches/peers/torch_network.py "$side" "$threads" 4)
                steps+=("$(over "$(wall training <<<"$here")" "$(wall 'channels_last, training' <<<"$there")")")
                batches+=("$(over "$(wall inference <<<"$here")" "$(wall 'ONNX Runtime, inference' <<<"$there")")")
            done
            case $side.$threads in 64.1) wanted=2.5 ;; 64.2) wanted=2.2 ;; 112.1) wanted=2.0 ;; *) wanted=1.8 ;; esac
            row "training : PyTorch, ${side}², threads $threads" '>=' "$wanted" "${steps[@]}"
            row "batches : ONNX Runtime, ${side}², threads $threads" '>=' 1.8 "${batches[@]}"
        done
    done
}

single() {
    if ! with_torch; then absent "one picture : ONNX Runtime" "python3 has no torch or onnxruntime"; return; fi
    local side threads pins round here there wanted
    for side in 64 112; do
        for threads in 1 2; do
            local pictures=()
            pins=0; [ "$threads" = 1 ] || pins=0,1
            for round in $(seq "$rounds"); do
                here=$(taskset -c "$pins" cargo bench --quiet -p taceva-network -- "$side" "$threads" 30 mixed single 2>/dev/null)
                there=$(taskset -c "$pins" python3 benches/peers/torch_network.py "$side" "$threads" 4)
                pictures+=("$(over "$(wall 'one picture' <<<"$here")" "$(wall 'one picture' <<<"$there")")")
            done
            case $side.$threads in 64.1) wanted=1.6 ;; 64.2 | 112.1) wanted=1.5 ;; *) wanted=1.4 ;; esac
            row "one picture : ONNX Runtime, ${side}², threads $threads" '>=' "$wanted" "${pictures[@]}"
        done
    done
}

slip() {
    if ! python3 -c 'import torch' 2>/dev/null; then absent "training on windows : PyTorch" "python3 has no torch"; return; fi
    local ratios=() round
    for round in $(seq "$rounds"); do
        ratios+=("$(python3 benches/models/slip_windows.py 1 20 --anyway | sed -n 's|^images/s .*here : PyTorch \([0-9.]*\) .*|\1|p')")
    done
    row "training on windows of frames : PyTorch, one thread" '>=' 1.5 "${ratios[@]}"
}

gpu() { absent "training on a GPU : PyTorch" "cargo run --release -p taceva-network --features gpu --example speed, on a machine with a GPU"; }

score() {
    local ratios=() round
    for round in $(seq "$rounds"); do
        ratios+=("$(python3 benches/peers/score.py --anyway | sed -n 's|^pandas.* / .*processor best \([0-9.]*\)x.*|\1|p')")
    done
    row "score of every metric : pandas + scikit-learn, processor time" '>=' 6 "${ratios[@]}"
}

update() {
    if ! python3 -c 'import taceva, numpy' 2>/dev/null; then absent "Python update : Rust" "python3 has no taceva wheel"; return; fi
    local ratios=() round
    for round in $(seq "$rounds"); do
        ratios+=("$(python3 benches/peers/python_update.py --anyway | awk '/^update, all at once \/ Rust/ { for (at = 1; at <= NF; at++) if ($at == "(bar") print $(at - 1) }')")
    done
    row "Python update : the same sums in Rust, processor time" '<=' 1.3 "${ratios[@]}"
}

wheel() {
    local wheels
    wheels=$(find "$target/wheels" -name 'taceva-*.whl' 2>/dev/null | head -n 1 || true)
    if [ -z "$wheels" ]; then absent "wheel, MB" ".ci/wheel makes none in $target/wheels"; return; fi
    row "wheel, MB" '<=' 10 "$(du -b "$wheels" | awk '{ print $1 / 1e6 }')"
}

sums() { absent "sums : floor of memory" "taceva bench kernels prints it"; }

video() {
    if ! python3 -c 'import av, numpy, PIL' 2>/dev/null; then absent "import of H.264, AV1 : PyAV" "python3 has no av, numpy or Pillow"; return; fi
    cargo build --release --quiet -p taceva-video --features av1 --examples
    local h264=() av1=() round said
    for round in $(seq "$rounds"); do
        said=$(python3 benches/peers/video.py "$target/release/examples" --runs 3 --anyway)
        h264+=("$(awk '/^h264/ { print $(NF - 1) }' <<<"$said")")
        av1+=("$(awk '/^av1/ { print $(NF - 1) }' <<<"$said")")
    done
    row "import of H.264 : PyAV, processor time" '<=' 1.2 "${h264[@]}"
    row "import of AV1 : PyAV, processor time" '<=' 1.2 "${av1[@]}"
}

rm -f "$kept.new"
echo "$(git rev-parse --short HEAD), $(uname -m), $(nproc) processors, $(awk -F ': ' '/^model name/ { print $2; exit }' /proc/cpuinfo), load $(cut -d ' ' -f 1-3 /proc/loadavg), $rounds rounds"
for one in $rows; do
    case $one in
    study | paper | build | training | single | slip | gpu | score | update | wheel | sums | video) "$one" ;;
    *) echo "no row \`$one\`: study, paper, build, training, single, slip, gpu, score, update, wheel, sums, video" >&2 && exit 2 ;;
    esac
done
echo "load at the end $(cut -d ' ' -f 1-3 /proc/loadavg)"
if [ -f "$kept.new" ]; then
    # Rows of this call replace those of the last one.
    if [ -f "$kept" ]; then awk -F '\t' 'NR == FNR { there[$1]; next } !($1 in there)' "$kept.new" "$kept" >>"$kept.new"; fi
    mv "$kept.new" "$kept"
fi
