"""How often the interval of skill holds where few locations make most of the error; simulated, for docs/coverage.md.

    python3 benches/peers/heavy_tails.py

Errors at a location are Gaussian with a spread of its own: log-normal with a standard deviation of 0.5 or 1 of its logarithm, or six times
as wide at every twelfth location as elsewhere. The interval is that of `taceva-metrics` (clusters left out on the scale of a logarithm
that goes on along its tangent below 0.7, at least 3 degrees of freedom), written anew with numpy and no line shared.
"""

import math

import numpy as np

RUNS = 4000
PRESSES = 4
FREEDOM = [3, 4, 5, 6, 8, 10, 15, 20, 30, 45]
STUDENT = [3.182, 2.776, 2.571, 2.447, 2.306, 2.228, 2.131, 2.086, 2.042, 2.014]
TANGENT = 0.7


def interval(model, constant):
    """Both ends of the interval of the skill, for squared errors of `model` and `constant` summed by (run, location)."""
    locations = model.shape[1]
    whole = model.sum(1, keepdims=True) / constant.sum(1, keepdims=True)
    without = (model.sum(1, keepdims=True) - model) / (constant.sum(1, keepdims=True) - constant)
    ratio = without / whole
    tangent = math.log(TANGENT) + (ratio - TANGENT) / TANGENT
    carried = np.where(ratio < TANGENT, tangent, np.log(np.maximum(ratio, 1e-300)))
    pseudo = -(locations - 1) * carried
    squares = (pseudo - pseudo.mean(1, keepdims=True)) ** 2 / (locations - 1)
    variance = squares.mean(1)
    kurtosis = (squares**2).mean(1) / variance**2
    with np.errstate(divide="ignore"):
        freedom = 2 * locations / (kurtosis - (locations - 3) / (locations - 1))
    freedom = np.where(freedom > 0, np.clip(freedom, 3, locations - 1), locations - 1)
    half = np.interp(freedom, FREEDOM, STUDENT) * np.sqrt(variance)
    return 1 - whole[:, 0] * np.exp(half), 1 - whole[:, 0] * np.exp(-half)


def spreads(random, kind, locations):
    """The spread of each (run, location), and the mean of its square."""
    if kind == "one in twelve":
        return np.where(random.random((RUNS, locations, 1)) < 1 / 12, 6.0, 1.0), 11 / 12 + 36 / 12
    deviation = float(kind.split()[1])
    return np.exp(deviation * random.standard_normal((RUNS, locations, 1))), math.exp(2 * deviation**2)


def main():
    random = np.random.default_rng(1)
    print("| spread of locations | locations | contained, skill 0.9 | shown, skill 0.9 | contained, skill 0 | shown, skill 0 |")
    print("|---|---|---|---|---|---|")
    for kind in ["log-normal 0.5", "log-normal 1", "one in twelve"]:
        for locations in [10, 16, 46]:
            cells = []
            for skill in [0.9, 0.0]:
                truth = random.uniform(-1, 1, (RUNS, locations, PRESSES))
                spread, mean_square = spreads(random, kind, locations)
                spread = spread * math.sqrt((1 - skill) / 3 / mean_square)
                errors = spread * random.standard_normal((RUNS, locations, PRESSES))
                low, high = interval((errors**2).sum(2), (truth**2).sum(2))
                cells += [((low <= skill) & (skill <= high)).mean(), (low > 0).mean()]
            print(f"| {kind} | {locations} | " + " | ".join(f"{cell:.3f}" for cell in cells) + " |")


main()
