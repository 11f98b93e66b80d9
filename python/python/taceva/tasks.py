"""Scores of tasks: slip, objects, grasps and changes of pose, as ``taceva score --task`` computes them."""

from __future__ import annotations

import csv
import json
import os
import tempfile
from collections.abc import Mapping, Sequence
from numbers import Real
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from taceva import _taceva
from taceva._arrays import real, require_rows
from taceva._counted import counted
from taceva._metrology import Metrology

__all__ = ["TaskComparison", "TaskScores", "compare", "merge", "score", "score_tables"]

#: Ends of the names of the columns of a pose.
_POSE = ("x", "y", "z", "qx", "qy", "qz", "qw")

#: Columns of the tables beside the task.
_BESIDE = ("id", "cluster", "t_s")


class TaskScores(Metrology):
    """Result of `score`, `score_tables` or `merge`: each score with its definition, interval, and numbers of samples and clusters."""

    @property
    def states(self) -> bytes:
        """Counts and exact sums of each cluster, for `merge` and for ``taceva merge``. A changed byte is refused."""
        return str(self._found["states"]).encode()

    def save_states(self, path: str | os.PathLike[str]) -> None:
        """Write the states to ``path``, which must not exist."""
        with Path(path).open("xb") as file:
            file.write(self.states)

    def __getitem__(self, metric: str | tuple[str, str]) -> dict[str, Any]:
        """Return the score of a metric of the only task, or of ``task, metric``. A variant follows a dot: ``"f1_macro.class slip"``."""
        tasks = self.to_dict()["tasks"]
        task, asked = (None, metric) if isinstance(metric, str) else metric
        if task is None and len(tasks) > 1:
            raise KeyError(f"{asked}: several tasks; expected result[task, metric] with one of {', '.join(own['name'] for own in tasks)}")
        name, _, variant = asked.partition(".")
        for own in tasks:
            for found in own["scores"]:
                if task in (None, own["name"]) and (found["metric"], found["variant"]) == (name, variant or None):
                    return dict(found)
        known = sorted({found["metric"] for own in tasks for found in own["scores"]})
        raise KeyError(f"{asked}: no such score, expected one of {', '.join(known)}")

    def __repr__(self) -> str:
        tasks = self.to_dict()["tasks"]
        words = [f"{task['name']}: {counted(_samples(task), 'sample')}" for task in tasks]
        return f"<taceva.tasks.TaskScores of {', '.join(words)}>"


class TaskComparison(Metrology):
    """Result of `compare`: scores side by side, and the test of each score of each pair of results."""

    def __repr__(self) -> str:
        found = self.to_dict()
        return f"<taceva.tasks.TaskComparison of {', '.join(found['of'])}: {counted(len(found['answers']), 'answer')}>"


def _samples(task: Mapping[str, Any]) -> int:
    return max((int(score["estimate"]["n"]) for score in task["scores"]), default=0)


def score(
    truth: Any,
    prediction: Any = None,
    *,
    clusters: Any,
    probabilities: Any = None,
    names: Sequence[str] | None = None,
    positive: Any = None,
    kind: str | None = None,
    times: Any = None,
    threshold: float | None = None,
    debounce: int | None = None,
    thresholds: Mapping[str, Sequence[str]] | None = None,
    name: str = "task",
    source: str = "unknown",
) -> TaskScores:
    """Score the predictions of a task, with intervals over clusters.

    Parameters
    ----------
    truth
        True classes ``[rows]``: names, or positions in ``names``. ``None``, NaN and ``""`` are rows without a label, which are left out. A task
        of poses has ``[rows, 7]``: x, y, z in mm and a quaternion x, y, z, w.
    prediction
        Predicted classes or poses, of the same form. The prediction may be absent beside probabilities: the class with the greatest score counts.
    clusters
        Stroke, clip or object of each row. Rows of a cluster resemble each other, so intervals are over clusters.
    probabilities
        Scores ``[rows, classes]`` in the order of ``names``, or ``[rows]`` of the positive one of two classes, with a ``threshold``.
    names
        Classes in their order; by default the classes that occur.
    positive
        Class that F1, precision and recall describe.
    kind
        ``"class"``, ``"outcome"``, ``"event"`` or ``"pose"``; by default ``"pose"`` for seven columns, else ``"event"`` with times, ``"outcome"``
        with a positive class, and ``"class"``.
    times
        Time of each row in s, for onsets of an event.
    threshold
        The positive class is predicted if its score is above this number.
    debounce
        Number of consecutive positive frames from which on the positive class is predicted.
    thresholds
        Thresholds between classes of a pose, as decimals: ``{"t": ["0.1", "0.5"], "r": ["0.2", "1"]}``, in mm and degrees.
    name
        Name of the task.
    source
        Origin of the samples, such as ``"recorded"`` or ``"simulated"``.

    Raises
    ------
    ValueError
        For arrays of another length, a class that is not among the names, a score that is not finite, and a quaternion of another norm.

    >>> import taceva
    >>> truth, found = ["lost", "held"] * 12, ["lost", "held", "held", "held"] * 6
    >>> result = taceva.tasks.score(truth, found, clusters=[row // 4 for row in range(24)], positive="held")
    >>> result["f1"]["estimate"]["value"], result["f1"]["estimate"]["of_constant"]
    (0.8, 0.6666666666666666)
    >>> result
    <taceva.tasks.TaskScores of task: 24 samples>
    """
    if name in _BESIDE or not name:
        raise ValueError(f"name {name!r}: expected another name than {', '.join(_BESIDE)}")
    is_pose = kind == "pose" or (kind is None and _is_pose(truth))
    kind = kind or ("pose" if is_pose else "event" if times is not None else "outcome" if positive is not None else "class")
    classes = None if names is None else [str(own) for own in names]
    given: dict[str, list[str]] = _poses(truth, name, "truth") if is_pose else {name: _labels(truth, "truth")}
    rows = len(next(iter(given.values())))
    found: dict[str, list[str]] = {}
    if prediction is not None:
        found = _poses(prediction, name, "prediction") if is_pose else {name: _labels(prediction, "prediction")}
    if probabilities is not None:
        found.update(_scores(probabilities, name, classes, positive))
    if not found:
        raise ValueError("prediction: expected predicted classes or poses, or probabilities")
    given["cluster"] = _labels(clusters, "clusters")
    if times is not None:
        given["t_s"] = [repr(time) for time in real(times, "times").astype(float).tolist()]
    for column, cells in {**given, **{f"prediction {own}": cells for own, cells in found.items()}}.items():
        if len(cells) != rows:
            raise ValueError(f"{column} has {counted(len(cells), 'row')}, truth has {rows}")
    task = {
        "name": name,
        "kind": kind,
        "positive": None if positive is None else _labels([positive], "positive")[0],
        "names": classes or [],
        "thresholds": None if thresholds is None else {axis: [str(cut) for cut in thresholds[axis]] for axis in ("t", "r")},
        "threshold": None if threshold is None else float(threshold),
        "debounce": None if debounce is None else int(debounce),
    }
    with tempfile.TemporaryDirectory() as folder:
        ids = [str(row) for row in range(rows)]
        tables = {"truth": {"id": ids, **given}, "prediction": {"id": ids, **found}}
        paths = {role: _written(Path(folder) / f"{role}.csv", columns) for role, columns in tables.items()}
        arguments = (paths["truth"], paths["prediction"], json.dumps([task]), "cluster", "id", source)
        return TaskScores(_called(_taceva.task_scores, arguments, {path: role for role, path in paths.items()}))


def score_tables(
    truth: str | os.PathLike[str],
    prediction: str | os.PathLike[str],
    tasks: str | Sequence[str],
    *,
    cluster: str | None = None,
    key: str | None = None,
    threshold: Mapping[str, float] | None = None,
    debounce: Mapping[str, int] | None = None,
    source: str = "unknown",
) -> TaskScores:
    """Score the tasks of two tables, as ``taceva score --task`` does.

    Parameters
    ----------
    truth, prediction
        Paths of the tables.
    tasks
        Tasks as the command takes them: ``"slip=event:positive=slip"``.
    cluster
        Column that tells strokes, clips or objects apart; by default ``point_id``.
    key
        Column that pairs the rows, or ``"order"``.
    threshold, debounce
        Rules by the name of the task: ``threshold={"slip": 0.4}``.
    source
        Origin of the samples of a truth without a column ``source``, such as ``"recorded"`` or ``"simulated"``.

    Raises
    ------
    ValueError
        For a missing column, an unknown class, and rows that do not pair.
    DatasetError
        For a table that cannot be read.
    """
    specs = [tasks] if isinstance(tasks, str) else list(tasks)
    limits, frames = dict(threshold or {}), dict(debounce or {})
    asked = []
    for spec in specs:
        own = spec.partition("=")[0]
        limit, least = limits.pop(own, None), frames.pop(own, None)
        rule = {"threshold": None if limit is None else float(limit), "debounce": None if least is None else int(least)}
        asked.append({"spec": spec, **rule})
    for unknown in [*limits, *frames]:
        raise ValueError(f"a rule is given for {unknown!r}, expected one of the tasks {', '.join(spec.partition('=')[0] for spec in specs)}")
    return TaskScores(_taceva.task_scores(os.fspath(truth), os.fspath(prediction), json.dumps(asked), cluster, key, source))


def merge(*results: TaskScores | bytes | str | os.PathLike[str]) -> TaskScores:
    """Return the common scores of parts: results, their ``states``, or files of states. The scores equal those of one call over all rows.

    Raises
    ------
    ValueError
        For parts of other classes, rules or cluster columns, for labels that would count twice, and for changed states.

    >>> import taceva
    >>> part = lambda clip, found: taceva.tasks.score(["lost", "held"], found, clusters=[clip] * 2, names=["lost", "held"])
    >>> taceva.tasks.merge(part("a", ["lost", "held"]), part("b", ["held", "held"]).states)["class_accuracy"]["estimate"]["value"]
    0.75
    """
    with tempfile.TemporaryDirectory() as folder:
        paths, own = _stored(results, Path(folder))
        return TaskScores(_called(_taceva.merge_tasks, (paths,), own))


def compare(
    *results: TaskScores | bytes | str | os.PathLike[str],
    names: Sequence[str] | None = None,
    metrics: Sequence[str] = (),
    seed: int = 0,
) -> TaskComparison:
    """Compare the scores of tasks of two or more results, as ``taceva compare`` does: cluster by cluster for the same labels.

    Parameters
    ----------
    results
        Results, their ``states``, or files of states.
    names
        Names of the results; by default ``A``, ``B`` and so on.
    metrics
        Scores to compare, such as ``["f1"]``; by default all.
    seed
        Seed of the random signs of clusters.

    Raises
    ------
    ValueError
        For fewer than two results, and for an unknown score.

    >>> import taceva
    >>> truth, clip = ["lost", "held"] * 20, [row // 4 for row in range(40)]
    >>> first = taceva.tasks.score(truth, ["lost", "held"] * 20, clusters=clip, names=["lost", "held"])
    >>> late = ["lost", "held", "held", "held"] * 5 + ["lost", "held"] * 10
    >>> second = taceva.tasks.score(truth, late, clusters=clip, names=["lost", "held"])
    >>> found = taceva.tasks.compare(first, second, metrics=["class_accuracy"])
    >>> found.to_dict()["answers"][0]["paired"], found.to_dict()["answers"][0]["values"]
    (True, [1.0, 0.875])
    """
    if len(results) < 2:
        raise ValueError(f"{counted(len(results), 'result')}, expected at least two")
    letters = [chr(ord("A") + at) if at < 26 else f"result {at + 1}" for at in range(len(results))]
    named = letters if names is None else [str(own) for own in names]
    if len(named) != len(results):
        raise ValueError(f"names: {counted(len(named), 'name')}, expected one for each of {len(results)} results")
    with tempfile.TemporaryDirectory() as folder:
        paths, own = _stored(results, Path(folder))
        return TaskComparison(_called(_taceva.compare_tasks, (named, paths, [str(metric) for metric in metrics], int(seed)), own))


def _stored(results: Sequence[Any], folder: Path) -> tuple[list[str], dict[str, str]]:
    """Return paths of states, and the names that errors give to the paths of temporary files."""
    paths: list[str] = []
    own: dict[str, str] = {}
    for at, result in enumerate(results, start=1):
        if isinstance(result, (str, os.PathLike)):
            paths.append(os.path.abspath(result))
            continue
        path = folder / f"{at}.state"
        path.write_bytes(result.states if isinstance(result, TaskScores) else bytes(result))
        own[str(path)] = f"result {at}"
        paths.append(str(path))
    return paths, own


def _called(function: Any, arguments: tuple[Any, ...], own: Mapping[str, str]) -> dict[str, Any]:
    """Call ``function``; errors name the user's arguments in place of temporary files."""
    try:
        return dict(function(*arguments))
    except ValueError as error:
        message = str(error)
        for path, words in own.items():
            message = message.replace(path, words)
        raised = type(error)(message)
        vars(raised).update(vars(error))
        if str(vars(raised).get("path")) in own:
            vars(raised)["path"] = None
        raise raised from None


def _written(path: Path, columns: Mapping[str, list[str]]) -> str:
    with path.open("x", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows(zip(*columns.values(), strict=True))
    return str(path)


def _is_pose(truth: Any) -> bool:
    shape: tuple[int, ...] = getattr(truth, "shape", ())
    return len(shape) == 2 and shape[1] == len(_POSE)


def _labels(given: Any, name: str) -> list[str]:
    """Return cells of labels; missing ones are empty.

    >>> _labels([0, 1.0, None, "slip", np.bool_(True), float("nan")], "truth")
    ['0', '1', '', 'slip', 'True', '']
    """
    found: npt.NDArray[Any] = np.asarray(given) if hasattr(given, "dtype") else np.asarray(given, dtype=object)
    if found.ndim != 1:
        raise ValueError(f"{name} has the shape {list(found.shape)}, expected one label per row")
    require_rows(found, name)
    return [_label(cell, f"{name} row {row}") for row, cell in enumerate(found.tolist())]


def _label(cell: Any, place: str) -> str:
    if cell is None or type(cell).__name__ in ("NAType", "NaTType"):
        return ""
    if isinstance(cell, (str, bool, np.bool_)):
        return str(cell)
    if isinstance(cell, Real):
        number = float(cell)
        if number != number:
            return ""
        if number.is_integer():
            return str(int(number))
    raise TypeError(f"{place}: {cell!r}, expected the name of a class or its position")


def _numbers(given: Any, name: str) -> npt.NDArray[np.float64]:
    return real(given, name).astype(np.float64)


def _poses(given: Any, name: str, role: str) -> dict[str, list[str]]:
    found = _numbers(given, role)
    if found.ndim != 2 or found.shape[1] != len(_POSE):
        raise ValueError(f"{role} has the shape {list(found.shape)}, expected [rows, 7]: x, y, z in mm and a quaternion x, y, z, w")
    cells = [["" if number != number else repr(number) for number in column] for column in found.T.tolist()]
    return {f"{name}.{part}": column for part, column in zip(_POSE, cells, strict=True)}


def _scores(given: Any, name: str, names: Sequence[str] | None, positive: Any) -> dict[str, list[str]]:
    found = _numbers(given, "probabilities")
    if found.ndim == 1:
        if positive is None:
            raise ValueError("probabilities has one column: name its class, the positive one of two, as positive=…")
        return {f"{name}.p.{_labels([positive], 'positive')[0]}": [repr(score) for score in found.tolist()]}
    if names is None:
        raise ValueError("probabilities: expected the classes of the columns as names=[…]")
    if found.ndim != 2 or found.shape[1] != len(names):
        raise ValueError(f"probabilities has the shape {list(found.shape)}, expected [rows, {len(names)}], a column for each of the names")
    return {f"{name}.p.{own}": [repr(score) for score in column] for own, column in zip(names, found.T.tolist(), strict=True)}
