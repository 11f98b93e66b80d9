"""Convex hull of points in a plane, by exact signs."""

import math
from fractions import Fraction


def turn(a, b, c):
    """Twice the signed area of a triangle: by binary64 if its sign is certain, else exact."""
    left, right = (b[0] - a[0]) * (c[1] - a[1]), (b[1] - a[1]) * (c[0] - a[0])
    if abs(left - right) > 1e-14 * (abs(left) + abs(right)):
        return left - right
    (ax, ay), (bx, by), (cx, cy) = ((Fraction(x), Fraction(y)) for x, y in (a, b, c))
    return (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)


def hull(points):
    """Corners of the hull, counterclockwise, by the chain of Andrew."""
    points = sorted(set(points))

    def chain(points):
        kept = []
        for point in points:
            while len(kept) > 1 and turn(kept[-2], kept[-1], point) <= 0:
                kept.pop()
            kept.append(point)
        return kept[:-1]

    return chain(points) + chain(points[::-1])


def area(points):
    first, *others = hull(points)
    return math.fsum(float(turn(first, a, b)) for a, b in zip(others, others[1:])) / 2


def contains(corners, point):
    return all(turn(a, b, point) >= 0 for a, b in zip(corners, corners[1:] + corners[:1]))
