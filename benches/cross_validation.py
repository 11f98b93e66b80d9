#!/usr/bin/env python3
"""Time of a cross-validation with five folds, in multiples of the time of one split.

    cargo build --release -p taceva-cli
    python3 benches/cross_validation.py target/release/taceva DATASET [ROUNDS] [MODEL ...]

Each round evaluates one split and five folds in turn, without a cache. Nothing but the standard library is needed. Features are made once, so ridge
and PLS should take at most 2.2 times as long, any other model at most 5.3 times. The exit code is 1 if a model takes longer.
"""

import os
import resource
import statistics
import subprocess
import sys
import time

FOLDS = 5
# Greatest multiples: of models whose features cost more than their fit, and of others.
LINEAR, OTHER = 2.2, FOLDS + 0.3


def processor_s():
    """Processor time of all finished children, s."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def evaluated(program, dataset, model, split):
    """Wall and processor time of one evaluation, s."""
    command = [program, "evaluate", dataset, "--model", model, "--split", split, "--metrics", "mae", "--no-cache", "-q"]
    wall, processor = time.monotonic(), processor_s()
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return time.monotonic() - wall, processor_s() - processor


def main():
    program, dataset = sys.argv[1:3]
    rounds = int(sys.argv[3]) if len(sys.argv) > 3 else 5
    models = sys.argv[4:] or ["ridge", "pls", "knn"]
    print(f"load {os.getloadavg()[0]:.1f}, {rounds} rounds: median (range) of the ratio of {FOLDS} folds to one split")
    is_slow = False
    for model in models:
        ratios = {"wall": [], "processor": []}
        for _ in range(rounds):
            one = evaluated(program, dataset, model, "random")
            folds = evaluated(program, dataset, model, f"cv:{FOLDS} random")
            for name, single, several in zip(ratios, one, folds):
                ratios[name].append(several / single)
        most = LINEAR if model in ("ridge", "pls") else OTHER
        cells = [f"{name} {statistics.median(of):.2f} ({min(of):.2f} to {max(of):.2f})" for name, of in ratios.items()]
        print(f"{model}: {', '.join(cells)}; at most {most}")
        is_slow |= statistics.median(ratios["processor"]) > most
    return int(is_slow)


if __name__ == "__main__":
    sys.exit(main())
