"""Scores with their intervals, as in the JSON of the command."""

from __future__ import annotations

import html
import json
import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from taceva import _taceva
from taceva._figure import Figure, figures_of
from taceva._pickles import PICKLE_VERSION, require_version


@dataclass(frozen=True)
class Interval:
    """A confidence interval of 95 %, with the method it comes from."""

    low: float
    high: float
    method: str


@dataclass(frozen=True)
class Score:
    """A score of one metric and channel. Where it is undefined, ``value`` is ``None`` and ``reason`` says why."""

    metric: str
    channel: str
    value: float | None
    unit: str
    #: ``None`` where there is none, as of samples without contact points.
    interval: Interval | None
    n: int
    n_invalid: int
    reason: str | None
    #: Why the score takes part in no verdict, where it does not, as files say it: ``no skill``, ``skill unknown``, ``bounded``, …
    standing: str | None

    def __float__(self) -> float:
        if self.value is None:
            raise ValueError(f"{self.metric} of {self.channel} is undefined: {self.reason}")
        return self.value


class Result:
    """The scores of an evaluation: what ``taceva evaluate`` and ``taceva score`` write as JSON.

    >>> import taceva
    >>> result = taceva.score([[0.0], [1.0]], [[0.5], [1.0]], channels=["Fz"])
    >>> round(float(result["mae", "Fz"]), 3), result["mae", "Fz"].unit
    (0.25, 'N')
    """

    def __init__(self, text: str) -> None:
        self._report = _taceva.read_result(text)
        self._text = text
        self._scores = [_score(found) for found in self._report["scores"]]

    @property
    def text(self) -> str:
        """The JSON, sealed, byte for byte as ``save`` writes it."""
        return self._text

    @property
    def metrics(self) -> list[str]:
        """Names of the metrics that have scores."""
        return list(dict.fromkeys(score.metric for score in self._scores))

    @property
    def notes(self) -> list[str]:
        """Notes for readers of the scores."""
        return list(self._report["notes"])

    @property
    def skipped(self) -> dict[str, str]:
        """Skipped metrics, with reasons."""
        return dict(self._report["skipped"])

    @property
    def source(self) -> str:
        """Origin of the samples: ``recorded``, ``simulated``, ``synthetic``, or ``unknown`` of arrays."""
        return str(self._report["source"])

    def __getitem__(self, key: tuple[str, str]) -> Score:
        metric, channel = key
        scores = {score.channel: score for score in self._scores if score.metric == metric}
        if not scores:
            left_out = self.skipped.get(f"metric:{metric}")
            why = f"left out: {left_out}" if left_out else f"known are {', '.join(self.metrics)}"
            raise KeyError(f"no metric {metric!r}: {why}")
        found = scores.get(channel)
        if found is None:
            raise KeyError(f"no channel {channel!r} of {metric}: known are {', '.join(scores)}")
        return found

    def scores(self) -> list[Score]:
        """Every score, in the order of reports."""
        return list(self._scores)

    def to_dict(self) -> dict[str, Any]:
        """Return the JSON as a dictionary, a new one at each call."""
        return dict(json.loads(self._text))

    def to_frame(self) -> Any:
        """Return a ``pandas.DataFrame``, one row per score; ``attrs`` holds the source of the samples and the notes."""
        import pandas

        rows = []
        for score in self.scores():
            row = dict(vars(score))
            interval = row.pop("interval")
            row["ci95_low"] = interval.low if interval else None
            row["ci95_high"] = interval.high if interval else None
            row["method"] = interval.method if interval else None
            rows.append(row)
        frame = pandas.DataFrame(rows)
        frame.attrs.update(source=self.source, notes=self.notes)
        return frame

    def to_latex(self) -> str:
        """Return a table for a paper, in the symbols of the field; it needs ``booktabs``."""
        said = "".join(f"% {line}\n" for line in self._said())
        return said + _taceva.score_table([self._text], "tex")

    def figures(self) -> list[Figure]:
        """Return every figure that the scores have data for, as in the report of the command."""
        return figures_of([self._text])

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the JSON to ``path``, which must not exist: the same bytes as ``taceva … --format json --out``."""
        with Path(path).open("x", encoding="utf-8", newline="\n") as file:
            file.write(self._text)

    def _said(self) -> list[str]:
        """Return what a reader must know first: that nothing was measured, and the notes."""
        return [*not_measured([self.source]), *self.notes]

    def __str__(self) -> str:
        return "\n".join([*self._said(), _taceva.score_table([self._text], "text")])

    def __repr__(self) -> str:
        return f"<taceva.Result of {len(self._scores)} scores, {self.source}>"

    def _repr_html_(self) -> str:
        said = "".join(f"<p>{html.escape(line)}</p>" for line in self._said())
        return said + _taceva.score_table([self._text], "html") + "".join(figure._repr_html_() for figure in self.figures())

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Result) and other._text == self._text

    def __hash__(self) -> int:
        return hash(self._text)

    def __reduce__(self) -> tuple[Any, tuple[int, str]]:
        return _arrived, (PICKLE_VERSION, self._text)


def not_measured(sources: Sequence[str]) -> list[str]:
    """Return the sentence that precedes every output about simulated or synthetic samples."""
    kinds = sorted({source for source in sources if source in ("simulated", "synthetic")})
    if not kinds:
        return []
    whose = "the samples are" if set(sources) == set(kinds) else "some of the samples are"
    return [f"{'Nothing here was measured' if whose.startswith('the') else 'Not all of this was measured'}: {whose} {' and '.join(kinds)}."]


def load(path: str | os.PathLike[str]) -> Result:
    """Read the JSON of one evaluation that ``save`` or the command wrote; a changed one is rejected."""
    return Result(Path(path).read_text(encoding="utf-8"))


def _arrived(version: object, text: str = "") -> Result:
    require_version(version)
    return Result(text)


def _score(found: dict[str, Any]) -> Score:
    interval = found.pop("interval")
    return Score(interval=Interval(*interval) if interval else None, **found)
