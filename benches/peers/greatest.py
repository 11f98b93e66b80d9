"""How often a jackknife's interval holds a greatest value; simulated, for docs/coverage.md.

    python3 benches/peers/greatest.py

The score is the greatest of 30 leaks, each the slope of a prediction on the truth of another channel, as in `crosstalk`. Contact points
are left out on the scale of a logarithm.
"""

import numpy as np

RUNS = 2000
PRESSES = 20
LEAKS = 30
# Student's t at 97.5 % with 9 and 39 degrees of freedom.
STUDENT = {10: 2.262, 40: 2.023}


def held(points, slopes, random):
    """The share of runs whose interval holds the greatest of `slopes`."""
    found = 0
    for _ in range(RUNS):
        truth = random.uniform(-0.5, 0.5, (points, PRESSES, LEAKS))
        of_point = 0.04 * random.standard_normal((points, 1, LEAKS))
        noise = 0.05 * random.standard_normal(truth.shape)
        predicted = (slopes + of_point) * truth + noise
        products, squares = (truth * predicted).sum(1), (truth * truth).sum(1)
        greatest = np.abs(products.sum(0) / squares.sum(0)).max()
        without = np.abs((products.sum(0) - products) / (squares.sum(0) - squares)).max(1)
        logarithms = np.log(without)
        error = np.sqrt((points - 1) / points * ((logarithms - logarithms.mean()) ** 2).sum())
        half = STUDENT[points] * error
        found += greatest * np.exp(-half) <= slopes.max() <= greatest * np.exp(half)
    return found / RUNS


def main():
    random = np.random.default_rng(1)
    print("| leaks as large as the greatest | others | locations | contained |")
    print("|---|---|---|---|")
    for count in [1, 5, 30]:
        for points in [10, 40]:
            slopes = np.full(LEAKS, 0.01)
            slopes[:count] = 0.1
            others = "0.01" if count < LEAKS else "none"
            print(f"| {count} of 30 | {others} | {points} | {held(points, slopes, random):.3f} |")


if __name__ == "__main__":
    main()
