"""Checks of predictions, from models in this process and from plugins."""

from __future__ import annotations

from typing import Any

import numpy as np

from taceva._arrays import numbers
from taceva._column_names import predicted


def prediction_rows(predictions: Any, name: str, rows: int, channels: list[str]) -> Any:
    """Return predictions as an array ``[rows, channels]`` of float32 or float64; named columns are matched by name.

    ``name`` is the name of the model, for messages. NaN is accepted; callers that know the samples check for it.

    Raises
    ------
    TypeError
        For complex numbers, texts and objects.
    ValueError
        For a wrong shape, or other columns.
    """
    width = len(channels)
    named = f"prediction of {name}"
    found = numbers(predicted(predictions, channels, named), named, allow_invalid=True)
    if found.ndim == 1 and width == 1:
        found = found[:, np.newaxis]
    if found.shape != (rows, width):
        raise ValueError(f"{name} predicted an array of the shape {list(found.shape)}, expected {[rows, width]}: one row per sample, one column per channel")
    return np.ascontiguousarray(found)
