"""What the peer scripts share: the program under test, and timing both sides in turn."""
import json
import os
import pathlib
import subprocess
import sys
import time

from machine import Machine, processor_seconds

ROOT = pathlib.Path(__file__).resolve().parents[2]


def taceva():
    """The release binary; built if it is not there."""
    target = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
    binary = target / "release" / "taceva"
    if not binary.exists():
        subprocess.run(["cargo", "build", "--release", "-p", "taceva-cli"], cwd=ROOT, check=True)
    return str(binary)


def run(*arguments):
    """Runs taceva and returns what it printed."""
    done = subprocess.run([taceva(), *map(str, arguments)], check=True, capture_output=True, text=True)
    return done.stdout


def evaluation(*arguments):
    """Runs taceva with JSON output and returns the evaluation."""
    return json.loads(run(*arguments, "--format", "json", "--quiet"))


def in_turn(repeats, **sides):
    """Times each side once a round, `repeats` rounds; returns seconds by the clock and of the processor, best first, by side, and the machine."""
    machine = Machine()
    times = {name: ([], []) for name in sides}
    for _ in range(repeats):
        for name, side in sides.items():
            clock, busy = time.perf_counter(), processor_seconds()
            side()
            for seconds, spent in zip(times[name], (time.perf_counter() - clock, processor_seconds() - busy)):
                seconds.append(spent)
    return {name: tuple(map(sorted, both)) for name, both in times.items()}, machine


def report(times, ours, machine):
    """Prints best and median of each side by the clock and of the processor, and the ratio to ours."""
    for name, both in times.items():
        clock, busy = ([seconds[0], seconds[len(seconds) // 2]] for seconds in both)
        print(f"{name:<28} best {clock[0]:8.3f} s   median {clock[1]:8.3f} s   of the processor {busy[0]:8.3f} s, {busy[1]:8.3f} s")
    for name, both in times.items():
        if name == ours:
            continue
        told = []
        for seconds, base in zip(both, times[ours]):
            middle = len(seconds) // 2
            told += [machine.ratio(seconds[0], base[0], 1), machine.ratio(seconds[middle], base[middle], 1)]
        print(f"{name} / {ours}: by the clock best {told[0]}x, median {told[1]}x; of the processor best {told[2]}x, median {told[3]}x")
    print(machine.said())


def need(*modules):
    """Ends with a reason where a peer is not installed."""
    missing = [module for module in modules if not _importable(module)]
    if missing:
        sys.exit(f"skipped: python3 has no {', '.join(missing)} (pip install numpy pandas scikit-learn pillow)")


def _importable(module):
    try:
        __import__(module)
        return True
    except ImportError:
        return False
