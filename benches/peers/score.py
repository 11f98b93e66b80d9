"""`taceva score` against pandas + scikit-learn, both from two CSV files to printed scores, in turn: time, and peak resident memory.

usage: python3 benches/peers/score.py [ROWS]

The tables hold six channels and a point_id. The peer computes MAE, R² and sMAPE, without intervals.

A process begins with the peak of the one that starts it, so this one stays small: others draw the tables and import the peer.
"""
import importlib.util
import os
import pathlib
import subprocess
import sys
import tempfile

from common import in_turn, need, report, taceva

MODULES = ("numpy", "pandas", "sklearn")
WRITE = "--write"

PEER = """
import sys, pandas
from sklearn.metrics import mean_absolute_error, r2_score
truth, pred = pandas.read_csv(sys.argv[1]), pandas.read_csv(sys.argv[2])
for channel in ("Px", "Py", "Pz", "Fx", "Fy", "Fz"):
    y, yhat = truth[channel].to_numpy(), pred[channel].to_numpy()
    size = (abs(y) + abs(yhat)) * 0.5 + 1e-8
    print(channel, mean_absolute_error(y, yhat), r2_score(y, yhat), (abs(y - yhat) / size).mean())
"""


def write(folder, rows):
    """Two tables as a lab would write them: positions to 4 decimals, forces to 6."""
    import numpy
    import pandas

    rng = numpy.random.default_rng(1)
    scale = {"Px": (12.5, 4), "Py": (12.5, 4), "Pz": (1.0, 4), "Fx": (0.7, 6), "Fy": (0.7, 6), "Fz": (1.8, 6)}
    truth, pred = {}, {}
    for name, (size, digits) in scale.items():
        y = rng.uniform(-size, size, rows)
        truth[name] = y.round(digits)
        pred[name] = (y + rng.normal(0, 0.03 * size, rows)).round(digits)
    point = [f"p{row // 4}" for row in range(rows)]
    pandas.DataFrame({"point_id": point} | truth).to_csv(folder / "truth.csv", index=False)
    pandas.DataFrame(pred).to_csv(folder / "pred.csv", index=False)


class Peaks:
    """The greatest resident memory of each side, in bytes."""

    def __init__(self):
        self.of_side = {}

    def run(self, side, command):
        """Runs a command to its end, and keeps how much memory it held at most."""
        process = subprocess.Popen([*map(str, command)], stdout=subprocess.DEVNULL)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode:
            sys.exit(f"{side}: failed with {process.returncode}")
        # Linux counts in KiB.
        self.of_side[side] = max(self.of_side.get(side, 0), usage.ru_maxrss * 1024)

    def print(self):
        for side, peak in self.of_side.items():
            print(f"{side:<28} peak resident memory {peak / 1e6:6.0f} MB")


def main(rows):
    missing = [module for module in MODULES if importlib.util.find_spec(module) is None]
    need(*missing)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        subprocess.run([sys.executable, __file__, WRITE, folder, str(rows)], check=True)
        truth, pred = folder / "truth.csv", folder / "pred.csv"
        megabytes = (truth.stat().st_size + pred.stat().st_size) / 1e6
        print(f"{rows} rows x 6 channels, {megabytes:.0f} MB")
        score = [taceva(), "score", "--truth", truth, "--pred", pred, "--quiet"]
        commands = {
            "taceva, all metrics": score,
            "taceva, accuracy": [*score, "--metrics", "accuracy"],
            "pandas + scikit-learn": [sys.executable, "-c", PEER, truth, pred],
        }
        peaks = Peaks()
        sides = {side: lambda side=side, command=command: peaks.run(side, command) for side, command in commands.items()}
        times, machine = in_turn(5, **sides)
        report(times, "taceva, all metrics", machine)
        peaks.print()


if __name__ == "__main__":
    if WRITE in sys.argv:
        write(pathlib.Path(sys.argv[2]), int(sys.argv[3]))
    else:
        main(int(sys.argv[1]) if len(sys.argv) > 1 else 1_000_000)
