"""What a model reads of a quantity in the plane: its direction, and its length.

usage: python3 benches/peers/length_and_direction.py SAMPLES.csv X Y

The table is written by `taceva evaluate --samples-out`. Printed are, by the true length, how long the predictions are and how far their
directions lie off; then what would be predicted by whoever knows every direction exactly and of the lengths nothing but their mean.
"""
import csv
import math
import sys


def main():
    path, *axes = sys.argv[1:]
    with open(path, newline="") as table:
        rows = [row for row in csv.DictReader(table) if all(row[f"{axis}_predicted"] for axis in axes)]
    true = [complex(*(float(row[axis]) for axis in axes)) for row in rows]
    predicted = [complex(*(float(row[f"{axis}_predicted"]) for axis in axes)) for row in rows]
    print("true length  samples  mean predicted length  its deviation  median of |angle|")
    for low in range(math.ceil(max(map(abs, true)))):
        pairs = [(t, p) for t, p in zip(true, predicted) if low <= abs(t) < low + 1]
        lengths = [abs(p) for _, p in pairs]
        mean = sum(lengths) / len(pairs)
        deviation = math.sqrt(sum((length - mean) ** 2 for length in lengths) / len(pairs))
        angles = sorted(abs(math.degrees(math.atan2((p / t).imag, (p / t).real))) for t, p in pairs)
        print(f"{low} to {low + 1:<8} {len(pairs):5d} {mean:18.2f} {deviation:18.2f} {angles[len(pairs) // 2]:16.1f}")
    length = sum(map(abs, true)) / len(true)
    report("the model", true, predicted)
    report("directions known, lengths not", true, [t / abs(t) * length for t in true])


def report(name, true, predicted):
    """R² and root mean square of each axis."""
    for axis in ("real", "imag"):
        t = [getattr(value, axis) for value in true]
        squares = sum((a - getattr(b, axis)) ** 2 for a, b in zip(t, predicted))
        mean = sum(t) / len(t)
        r2 = 1 - squares / sum((a - mean) ** 2 for a in t)
        print(f"{name}: R² {r2:.3f}, root mean square {math.sqrt(squares / len(t)):.2f}")


main()
