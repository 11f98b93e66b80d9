"""Spread between bins beyond what repeats give by chance, from the variance within and between contact points."""

import collections
import math

from distributions import Z
from intervals import Undefined, mean, square_sum

# Variances of bins share the errors of their estimate, and a shown excess must exceed these quantiles (docs/run-files.md).
SHARED = 0.75
SHOWN = {2: Z, 4: 2.241402727604947}
LEAST_FREEDOM = 6


def cube_root_normal(ratio, above, below):
    """Normal deviate of a ratio of variances, by Paulson."""
    root = ratio ** (1 / 3) if ratio > 0 else 0.0
    a, b = 2 / (9 * above), 2 / (9 * below)
    return ((1 - b) * root - (1 - a)) / math.sqrt(b * root * root + a)


def parts_of(keys, values, clusters, n_min):
    """Samples of each bin by cluster, in the order of the bins."""
    bins = collections.defaultdict(lambda: collections.defaultdict(list))
    for key, value, cluster in zip(keys, values, clusters):
        bins[key][cluster].append(float(value))
    return [dict(sorted(bins[key].items())) for key in sorted(bins) if sum(map(len, bins[key].values())) >= n_min]


class Noise:
    """Variance of the means of bins by chance."""

    def __init__(self, bins):
        self.bins, count = bins, len(bins)
        self.means = [mean(value for part in parts.values() for value in part) for parts in bins]
        sizes = [sum(map(len, parts.values())) for parts in bins]
        free_within = sum(len(part) - 1 for parts in bins for part in parts.values())
        free_between = sum(len(parts) - 1 for parts in bins)
        if free_within + free_between == 0:
            raise Undefined("no repeats")
        self.within = math.fsum(square_sum(part) for parts in bins for part in parts.values()) / free_within if free_within else 0.0
        weights = [math.fsum((len(part) / n) ** 2 for part in parts.values()) for parts, n in zip(bins, sizes)]
        self.between, self.freedom = 0.0, float(free_within)
        if free_between:
            size = math.fsum(n - n * weight for n, weight in zip(sizes, weights)) / free_between
            apart = (len(part) * (mean(part) - middle) ** 2 for parts, middle in zip(bins, self.means) for part in parts.values())
            of_parts = math.fsum(apart) / free_between
            self.between = max(of_parts - self.within, 0.0) / size
            alpha = mean(weights) / size
            beta = mean(1 / n for n in sizes) - alpha
            one, other = alpha * max(of_parts, self.within), beta * self.within
            below = sum(term * term / free for term, free in ((one, free_between), (other, free_within)) if free)
            if below > 0:
                self.freedom = (one + other) ** 2 / below
        self.of_bins = [self.between * weight + self.within / n for weight, n in zip(weights, sizes)]
        shares = weights if self.between > 0 else [1 / n for n in sizes]
        total, self.squares = math.fsum(self.of_bins), math.fsum(v * v for v in self.of_bins)
        if total <= 0:
            self.variance = 0.0
            return
        self.squares += SHARED * math.fsum(v * v * u for v, u in zip(self.of_bins, shares))
        self.freedom = max(self.freedom / (1 + SHARED), 1.0)
        shared = self.shared(sizes) / (count * (count - 1) / 2) if self.between > 0 and count > 1 else 0.0
        self.variance = max(total / count - shared, 0.0)

    def shared(self, sizes):
        """Covariance of bins that have a cluster in common, summed over their pairs."""
        of_cluster = collections.defaultdict(list)
        for place, (parts, n, middle) in enumerate(zip(self.bins, sizes, self.means)):
            for cluster, part in parts.items():
                of_cluster[cluster].append((place, len(part) / n, mean(part) - middle if len(parts) > 1 else None))
        pairs = [(one, two) for of in of_cluster.values() for at, one in enumerate(of) for two in of[at + 1 :]]
        overlap = collections.defaultdict(float)
        for one, two in pairs:
            overlap[one[0], two[0]] += one[1] * two[1]
        products = expected = 0.0
        for one, two in pairs:
            if one[2] is not None and two[2] is not None:
                products += one[2] * two[2]
                expected += 1 - one[1] - two[1] + overlap[one[0], two[0]]
        if expected <= 0:
            return 0.0
        return min(max(products / expected, 0.0), self.between) * math.fsum(one[1] * two[1] for one, two in pairs)


def excess(keys, values, clusters, n_min):
    """Excess of one set of bins: its value, its ends, how far it is above chance, and the mean of the bins."""
    bins = parts_of(keys, values, clusters, n_min)
    if len(bins) < 2:
        raise Undefined("too few bins")
    noise, count = Noise(bins), len(bins)
    middle, variance = mean(noise.means), square_sum(noise.means) / (count - 1)
    if noise.variance <= 0:
        value = math.sqrt(variance)
        return {"value": value, "ends": [value, value], "above": math.inf if value > 0 else 0.0, "mean": middle}
    ratio, total = variance / noise.variance, math.fsum(noise.of_bins)

    def above(shift):
        true = shift * noise.variance
        of_sum = total + count * true
        of_squares = noise.squares + 2 * true * total + count * true * true
        return cube_root_normal(ratio / (1 + shift), (count - 1) / count * of_sum**2 / of_squares, noise.freedom)

    def at(wanted):
        if above(0.0) <= wanted:
            return 0.0
        low, high = 0.0, 1.0
        while above(high) > wanted and high < 1e300:
            high *= 2
        for _ in range(100):
            half = (low + high) / 2
            low, high = (half, high) if above(half) > wanted else (low, half)
        return (low + high) / 2

    value = math.sqrt(max(variance - noise.variance, 0.0))
    low = min(math.sqrt(at(Z) * noise.variance), value) if noise.freedom >= LEAST_FREEDOM else 0.0
    high = max(math.sqrt(at(-Z) * noise.variance), value)
    return {"value": value, "ends": [low, high], "above": above(0.0) if low > 0 else 0.0, "mean": middle}


def mean_excess(of):
    """Mean of several excesses. Its lower end is above 0 if at least one of them is shown."""
    count = len(of)
    value = mean(one["value"] for one in of)
    distance = lambda end, sign: math.sqrt(math.fsum((sign * (one["ends"][end] - one["value"])) ** 2 for one in of)) / count
    shown = [one["ends"][0] / count for one in of if one["above"] > SHOWN[count]]
    low = max(value - distance(0, -1), *shown) if shown else 0.0
    return {"value": value, "ends": [min(low, value), value + distance(1, 1)]}
