#!/usr/bin/env python3
"""Degradation of two models by twelve faults on the four simulated sensors, five seeds, for docs/faults.md.

    python3 benches/stress/table.py [SEEDS]      with `taceva` on the path

Each seed acquires the default study, fits `ridge` and `cnn` on the training part of each sensor and scores the test part by `taceva stress`.
A cell has the degradation of Fz at severities 1, 3 and 5: the geometric mean over seeds. `–` is a severity that no parameter of the fault reaches.
Nothing but the standard library is needed. The last lines count ordered stimuli and degradations, for all cells and for each fault with an exception. They
name the faults that `check` does not notice by model, each with the number of recordings and the greatest stimulus of these. The processor time of a sensor
goes to standard error.
"""

import json
import math
import resource
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

MODELS = ["ridge", "cnn"]
# Settings of the network in the default study.
SETTINGS = "local_mean=0 contrast=false jitter=0 noise=0"
LIT = f"color=rgb difference=true {SETTINGS}"
CNN = {
    "vitactip": f"size=48x48 color=gray epochs=40 {SETTINGS}",
    "magictac": f"size=32x32 epochs=40 {LIT}",
    "gelsight": f"size=32x32 epochs=40 {LIT}",
    "gelsightwm": f"size=40x40 epochs=80 {LIT}",
}
SEVERITIES = [1, 3, 5]
CHANNEL = "Fz"


def taceva(*words):
    ran = subprocess.run(["taceva", *map(str, words), "--quiet"], capture_output=True, text=True)
    if ran.returncode != 0:
        sys.exit(f"taceva {' '.join(map(str, words))}: exit code {ran.returncode}\n{ran.stdout}{ran.stderr}")


def processor_s():
    """Processor time of all finished children, s."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def stressed(recording, model, folder):
    """Result of `taceva stress`, and its processor time."""
    fitted, result = folder / "m.taceva", folder / "s.json"
    settings = CNN[recording.name.split("-")[1]].split() if model == "cnn" else []
    words = [word for setting in settings for word in ("--set", setting)]
    taceva("fit", recording, "--model", model, *words, "--out", fitted, "--force")
    began = processor_s()
    taceva("stress", recording, "--model", fitted, "--format", "json", "--out", result, "--force")
    return json.loads(result.read_text()), processor_s() - began


def degradation(severity):
    """Degradation with the untouched picture of before, and its interval; `None` if it is undefined."""
    of = severity["stale"][CHANNEL]["degradation"]
    return (of["value"], of["ci95"]) if of["value"] else None


def geometric(values):
    return math.exp(statistics.mean(map(math.log, values)))


def short(value):
    return f"{value:.0f}" if value >= 9.95 else f"{value:.1f}"


def counts(pairs):
    """Number of true pairs, for all faults and for each fault with a false one."""
    whole = [pair for of in pairs.values() for pair in of]
    partial = [f"`{fault}` {sum(of)} of {len(of)}" for fault, of in pairs.items() if not all(of)]
    share = f"{sum(whole)} of {len(whole)} ({100 * sum(whole) / max(len(whole), 1):.1f} %)"
    return share + (f"; {', '.join(partial)}" if partial else "")


def main():
    seeds = range(1, (int(sys.argv[1]) if len(sys.argv) > 1 else 5) + 1)
    cells, recovered, sensors, faults, seconds = {}, {}, [], {}, []
    unnoticed = {model: {} for model in MODELS}
    # By fault, for each compared pair of severities: True if the higher one has the greater number.
    ordered, growing = {}, {}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for seed in seeds:
            run = folder / f"run{seed}"
            taceva("run", "--seed", seed, "--model", "baseline", "--out", run, "--no-cache")
            for recording in sorted((run / "recordings").iterdir()):
                for model in MODELS:
                    result, took = stressed(recording, model, folder)
                    seconds.append(took)
                    sensor = result["subject"]["sensor"]
                    if sensor not in sensors:
                        sensors.append(sensor)
                    for fault in result["faults"]:
                        faults[fault["id"]] = True
                        key = (model, sensor, fault["id"])
                        of = {severity["severity"]: severity for severity in fault["severities"]}
                        for at, severity in of.items():
                            found = degradation(severity)
                            if found and at in SEVERITIES:
                                cells.setdefault((*key, at), []).append(found[0])
                            before = of.get(at - 1)
                            if before is None:
                                continue
                            is_ordered = severity["stimulus"] > before["stimulus"]
                            ordered.setdefault(fault["id"], []).append(is_ordered)
                            earlier = degradation(before)
                            if found and earlier:
                                # Within intervals: the upper end is not below the value of before.
                                is_growing = found[1] is None or found[1][1] >= earlier[0]
                                growing.setdefault(fault["id"], []).append(is_growing)
                        share = (fault["recovers"] or {}).get(CHANNEL, {}).get("value")
                        if share is not None:
                            recovered.setdefault(key, []).append(share)
                    tested = {
                        (fault["id"], severity["severity"]): severity["stimulus"]
                        for fault in result["faults"]
                        for severity in fault["severities"]
                    }
                    for one in result["unnoticed"]:
                        if one["channel"] == CHANNEL:
                            stimulus = tested[one["fault"], one["severity"]]
                            unnoticed[model].setdefault(one["fault"], []).append((stimulus, recording))
    for model in MODELS:
        print(f"| {model}: fault | {' | '.join(sensors)} |")
        print("|---|" + "---|" * len(sensors))
        for fault in faults:
            row = []
            for sensor in sensors:
                values = [cells.get((model, sensor, fault, at)) for at in SEVERITIES]
                cell = " ".join(short(geometric(of)) if of else "–" for of in values)
                shares = recovered.get((model, sensor, fault))
                if shares:
                    cell += f" ({100 * statistics.median(shares):.0f} %)"
                row.append(cell)
            print(f"| `{fault}` | {' | '.join(row)} |")
        print()
    above = f"Stimulus greater than at the next lower severity: {counts(ordered)}."
    print(f"{above} Degradation at least as great as at the next lower severity, within intervals: {counts(growing)}.")
    print()
    count = len(seconds) // len(MODELS)
    print(f"Faults that double the error of {CHANNEL} while check finds nothing, with the number of such recordings of {count} and the greatest stimulus:")
    print()
    for model in MODELS:
        found = sorted(unnoticed[model].items())
        words = [f"`{fault}` ({len({at for _, at in of})}, {max(of)[0]:.2g})" for fault, of in found]
        print(f"- {model}: {', '.join(words) or 'none'}.")
    print(f"Processor time of all faults and severities, a sensor: {statistics.median(seconds):.1f} s, at most {max(seconds):.1f} s.", file=sys.stderr)


if __name__ == "__main__":
    main()
