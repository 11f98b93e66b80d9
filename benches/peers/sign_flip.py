"""Which of two models errs less on the mean over channels: a paired sign-flip test over contact points, written independently of
`taceva compare`, which tests each channel.

usage: python3 benches/peers/sign_flip.py A.samples.csv B.samples.csv CHANNEL...

Both tables are written by `taceva evaluate --samples-out` on the same split. Printed are both mean absolute errors, their mean over
channels, and the share of 100,000 draws of signs (seed 1) in which the difference is at least as large as it is.
"""
import csv
import random
import sys


def errors(path, channels):
    """The mean over channels of |prediction − truth|, a list for each contact point."""
    points = {}
    with open(path, newline="") as table:
        for row in csv.DictReader(table):
            each = [abs(float(row[f"{name}_predicted"]) - float(row[name])) for name in channels if row[f"{name}_predicted"]]
            if len(each) == len(channels):
                points.setdefault(row["point_id"], []).append(sum(each) / len(each))
    return points


def main():
    first, second, *channels = sys.argv[1:]
    a, b = errors(first, channels), errors(second, channels)
    if a.keys() != b.keys():
        sys.exit("the two tables predict other contact points")
    count = sum(map(len, a.values()))
    mean = [sum(sum(point) for point in side.values()) / count for side in (a, b)]
    differences = [sum(a[point]) - sum(b[point]) for point in sorted(a)]
    seen, draws, random_bits = abs(sum(differences)), 100_000, random.Random(1)
    above = sum(
        abs(sum(value if random_bits.random() < 0.5 else -value for value in differences)) >= seen * (1 - 1e-12)
        for _ in range(draws)
    )
    print(f"mean absolute error {mean[0]:.4f} and {mean[1]:.4f}, {count} samples of {len(a)} contact points")
    print(f"p = {(1 + above) / (1 + draws):.5f}")


main()
