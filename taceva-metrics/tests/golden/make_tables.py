"""Writes tables.json: sixty ordinary tables as recipes, and their scores to 50 digits with nothing rounded on the way.

python3 make_tables.py > tables.json
"""
import json
from decimal import Decimal, getcontext
from fractions import Fraction

getcontext().prec = 90
MASK = (1 << 64) - 1


class Splitmix:
    def __init__(self, seed):
        self.state = seed

    def next(self):
        self.state = (self.state + 0x9E3779B97F4A7C15) & MASK
        z = self.state
        z = ((z ^ (z >> 30)) * 0xBF58476D1CE4E5B9) & MASK
        z = ((z ^ (z >> 27)) * 0x94D049BB133111EB) & MASK
        return z ^ (z >> 31)

    def unit(self):
        return (self.next() >> 11) * 2.0**-53

    def bell(self):
        total = self.unit()
        for _ in range(11):
            total = total + self.unit()
        return total - 6.0


def decimal(value):
    exact = Decimal(value.numerator) / Decimal(value.denominator)
    return str(exact.normalize().__round__(0) if exact == 0 else Decimal(exact).quantize(
        Decimal(1).scaleb(exact.adjusted() - 49)))


def root(value):
    return (Decimal(value.numerator) / Decimal(value.denominator)).sqrt()


def table(seed, rows, low, high, noise):
    random = Splitmix(seed)
    truth, estimate = [], []
    for _ in range(rows):
        y = low + (high - low) * random.unit()
        truth.append(y)
        estimate.append(y + noise * random.bell())
    y = [Fraction(v) for v in truth]
    e = [Fraction(v) for v in estimate]
    d = [a - b for a, b in zip(y, e)]
    n = len(y)
    squares = sum(v * v for v in d)
    mean = sum(y) / n
    spread = sum((v - mean) ** 2 for v in y)
    eps = Fraction(1e-8)
    terms = sum(abs(v) / ((abs(a) + abs(b)) / 2 + eps) for v, a, b in zip(d, y, e))
    rmse = root(squares / n)
    return {
        "seed": seed,
        "rows": rows,
        "low": low,
        "high": high,
        "noise": noise,
        "mae": decimal(sum(abs(v) for v in d) / n),
        "bias": decimal(sum(d) / n),
        "rmse": str(rmse.quantize(Decimal(1).scaleb(rmse.adjusted() - 49))),
        "r2": decimal(1 - squares / spread),
        "smape": decimal(terms / n),
        # Size of errors relative to the mean error: cancellation.
        "absolute": float(sum(abs(v) for v in d) / n),
    }


def main():
    kinds = [(-12.5, 12.5, 0.3), (0.02, 1.83, 0.04), (-0.5, 0.5, 0.02), (0.0, 3.0, 0.1)]
    rows = [5, 12, 20, 31, 46, 60, 80, 97, 120, 150, 170, 199, 230, 277, 320]
    tables = [
        table(7000 + 60 * kind + count, count, *kinds[kind]) for count in rows for kind in range(4)
    ]
    print(json.dumps({"schema": "taceva-golden-tables/1", "tables": tables}, indent=0))


main()
