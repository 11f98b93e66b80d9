"""Models on recordings, by the pipeline of the command."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Any

from taceva import _taceva
from taceva._bar import bar
from taceva._dataset import Dataset
from taceva._result import Result


def evaluate(
    dataset: Dataset | str | os.PathLike[str],
    model: str | os.PathLike[str],
    *,
    settings: Mapping[str, Any] | None = None,
    channels: Sequence[str] = (),
    split: str | None = None,
    seed: int = 0,
    part: str | None = None,
    metrics: str | Sequence[str] = "all",
    jobs: int = 0,
) -> Result:
    """Fit a model on the training part of a recording, predict what it has not seen, and score that.

    Parameters
    ----------
    model
        A name, such as ``ridge``, ``cnn`` or ``linfa/elastic-net``, or the file of a fitted model, which brings its own split.
    settings
        Settings of the model and its features by name: ``{"size": "16x16"}``.
    channels
        What to predict; all labels of the recording, if empty.
    split, seed
        As of `Dataset.split`.
    part
        ``test`` where nothing is said; ``train``, ``validation`` or ``all`` are no test, and a note says so.

    Returns
    -------
    Result
        What ``taceva evaluate DATASET --model NAME --format json`` writes, byte for byte.

    Raises
    ------
    ModelError
        For a model that does not fit the recording.
    ValueError
        For a model, a setting or a split that does not exist.
    """
    recording = dataset if isinstance(dataset, Dataset) else Dataset(dataset)
    words = [f"{name}={_written(value)}" for name, value in (settings or {}).items()]
    text = _taceva.evaluate_named(
        recording._inner,
        os.fspath(model),
        words,
        list(channels),
        split,
        seed,
        part,
        [metrics] if isinstance(metrics, str) else list(metrics),
        jobs,
        bar(),
    )
    return Result(text)


def _written(value: Any) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)
