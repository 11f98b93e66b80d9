"""Limits that contain a share of all errors, and shares of errors within a limit."""

import collections
import math

import numpy as np

from accuracy import slope
from distributions import Z, chi_squared_quantile, noncentral_t_quantile, student_above, student_quantile, tolerance_factor
from intervals import Undefined, attempt, known, mean, number, of_components, square_sum
from study import Rows, by_channel, mean_of_axes, score, whole

SHARE = CONFIDENCE = 0.95
LEVEL, WITHIN, LEAST_OF_LEVEL = 0.1, 0.05, 5
TOLERANCES = (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0)


class Sample:
    """Errors as a normal sample: independent, or of a one-way random model with a part between contact points."""

    def __init__(self, errors, clusters):
        groups = collections.defaultdict(list)
        for error, cluster in zip(errors.tolist(), clusters):
            groups[cluster].append(error)
        n, k = len(errors), len(groups)
        if n < 2:
            raise Undefined("too few errors")
        self.mean, self.is_independent = mean(errors), n == k
        if self.is_independent:
            self.sd, self.freedom, self.worth, self.mean_freedom = math.sqrt(square_sum(errors) / (n - 1)), n - 1.0, float(n), n - 1.0
            return
        if k < 2:
            raise Undefined("one cluster")
        between = math.fsum(len(group) * (mean(group) - self.mean) ** 2 for group in groups.values()) / (k - 1)
        within = math.fsum(square_sum(group) for group in groups.values()) / (n - k)
        sizes = sum(len(group) ** 2 for group in groups.values())
        size = (n - sizes / n) / (k - 1)
        share = 1 / size if between > within else 0.0
        total = share * between + (1 - share) * within
        self.freedom = total**2 / ((share * between) ** 2 / (k - 1) + ((1 - share) * within) ** 2 / (n - k))
        of_mean = max(0.0, between - within) / size * sizes / n**2 + within / n
        self.sd, self.worth, self.mean_freedom = math.sqrt(total), total / of_mean, k - 1.0

    def factor(self):
        return tolerance_factor(self.worth, self.freedom, SHARE, CONFIDENCE)


def agreement(study, metric, label, _):
    rows = Rows(study, metric)
    points = np.array(rows.points)
    pairs = rows.pairs(label)

    def one(channel, kept):
        truth, predicted, ok = pairs[channel]
        y, p = truth[ok & kept], predicted[ok & kept]
        sample = attempt(Sample, y - p, points[ok & kept])
        of = lambda value: attempt(lambda: value(known(sample)))
        rise = slope((y + p) / 2, y - p) if len(y) > 2 else None
        return {
            "value": of(lambda s: Z * s.sd),
            "bias": mean(y - p),
            "sd": of(lambda s: s.sd),
            "lower": of(lambda s: s.mean - Z * s.sd),
            "upper": of(lambda s: s.mean + Z * s.sd),
            "slope": Undefined("equal means") if rise is None else rise,
        }

    def count(channel, kept):
        return int((pairs[channel][2] & kept).sum())

    kinds = {"value": "positive", "bias": "any", "sd": "positive", "lower": "any", "upper": "any", "slope": "any"}
    nodes = by_channel(rows, label, one, count, kinds)
    rise = nodes["slope"]
    if "standard_error" in rise:
        t = abs(rise["value"]) / rise["standard_error"]
        nodes["slope_p"] = {"value": 2 * student_above(t, rise["degrees_of_freedom"])}
    if len(pairs) == 1:
        exact(nodes, *pairs[label], points, rows)
    return score(nodes, min(count(channel, rows.all) for channel in pairs))


def exact(nodes, truth, predicted, ok, points, rows):
    """Intervals and p value where every point has one sample."""
    y, p = truth[ok], predicted[ok]
    sample = Sample(y - p, points[ok])
    if not sample.is_independent:
        return
    clusters = len(set(rows.cluster[ok]))
    root = math.sqrt(sample.worth)
    t = student_quantile(0.975, sample.mean_freedom) * sample.sd / root
    near, far = (noncentral_t_quantile(q, sample.freedom, Z * root) / root * sample.sd for q in (0.025, 0.975))
    spread = [sample.sd * math.sqrt(sample.freedom / chi_squared_quantile(q, sample.freedom)) for q in (0.975, 0.025)]
    ends = {
        "bias": [sample.mean - t, sample.mean + t],
        "sd": spread,
        "lower": [sample.mean - far, sample.mean - near],
        "upper": [sample.mean + near, sample.mean + far],
        "value": [Z * end for end in spread],
    }
    for name, of in ends.items():
        nodes[name] = number(nodes[name]["value"], attempt(of_components, of, clusters, sample.mean_freedom if name == "bias" else sample.freedom))
    e, m = y - p, (y + p) / 2
    rise, n = slope(m, e), len(e)
    rest = square_sum(e - rise * m)
    nodes["slope_p"] = {"value": 2 * student_above(abs(rise) / math.sqrt(rest / (n - 2) / square_sum(m)), n - 2.0)}


def tolerance_interval(study, metric, label, _):
    rows = Rows(study, metric)
    points = np.array(rows.points)
    pairs = rows.pairs(label)
    factors = {}

    def one(channel, kept):
        truth, predicted, ok = pairs[channel]
        sample = Sample((truth - predicted)[ok & kept], points[ok & kept])
        # A score without a cluster keeps the factor of all of them.
        factor = factors.setdefault(channel, sample.factor())
        lower, upper = sample.mean - factor * sample.sd, sample.mean + factor * sample.sd
        return {"value": max(abs(lower), abs(upper)), "lower": lower, "upper": upper}

    def count(channel, kept):
        return int((pairs[channel][2] & kept).sum())

    for channel in pairs:
        one(channel, rows.all)
    nodes = by_channel(rows, label, one, count, {"value": "positive", "lower": "any", "upper": "any"})
    return score(nodes, min(count(channel, rows.all) for channel in pairs))


def millionths(values):
    return np.rint(values * 1e6)


def tolerance(study, metric, label, _):
    rows = Rows(study, metric)
    pairs = {channel: (millionths(truth), millionths(predicted), ok) for channel, (truth, predicted, ok) in rows.pairs(label).items()}

    def within(channel, kept, limit):
        truth, predicted, ok = pairs[channel]
        return int((np.abs(truth - predicted)[ok & kept] <= whole(limit)).sum())

    def count(channel, kept):
        return int((pairs[channel][2] & kept).sum())

    def one(channel, kept):
        n = count(channel, kept)
        return {"value": within(channel, kept, WITHIN) / n if n else Undefined("no samples")}

    nodes = by_channel(rows, label, one, count, {"value": "share"})
    if study.constants:
        of_constant = []
        for channel, (truth, _, ok) in pairs.items():
            off = np.abs(truth[ok] - millionths(study.constants[channel]))
            of_constant.append(int((off <= whole(WITHIN)).sum()) / int(ok.sum()))
        nodes["of_constant"] = {"value": mean(of_constant)}
    arrays = {}
    if len(pairs) == 1:
        n = count(label, rows.all)
        shares = [within(label, rows.all, limit) / n for limit in TOLERANCES]
        arrays["curve"] = {"x": list(TOLERANCES), "values": shares, "counts": [n] * len(TOLERANCES)}
    return score(nodes, min(count(channel, rows.all) for channel in pairs), **arrays)


def bias_level(study, metric, label, _):
    """Greatest mean error of a level of the truth."""
    rows = Rows(study, metric)
    width = whole(LEVEL)
    greatest, arrays, counts = [], {}, {}
    pairs = rows.pairs(label)
    for truth, predicted, ok in pairs.values():
        errors = collections.defaultdict(list)
        for y, p in zip(truth[ok].tolist(), predicted[ok].tolist()):
            errors[whole(y) // width].append(y - p)
        means = {level: mean(of) for level, of in errors.items()}
        used = [level for level, of in errors.items() if len(of) >= LEAST_OF_LEVEL]
        greatest.append({"value": max(abs(means[level]) for level in used) if used else Undefined("no level")})
        levels = sorted(errors)
        middles = [(level * width + width // 2) / 1e6 for level in levels]
        curve = {"x": middles, "values": [means[level] for level in levels], "counts": [len(errors[level]) for level in levels]}
        arrays, counts = {"curve": curve}, {"bins_used": len(used)}
    value = mean_of_axes(greatest)["value"]
    if len(pairs) > 1:
        arrays, counts = {}, None
    return score({"value": number(value)}, min(int(ok.sum()) for _, _, ok in pairs.values()), counts, **arrays)


METRICS = {"agreement": agreement, "tolerance_interval": tolerance_interval, "tolerance": tolerance, "bias_level": bias_level}
