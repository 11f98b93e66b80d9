"""Scores with their intervals, as in the JSON of the command."""

from __future__ import annotations

import html
import json
import os
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, overload

from taceva import _taceva
from taceva._figure import Figure, figures_of
from taceva._pickles import PICKLE_VERSION, require_version


@dataclass(frozen=True)
class Interval:
    """A 95 % confidence interval: both ends in the unit of its score, and its method."""

    low: float
    high: float
    method: str


@dataclass(frozen=True)
class Score:
    """A score of one metric and channel. If it is undefined, ``value`` is ``None`` and ``reason`` states why.

    Without an interval, ``interval_reason`` states why.

    A score acts as a number in its unit: ``float``, ``round``, ``format``, ``<``, ``<=``, ``>`` and ``>=`` accept it, and raise ``ValueError``
    if it is undefined. ``==`` compares whole scores: compare ``value`` with a number.

    >>> import taceva
    >>> mae = taceva.score([[0.0], [1.0]], [[0.5], [1.0]], channels=["Fz"])["mae", "Fz"]
    >>> f"{mae:.3f}", str(mae), mae < 0.3
    ('0.250', '0.25 N', True)
    """

    metric: str
    channel: str
    #: Value in ``unit``; ``None`` if the score is undefined.
    value: float | None
    #: ``1`` for a score without a unit, such as R².
    unit: str
    #: ``None`` without an interval, as for samples without contact points; ``interval_reason`` states why.
    interval: Interval | None
    #: Number of samples that were scored.
    n: int
    #: Number of samples that were skipped because a value was NaN or infinite.
    n_invalid: int
    #: Reason why the score is undefined; ``None`` if it is defined.
    reason: str | None
    #: Reason why the score is excluded from verdicts, if it is, as in files: ``no skill``, ``skill unknown``, ``bounded``, …
    standing: str | None
    #: Reason why a defined score has no interval; ``None`` with an interval.
    interval_reason: str | None = None

    def __float__(self) -> float:
        if self.value is None:
            raise ValueError(f"{self.metric} of {self.channel} is undefined: {self.reason}")
        return self.value

    def __round__(self, digits: int | None = None) -> float:
        return round(float(self), digits)

    def __format__(self, form: str) -> str:
        return format(float(self), form) if form else str(self)

    def __str__(self) -> str:
        if self.value is None:
            return f"undefined: {self.reason}"
        return str(self.value) if self.unit == "1" else f"{self.value} {self.unit}"

    def __lt__(self, other: float | Score) -> bool:
        return float(self) < self._comparable(other)

    def __le__(self, other: float | Score) -> bool:
        return float(self) <= self._comparable(other)

    def __gt__(self, other: float | Score) -> bool:
        return float(self) > self._comparable(other)

    def __ge__(self, other: float | Score) -> bool:
        return float(self) >= self._comparable(other)

    def _comparable(self, other: float | Score) -> float:
        """Return ``other`` as a number in the unit of this score."""
        if isinstance(other, Score) and other.unit != self.unit:
            raise ValueError(f"{self.metric} of {self.channel} is in {self.unit}, {other.metric} of {other.channel} in {other.unit}: expected one unit")
        return float(other)


class Result(Mapping[tuple[str, str], Score]):
    """Scores of an evaluation, from the JSON of ``taceva evaluate`` or ``taceva score``.

    A mapping of scores by metric and channel, in the order of reports. A metric alone returns its scores by channel.

    >>> import taceva
    >>> result = taceva.score([[0.0], [1.0]], [[0.5], [1.0]], channels=["Fz"])
    >>> round(result["mae", "Fz"], 3), result["mae", "Fz"].unit
    (0.25, 'N')
    >>> ("mae", "Fz") in result, "mae" in result, ("mae", "Px") in result, list(result["mae"])
    (True, True, False, ['Fz'])
    """

    def __init__(self, text: str, samples: str | Callable[[], str] | None = None) -> None:
        #: Table of the samples behind the scores, or a function that makes it.
        self._samples = samples
        self._report = _taceva.read_result(text)
        self._text = text
        self._scores = [_score(found) for found in self._report["scores"]]

    @property
    def text(self) -> str:
        """Sealed JSON, with the same bytes as ``save`` writes."""
        return self._text

    @property
    def metrics(self) -> list[str]:
        """Names of the metrics with scores."""
        return list(dict.fromkeys(score.metric for score in self._scores))

    @property
    def notes(self) -> list[str]:
        """Notes for the reader of the scores."""
        return list(self._report["notes"])

    @property
    def skipped(self) -> dict[str, str]:
        """Skipped metrics, with reasons."""
        return dict(self._report["skipped"])

    @property
    def source(self) -> str:
        """Origin of the samples: ``recorded``, ``simulated``, ``synthetic``; ``unknown`` for arrays."""
        return str(self._report["source"])

    @overload
    def __getitem__(self, key: tuple[str, str]) -> Score: ...

    @overload
    def __getitem__(self, key: str) -> dict[str, Score]: ...

    def __getitem__(self, key: tuple[str, str] | str) -> Score | dict[str, Score]:
        if not isinstance(key, str) and not (isinstance(key, tuple) and len(key) == 2):
            raise KeyError(f"{key!r}: expected a metric and a channel, result['mae', 'Fz'], or a metric, result['mae']")
        metric: str
        channel: str | None
        if isinstance(key, str):
            metric, channel = key, None
        else:
            metric, channel = key
        scores = {score.channel: score for score in self._scores if score.metric == metric}
        if not scores:
            left_out = self.skipped.get(f"metric:{metric}")
            why = f"left out: {left_out}" if left_out else f"known are {', '.join(self.metrics)}"
            raise KeyError(f"no metric {metric!r}: {why}")
        if channel is None:
            return scores
        found = scores.get(channel)
        if found is None:
            raise KeyError(f"no channel {channel!r} of {metric}: known are {', '.join(scores)}")
        return found

    def __iter__(self) -> Iterator[tuple[str, str]]:
        return ((score.metric, score.channel) for score in self._scores)

    def __len__(self) -> int:
        return len(self._scores)

    def scores(self) -> list[Score]:
        """All scores, in the order of reports."""
        return list(self._scores)

    def to_dict(self) -> dict[str, Any]:
        """Return the JSON of the result as a dictionary, a new one at each call."""
        return dict(json.loads(self._text))

    def to_frame(self) -> Any:
        """Return a ``pandas.DataFrame``, one row per score.

        Its columns are the fields of `Score`, with the interval as ``ci95_low``, ``ci95_high`` and ``method``. ``attrs`` has the source of the
        samples and the notes.
        """
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
        """Return a LaTeX table for a paper; it needs ``booktabs``.

        The caption states the number of samples, and of contact points if all intervals have the same number.
        """
        said = "".join(f"% {line}\n" for line in self._said())
        return said + _taceva.score_table([self._text], "tex")

    def figures(self) -> list[Figure]:
        """Return all figures for which the scores have data; the default metrics of `score` have none.

        `report` also draws the samples, on a page.
        """
        return figures_of([self._text])

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the JSON to ``path``, which must not exist: the same bytes as ``taceva … --format json --out``."""
        with Path(path).open("x", encoding="utf-8", newline="\n") as file:
            file.write(self._text)

    def save_samples(self, path: str | os.PathLike[str]) -> None:
        """Write the samples behind the scores to ``path``, which must not exist.

        `load` and ``taceva compare`` find them beside ``NAME.json`` as ``NAME.samples.csv``, and compare results in pairs.

        Raises
        ------
        ValueError
            For a result without samples.
        """
        samples = self._table_of_samples()
        if samples is None:
            raise ValueError("no samples are kept: `score` and `evaluate` keep up to 200000; sums, and loaded files without their table, keep none")
        with Path(path).open("x", encoding="utf-8", newline="\n") as file:
            file.write(samples)

    def _table_of_samples(self) -> str | None:
        """Return the table of the samples behind the scores, or ``None`` if they are not kept."""
        if callable(self._samples):
            self._samples = self._samples()
        return self._samples

    def _said(self) -> list[str]:
        """Return the most important notes: that samples were not measured, and the notes of the result."""
        unmeasured = _taceva.not_measured([self.source])
        return [*([unmeasured] if unmeasured else []), *self.notes]

    def _absent(self) -> list[str]:
        """Return notes on missing items: skipped metrics, and intervals of arrays."""
        skipped = [what.removeprefix("metric:") for what in self.skipped]
        lines = [f"Skipped: {', '.join(skipped)}. See result.skipped for the reasons."] if skipped else []
        has_values = any(score.value is not None for score in self._scores)
        if self.source == "unknown" and has_values and all(score.interval is None for score in self._scores):
            lines.append("No intervals: they need at least 5 contact points. Pass points=[…], or independent=True if no two samples belong together.")
        return lines

    def __str__(self) -> str:
        return "\n".join([*self._said(), _taceva.score_table([self._text], "text"), *self._absent()])

    def __repr__(self) -> str:
        return f"<taceva.Result of {len(self._scores)} scores, {self.source}>"

    def _repr_html_(self) -> str:
        said, absent = ("".join(f"<p>{html.escape(line)}</p>" for line in lines) for lines in (self._said(), self._absent()))
        return said + _taceva.score_table([self._text], "html") + absent + "".join(figure._repr_html_() for figure in self.figures())

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Result) and other._text == self._text

    def __hash__(self) -> int:
        return hash(self._text)

    def __reduce__(self) -> tuple[Any, tuple[int, str, str | None]]:
        return _arrived, (PICKLE_VERSION, self._text, self._table_of_samples())


def load(path: str | os.PathLike[str]) -> Result:
    """Read the JSON of one evaluation that `Result.save` or the command wrote, and the table ``NAME.samples.csv`` beside ``NAME.json`` if it exists.

    Raises
    ------
    FileNotFoundError
        If there is no such file.
    ValueError
        For a file that was edited after it was written, or is not the result of one evaluation.
    """
    samples = Path(path).with_suffix(".samples.csv")
    return Result(Path(path).read_text(encoding="utf-8"), samples.read_text(encoding="utf-8") if samples.is_file() else None)


def _arrived(version: object, text: str = "", samples: str | None = None) -> Result:
    require_version(version)
    return Result(text, samples)


def _score(found: dict[str, Any]) -> Score:
    interval = found.pop("interval")
    return Score(interval=Interval(*interval) if interval else None, **found)
