"""What is predicted without contact, and the least force that light presses show."""

import collections
import math

import numpy as np

from accuracy import squares
from distributions import Z, critical_factor, detection_factor
from intervals import Undefined, attempt, deviation, jackknife, mean, number
from study import Rows, by_channel, channels, score

GATE, LIGHT, KNOWN = 0.02, 0.2, 3.29
LEAST_IDLE, LEAST_PLACES, LEAST_LEFT = 10, 10, 3


def idle(study, metric, label, _):
    rows = Rows(study, metric)
    force = rows.truth("Fz")
    predicted = {channel: rows.predicted(channel) for channel in channels(label)}
    ok = {channel: ~np.isnan(of) & ~np.isnan(rows.truth(channel)) & (np.abs(force) < GATE) for channel, of in predicted.items()}
    is_zero = metric == "zero_error"
    names = ("value",) if is_zero else ("value", "critical", "known_deviation", "independent_low", "independent_high")

    def one(channel, kept):
        values = predicted[channel][ok[channel] & kept]
        n = len(values)
        if n < LEAST_IDLE:
            return dict.fromkeys(names, Undefined("too few samples"))
        if is_zero:
            return {"value": mean(values)}
        spread = deviation(values, 1)
        of_next = math.sqrt(1 + 1 / n) * spread
        value = detection_factor(n - 1.0) * of_next
        third = 2 / 9 / (n - 1)
        low, high = (value / math.sqrt((1 - third + z * math.sqrt(third)) ** 3) for z in (Z, -Z))
        return dict(zip(names, (value, critical_factor(n - 1.0) * of_next, KNOWN * spread, low, high)))

    def count(channel, kept):
        return int((ok[channel] & kept).sum())

    nodes = by_channel(rows, label, one, count, dict.fromkeys(names, "any" if is_zero else "positive"))
    return score(nodes, min(count(channel, rows.all) for channel in predicted))


def detection_limit(study, metric, label, _):
    rows = Rows(study, metric)
    truth, predicted = rows.truth("Fz"), rows.predicted("Fz")
    ok = ~np.isnan(truth) & ~np.isnan(predicted) & (truth >= GATE) & (truth <= LIGHT)
    points = np.array(rows.points)

    def line(kept, least):
        """Limit and threshold of the line through the predictions of light presses."""
        kept = ok & kept
        n = int(kept.sum())
        places = collections.Counter(points[kept].tolist())
        of_squares = sum(count * count for count in places.values())
        if n == 0 or n * n // of_squares < least:
            raise Undefined("too few places")
        independent = n * n / of_squares
        freedom = independent - 2
        x, y = truth[kept], predicted[kept]
        middle = mean(x)
        x, y = x - middle, y - mean(y)
        xx, yy, xy = squares(x), squares(y), math.fsum((x * y).tolist())
        rest, threshold = xx * yy - xy * xy, critical_factor(freedom)
        if not (xy > 0 and xy / math.sqrt(rest) * math.sqrt(freedom) > threshold):
            raise Undefined("no rise")
        spread = math.sqrt(rest / xx / n * independent / freedom) * xx / xy
        spread *= math.sqrt(1 + (1 + middle**2 / (xx / n)) / independent)
        return detection_factor(freedom) * spread, threshold * spread

    least, greatest = float(truth[ok].min()), float(truth[ok].max())

    def whole_line():
        value, critical = line(rows.all, LEAST_PLACES)
        if value > greatest:
            raise Undefined("above all light presses")
        return max(value, least), critical

    def without(kept):
        value, critical = line(kept, LEAST_LEFT)
        return Undefined("below all light presses") if value < float(truth[ok & kept].min()) else value, critical

    full = attempt(whole_line)
    left = rows.left_out(lambda of: int((ok & of).sum()), lambda kept: attempt(without, kept))
    nodes = {}
    for place, name in enumerate(("value", "critical")):
        value = full if isinstance(full, Undefined) else full[place]
        others = [(samples, of if isinstance(of, Undefined) else of[place]) for samples, of in left]
        nodes[name] = number(value, attempt(jackknife, value, "positive", others))
    nodes |= {"least_force": {"value": least}, "greatest_force": {"value": greatest}}
    return score(nodes, int(ok.sum()), {"places": len(set(points[ok].tolist()))})


METRICS = {"noise_equivalent_force": idle, "zero_error": idle, "detection_limit": detection_limit}
