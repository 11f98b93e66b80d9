"""Scenes, repeats, phases and units beside arrays, scored like tables with these columns."""

from __future__ import annotations

import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import taceva

CHANNELS = ["Px", "Py", "Pz", "Fx", "Fy", "Fz"]
POINTS, STEPS, REPEATS = 12, 3, 4


def presses() -> tuple[Any, Any, dict[str, Any], Any]:
    """Truth, prediction, fields and points: loading and unloading presses under two lights, from a fixed seed."""
    generator = np.random.default_rng(8)
    point, step, repeat, phase = (
        axis.reshape(-1) for axis in np.meshgrid(range(POINTS), range(STEPS), range(REPEATS), range(2), indexing="ij")
    )
    rows = len(point)
    truth = np.column_stack([point % 4, point // 4, 0.2 + 0.3 * step, *np.zeros((2, rows)), 0.5 + step + 0.1 * phase]).astype(float)
    truth += generator.normal(0, 0.01, truth.shape)
    fields = {
        "scene": np.where(repeat % 2 == 0, "dark", "bright"),
        "phase": ["load" if down == 0 else "unload" for down in phase],
        "depth_step": step.astype("i4"),
        "repeat": repeat.astype("u1"),
        "t_s": np.arange(rows) / 30,
    }
    return truth, truth + generator.normal(0, 0.05, truth.shape), fields, point


def test_arrays_with_fields_are_scored_as_tables_with_these_columns(tmp_path: Path) -> None:
    truth, prediction, fields, points = presses()
    tables = tmp_path / "truth.csv", tmp_path / "prediction.csv"
    names = list(fields)
    with tables[0].open("w") as file:
        print("point_id", *names, *CHANNELS, sep=",", file=file)
        for row, values in enumerate(truth.tolist()):
            print(points[row], *(fields[name][row] for name in names), *map(repr, values), sep=",", file=file)
    with tables[1].open("w") as file:
        print(*CHANNELS, sep=",", file=file)
        for values in prediction.tolist():
            print(*map(repr, values), sep=",", file=file)
    of_tables = taceva.score_tables(*tables).to_dict()["metrics"]
    result = taceva.score(truth, prediction, points=points, metrics="all", **fields)
    found = result.to_dict()["metrics"]
    needing = {"repeatability", "hysteresis", "r_light"} & set(of_tables)
    assert len(set(found) - set(taceva.score(truth, prediction, points=points, metrics="all").metrics)) >= 1, sorted(found)
    assert needing <= set(found)
    for metric in found:
        assert found[metric] == of_tables[metric], metric


def test_fields_come_in_pieces_merge_and_travel() -> None:
    truth, prediction, fields, points = presses()
    whole = taceva.score(truth, prediction, points=points, metrics="all", **fields)
    parts = [taceva.TactileMetrics(metrics="all", fields=list(fields)) for _ in range(2)]
    for at, part in enumerate(parts):
        part.update(truth[at::2], prediction[at::2], points[at::2], **{name: column[at::2] for name, column in fields.items()})
    merged = pickle.loads(pickle.dumps(parts[1]))
    merged.merge_states(parts[0].states())
    assert merged.compute().text == whole.text
    with pytest.raises(ValueError):
        merged.merge(taceva.TactileMetrics(["Fz"]))


@pytest.mark.parametrize(
    ("fields", "error", "message"),
    [
        ({}, ValueError, "scene is missing: every row needs scene, repeat"),
        ({"scene": ["a"] * 3, "repeat": [0, 1, 2], "t_s": [0.0] * 3}, ValueError, "t_s was not declared"),
        ({"scene": ["a"] * 2, "repeat": [0, 1, 2]}, ValueError, "scene has 2 rows, truth has 3"),
        ({"scene": ["a"] * 3, "repeat": [0.5, 1, 2]}, TypeError, "repeat: expected whole numbers, found an array of float64"),
        ({"scene": [None] * 3, "repeat": [0, 1, 2]}, TypeError, "scene: expected whole numbers or texts"),
    ],
    ids=["missing", "unexpected", "length", "fractions", "nothing"],
)
def test_fields_of_another_form_are_refused_and_nothing_is_taken_in(fields: dict[str, Any], error: type[Exception], message: str) -> None:
    metrics = taceva.TactileMetrics(["Fz"], fields=["scene", "repeat"])
    with pytest.raises(error, match=message):
        metrics.update(np.zeros((3, 1)), np.zeros((3, 1)), **fields)
    assert metrics.compute()["mae", "Fz"].n == 0


def test_fields_that_do_not_exist_are_refused_with_those_that_do() -> None:
    with pytest.raises(ValueError, match='no field "light": expected one of scene, unit_id, phase'):
        taceva.TactileMetrics(fields=["light"])
    with pytest.raises(TypeError, match="fields: expected a list of names"):
        taceva.TactileMetrics(fields="scene")
    with pytest.raises(ValueError, match="phase 'up': expected load or unload"):
        taceva.score(np.zeros((2, 6)), np.zeros((2, 6)), phase=["load", "up"])
