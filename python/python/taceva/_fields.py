"""Fields of a row other than its numbers and contact point: scene, unit of the sensor, repeat and others."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from taceva._arrays import native, points, real
from taceva._counted import counted

#: Fields with texts, and fields with numbers, some of which are counts.
_TEXTS = ("scene", "unit_id", "phase")
_COUNTS = ("depth_step", "repeat")


def columns(fields: Mapping[str, Any], expected: Sequence[str], rows: int) -> list[tuple[str, Any]]:
    """Return each of the ``expected`` fields as an array or a list of strings, one value per row.

    Raises
    ------
    ValueError
        For a missing or undeclared field, a wrong length, an unknown phase, or a number that is not finite.
    TypeError
        For counts that are not whole numbers.
    """
    require_unweighted(fields)
    for name in expected:
        if name not in fields:
            raise ValueError(f"{name} is missing: every row needs {', '.join(expected)}, as declared in fields")
    for name in fields:
        if name not in expected:
            raise ValueError(f"{name} was not declared: add it at the start, fields=[{', '.join(map(repr, [*expected, name]))}]")
    found = []
    for name in expected:
        column = points(fields[name], name) if name in _TEXTS else _numbers(fields[name], name)
        if len(column) != rows:
            raise ValueError(f"{name} has {counted(len(column), 'row')}, truth has {rows}")
        if name == "phase":
            other = sorted({str(phase) for phase in column} - {"load", "unload"})
            if other:
                raise ValueError(f"phase {other[0]!r}: expected load or unload")
        found.append((name, column))
    return found


def require_unweighted(fields: Iterable[str]) -> None:
    """Reject weights, which no metric supports.

    >>> require_unweighted(["weights"])
    Traceback (most recent call last):
        ...
    TypeError: weights: metrics count every sample once; score each part by itself, or use your own function with taceva.score_function
    """
    for name in fields:
        if name in ("weight", "weights", "sample_weight"):
            raise TypeError(f"{name}: metrics count every sample once; score each part by itself, or use your own function with taceva.score_function")


def _numbers(column: Any, name: str) -> Any:
    found = real(column, name)
    if found.ndim != 1:
        raise ValueError(f"{name} has the shape {list(found.shape)}, expected one value per row")
    if name in _COUNTS and found.dtype.kind not in "iu":
        raise TypeError(f"{name}: expected whole numbers, found an array of {found.dtype}")
    return np.ascontiguousarray(native(found, name), dtype=np.float64)
