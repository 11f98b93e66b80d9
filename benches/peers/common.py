"""What the peer scripts share: the program under test, and timing both sides in turn."""
import json
import os
import pathlib
import subprocess
import sys
import time

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
    """Times each side once a round, `repeats` rounds; returns seconds, best first."""
    times = {name: [] for name in sides}
    for _ in range(repeats):
        for name, side in sides.items():
            start = time.perf_counter()
            side()
            times[name].append(time.perf_counter() - start)
    return {name: sorted(seconds) for name, seconds in times.items()}


def report(times, ours):
    """Prints best and median of each side, and the ratio to ours."""
    middle = {name: seconds[len(seconds) // 2] for name, seconds in times.items()}
    for name, seconds in times.items():
        print(f"{name:<28} best {seconds[0]:8.3f} s   median {middle[name]:8.3f} s")
    for name in times:
        if name != ours:
            print(f"{name} / {ours}: best {times[name][0] / times[ours][0]:.1f}x, median {middle[name] / middle[ours]:.1f}x")


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
