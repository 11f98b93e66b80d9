"""Errors of predictions: each function returns the node of a score."""

import math
from fractions import Fraction

import numpy as np

from intervals import Undefined, mean, square_sum
from study import Rows, by_channel, score, scored

GATE, EPS = 0.02, 1e-8
KINDS = {"mae": "positive", "rmse": "positive", "bias": "any", "r2": "below one", "smape": "below two", "smape_gated": "below two"}


def squares(values):
    return math.fsum(value * value for value in values.tolist())


def of_pairs(study, metric, label, _):
    rows = Rows(study, metric)
    pairs = rows.pairs(label)
    if metric == "smape_gated":
        pairs = {channel: (truth, predicted, ok & (np.abs(truth) >= GATE)) for channel, (truth, predicted, ok) in pairs.items()}

    def one(channel, kept):
        truth, predicted, ok = pairs[channel]
        y, p = truth[ok & kept], predicted[ok & kept]
        if not len(y):
            return {"value": Undefined("no samples")}
        d = y - p
        value = {
            "mae": lambda: mean(np.abs(d)),
            "rmse": lambda: math.sqrt(squares(d) / len(d)),
            "bias": lambda: float(sum(Fraction(float(a)) - Fraction(float(b)) for a, b in zip(y, p)) / len(y)),
            "r2": lambda: 1 - squares(d) / square_sum(y),
        }.get(metric, lambda: mean(np.abs(d) / ((np.abs(y) + np.abs(p)) / 2 + EPS)))()
        return {"value": value}

    def count(channel, kept):
        return int((pairs[channel][2] & kept).sum())

    nodes = by_channel(rows, label, one, count, {"value": KINDS[metric]})
    return score(nodes, min(count(channel, rows.all) for channel in pairs))


def skill(study, metric, label, _):
    rows = Rows(study, metric)
    pairs = rows.pairs(label)

    def numbers(kept):
        of_model = of_constant = 0.0
        for channel, (truth, predicted, ok) in pairs.items():
            y, p = truth[ok & kept], predicted[ok & kept]
            of_model += squares(y - p)
            of_constant += squares(y - study.constants.get(channel, mean(y) if len(y) else 0.0))
        return {"value": (of_constant - of_model) / of_constant if of_constant else Undefined("equal truth")}

    nodes = scored(rows, numbers, lambda kept: sum(int((ok & kept).sum()) for _, _, ok in pairs.values()), {"value": "below one"})
    if not study.constants:
        nodes["flags"] = ["constant is the mean of truth"]
    if len(pairs) == 1:
        truth, _, ok = pairs[label]
        nodes["constant"] = {"value": study.constants.get(label, mean(truth[ok]))}
    return score(nodes, min(int(ok.sum()) for _, _, ok in pairs.values()))


def mae_euclid(study, metric, label, _):
    rows = Rows(study, metric)
    (x, of_x, _), (y, of_y, _) = rows.pairs(label).values()
    distance = np.hypot(x - of_x, y - of_y)
    ok = ~np.isnan(distance)
    nodes = scored(rows, lambda kept: {"value": mean(distance[ok & kept])}, lambda kept: int((ok & kept).sum()), {"value": "positive"})
    return score(nodes, int(ok.sum()))


def slope(x, y):
    """Slope of `y` over `x`; `None` if all `x` are equal."""
    x = x - mean(x)
    below = squares(x)
    return math.fsum((x * (y - mean(y))).tolist()) / below if below else None


def drift(study, metric, label, _):
    rows = Rows(study, metric)
    times = study.times[rows.rows]
    pairs = {channel: (truth - predicted, ok & ~np.isnan(times)) for channel, (truth, predicted, ok) in rows.pairs(label).items()}

    def one(channel, kept):
        error, ok = pairs[channel]
        return {"value": 3600 * slope(times[ok & kept], error[ok & kept])}

    def count(channel, kept):
        return int((pairs[channel][1] & kept).sum())

    return score(by_channel(rows, label, one, count, {"value": "any"}), min(count(channel, rows.all) for channel in pairs))


def linearity(study, metric, label, _):
    rows = Rows(study, metric)
    pairs = rows.pairs(label)

    def one(channel, kept):
        truth, predicted, ok = pairs[channel]
        x, y = truth[ok & kept], predicted[ok & kept]
        rise = slope(x, y)
        offset = mean(y) - rise * mean(x)
        greatest = float(np.abs((y - mean(y)) - rise * (x - mean(x))).max())
        return {"value": greatest / float(x.max() - x.min()), "greatest_deviation": greatest, "slope": rise, "offset": offset}

    def count(channel, kept):
        return int((pairs[channel][2] & kept).sum())

    kinds = {"value": "greatest", "greatest_deviation": "greatest", "slope": "any", "offset": "any"}
    return score(by_channel(rows, label, one, count, kinds), min(count(channel, rows.all) for channel in pairs))


def least_squares(x, y):
    """Slopes of the columns of `y` over those of `x`, exact: the normal equations of centred columns, by elimination."""
    x, y = ([[value - sum(of) / len(of) for value in of] for of in zip(*columns)] for columns in (x, y))
    product = lambda a, b: sum(p * q for p, q in zip(a, b))
    rows = [[product(a, b) for b in (*x, *y)] for a in x]
    for at in range(len(x)):
        rows[at] = [value / rows[at][at] for value in rows[at]]
        for other in range(len(x)):
            if other != at:
                rows[other] = [a - rows[other][at] * b for a, b in zip(rows[other], rows[at])]
    return [row[len(x) :] for row in rows]


def crosstalk(study, metric, _, given):
    """Least squares of all predictions over all truths, relative to the spans of the truths."""
    rows = Rows(study, metric)
    names = given["of"]
    truth = np.array([rows.truth(name) for name in names]).T
    predicted = np.array([rows.predicted(name) for name in names]).T
    ok = ~(np.isnan(truth).any(axis=1) | np.isnan(predicted).any(axis=1))
    truth, predicted = ([[Fraction(float(value)) for value in row] for row in of[ok]] for of in (truth, predicted))
    slopes = least_squares(truth, predicted)
    span = [max(of) - min(of) for of in zip(*truth)]
    matrix = [[float(slopes[j][i] * span[j] / span[i]) for j in range(len(names))] for i in range(len(names))]
    greatest = max(abs(matrix[i][j]) for i in range(len(names)) for j in range(len(names)) if i != j)
    return score({"value": {"value": greatest}}, len(truth), matrix={"values": matrix})


METRICS = dict.fromkeys(KINDS, of_pairs) | {
    "skill": skill,
    "mae_euclid": mae_euclid,
    "drift": drift,
    "linearity": linearity,
    "crosstalk": crosstalk,
}
