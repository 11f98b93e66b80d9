"""One study of a run: its samples with labels and predictions, the phases of its plan, and its split (docs/run-files.md)."""

import collections
import csv
import math
import tomllib
from fractions import Fraction
from pathlib import Path

import numpy as np
import pyarrow.parquet

from intervals import Undefined, attempt, jackknife, mean, number

MASK = (1 << 64) - 1
CHANNELS = ("Px", "Py", "Pz", "Fx", "Fy", "Fz")
PLANES = {"Pxy": ("Px", "Py"), "Fxy": ("Fx", "Fy")}
# Settings of a scene that states no others.
SETTINGS = {"bins": 20, "n_min": 1, "gate_N": 0.02, "smoothing": 5, "tolerance_mm": 0.05}


def channels(label):
    return PLANES.get(label, (label,))


def fnv(data):
    state = 0xCBF29CE484222325
    for byte in data:
        state = ((state ^ byte) * 0x100000001B3) & MASK
    return state


def mix(word):
    s = (word + 0x9E3779B97F4A7C15) & MASK
    s = ((s ^ (s >> 30)) * 0xBF58476D1CE4E5B9) & MASK
    s = ((s ^ (s >> 27)) * 0x94D049BB133111EB) & MASK
    return s ^ (s >> 31)


def numbers(column):
    return np.array([math.nan if value in (None, "") else float(value) for value in column])


def whole(value):
    """Whole millionths of a length or force, halves to even."""
    return round(value * 1e6)


def text_of(cell):
    """A text of a table of samples, without the apostrophe that protects a text which begins like a formula."""
    bare = cell.lstrip("'")
    return cell[1:] if cell.startswith("'") and bare[:1] in ("=", "+", "-", "@", "\t", "\r", "\n", "＝", "＋", "－", "＠") else cell


class Study:
    """Rows of a study in the order of its recording."""

    def __init__(self, run, plan, results, name, seed):
        self.results, self.seed = results, seed
        scene = tomllib.loads((run / "scene.toml").read_text())
        self.settings = SETTINGS | scene.get("metrics", {}).get("settings", {})
        self.header = tomllib.loads((run / "recordings" / name / "dataset.toml").read_text())
        table = pyarrow.parquet.read_table(run / "recordings" / name / "samples.parquet")
        labels = collections.defaultdict(lambda: [None] * table.num_rows)
        labels |= {column: table[column].to_pylist() for column in table.column_names}
        self.ids = labels["sample"]
        self.points = [point or "" for point in labels["point_id"]]
        self.units, self.scenes, self.branches, self.kinds = (labels[key] for key in ("unit_id", "scene", "phase", "kind"))
        self.digests = labels["frame_sha256"]
        self.steps, self.times, self.spacing, self.light = (numbers(labels[key]) for key in ("depth_step", "t_s", "spacing_mm", "intensity"))
        self.truth = {channel: numbers(labels[channel]) for channel in (*CHANNELS, "surface_z")}
        self.read_predictions(run / "reports" / f"{name}.samples.csv")
        self.read_plan(plan)
        self.read_footprint(self.header["footprint"])
        self.constants = self.means_of_training()

    def read_predictions(self, path):
        with path.open(newline="") as file:
            rows = {text_of(row["sample"]): row for row in csv.DictReader(file)}
        assert len(rows) == len(self.ids) and all(sample in rows for sample in self.ids), f"{path}: other samples than the recording"
        rows = [rows[sample] for sample in self.ids]
        for channel, labels in self.truth.items():
            assert np.array_equal(labels, numbers(row.get(channel) for row in rows), equal_nan=True), f"{path}: other labels of {channel}"

        def column(name):
            return numbers(row.get(name) for row in rows)

        self.bounded = {channel: column(f"{channel}_predicted") for channel in CHANNELS}
        free = {channel: column(f"{channel}_predicted_unbounded") for channel in CHANNELS}
        # The second column is absent if no prediction was clipped.
        self.free = {channel: self.bounded[channel] if np.isnan(free[channel]).all() else free[channel] for channel in CHANNELS}
        self.spacing_predicted = column("spacing_predicted_mm")
        self.has_predictions = not all(np.isnan(column).all() for column in (*self.bounded.values(), self.spacing_predicted))
        self.is_predicted = ~np.isnan(np.array(list(self.bounded.values()))).all(axis=0)
        self.words = [row["protocol"].split() for row in rows]

    def read_plan(self, plan):
        phases = {press["id"]: press["phases"] for press in plan["presses"]}
        self.of_phase = collections.defaultdict(list)
        for row, sample in enumerate(self.ids):
            of_press = phases.get(sample.split("/")[0], [])
            said = [word for word in self.words[row] if word != "other-units"]
            assert sorted(of_press) == sorted(said), f"{sample}: plans.json has the phases {of_press}, the table of samples {said}"
            for phase in of_press:
                self.of_phase[phase].append(row)
        self.phase_of = {metric["id"]: metric["phase"] for metric in plan["metrics"]}
        self.planned = {metric["id"]: metric["channels"] for metric in plan["metrics"]}

    def read_footprint(self, footprint):
        self.is_disc = footprint["shape"] == "disc"
        sides = ("radius_mm", "radius_mm") if self.is_disc else ("half_x_mm", "half_y_mm")
        self.half = tuple(whole(footprint[side]) for side in sides)
        self.reach = self.half[0]
        if not self.is_disc:
            square = self.half[0] ** 2 + self.half[1] ** 2
            self.reach = math.isqrt(square)
            self.reach += self.reach**2 < square
        self.depth_max = whole(footprint["depth_max_mm"])

    def rows(self, metric, predicted=True):
        """Rows that a metric reads."""
        # A plan that does not ask for the skill of its predictions gets it on their phase.
        rows = self.of_phase[self.phase_of.get(metric, "calibration")]
        return [row for row in rows if self.is_predicted[row]] if predicted else rows

    def cell(self, x, y, count):
        """Row and column of a place on a map of the surface; `None` outside."""
        x, y = whole(x), whole(y)
        inside = x * x + y * y <= self.half[0] ** 2 if self.is_disc else abs(x) <= self.half[0] and abs(y) <= self.half[1]
        if not inside:
            return None
        column, row = (min((v + half) * count // (2 * half), count - 1) for v, half in zip((x, y), self.half))
        return row, column

    def edges(self, count):
        return [[half * (2 * edge - count) / (count * 1e6) for edge in range(count + 1)] for half in self.half]

    def split(self):
        """Rows of the training, validation and test parts."""
        calibration = self.of_phase["calibration"]
        points = list(dict.fromkeys(self.points[row] for row in calibration))
        order, state = list(range(len(points))), self.results["provenance"]["seed"]
        for last in range(len(points) - 1, 0, -1):
            bound = last + 1
            while True:
                word = mix(state)
                state = (state + 0x9E3779B97F4A7C15) & MASK
                if word <= MASK - (MASK % bound + 1) % bound:
                    break
            order[last], order[word % bound] = order[word % bound], order[last]
        rule, _, shares = self.results["provenance"]["split"].partition(" ")
        assert rule == "by-point", f"split {rule}: the page states the rule by-point"
        exact = [float(share) / 100 * len(points) for share in shares.split("/")]
        counts = [math.floor(count + 1e-9) for count in exact]
        by_remainder = sorted(range(3), key=lambda part: counts[part] - exact[part])
        for part in by_remainder[: len(points) - sum(counts)]:
            counts[part] += 1
        for part in range(3):
            if counts[part] == 0:
                counts[counts.index(max(counts))] -= 1
                counts[part] += 1
        parts = [part for part, count in enumerate(counts) for _ in range(count)]
        part_of = {points[place]: part for place, part in zip(order, parts)}
        return [[row for row in calibration if part_of[self.points[row]] == part] for part in range(3)]

    def means_of_training(self):
        if "split" not in self.results["provenance"]:
            self.parts = None
            return {}
        predicted = [row for row in self.of_phase["calibration"] if self.is_predicted[row]]
        if self.results["provenance"]["split"].startswith("cv:"):
            # The models of the folds share no constant.
            self.parts = [[], [], self.of_phase["calibration"]]
            return {}
        self.parts = self.split()
        train, _, test = self.parts
        assert test == predicted, "the test part is not the part with predictions"
        return {channel: float(sum(Fraction(float(self.truth[channel][row])) for row in train) / len(train)) for channel in CHANNELS}

    def provenance(self):
        """Numbers behind the scores. The seed of the split is that of the plans."""
        frames = self.header.get("frames", {}).get("count", 0)
        found = {
            "seed": self.seed,
            "presses": {digest: self.header["presses"] for digest in self.results["provenance"]["presses"]},
            "frames_decoded": frames if self.has_predictions else 0,
        }
        if self.parts:
            counts = dict(zip(("train", "validation", "test"), map(len, self.parts)))
            left_out = len(self.ids) - sum(counts.values())
            found["samples"] = counts | ({"left_out": left_out} if left_out else {})
        return found


class Rows:
    """Rows of a metric, each in a cluster of its contact point."""

    def __init__(self, study, metric, predicted=True):
        self.study, self.rows = study, np.array(study.rows(metric, predicted), int)
        self.points = [study.points[row] for row in self.rows]
        names = sorted(set(self.points), key=str.encode)
        self.clusters = len(names)
        if self.clusters <= 64:
            cluster_of = {name: place for place, name in enumerate(names)}
        else:
            cluster_of = {name: mix(study.seed ^ fnv(name.encode())) % 32 for name in names}
            self.clusters = 32
        self.cluster = np.array([cluster_of[point] for point in self.points], int)
        self.all = np.ones(len(self.rows), bool)

    def truth(self, channel):
        return self.study.truth[channel][self.rows]

    def predicted(self, channel, free=False):
        return (self.study.free if free else self.study.bounded)[channel][self.rows]

    def pairs(self, label):
        """Truth, prediction and rows with both, of each channel."""
        of = {channel: (self.truth(channel), self.predicted(channel)) for channel in channels(label)}
        return {channel: (truth, predicted, ~np.isnan(truth) & ~np.isnan(predicted)) for channel, (truth, predicted) in of.items()}

    def left_out(self, count, of):
        """Samples of each cluster, and the numbers without it; clusters without a sample do not count."""
        clusters = range(self.clusters)
        counts = [count(self.cluster == cluster) for cluster in clusters]
        return [(counts[cluster], of(self.cluster != cluster)) for cluster in clusters if counts[cluster]]


def every(found, names):
    """The numbers, or the reason for each of them."""
    return dict.fromkeys(names, found) if isinstance(found, Undefined) else found


def scored(rows, of, count, kinds):
    """Nodes of the numbers that `of` computes from a selection of rows. A kind of `None` has no interval."""
    numbers = lambda kept: every(attempt(of, kept), kinds)
    full = numbers(rows.all)
    left = rows.left_out(count, numbers) if set(kinds.values()) - {None, "greatest"} else []
    nodes = {}
    for name, value in full.items():
        kind = kinds.get(name)
        interval = attempt(jackknife, value, kind, [(samples, others[name]) for samples, others in left]) if kind else None
        nodes[name] = number(value, interval)
    return nodes


def mean_of_axes(of):
    """Numbers of a plane: the mean of both axes, undefined if one is."""
    first, *others = of
    if not others:
        return first
    wrong = lambda name: next((axis[name] for axis in of if isinstance(axis[name], Undefined)), None)
    return {name: wrong(name) or mean(axis[name] for axis in of) for name in first}


def by_channel(rows, label, one, count, kinds):
    """Nodes of a channel, or the means of both axes of a plane. Its jackknife counts the samples of both."""
    names = channels(label)
    return scored(
        rows,
        lambda kept: mean_of_axes([one(channel, kept) for channel in names]),
        lambda kept: sum(count(channel, kept) for channel in names),
        kinds,
    )


def score(nodes, n, counts=None, **arrays):
    """Node of a score: its value, its variants and its arrays."""
    node = nodes.pop("value") | {"n": n, "n_invalid": 0} | nodes | arrays
    return node | ({"counts": counts} if counts else {})


def studies(run, results, plans):
    """Studies of a run, in its order."""
    folders = sorted((Path(run) / "recordings").glob("*/dataset.toml"), key=lambda path: int(path.parent.name.split("-")[0]))
    for folder, plan, of_study in zip(folders, plans["studies"], results["studies"], strict=True):
        yield Study(Path(run), plan, of_study, folder.parent.name, plans["seed"])
