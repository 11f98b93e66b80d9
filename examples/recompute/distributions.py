"""Tails and quantiles of the normal, Student's t, chi-squared and noncentral t distributions, by series and quadrature."""

import functools
import math
from statistics import NormalDist

import numpy as np

NORMAL = NormalDist()
# The 97.5 % quantile of the normal distribution.
Z = NORMAL.inv_cdf(0.975)


def panels(low, high, count, nodes=48):
    """Points and weights of Gauss and Legendre on `count` equal panels."""
    x, w = np.polynomial.legendre.leggauss(nodes)
    edges = np.linspace(low, high, count + 1)
    middle, half = (edges[1:] + edges[:-1]) / 2, (edges[1:] - edges[:-1]) / 2
    return (middle[:, None] + half[:, None] * x).ravel(), (half[:, None] * w).ravel()


def root(function, low, high):
    """Zero of a continuous function between two ends with different signs, by the method of Illinois."""
    below, above = function(low), function(high)
    if below == 0.0:
        return low
    if above == 0.0:
        return high
    last = 0
    for _ in range(300):
        middle = high - above * (high - low) / (above - below)
        if not low < middle < high:
            middle = (low + high) / 2
        found = function(middle)
        if found == 0.0 or high - low <= 4e-16 * abs(middle):
            return middle
        if (found > 0.0) == (above > 0.0):
            moved, high, above = abs(high - middle), middle, found
            below = below / 2 if last == 1 else below
            last = 1
        else:
            moved, low, below = abs(middle - low), middle, found
            above = above / 2 if last == -1 else above
            last = -1
        if moved <= 2e-16 * abs(middle):
            return middle
    return (low + high) / 2


def fraction_of_beta(a, b, x):
    """Continued fraction of the incomplete beta function, by the algorithm of Lentz."""
    tiny = 1e-300
    c, d = 1.0, 1.0 - (a + b) * x / (a + 1.0)
    d = 1.0 / (d or tiny)
    value = d
    for m in range(1, 5000):
        even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m))
        odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1))
        for term in (even, odd):
            d = 1.0 / (1.0 + term * d or tiny)
            c = 1.0 + term / c or tiny
            value *= c * d
        if abs(c * d - 1.0) < 1e-16:
            break
    return value


def student_above(t, freedom):
    """Probability that Student's t exceeds `t`, for t ≥ 0."""
    a, b = freedom / 2, 0.5
    x, rest = freedom / (freedom + t * t), t * t / (freedom + t * t)
    if t == 0.0:
        return 0.5
    front = math.exp(math.lgamma(a + b) - math.lgamma(a) - math.lgamma(b) + a * math.log(x) + b * math.log(rest))
    if x < (a + 1) / (a + b + 2):
        return front * fraction_of_beta(a, b, x) / a / 2
    return (1.0 - front * fraction_of_beta(b, a, rest) / b) / 2


def student_density(t, freedom):
    scale = math.lgamma((freedom + 1) / 2) - math.lgamma(freedom / 2)
    return math.exp(scale - (freedom + 1) / 2 * math.log1p(t * t / freedom)) / math.sqrt(freedom * math.pi)


@functools.lru_cache(None)
def student_quantile(probability, freedom):
    """Quantile of Student's t above the median. Newton's steps begin at the normal quantile, which is below it, and only increase."""
    wanted, t = 1.0 - probability, NORMAL.inv_cdf(probability)
    for _ in range(200):
        step = (student_above(t, freedom) - wanted) / student_density(t, freedom)
        t += step
        if abs(step) <= 2e-16 * t:
            break
    return t


def chi_squared_above(x, freedom):
    """Probability that chi-squared exceeds `x`: a series below the mean, a continued fraction above it."""
    a, x = freedom / 2, x / 2
    if x <= 0.0:
        return 1.0
    front = math.exp(a * math.log(x) - x - math.lgamma(a))
    if x < a + 1:
        term = value = 1.0 / a
        n = 0
        while term > value * 1e-17:
            n += 1
            term *= x / (a + n)
            value += term
        return 1.0 - front * value
    tiny = 1e-300
    b = x + 1.0 - a
    c, d = 1.0 / tiny, 1.0 / b
    value = d
    for i in range(1, 5000):
        above = -i * (i - a)
        b += 2.0
        d = 1.0 / (above * d + b or tiny)
        c = b + above / c or tiny
        value *= c * d
        if abs(c * d - 1.0) < 1e-16:
            break
    return front * value


@functools.lru_cache(None)
def chi_squared_quantile(probability, freedom):
    wanted = 1.0 - probability
    high = freedom + 10.0
    while chi_squared_above(high, freedom) > wanted:
        high *= 2
    return root(lambda x: chi_squared_above(x, freedom) - wanted, 0.0, high)


@functools.lru_cache(None)
def spread_nodes(freedom):
    """Values of √(χ²/ν), each with its weight."""
    width = 14 / math.sqrt(2 * freedom)
    at, weight = panels(max(0.0, 1 - width), 1 + width, 12)
    log = math.log(2) + freedom / 2 * math.log(freedom / 2) - math.lgamma(freedom / 2)
    return at, weight * np.exp(log + (freedom - 1) * np.log(at) - freedom * at * at / 2)


def normal_below(x):
    return np.array([math.erfc(-v / math.sqrt(2)) / 2 for v in x])


def noncentral_t_below(t, freedom, noncentrality):
    at, weight = spread_nodes(freedom)
    return math.fsum(weight * normal_below(t * at - noncentrality))


@functools.lru_cache(None)
def noncentral_t_quantile(probability, freedom, noncentrality):
    low, high = noncentrality - 10.0, noncentrality + 10.0
    while noncentral_t_below(low, freedom, noncentrality) > probability:
        low -= 2 * (high - low)
    while noncentral_t_below(high, freedom, noncentrality) < probability:
        high += 2 * (high - low)
    return root(lambda t: noncentral_t_below(t, freedom, noncentrality) - probability, low, high)


def critical_factor(freedom):
    """95 % quantile of Student's t."""
    return student_quantile(0.95, freedom)


@functools.lru_cache(None)
def detection_factor(freedom):
    """Noncentrality for which noncentral t is below the critical factor with a probability of 5 %."""
    t = critical_factor(freedom)
    return root(lambda shift: noncentral_t_below(t, freedom, shift) - 0.05, t * 0.5, t * 8)


def half_width(off, share):
    """Half-width of the interval about `off` that holds the share of a normal distribution."""
    missed = lambda r: math.erfc((r - off) / math.sqrt(2)) / 2 + math.erfc((r + off) / math.sqrt(2)) / 2
    r = max(off + NORMAL.inv_cdf(share), NORMAL.inv_cdf((1 + share) / 2))
    for _ in range(60):
        step = (missed(r) - (1.0 - share)) / (NORMAL.pdf(r - off) + NORMAL.pdf(r + off))
        r += step
        if abs(step) <= 2e-16 * r:
            break
    return r


@functools.lru_cache(None)
def tolerance_factor(worth, freedom, share, confidence):
    """Exact two-sided factor of tolerance limits of a normal sample of `worth` values (Krishnamoorthy and Mathew, 2009)."""
    at, weight = panels(0.0, 9.0, 6, 24)
    halves = [half_width(x / math.sqrt(worth), share) for x in at]
    density = 2 * weight * np.exp(-at * at / 2) / math.sqrt(2 * math.pi)
    held = lambda k: math.fsum(d * chi_squared_above(freedom * (h / k) ** 2, freedom) for h, d in zip(halves, density))
    howe = half_width(0.0, share) * math.sqrt((1 + 1 / worth) * freedom / chi_squared_quantile(1.0 - confidence, freedom))
    return root(lambda k: held(k) - confidence, howe / 2, howe * 2)
