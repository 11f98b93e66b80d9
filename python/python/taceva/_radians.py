"""Angles that are probably in radians, although their period is taken in degrees."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

#: Rounding of values in radians, to three decimals; the same as for tables.
_ROUNDED_RAD = 1e-3


class LikelyRadians:
    """Greatest values of periodic angles without a stated unit.

    >>> angles = LikelyRadians.of({"yaw": 360, "roll": 360}, stated=["roll"])
    >>> angles.add(["yaw", "roll"], np.array([[-3.0, 3.0], [3.1, 1.0]]))
    >>> angles.greatest
    {'yaw': 3.1}
    """

    def __init__(self, periods: Mapping[str, int], greatest: Mapping[str, float] | None = None) -> None:
        #: Periods of the angles without a stated unit, degrees.
        self.periods = dict(periods)
        #: Greatest magnitude of each angle so far.
        self.greatest = dict(greatest or {})

    @staticmethod
    def of(periods: Mapping[str, int], stated: Collection[str]) -> LikelyRadians:
        """Return the angles of ``periods`` whose unit neither ``stated`` nor their name contains."""
        return LikelyRadians({name: period for name, period in periods.items() if name not in stated and not name.endswith("_deg")})

    def add(self, channels: Sequence[str], table: npt.NDArray[Any]) -> None:
        """Add the rows of a table, whose columns are ``channels``."""
        columns = table.reshape(len(table), len(channels))
        self.merge({name: _greatest(columns[:, channels.index(name)]) for name in self.periods})

    def merge(self, greatest: Mapping[str, float]) -> None:
        """Add the greatest values of other rows; those of angles with a stated unit are ignored."""
        for name in self.periods:
            self.greatest[name] = max(greatest.get(name, 0.0), self.greatest.get(name, 0.0))

    def notes(self) -> list[str]:
        """Return a note for each angle whose values all lie within one period in radians.

        >>> LikelyRadians({"yaw": 360}, {"yaw": 6.0}).notes()[0].partition(" lie")[0]
        'yaw: all values'
        >>> LikelyRadians({"yaw": 360}, {"yaw": 9.0}).notes()
        []
        """
        within = [name for name, value in self.greatest.items() if 0.0 < value <= math.radians(self.periods[name]) + _ROUNDED_RAD]
        return [
            f"{name}: all values lie within ±{math.radians(self.periods[name]):.2f}, as angles in radians do, but are scored as degrees with a "
            f"period of {self.periods[name]}, because no unit is stated; give units={{{name!r}: 'rad'}} for radians, or units={{{name!r}: 'deg'}} "
            "for degrees"
            for name in within
        ]


def _greatest(column: npt.NDArray[Any]) -> float:
    """Return the greatest finite magnitude, or 0."""
    finite = np.abs(column[np.isfinite(column)].astype(np.float64))
    return float(finite.max(initial=0.0))
