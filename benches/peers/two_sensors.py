"""How often two sensors that do not differ are shown to differ; simulated, for docs/coverage.md.

    python3 benches/peers/two_sensors.py

Errors at a location are Gaussian with a spread of its own: uniform about its mean, log-normal with a standard deviation of 0.5 or 1 of its
logarithm, or six times as wide at every twelfth location as elsewhere. The two sensors are tested on locations of their own. `by intervals`
is the decision of `taceva-metrics`: the intervals of both scores, made on the scale of a logarithm with at least 3 degrees of freedom, put
together as Zou and Donner do; `Welch` takes the jackknife's standard errors on the scale of the score and one degree of freedom less than
there are locations. Written anew with numpy and no line shared. `shown, 1.7 times` is of sensors of which one has errors 1.7 times as large.
"""

import math

import numpy as np

RUNS = 4000
PRESSES = 4
FREEDOM = [3, 4, 5, 6, 8, 10, 15, 20, 30, 45, 90, 1e9]
STUDENT = [3.182446, 2.776445, 2.570582, 2.446912, 2.306004, 2.228139, 2.131450, 2.085963, 2.042272, 2.014103, 1.986675, 1.959964]
TANGENT = 0.7


def quantile(freedom):
    """t of 95 %, between whole degrees by their reciprocals."""
    return np.interp(-1 / np.asarray(freedom, float), [-1 / f for f in FREEDOM], STUDENT)


def moved(whole, without):
    """Standard error and degrees of freedom of the jackknife, by (run, location left out)."""
    locations = without.shape[1]
    pseudo = locations * whole[:, None] - (locations - 1) * without
    squares = (pseudo - pseudo.mean(1, keepdims=True)) ** 2 / (locations - 1)
    variance = squares.mean(1)
    kurtosis = (squares**2).mean(1) / variance**2
    with np.errstate(divide="ignore"):
        freedom = 2 * locations / (kurtosis - (locations - 3) / (locations - 1))
    freedom = np.where(freedom > 0, np.clip(freedom, 3, locations - 1), locations - 1)
    return np.sqrt(variance), freedom


class Sensor:
    """A score of each run, a mean of positive numbers or 1 less such a mean, with its two kinds of interval."""

    def __init__(self, above, below):
        whole = above.sum(1) / below.sum(1)
        without = (above.sum(1, keepdims=True) - above) / (below.sum(1, keepdims=True) - below)
        ratio = without / whole[:, None]
        tangent = math.log(TANGENT) + (ratio - TANGENT) / TANGENT
        carried = np.where(ratio < TANGENT, tangent, np.log(np.maximum(ratio, 1e-300)))
        error, freedom = moved(np.zeros(len(whole)), carried)
        half = quantile(freedom) * error
        # A score that is 1 less such a mean has the same distances, exchanged; the test of a difference does not see that.
        self.value, self.low, self.high = whole, whole * np.exp(-half), whole * np.exp(half)
        self.error, _ = moved(whole, without)
        self.freedom = above.shape[1] - 1


def by_intervals(a, b):
    apart = a.value - b.value
    below = np.hypot(a.value - a.low, b.high - b.value)
    above = np.hypot(a.high - a.value, b.value - b.low)
    return (np.where(apart > 0, below, above) <= np.abs(apart)).mean()


def welch(a, b):
    error = np.hypot(a.error, b.error)
    freedom = error**4 / (a.error**4 / a.freedom + b.error**4 / b.freedom)
    return (np.abs(a.value - b.value) >= quantile(freedom) * error).mean()


def sensor(random, score, kind, locations, times):
    if kind == "uniform":
        spread = random.uniform(0.5, 1.5, (RUNS, locations, 1))
    elif kind == "one in twelve":
        spread = np.where(random.random((RUNS, locations, 1)) < 1 / 12, 6.0, 1.0)
    else:
        spread = np.exp(float(kind.split()[1]) * random.standard_normal((RUNS, locations, 1)))
    errors = times * spread * random.standard_normal((RUNS, locations, PRESSES))
    if score == "mae":
        return Sensor(np.abs(errors).sum(2), np.full((RUNS, locations), float(PRESSES)))
    truth = random.uniform(-4, 4, (RUNS, locations, PRESSES))
    return Sensor((errors**2).sum(2), (truth**2).sum(2))


def main():
    random = np.random.default_rng(1)
    print("| score | spread of locations | locations | by intervals | Welch | by intervals, 1.7 times | Welch, 1.7 times |")
    print("|---|---|---|---|---|---|---|")
    for score in ["mae", "skill"]:
        for kind in ["uniform", "log-normal 0.5", "log-normal 1", "one in twelve"]:
            for of_a, of_b in [(10, 10), (16, 16), (46, 46), (12, 46)]:
                a, b, worse = (sensor(random, score, kind, n, times) for n, times in [(of_a, 1), (of_b, 1), (of_b, 1.7)])
                shown = [by_intervals(a, b), welch(a, b), by_intervals(a, worse), welch(a, worse)]
                print(f"| {score} | {kind} | {of_a}, {of_b} | " + " | ".join(f"{cell:.3f}" for cell in shown) + " |")


main()
