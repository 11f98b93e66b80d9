"""`taceva score` against pandas + scikit-learn, both from two CSV files to printed scores, in turn.

usage: python3 benches/peers/score.py [ROWS]

The tables hold six channels and a point_id. The peer computes MAE, R² and sMAPE, without intervals.
"""
import pathlib
import subprocess
import sys
import tempfile

from common import in_turn, need, report, run

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


def main(rows):
    need("numpy", "pandas", "sklearn")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        write(folder, rows)
        truth, pred = folder / "truth.csv", folder / "pred.csv"
        megabytes = (truth.stat().st_size + pred.stat().st_size) / 1e6
        print(f"{rows} rows x 6 channels, {megabytes:.0f} MB")

        def peer():
            subprocess.run([sys.executable, "-c", PEER, truth, pred], check=True, stdout=subprocess.DEVNULL)

        times, machine = in_turn(
            5,
            **{
                "taceva, all metrics": lambda: run("score", "--truth", truth, "--pred", pred, "--quiet"),
                "taceva, accuracy": lambda: run("score", "--truth", truth, "--pred", pred, "--metrics", "accuracy", "--quiet"),
                "pandas + scikit-learn": peer,
            },
        )
        report(times, "taceva, all metrics", machine)


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 1_000_000)
