"""Spread of repeated presses, in cells of one contact point and depth step."""

import collections
import math

import numpy as np

from intervals import Undefined, deviation, mean, square_sum
from study import Rows, by_channel, channels, score

LIMIT = 2.8


def pooled(cells):
    return math.sqrt(math.fsum(map(square_sum, cells)) / sum(len(cell) - 1 for cell in cells))


def repeats(study, metric, label, _):
    rows = Rows(study, metric)
    steps = study.steps[rows.rows]
    predicted = {channel: rows.predicted(channel) for channel in channels(label)}
    ok = {channel: ~np.isnan(of) & ~np.isnan(steps) for channel, of in predicted.items()}
    is_spread = metric == "repeatability"
    names = ("value", "population", "pooled", "limit") if is_spread else ("value",)

    def cells(channel, kept):
        found = collections.defaultdict(list)
        for row in np.nonzero(ok[channel] & kept)[0]:
            found[rows.points[row], steps[row]].append(float(predicted[channel][row]))
        return found

    def one(channel, kept):
        several = [cell for cell in cells(channel, kept).values() if len(cell) > 1]
        if not several or (not is_spread and len(several) < 2):
            return dict.fromkeys(names, Undefined("too few cells"))
        within = pooled(several)
        if is_spread:
            spreads, of_all = ([deviation(cell, ddof) for cell in several] for ddof in (1, 0))
            return {"value": mean(spreads), "population": mean(of_all), "pooled": within, "limit": LIMIT * within}
        signal = deviation([mean(cell) for cell in several], 1) ** 2 - within**2 * mean(1 / len(cell) for cell in several)
        return {"value": math.sqrt(max(signal, 0.0)) / within}

    def count(channel, kept):
        return int((ok[channel] & kept).sum())

    nodes = by_channel(rows, label, one, count, dict.fromkeys(names, "positive"))
    of = {channel: cells(channel, rows.all) for channel in predicted}
    counts = {
        "cells_valid": min(sum(len(cell) > 1 for cell in found.values()) for found in of.values()),
        "cells_total": min(map(len, of.values())),
    }
    arrays = {}
    if is_spread:
        levels = sorted({step for found in of.values() for _, step in found})
        at = [[deviation(cell, 1) for found in of.values() for (_, step), cell in found.items() if step == level and len(cell) > 1] for level in levels]
        values = [mean(spreads) if spreads else None for spreads in at]
        arrays["curve"] = {"x": levels, "values": values, "counts": [len(spreads) // len(of) for spreads in at]}
    node = score(nodes, min(count(channel, rows.all) for channel in predicted), counts, **arrays)
    if not is_spread and any(is_low(rows.truth(channel)[ok[channel]], of[channel].values()) for channel in predicted):
        node["flags"] = ["low stimulus"]
    return node


def is_low(truth, cells):
    """True if the labels differ less than the predictions of one cell."""
    truth = truth[~np.isnan(truth)]
    several = [cell for cell in cells if len(cell) > 1]
    return len(truth) > 1 and bool(several) and deviation(truth, 1) < pooled(several)


METRICS = {"repeatability": repeats, "signal_to_repeatability": repeats}
