"""Jackknife over clusters of contact points, and the scale of each interval (docs/run-files.md, "Intervals")."""

import math

from distributions import Z, student_quantile

# Ends of the range of a score. `greatest` is the greatest of several numbers and has no interval.
ENDS = {
    "any": (-math.inf, math.inf),
    "positive": (0.0, math.inf),
    "below one": (-math.inf, 1.0),
    "ratio": (0.0, 1.0),
    "ratio with ends": (0.0, 1.0),
    "share": (0.0, 1.0),
    "below two": (0.0, 2.0),
}
LEAST_CLUSTERS = 5


class Undefined(Exception):
    """A number or interval without a value, and why."""


def attempt(function, *arguments):
    """The value of the function, or the `Undefined` that it raises."""
    try:
        return function(*arguments)
    except Undefined as reason:
        return reason


def known(value):
    """The value, unless it is `Undefined`."""
    if isinstance(value, Undefined):
        raise value
    return value


def mean(values):
    """Mean from an exactly rounded sum."""
    values = [float(value) for value in values]
    if not values:
        raise Undefined("no values")
    return math.fsum(values) / len(values)


def square_sum(values):
    """Sum of squared distances from the mean."""
    middle = mean(values)
    return math.fsum((float(value) - middle) ** 2 for value in values)


def deviation(values, ddof):
    if len(values) <= ddof:
        raise Undefined("too few values")
    return math.sqrt(square_sum(values) / (len(values) - ddof))


def standard_error(value, left_out):
    """Standard error and degrees of freedom, from the samples of each cluster and the score without it."""
    count = len(left_out)
    if count < LEAST_CLUSTERS:
        raise Undefined(f"{count} clusters")
    n = sum(samples for samples, _ in left_out)
    pseudo = []
    for samples, other in left_out:
        h = n / samples
        pseudo.append((h, h * value - (h - 1) * known(other)))
    middle = mean(p for _, p in pseudo)
    squares = [(p - middle) ** 2 / (h - 1) for h, p in pseudo]
    variance, freedom = mean(squares), float(count - 1)
    if variance > 0.0:
        kurtosis = mean((square / variance) ** 2 for square in squares)
        difference = kurtosis - (count - 3) / (count - 1)
        if difference > 0.0:
            freedom = min(max(2 * count / difference, 3.0), count - 1.0)
    return math.sqrt(variance), freedom


def on_scale(value, other, kind):
    """The score of a cluster left out, relative to `value` on the scale of its range; `None` if it is not finite."""
    low, high = ENDS[kind]
    try:
        if kind == "positive":
            ratio = (other - low) / (value - low)
        elif kind == "below one":
            ratio = (high - other) / (high - value)
        elif kind in ("ratio", "below two"):
            odds = math.log(((other - low) / (value - low)) / ((high - other) / (high - value)))
            return odds if math.isfinite(odds) else None
        else:
            return None
        carried = math.log(0.7) + (ratio - 0.7) / 0.7 if ratio < 0.7 else math.log(ratio)
    except (ZeroDivisionError, ValueError):
        return None
    return carried if math.isfinite(carried) else None


def wilson(share, n, z):
    """Ends of the interval of Wilson."""
    scale = 1 + z * z / n
    centre = (share + z * z / (2 * n)) / scale
    half = z * math.sqrt(share * (1 - share) / n + z * z / (4 * n * n)) / scale
    return [0.0 if share <= 0.0 else centre - half, 1.0 if share >= 1.0 else centre + half]


def of_error(value, kind, error, freedom, clusters, samples=0, carried=None, rule="jackknife"):
    """Interval by a standard error, on the scale of the range."""
    low, high = ENDS[kind]
    used, scale = freedom, ""
    t = student_quantile(0.975, freedom)
    if kind == "share":
        binomial, scale = value * (1 - value), "Wilson with effective samples"
        worth = (min(binomial / error / error, samples) if error > 0.0 else samples) if binomial > 0.0 else float(clusters)
        ends = wilson(value, worth, t)
    else:
        below, above = value - low, high - value
        is_inside = below > 0.0 and above > 0.0
        if not is_inside and error <= 0.0:
            raise Undefined("at an end of its range")

        def step(slope):
            return student_quantile(0.975, carried[1]) * carried[0] if carried else t * error * slope

        if kind == "positive" and is_inside:
            s, scale = step(1 / below), "logarithmic"
            ends = [low + below * math.exp(-s), low + below * math.exp(s)]
        elif kind == "below one" and is_inside:
            s, scale = step(1 / above), "logarithmic"
            ends = [high - above * math.exp(s), high - above * math.exp(-s)]
        elif kind in ("ratio", "below two") and is_inside:
            width = high - low
            s, scale = step(width / (below * above)), "logit"
            ends = [low + width * below / (below + above * math.exp(-x)) for x in (-s, s)]
        else:
            ends, scale = [value - t * error, value + t * error], "" if kind == "any" else "cut to the range"
        if carried and scale in ("logarithmic", "logit"):
            used = carried[1]
    ends = [min(max(ends[0], low), value), max(min(ends[1], high), value)]
    return stated(ends, error, used, clusters, ", ".join(filter(None, [f"{rule} by point_id, G={clusters}", scale])))


def stated(ends, error, freedom, clusters, method):
    """The fields of an interval in `results.json`."""
    return {"ci95": ends, "method": method, "standard_error": error, "clusters": clusters, "degrees_of_freedom": freedom}


def of_components(ends, clusters, freedom=None):
    """Interval whose ends do not follow from a standard error."""
    if clusters < LEAST_CLUSTERS:
        raise Undefined(f"{clusters} clusters")
    freedom = clusters - 1.0 if freedom is None else freedom
    error = (ends[1] - ends[0]) / 2 / student_quantile(0.975, freedom)
    return stated(ends, error, freedom, clusters, f"variance components by point_id, G={clusters}")


def jackknife(value, kind, left_out):
    """Interval of a score from the scores with each cluster left out."""
    value = known(value)
    if kind == "greatest":
        raise Undefined("the greatest of several numbers")
    error, freedom = standard_error(value, left_out)
    others = [on_scale(value, other, kind) for _, other in left_out]
    carried = None
    if None not in others:
        carried = standard_error(0.0, [(samples, other) for (samples, _), other in zip(left_out, others)])
    return of_error(value, kind, error, freedom, len(left_out), sum(samples for samples, _ in left_out), carried)


def number(value, interval=None):
    """Node of a number: its value and the fields of its interval, without those that are undefined."""
    node = {} if isinstance(value, Undefined) else {"value": value}
    return node | (interval if isinstance(interval, dict) else {})


def wilson_of_independent(share, n):
    return {"ci95": wilson(share, n, Z), "method": "Wilson, samples taken as independent"}
