"""Scores by place: sensitivity and its uniformity, errors by distance and depth, hysteresis, and the surfaces of two units."""

import collections
import math

import numpy as np

from accuracy import squares
from excess import excess, mean_excess
from hull import contains, hull
from intervals import Undefined, attempt, deviation, jackknife, known, mean, number, of_components, square_sum
from study import Rows, by_channel, channels, every, score, scored, whole

STEPS, FEW, DDOF = 100, 5, 0


def binned(keys, values):
    """Values of each bin, in the order of the bins."""
    bins = collections.defaultdict(list)
    for key, value in zip(keys.tolist(), values.tolist()):
        bins[key].append(value)
    return [bins[key] for key in sorted(bins)]


def of_means(bins, n_min, ddof):
    """Mean and deviation of the means of bins, the deviation by chance, and the mean deviation within bins."""
    bins = [of for of in bins if len(of) >= n_min]
    if not bins:
        return dict.fromkeys(("mean", "deviation", "noise", "within"), Undefined("no bin"))
    means, free = [mean(of) for of in bins], sum(len(of) - 1 for of in bins)
    within = mean(math.sqrt(square_sum(of) / len(of)) for of in bins)
    found = {"mean": mean(means), "deviation": attempt(deviation, means, ddof), "within": within}
    if not free:
        return found | {"noise": Undefined("no repeats")}
    pooled = math.fsum(map(square_sum, bins)) / free
    return found | {"noise": math.sqrt(pooled * mean(1 / len(of) for of in bins))}


def ratio(middle, spread):
    return abs(middle) / (abs(middle) + spread)


def node(function):
    """Node that the function returns, empty if it is undefined."""
    found = attempt(function)
    return {} if isinstance(found, Undefined) else found


def surface(study, metric, *_):
    """Compliance Pz / Fz, its map, and how uniform it is over the surface."""
    rows = Rows(study, metric, predicted=False)
    bins, n_min, gate = (study.settings[name] for name in ("bins", "n_min", "gate_N"))
    depth, force = rows.truth("Pz"), rows.truth("Fz")
    have = ~np.isnan(depth) & ~np.isnan(force)
    gated = have & ((force < gate) | (depth <= 0))
    ok = have & ~gated
    compliance = np.full(len(ok), math.nan)
    compliance[ok] = depth[ok] / force[ok]
    normal = ok & (np.abs(rows.truth("Fx")) < gate) & (np.abs(rows.truth("Fy")) < gate)
    places = [study.cell(x, y, bins) if of and not math.isnan(x + y) else () for x, y, of in zip(rows.truth("Px"), rows.truth("Py"), ok)]
    cell = np.array([place[0] * bins + place[1] if place else -1 for place in places])
    on_map = cell >= 0
    cells = binned(cell[on_map], compliance[on_map])
    used = sum(len(of) >= n_min for of in cells)
    counts = {"gated": int(gated.sum()), "outside": places.count(None), "bins_used": used}
    if metric == "sensitivity":
        return sensitivity(study, rows, (depth, force, compliance), ok, normal, cell, counts, bins, n_min)

    def numbers(kept):
        spreads = [
            of_means(binned(cell[on_map & also & kept], compliance[on_map & also & kept]), least, DDOF)
            for also, least in ((rows.all, n_min), (rows.all, FEW), (normal, n_min))
        ]
        of = [attempt(lambda s=s: ratio(known(s["mean"]), known(s["deviation"]))) for s in spreads]
        return dict(zip(("value", "n_min_5", "normal_only"), of)) | {key: spreads[0][key] for key in ("mean", "deviation")}

    kinds = {"value": "ratio", "n_min_5": "ratio", "normal_only": "ratio", "mean": "any", "deviation": "positive"}
    nodes = scored(rows, numbers, lambda kept: int((on_map & kept).sum()), kinds)

    def debiased():
        found = excess(cell[on_map], compliance[on_map], rows.cluster[on_map], n_min)
        ends = [ratio(found["mean"], end) for end in reversed(found["ends"])]
        return number(ratio(found["mean"], found["value"]), attempt(of_components, ends, len(set(rows.cluster[on_map]))))

    nodes["debiased"] = node(debiased)
    return score(nodes, int(on_map.sum()), counts)


def sensitivity(study, rows, columns, ok, normal, cell, counts, bins, n_min):
    depth, force, compliance = columns

    def numbers(kept):
        of, of_normal = ok & kept, normal & kept
        if not of.any():
            return dict.fromkeys(("value", "slope", "normal_only"), Undefined("no samples"))
        products = math.fsum((depth[of] * force[of]).tolist())
        without_shear = mean(compliance[of_normal]) if of_normal.any() else Undefined("no samples")
        return {"value": mean(compliance[of]), "slope": products / squares(force[of]), "normal_only": without_shear}

    nodes = scored(rows, numbers, lambda kept: int((ok & kept).sum()), dict.fromkeys(("value", "slope", "normal_only"), "any"))
    found = collections.defaultdict(list)
    for key, value in zip(cell.tolist(), compliance.tolist()):
        if key >= 0:
            found[divmod(key, bins)].append(value)
    return score(nodes, int(ok.sum()), counts, map=map_of(study, found, bins, n_min))


def map_of(study, found, bins, n_min=1):
    x, y = study.edges(bins)
    places = [[found.get((row, column), []) for column in range(bins)] for row in range(bins)]
    values = [[mean(of) if len(of) >= max(n_min, 1) else None for of in line] for line in places]
    return {"x_mm": x, "y_mm": y, "values": values, "counts": [[len(of) for of in line] for line in places]}


def r_spatial(study, metric, label, _):
    """Deviation of the mean absolute error between rings and between levels of depth."""
    rows = Rows(study, metric)
    n_min, window = study.settings["n_min"], study.settings["smoothing"]
    ring, level = (np.full(len(rows.rows), -1) for _ in range(2))
    outside = np.zeros(len(rows.rows), bool)
    for row, place in enumerate(zip(*(rows.truth(axis) for axis in ("Px", "Py", "Pz")))):
        if any(map(math.isnan, place)):
            continue
        x, y, z = map(whole, place)
        square = x * x + y * y
        if square > study.reach**2 or not 0 <= z <= study.depth_max:
            outside[row] = True
            continue
        ring[row] = min(math.isqrt(STEPS * STEPS * square) // study.reach, STEPS - 1)
        level[row] = min(z * STEPS // study.depth_max, STEPS - 1)
    names = channels(label)
    error = {channel: np.abs(rows.truth(channel) - rows.predicted(channel, free=True)) for channel in names}
    ok = {channel: (ring >= 0) & ~np.isnan(error[channel]) for channel in names}

    def smooth(bins):
        means = [mean(of) for of in bins if len(of) >= n_min]
        reach = window // 2
        if not means:
            raise Undefined("no bin")
        return deviation([mean(means[max(0, at - reach) : at + reach + 1]) for at in range(len(means))], DDOF)

    def one(channel, kept):
        kept = ok[channel] & kept
        both = [binned(keys[kept], error[channel][kept]) for keys in (ring, level)]
        full = [of_means(bins, n_min, DDOF) for bins in both]
        few = [of_means(bins, FEW, DDOF) for bins in both]
        middle = lambda of, key: attempt(lambda: mean(known(bins[key]) for bins in of))
        return {
            "value": middle(full, "deviation"),
            "std_distance": full[0]["deviation"],
            "std_depth": full[1]["deviation"],
            "within": middle(full, "within"),
            "noise_floor": middle(full, "noise"),
            "smooth": attempt(lambda: mean(map(smooth, both))),
            "n_min_5": middle(few, "deviation"),
        }

    def count(channel, kept):
        return int((ok[channel] & kept).sum())

    kinds = dict.fromkeys(("value", "std_distance", "std_depth", "within", "noise_floor", "smooth", "n_min_5"), "positive")
    nodes = by_channel(rows, label, one, count, kinds)

    def excess_of_all():
        of = [
            excess(keys[ok[channel]], error[channel][ok[channel]], rows.cluster[ok[channel]], n_min)
            for channel in names
            for keys in (ring, level)
        ]
        found = mean_excess(of)
        clusters = min(len(set(rows.cluster[ok[channel]])) for channel in names)
        return number(found["value"], attempt(of_components, found["ends"], clusters))

    nodes["excess"] = node(excess_of_all)
    n = min(count(channel, rows.all) for channel in names)
    if len(names) > 1:
        return score(nodes, n)
    of, kept = error[label], ok[label]
    counts, arrays = {"outside": int((outside & ~np.isnan(of)).sum())}, {}
    for name, keys, extent in (("distance", ring, study.reach), ("depth", level, study.depth_max)):
        bins = [of[kept & (keys == key)] for key in range(STEPS)]
        counts[f"bins_{name}"] = sum(len(values) >= max(n_min, 1) for values in bins)
        middles = [(2 * key + 1) * (extent / 1e6) / (2 * STEPS) for key in range(STEPS)]
        means = [mean(values) if len(values) >= max(n_min, 1) else None for values in bins]
        arrays[name] = {"x": middles, "values": means, "counts": [len(values) for values in bins]}
    return score(nodes, n, counts, **arrays)


def hysteresis(study, metric, *_):
    """Area between loading and unloading, of each contact point."""
    rows = Rows(study, metric, predicted=False)
    depth, force = rows.truth("Pz"), rows.truth("Fz")
    branch = [study.branches[row] for row in rows.rows]
    ok = ~np.isnan(depth) & ~np.isnan(force) & np.array([of in ("load", "unload") for of in branch])
    of_point = collections.defaultdict(list)
    for row in np.nonzero(ok)[0]:
        of_point[rows.points[row]].append(row)

    def press(of):
        sides = []
        for wanted in ("load", "unload"):
            at = collections.defaultdict(list)
            for row in of:
                if branch[row] == wanted:
                    at[depth[row]].append(force[row])
            if len(at) < 2:
                raise Undefined("a branch of one depth")
            sides.append((sorted(at), [mean(at[key]) for key in sorted(at)]))
        (down, pushed), (up, released) = sides
        low, high = max(down[0], up[0]), min(down[-1], up[-1])
        if low >= high:
            raise Undefined("branches at other depths")
        at = np.array(sorted({key for key in down + up if low <= key <= high}))
        loading = np.interp(at, down, pushed)
        gap = loading - np.interp(at, up, released)
        width, u, v = np.diff(at), gap[:-1], gap[1:]
        both = np.abs(u) + np.abs(v)
        crosses = u * v < 0
        areas = np.where(crosses, (u * u + v * v) / np.where(both == 0, 1, both), both) * width / 2
        area = math.fsum(areas.tolist())
        work = math.fsum(((loading[:-1] + loading[1:]) * width / 2).tolist())
        return {
            "value": area,
            "signed_area": math.fsum(((u + v) * width / 2).tolist()),
            "ratio": area / work,
            "greatest_difference": float(np.abs(gap).max() / np.abs(pushed).max()),
        }

    presses = {point: attempt(press, of) for point, of in of_point.items()}
    valid = {point: of for point, of in presses.items() if not isinstance(of, Undefined)}
    names = ("value", "signed_area", "ratio", "greatest_difference")

    def numbers(kept):
        left = [of for point, of in valid.items() if kept[of_point[point][0]]]
        return {name: mean(of[name] for of in left) if left else Undefined("no press") for name in names}

    kinds = dict.fromkeys(names, "positive") | {"signed_area": "any"}
    nodes = scored(rows, numbers, lambda kept: int((ok & kept).sum()), kinds)
    found, bins = collections.defaultdict(list), study.settings["bins"]
    x, y = rows.truth("Px"), rows.truth("Py")
    for point, of in valid.items():
        place = study.cell(mean(x[of_point[point]]), mean(y[of_point[point]]), bins)
        if place:
            found[place].append(of["value"])
    counts = {"points_valid": len(valid), "points_total": len(presses)}
    return score(nodes, int(ok.sum()), counts, map=map_of(study, found, bins))


def registration(moving, fixed):
    """Rotation and shift of least squares: by Kabsch in binary64, then two steps of Newton in a wider format."""
    moving, fixed = moving.astype(np.longdouble), fixed.astype(np.longdouble)
    of_moving, of_fixed = moving.mean(axis=0), fixed.mean(axis=0)
    products = (moving - of_moving).T @ (fixed - of_fixed)
    u, _, vt = np.linalg.svd(products.astype(float))
    turn = (vt.T @ np.diag([1, 1, np.sign(np.linalg.det(vt.T @ u.T))]) @ u.T).astype(np.longdouble)
    for _ in range(2):
        # Of the best rotation, the products of turned and fixed points are symmetric.
        of_turned = turn @ products
        skew = np.array([of_turned[j, i] - of_turned[i, j] for i, j in ((2, 1), (0, 2), (1, 0))])
        even = (of_turned + of_turned.T) / 2
        x, y, z = np.linalg.solve((np.trace(even) * np.eye(3) - even).astype(float), (skew / 2).astype(float) * 2)
        step = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]], np.longdouble)
        turn = turn + step @ turn
        # Back to a rotation: (3 − R Rᵀ) R / 2.
        turn = (3 * np.eye(3, dtype=np.longdouble) - turn @ turn.T) @ turn / 2
    return turn, of_fixed - turn @ of_moving


def inter_sensor(study, metric, *_):
    """Gap between the surfaces of two units, registered by their common points."""
    rows = Rows(study, metric, predicted=False)
    places = np.array([rows.truth(axis) for axis in ("Px", "Py", "surface_z")]).T
    ok = ~np.isnan(places).any(axis=1)
    distinct = collections.defaultdict(set)
    for row in np.nonzero(ok)[0]:
        distinct[study.units[rows.rows[row]], rows.points[row]].add(tuple(places[row].tolist()))
    middle = {key: np.array([mean(axis) for axis in zip(*of)]) for key, of in distinct.items()}
    cluster_of = dict(zip(rows.points, rows.cluster.tolist()))
    first, second = sorted({unit for unit, _ in middle})

    def gap(of, to):
        corners = hull([(float(x), float(y)) for x, y, _ in to])
        inside = [point for point in of if contains(corners, (float(point[0]), float(point[1])))]
        return mean(math.sqrt(float(((to - point) ** 2).sum(axis=1).min())) for point in inside)

    def numbers(without):
        one, two = (
            {point: at for (of, point), at in middle.items() if of == unit and cluster_of[point] != without} for unit in (first, second)
        )
        shared = [point for point in one if point in two]
        turn, shift = registration(np.array([two[point] for point in shared]), np.array([one[point] for point in shared]))
        one, two = np.array(list(one.values())), np.array(list(two.values())) @ turn.T + shift
        forward, backward = gap(one, two), gap(two, one)
        return {"value": (forward + backward) / 2, "forward": forward, "backward": backward}, len(shared)

    full, shared = numbers(None)
    samples = [int((ok & (rows.cluster == cluster)).sum()) for cluster in range(rows.clusters)]
    left = [(count, attempt(lambda c=cluster: numbers(c)[0])) for cluster, count in enumerate(samples) if count]
    left = [(count, every(found, full)) for count, found in left]
    nodes = {}
    for name, value in full.items():
        nodes[name] = number(value, attempt(jackknife, value, "positive", [(count, of[name]) for count, of in left]))
    counts = {"units": 2, "pairs_valid": 1, "pairs_total": 1, "pairs_by_point_id": int(shared >= 3), "pairs_unsettled": 0}
    matrix = {"values": [[None, full["value"]], [full["value"], None]]}
    return score(nodes, int(ok.sum()), counts, matrix=matrix)


METRICS = {
    "sensitivity": surface,
    "uniformity": surface,
    "r_spatial": r_spatial,
    "hysteresis": hysteresis,
    "inter_sensor": inter_sensor,
}
