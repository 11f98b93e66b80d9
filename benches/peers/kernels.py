"""Every way to sum, in Rust and in Python, on the same bytes: MAE, R² and sMAPE of six channels, one thread.

usage: python3 benches/peers/kernels.py [ROWS [REPEATS]]

The columns are simulated: truths even over each channel's range, errors of a bell. The Rust side is the example `kernel_times`
of taceva-metrics, run before and after the Python side; each way has one warm-up and then REPEATS rounds. Printed are
nanoseconds a pair, best and median, of the thread's processor time and of the wall clock, and how many times longer than our
fastest each takes. A peer that is not installed is skipped with the reason.
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

# One thread on both sides; these must be set before numpy is imported.
for variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[variable] = "1"

from common import ROOT, need  # noqa: E402
from machine import Machine  # noqa: E402

RANGES = [(-12.5, 12.5, 0.25), (-12.5, 12.5, 0.25), (0.0, 1.0, 0.03), (-0.7, 0.7, 0.025), (-0.7, 0.7, 0.025), (0.02, 1.83, 0.036)]
EPSILON = 1e-8
BATCH = 4096


def rust_times(columns, repeats):
    """What the example prints: name -> best and median of thread time, best and median of wall time."""
    command = ["cargo", "run", "--release", "--quiet", "-p", "taceva-metrics", "--example", "kernel_times", "--"]
    command += [str(columns), str(len(RANGES)), str(repeats)]
    return json.loads(subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout)


def timed(side, repeats, pairs):
    """Best and median nanoseconds a pair of the thread's processor time and of the wall clock."""
    side()
    busy, wall = [], []
    for _ in range(repeats):
        start, start_busy = time.perf_counter(), time.thread_time()
        side()
        busy.append(time.thread_time() - start_busy)
        wall.append(time.perf_counter() - start)
    return [sorted(clock)[at] * 1e9 / pairs for clock in (busy, wall) for at in (0, repeats // 2)]


def numpy_sides(numpy, truth, prediction):
    """numpy on channels in rows, and on channels in columns as tables come."""

    def scores(y, yhat, axis):
        d = y - yhat
        mae = numpy.abs(d).mean(axis)
        total = ((y - y.mean(axis, keepdims=True)) ** 2).sum(axis)
        r2 = 1 - (d**2).sum(axis) / total
        smape = (numpy.abs(d) / ((numpy.abs(y) + numpy.abs(yhat)) * 0.5 + EPSILON)).mean(axis)
        return mae, r2, smape

    by_row = numpy.ascontiguousarray(truth.T), numpy.ascontiguousarray(prediction.T)
    return {
        "numpy (6, n)": lambda: scores(truth, prediction, 1),
        "numpy (n, 6)": lambda: scores(*by_row, 0),
    }


def sklearn_sides(numpy, truth, prediction):
    try:
        from sklearn.metrics import mean_absolute_error, r2_score
    except ImportError:
        print("scikit-learn skipped: not installed (pip install scikit-learn)")
        return {}

    def scores():
        for y, yhat in zip(truth, prediction):
            mean_absolute_error(y, yhat)
            r2_score(y, yhat)
            # It has no sMAPE.
            (numpy.abs(y - yhat) / ((numpy.abs(y) + numpy.abs(yhat)) * 0.5 + EPSILON)).mean()

    return {"scikit-learn + numpy sMAPE": scores}


def torch_sides(truth, prediction):
    try:
        import torch
        from torchmetrics import MeanAbsoluteError, MetricCollection, R2Score, SymmetricMeanAbsolutePercentageError
    except ImportError as error:
        print(f"torchmetrics skipped: {error} (pip install torch torchmetrics)")
        return {}
    torch.set_num_threads(1)
    columns = [(torch.from_numpy(yhat), torch.from_numpy(y)) for y, yhat in zip(truth, prediction)]

    def scores():
        for yhat, y in columns:
            metrics = MetricCollection([MeanAbsoluteError(), R2Score(), SymmetricMeanAbsolutePercentageError()])
            metrics = metrics.set_dtype(torch.float64)
            for start in range(0, len(y), BATCH):
                metrics.update(yhat[start : start + BATCH], y[start : start + BATCH])
            metrics.compute()

    return {f"torchmetrics f64, batches of {BATCH}": scores}


def main(rows, repeats):
    need("numpy")
    import numpy

    random = numpy.random.default_rng(1)
    truth = numpy.stack([random.uniform(low, high, rows) for low, high, _ in RANGES])
    prediction = truth + numpy.stack([random.normal(0, 1.25 * noise, rows) for _, _, noise in RANGES])
    pairs = truth.size
    print(f"simulated columns: {len(RANGES)} channels x {rows} rows, {2 * truth.nbytes / 1e6:.0f} MB, {repeats} rounds")

    sides = numpy_sides(numpy, truth, prediction) | sklearn_sides(numpy, truth, prediction) | torch_sides(truth, prediction)
    with tempfile.TemporaryDirectory() as folder:
        columns = pathlib.Path(folder, "columns.f64")
        with open(columns, "wb") as file:
            for y, yhat in zip(truth, prediction):
                file.write(y.astype("<f8").tobytes())
                file.write(yhat.astype("<f8").tobytes())
        machine = Machine()
        before = rust_times(columns, repeats)
        peers = {name: timed(side, repeats, pairs) for name, side in sides.items()}
        after = rust_times(columns, repeats)

    ours = {name: [min(pair) for pair in zip(before[name], after[name])] for name in before}
    times = ours | peers
    alone = [name for name in times if name.endswith(" mae")]
    exact = [name for name in ours if name.startswith("exact") and name not in alone and "threads" not in name]
    fastest = min(exact, key=lambda name: times[name][0])
    floor = times["floor"]
    print(f"{'':<32}{'ns a pair, thread':>22}{'ns a pair, wall':>22}   thread time, best and median")
    for name, (best, median, wall_best, wall_median) in times.items():
        over_floor = f"{machine.ratio(best, floor[0]):>5} {machine.ratio(median, floor[1]):>5} x floor"
        over_ours = ""
        if name not in alone and name != "floor":
            over_ours = f"   {machine.ratio(best, times[fastest][0]):>5} {machine.ratio(median, times[fastest][1]):>5} x {fastest}"
        print(f"{name:<32}{best:>11.3f}{median:>11.3f}{wall_best:>11.3f}{wall_median:>11.3f}   {over_floor}{over_ours}")
    print(machine.said())


if __name__ == "__main__":
    arguments = [int(argument) for argument in sys.argv[1:]]
    if len(arguments) > 2:
        sys.exit(__doc__)
    main(*(arguments + [1_000_000, 15][len(arguments) :]))
