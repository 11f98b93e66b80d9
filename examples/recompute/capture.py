"""Frames and their times, the field of view, and the spacing of gratings."""

import math
from fractions import Fraction

import numpy as np

from hull import area
from intervals import Undefined, wilson_of_independent
from study import Rows, score, scored, whole

GATE, WIDEST = 0.02, 1.5
# Distance of two points of the curve of recognised gratings, nm.
STEP = 50_000


def gratings(study, metric, label, _):
    rows = Rows(study, metric, predicted=False)
    of_kind = np.array([study.kinds[row] == label for row in rows.rows])
    truth, predicted = study.spacing[rows.rows], study.spacing_predicted[rows.rows]
    ok = of_kind & ~np.isnan(truth) & ~np.isnan(predicted)
    truth, predicted = np.rint(np.where(ok, truth, 0) * 1e6), np.rint(np.where(ok, predicted, 0) * 1e6)
    off = np.abs(truth - predicted)
    tolerance = whole(study.settings["tolerance_mm"])

    def share(kept, limit):
        kept = ok & kept
        return int((off[kept] <= limit).sum()) / int(kept.sum()) if kept.any() else Undefined("no samples")

    def numbers(kept):
        return {"value": share(kept, tolerance), "exact": share(kept, 0)}

    nodes = scored(rows, numbers, lambda kept: int((ok & kept).sum()), {"value": "share", "exact": "share"})
    n = int(ok.sum())
    within = [int((off[ok] <= STEP * step).sum()) for step in range(21)]
    hits = int((off[ok] <= tolerance).sum())
    best = max(int(((truth[ok] >= low) & (truth[ok] <= low + 2 * tolerance)).sum()) for low in set(truth[ok]))
    nodes["of_constant"] = {"value": best / n}
    nodes["wilson"] = {"value": hits / n} | wilson_of_independent(hits / n, n)
    curve = {"x": [step * 50 / 1000 for step in range(21)], "values": [count / n for count in within], "counts": within}
    return score(nodes, n, curve=curve)


def intrinsic(study, metric, label, _):
    rows = study.rows(metric, predicted=False)
    frames = sorted({(study.times[row], study.digests[row]) for row in rows if not math.isnan(study.times[row])})
    times = sorted({time for time, _ in frames})
    between = sorted(b - a for a, b in zip(times, times[1:]))
    half = len(between) // 2
    median = between[half] if len(between) % 2 else (between[half - 1] + between[half]) / 2
    regular = [interval for interval in between if interval <= WIDEST * median]
    nodes, counts = {}, None
    if label == "frame_rate":
        value = 1 / median
    elif label == "jitter":
        exact = [Fraction(interval) for interval in regular]
        middle = sum(exact) / len(exact)
        value = math.sqrt(sum((interval - middle) ** 2 for interval in exact) / (len(exact) - 1))
    elif label == "dropped":
        value = (len(between) - len(regular)) / len(between)
    elif label == "duplicated":
        digests = [digest for _, digest in frames]
        value = sum(a == b for a, b in zip(digests, digests[1:])) / (len(digests) - 1)
    elif label == "field_of_view":
        x, y = study.truth["Px"], study.truth["Py"]
        touched = (np.abs(study.truth["Fz"]) >= GATE) & ~np.isnan(x) & ~np.isnan(y)
        x, y = x[touched], y[touched]
        value, counts = area(list(zip(x.tolist(), y.tolist()))), {"contacts": int(touched.sum())}
        nodes = {"width": {"value": float(x.max() - x.min())}, "height": {"value": float(y.max() - y.min())}}
    else:
        width, height = (float(study.header["frames"][side]) for side in ("width", "height"))
        value, nodes = width * height, {"width": {"value": width}, "height": {"value": height}}
    return score({"value": {"value": float(value)}} | nodes, len(frames), counts)


METRICS = {"sr": gratings, "intrinsic": intrinsic}
