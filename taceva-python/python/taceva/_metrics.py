"""Metrics over arrays."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Any

from taceva import _taceva
from taceva._arrays import numbers
from taceva._arrays import points as names_of_points
from taceva._bar import bar
from taceva._result import Result

#: The channels of the TacEva paper: place and depth in mm, forces in N.
SIX = ("Px", "Py", "Pz", "Fx", "Fy", "Fz")

_PICKLE_VERSION = 1


class TactileMetrics:
    """Streams pairs of truth and prediction into exact sums, and gives their scores at any time.

    The scores depend on the set of samples alone: not on their order, on how they were divided into updates, or on which of several merged
    objects saw them. Only sums are held, never the samples.

    Parameters
    ----------
    channels
        Names, one a column of the arrays.
    metrics
        Metrics and groups by name: ``accuracy`` is all that truth and prediction allow.
    units
        Units of channels beside the six, such as ``{"Mz": "N mm"}``; ``1`` where none is given.
    independent
        Whether samples do not depend on each other; intervals are formed of samples then. Where this is not said and no points are given there
        are no intervals.

    >>> import numpy as np
    >>> import taceva
    >>> metrics = taceva.TactileMetrics(["Px", "Fz"])
    >>> truth = np.array([[0.0, 1.0], [1.0, 2.0]])
    >>> metrics.update(truth, truth + [0.5, 0.25])
    >>> metrics.update(truth, truth)
    >>> metrics.compute()["mae", "Px"].value
    0.25
    """

    def __init__(
        self,
        channels: Sequence[str] = SIX,
        metrics: str | Sequence[str] = "accuracy",
        *,
        units: Mapping[str, str] | None = None,
        independent: bool = False,
    ) -> None:
        if isinstance(channels, str):
            raise TypeError(f"channels: expected a list of names, found the text {channels!r}")
        if not channels:
            raise ValueError("no channels: expected the names of the columns")
        units = dict(units or {})
        unknown = sorted(set(units) - set(channels))
        if unknown:
            raise ValueError(f"units of {', '.join(unknown)}, which are no channels: {', '.join(channels)}")
        with_units = [(name, units.get(name) or _taceva.unit_of(name) or "1") for name in channels]
        wanted = [metrics] if isinstance(metrics, str) else list(metrics)
        self._asked = (with_units, wanted, independent)
        self._sums = _taceva.Sums(*self._asked)

    @property
    def channels(self) -> tuple[str, ...]:
        """Names of the channels."""
        return tuple(name for name, _ in self._asked[0])

    def update(
        self,
        truth: Any,
        prediction: Any,
        points: Any = None,
        *,
        allow_invalid: bool = False,
    ) -> None:
        """Take in samples; none is taken in where one is refused.

        Parameters
        ----------
        truth, prediction
            ``[rows, channels]``, or ``[rows]`` of one channel: arrays of numpy or tensors of torch, float32 or float64, in the unit of their
            channel; whole numbers are converted.
        points
            The contact point of each row, a whole number or a text: intervals take the samples of one point as dependent.
        allow_invalid
            Whether rows with NaN or an infinite number are counted and left out instead of refused.

        Raises
        ------
        ValueError
            For arrays of other shapes or lengths, and for NaN.
        TypeError
            For arrays of anything but real numbers.
        """
        self._sums.update(
            numbers(truth, "truth", allow_invalid=allow_invalid),
            numbers(prediction, "prediction", allow_invalid=allow_invalid),
            None if points is None else names_of_points(points),
        )

    def compute(self) -> Result:
        """Return the scores of all samples so far; more samples may follow."""
        return Result(self._sums.compute())

    def merge(self, other: TactileMetrics) -> None:
        """Take over what ``other``, of the same channels and metrics, has seen."""
        self._sums.merge(other._sums)

    def reset(self) -> None:
        """Forget all samples."""
        self._sums.reset()

    def states(self) -> bytes:
        """Return all that was seen, a few kB, for ``merge_states`` in another process."""
        return bytes(self._sums.states_bytes())

    def merge_states(self, states: bytes) -> None:
        """Take over what ``states`` of another process gave."""
        self._sums.merge_bytes(states)

    def __getstate__(self) -> dict[str, Any]:
        return {"version": _PICKLE_VERSION, "asked": self._asked, "states": self.states()}

    def __setstate__(self, state: dict[str, Any]) -> None:
        if state.get("version") != _PICKLE_VERSION:
            raise ValueError(
                f"a pickle of version {state.get('version')}, this taceva reads version {_PICKLE_VERSION}: "
                "use the same taceva on both sides, or pass states()"
            )
        self._asked = state["asked"]
        self._sums = _taceva.Sums(*self._asked)
        self._sums.merge_bytes(state["states"])

    def __repr__(self) -> str:
        return f"TactileMetrics({list(self.channels)}, {self._asked[1]})"


def score(
    truth: Any,
    prediction: Any,
    *,
    points: Any = None,
    channels: Sequence[str] | None = None,
    metrics: str | Sequence[str] = "accuracy",
    units: Mapping[str, str] | None = None,
    independent: bool = False,
    allow_invalid: bool = False,
) -> Result:
    """Return the scores of ``prediction`` against ``truth``, arrays of ``[rows, channels]``; see `TactileMetrics`.

    Where ``channels`` are not named there are six columns, those of the paper.

    >>> import numpy as np
    >>> import taceva
    >>> truth = np.zeros((4, 6))
    >>> taceva.score(truth, truth + 0.5)["mae", "Pz"].value
    0.5
    """
    found = TactileMetrics(SIX if channels is None else channels, metrics, units=units, independent=independent)
    found.update(truth, prediction, points, allow_invalid=allow_invalid)
    return found.compute()


def score_tables(
    truth: str | os.PathLike[str],
    prediction: str | os.PathLike[str],
    *,
    metrics: str | Sequence[str] = "all",
    sensor: str | os.PathLike[str] | None = None,
    allow_invalid: bool = False,
    jobs: int = 0,
) -> Result:
    """Return the scores of two CSV tables: what ``taceva score --truth … --pred …`` writes, byte for byte.

    ``jobs`` are threads, all cores where it is 0; no result depends on it.
    """
    wanted = [metrics] if isinstance(metrics, str) else list(metrics)
    text = _taceva.score_tables(
        os.fspath(truth),
        os.fspath(prediction),
        wanted,
        None if sensor is None else os.fspath(sensor),
        allow_invalid,
        jobs,
        bar(),
    )
    return Result(text)
