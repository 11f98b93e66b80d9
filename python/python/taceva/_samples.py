"""Samples behind the scores of arrays, for comparisons in pairs."""

from __future__ import annotations

import csv
import io
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

#: Least number of rows, and least share of the squared error, for a note on a single row; the same as for recordings.
_LEAST_ROWS = 50
_LEAST_SHARE = 0.25


@dataclass(frozen=True)
class Samples:
    """Truth and prediction of each row of arrays, ``[rows, channels]``, copied."""

    channels: Sequence[str]
    truth: npt.NDArray[Any]
    prediction: npt.NDArray[Any]
    #: Contact points and names of the rows, if known.
    points: Sequence[Any] | None
    names: Sequence[Any] | None

    @staticmethod
    def of(channels: Sequence[str], truth: Any, prediction: Any, points: Any, names: Any) -> Samples:
        """Return a copy of the rows of ``truth`` and ``prediction``, with their points and names."""
        tables = [np.array(table, dtype=np.float64).reshape(len(table), len(channels)) for table in (truth, prediction)]
        listed = [None if words is None else np.asarray(words).tolist() for words in (points, names)]
        return Samples(tuple(channels), tables[0], tables[1], listed[0], listed[1])

    def table(self) -> str:
        """Return a table for ``taceva compare``, with empty cells for numbers that are not finite.

        >>> print(Samples.of(["Fz"], [[0.5]], [[0.25]], ["a"], None).table(), end="")
        sample,point_id,Fz,Fz_predicted
        1,a,0.5,0.25
        """
        out = io.StringIO()
        writer = csv.writer(out, lineterminator="\n")
        columns: dict[str, Sequence[Any]] = {"sample": self.names or range(1, len(self.truth) + 1)}
        if self.points is not None:
            columns["point_id"] = self.points
        for at, channel in enumerate(self.channels):
            columns[channel] = _cells(self.truth[:, at])
            columns[f"{channel}_predicted"] = _cells(self.prediction[:, at])
        writer.writerow(columns)
        writer.writerows(zip(*columns.values(), strict=True))
        return out.getvalue()

    def notes(self, periodic: Collection[str]) -> list[str]:
        """Return a note for each channel, except angles, in which one row makes a great part of the squared error."""
        found = []
        for at, channel in enumerate(self.channels):
            with np.errstate(over="ignore", invalid="ignore"):
                errors = (self.prediction[:, at] - self.truth[:, at]) ** 2
                share = errors[np.isfinite(errors)] / np.sum(errors, where=np.isfinite(errors))
            if channel in periodic or len(share) < _LEAST_ROWS or not share.max() >= _LEAST_SHARE:
                continue
            row = int(np.flatnonzero(np.isfinite(errors))[share.argmax()])
            name = f"row {row}" if self.names is None else f"sample {self.names[row]}"
            found.append(f"{channel}: {name} makes {100 * share.max():.0f} % of the squared error: look at its truth and its prediction")
        return found


def _cells(numbers: npt.NDArray[Any]) -> list[str]:
    return [repr(number) if is_finite else "" for number, is_finite in zip(numbers.tolist(), np.isfinite(numbers).tolist(), strict=True)]
