"""Robustness to light: how much the error changes with the brightness of a scene."""

import numpy as np

from intervals import Undefined, attempt, mean, number, of_error, standard_error
from study import Rows, by_channel, channels, score

REFERENCE, LOW = "normal", 0.05


def robustness(scene, reference, increases=False):
    """R of a scene, from the mean error and the mean brightness of both."""
    a = abs(scene[1] / reference[1] - 1)
    b = scene[0] / reference[0] - 1
    b = max(b, 0.0) if increases else abs(b)
    if a + b == 0:
        raise Undefined("nothing changed")
    return a / (a + b)


def r_light(study, metric, label, _):
    rows = Rows(study, metric)
    names = channels(label)
    scene_of = np.array([study.scenes[row] or "" for row in rows.rows])
    light = study.light[rows.rows]
    error = {channel: np.abs(rows.truth(channel) - rows.predicted(channel, free=True)) for channel in names}
    ok = {channel: ~np.isnan(of) & ~np.isnan(light) & (scene_of != "") for channel, of in error.items()}
    scenes = sorted(set(scene_of[ok[names[0]]].tolist()) - {REFERENCE})

    def means(channel, kept):
        """Mean error and mean brightness of each scene with samples."""
        found = {}
        for scene in (REFERENCE, *scenes):
            of = ok[channel] & kept & (scene_of == scene)
            if of.any():
                found[scene] = mean(error[channel][of]), mean(light[of])
        return found

    def one(channel, kept):
        found = means(channel, kept)

        def of_scene(scene, increases=False):
            if scene not in found or REFERENCE not in found:
                raise Undefined("no samples")
            return robustness(found[scene], found[REFERENCE], increases)

        plain = {scene: attempt(of_scene, scene) for scene in scenes}
        plus = [attempt(of_scene, scene, True) for scene in scenes]
        of_defined = lambda values: attempt(lambda: mean_of([value for value in values if not isinstance(value, Undefined)]))
        nodes = {"value": of_defined(plain.values()), "plus": of_defined(plus)}
        return nodes | {f"scene:{scene}": value for scene, value in plain.items()}

    def count(channel, kept):
        return int((ok[channel] & kept).sum())

    n = min(count(channel, rows.all) for channel in names)
    full = {channel: means(channel, rows.all) for channel in names}
    is_low = any(abs(of[scene][1] / of[REFERENCE][1] - 1) < LOW for of in full.values() for scene in scenes)
    is_improved = any(of[scene][0] < of[REFERENCE][0] for of in full.values() for scene in scenes)
    flags = [flag for flag, is_raised in (("low stimulus", is_low), ("improved error", is_improved)) if is_raised]
    if len(names) == 1:
        node = of_channel(rows, label, scenes, full[label], lambda kept: means(label, kept), scene_of, ok[label], n)
    else:
        kinds = {"value": "ratio", "plus": "ratio with ends"} | {f"scene:{scene}": "ratio" for scene in scenes}
        nodes = by_channel(rows, label, one, count, kinds)
        pairs = [[(mean(of[at][0] for of in full.values()), full[names[0]][at][1]) for at in (scene, REFERENCE)] for scene in scenes]
        nodes["of_mean_error"] = {"value": mean(robustness(*pair) for pair in pairs)}
        node = score(nodes, n)
    return node | ({"flags": flags} if flags else {})


def mean_of(values):
    if not values:
        raise Undefined("no scene")
    return mean(values)


def of_channel(rows, label, scenes, full, means, scene_of, ok, n):
    """One channel: its intervals are of first order, because errors of scenes share contact points."""
    reference = full[REFERENCE]
    left = rows.left_out(lambda kept: int((ok & kept).sum()), means)
    clusters = {scene: len(set(rows.cluster[ok & (scene_of == scene)])) for scene in (REFERENCE, *scenes)}

    def slope(scene, increases):
        a, change = abs(full[scene][1] / reference[1] - 1), full[scene][0] / reference[0]
        of_error = a * change / (a + abs(change - 1)) ** 2
        return of_error if change < 1 and not increases else -of_error

    def interval(of, increases, kind):
        count = min(clusters[scene] for scene in (*of, REFERENCE))
        if count < 5:
            raise Undefined(f"{count} clusters")
        moved = []
        for samples, others in left:
            if any(scene not in others for scene in (*of, REFERENCE)):
                raise Undefined("no samples")
            change = {scene: others[scene][0] / full[scene][0] - 1 for scene in (*of, REFERENCE)}
            moved.append((samples, mean(slope(scene, increases) * (change[scene] - change[REFERENCE]) for scene in of)))
        value = mean(robustness(full[scene], reference, increases) for scene in of)
        return of_error(value, kind, standard_error(0.0, moved)[0], count - 1.0, count, rule="delta method")

    plain, plus = ([robustness(full[scene], reference, increases) for scene in scenes] for increases in (False, True))
    of_all = attempt(interval, scenes, False, "ratio")
    of_plus = of_all if plain == plus else attempt(interval, scenes, True, "ratio with ends")
    nodes = {"value": number(mean(plain), of_all), "plus": number(mean(plus), of_plus)}
    for scene, value in zip(scenes, plain):
        nodes[f"scene:{scene}"] = number(value, attempt(interval, [scene], False, "ratio"))
    table = [[full[scene][1] / reference[1], full[scene][0] / reference[0], a, b] for scene, a, b in zip(scenes, plain, plus)]
    return score(nodes, n, {"scenes": len(scenes), "scenes_defined": len(scenes)}, scenes={"values": table})


METRICS = {"r_light": r_light}
