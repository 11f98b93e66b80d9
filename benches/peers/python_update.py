"""The Python package against the Rust calls that it makes, scikit-learn and torchmetrics: ratios of processor time, both sides in turn.

usage: python benches/peers/python_update.py [ROWS]

To be run by a Python that has the release wheel installed, and numpy; `TACEVA_CALL_TIMES` names another build of the program that makes the calls from
Rust, which must be of the profile of the wheel. scikit-learn and torchmetrics are skipped where they are absent. Prints the load
of the machine before and after: processor time is compared, of all threads of a side, since other work lengthens time by the clock alone.
"""
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
import time

from common import ROOT, _importable, need
from machine import Machine

ROUNDS = 5
MACHINE = Machine()


def example():
    """The program that makes the calls from Rust; built if it is not there."""
    if "TACEVA_CALL_TIMES" in os.environ:
        return os.environ["TACEVA_CALL_TIMES"]
    target = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
    binary = target / "release" / "examples" / "call_times"
    if not binary.exists():
        build = ["cargo", "build", "--release", "--locked", "-p", "taceva-python", "--example", "call_times"]
        subprocess.run(build, cwd=ROOT, check=True)
    return str(binary)


def rust(*words):
    """Least milliseconds of five."""
    done = subprocess.run([example(), *map(str, words)], check=True, capture_output=True, text=True)
    return min(map(float, done.stdout.split()))


def processor_ms(call, calls=1):
    """Milliseconds of processor time of all threads: the least of five times after one another, as the calls from Rust are measured, so that both
    sides find their arrays in the same caches."""
    def once():
        before = time.process_time()
        for _ in range(calls):
            call()
        return (time.process_time() - before) * 1000 / calls

    return min(once() for _ in range(5))


def least(sides):
    """Each side in turn, for some rounds; the least of each."""
    found = {}
    for _ in range(ROUNDS):
        for name, side in sides.items():
            found.setdefault(name, []).append(side())
    return {name: min(times) for name, times in found.items()}


def row(name, ours, theirs, bar):
    ratio = MACHINE.ratio(ours, theirs)
    verdict = "not told" if ratio == "–" else "kept" if ours <= bar * theirs else "MISSED"
    print(f"{name:<58} {ours:9.2f} ms {theirs:9.2f} ms {ratio:>7} (bar {bar}: {verdict})")


def updates(rows):
    import numpy as np
    import taceva

    generator = np.random.default_rng(1)
    truth = generator.uniform(size=(rows, 6))
    prediction = truth + generator.normal(0, 0.05, size=truth.shape)
    points = generator.integers(0, 100, rows)
    names = [slice(first, first + 1000) for first in range(0, rows, 1000)]

    def whole(points=None):
        metrics = taceva.TactileMetrics(metrics="accuracy")
        metrics.update(truth, prediction, points)

    def by_thousand():
        metrics = taceva.TactileMetrics(metrics="accuracy")
        for part in names:
            metrics.update(truth[part], prediction[part])
        return metrics.compute()

    sides = {
        "rust": lambda: rust("update", rows),
        "whole": lambda: processor_ms(whole),
        "points": lambda: processor_ms(lambda: whole(points)),
        "thousands": lambda: processor_ms(by_thousand),
    }
    if _importable("sklearn"):
        from sklearn.metrics import mean_absolute_error, r2_score, root_mean_squared_error

        def sklearn():
            for score in (mean_absolute_error, r2_score, root_mean_squared_error):
                score(truth, prediction, multioutput="raw_values")

        sides["sklearn"] = lambda: processor_ms(sklearn)
    if _importable("torchmetrics"):
        import torch
        from torchmetrics import MeanAbsoluteError, MeanSquaredError, MetricCollection, R2Score

        tensors = torch.from_numpy(truth), torch.from_numpy(prediction)

        def torchmetrics():
            collection = MetricCollection([MeanAbsoluteError(num_outputs=6), MeanSquaredError(squared=False, num_outputs=6), R2Score(multioutput="raw_values")])
            collection.set_dtype(torch.float64)
            for part in names:
                collection.update(tensors[1][part], tensors[0][part])
            return collection.compute()

        sides["torchmetrics"] = lambda: processor_ms(torchmetrics)
    found = least(sides)
    print(f"update, {rows} rows of 6 channels, metrics of accuracy; processor time, least of {ROUNDS} rounds")
    row("update, all at once / Rust on ready columns", found["whole"], found["rust"], 1.5)
    row("integer points / none", found["points"], found["whole"], 2)
    for peer, ours, bar in (("sklearn", "whole", 0.5), ("torchmetrics", "thousands", 0.25)):
        if peer in found:
            calls = "all at once" if ours == "whole" else "1,000 rows a call"
            row(f"update, {calls} / {peer} (mae, rmse, r2)", found[ours], found[peer], bar)
        else:
            print(f"skipped: no {peer}")


def frames():
    import numpy as np
    import taceva

    generator = np.random.default_rng(2)
    smooth = np.add.outer(np.arange(240), np.arange(320)) // 4
    pictures = (smooth[None, :, :, None] + generator.integers(0, 30, size=(120, 240, 320, 3))).astype(np.uint8)
    with tempfile.TemporaryDirectory() as folder:
        dataset = taceva.from_arrays(f"{folder}/recording", np.zeros((120, 1)), pictures, sensor="drawn", source="synthetic", channels=["Fz"])
        found = least(
            {"rust": lambda: rust("frames", dataset.path), "python": lambda: processor_ms(lambda: dataset.frames(jobs=1))}
        )
        inner = dataset._inner.frames([0, 1], 1)
        shared = np.shares_memory(np.asarray(inner), np.asarray(inner))
        print(f"frames, {len(dataset)} pictures of 320×240; one buffer, two arrays of it share memory: {shared}")
        row("frames, one thread / map_frames", found["python"], found["rust"], 1.1)


def other_thread(rows):
    """How fast another Python thread runs while sums are formed, by its share of the processor time that is free."""
    import numpy as np
    import taceva

    truth = np.random.default_rng(3).uniform(size=(rows, 6))
    metrics = taceva.TactileMetrics(metrics="accuracy")

    def spun(work):
        """Turns a second of a thread that counts while `work` is done again and again."""
        ended, turns = threading.Event(), [0]

        def spin():
            while not ended.is_set():
                for _ in range(1000):
                    turns[0] += 1

        spinner = threading.Thread(target=spin)
        begun = time.monotonic()
        spinner.start()
        while time.monotonic() - begun < 3:
            work()
        elapsed = time.monotonic() - begun
        ended.set()
        spinner.join()
        return turns[0] / elapsed

    def alone():
        time.sleep(0.05)

    speeds = {"beside": [], "alone": []}
    for _ in range(3):
        speeds["alone"].append(spun(alone))
        speeds["beside"].append(spun(lambda: metrics.update(truth, truth)))
    share = max(speeds["beside"]) / max(speeds["alone"])
    print(f"another Python thread keeps {share:.2f} of its speed beside update (bar 0.9, on idle cores: of 2 here)")


def interrupts():
    """Seconds from Ctrl-C until KeyboardInterrupt: of a model that sleeps, and of a large update."""
    import numpy as np
    import taceva

    # A shell ignores the signal for what it starts in the background, and Python then raises nothing.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    many = np.broadcast_to(np.arange(6.0), (2**31 - 1, 6))
    with tempfile.TemporaryDirectory() as folder:
        dataset = taceva.from_arrays(
            f"{folder}/recording", np.zeros((5, 1)), np.zeros((5, 8, 8), np.uint8), sensor="drawn", source="synthetic", channels=["Fz"]
        )
        works = {
            "a predict that sleeps": lambda: taceva.evaluate(dataset, lambda frames: time.sleep(60)),
            "an update of 2³¹ − 1 rows": lambda: taceva.score(many, many),
        }
        for name, work in works.items():
            took = []
            for _ in range(5):
                pressed = []

                def press():
                    time.sleep(0.4)
                    pressed.append(time.monotonic())
                    os.kill(os.getpid(), signal.SIGINT)

                presser = threading.Thread(target=press)
                try:
                    presser.start()
                    work()
                except KeyboardInterrupt:
                    took.append(time.monotonic() - pressed[0])
                presser.join()
            print(f"Ctrl-C ends {name} in {1000 * min(took):.1f} … {1000 * max(took):.1f} ms (bar 100)")


def imports():
    code = "import time; begun = time.process_time(); import numpy; middle = time.process_time(); import taceva; print(middle - begun, time.process_time() - middle)"
    both = [subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True).stdout.split() for _ in range(ROUNDS)]
    numpy, own = (1000 * min(float(pair[at]) for pair in both) for at in (0, 1))
    print(f"import taceva {own:.0f} ms beyond numpy's {numpy:.0f} ms, processor time (bar 100)")


if __name__ == "__main__":
    need("numpy", "taceva")
    rows = int(sys.argv[1]) if len(sys.argv) > 1 else 1_000_000
    print(MACHINE.said())
    imports()
    updates(rows)
    frames()
    other_thread(rows)
    interrupts()
    print(MACHINE.said())
