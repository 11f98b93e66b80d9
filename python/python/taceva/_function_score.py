"""Scores by a function of the caller, with intervals by contact point."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from statistics import NormalDist
from typing import Any

import numpy as np
import numpy.typing as npt

from taceva import _taceva
from taceva._arrays import numbers, refuse_invalid
from taceva._arrays import points as names_of_points
from taceva._column_names import beside, pair
from taceva._counted import counted
from taceva._metrics import SIX
from taceva._result import Interval, Score

Numbers = npt.NDArray[np.float64]

#: Metric: a function from truth and prediction of some rows to a number.
Metric = Callable[[Numbers, Numbers], Any]

#: Least number of contact points for an interval.
_LEAST_POINTS = 6

#: Number of parts of the points that are left out in turn for the skewness; with fewer points, each point is left out.
_MOST_PARTS = 200


def score_function(
    function: Metric,
    truth: Any,
    prediction: Any,
    *,
    points: Any = None,
    channels: Sequence[str] | None = None,
    name: str | None = None,
    unit: str | Mapping[str, str] | None = None,
    together: bool = False,
    independent: bool = False,
    draws: int = 1000,
    seed: int = 0,
) -> dict[str, Score]:
    """Return the value of ``function`` for truth and prediction by channel, with an interval by contact point.

    The 95 % interval is BCa. The function is called again for ``draws`` samples of whole points, drawn with replacement. It is also called once
    without each point; more than 200 points are left out in 200 groups. The same ``seed`` gives the same interval. Fewer than six points give
    no interval.

    Parameters
    ----------
    function
        Receives truth and prediction of some rows, float64 ``[rows]`` of one channel, and returns a number.
    truth, prediction, points, channels
        As in `score`. NaN is rejected.
    name
        Name of the metric; by default the name of the function.
    unit
        Unit of the number, optionally by channel; by default the unit of the channel, or ``1``.
    together
        True to call the function with ``[rows, channels]`` once for all channels. The result has one score, of the channels joined by ``+``.
    independent
        True if each row counts as one contact point.
    draws
        Number of samples of an interval, at least 100; 0 for no interval.

    Raises
    ------
    ValueError, TypeError
        As `TactileMetrics.update`, and for a function that does not return a number. Exceptions of the function are raised unchanged.

    >>> import numpy as np
    >>> import taceva
    >>> truth = np.arange(40.0)
    >>> worst = lambda truth, prediction: np.abs(prediction - truth).max()
    >>> found = taceva.score_function(worst, truth, truth + 0.25, channels=["Fz"], points=np.arange(40) // 4, name="worst")
    >>> found["Fz"].value, found["Fz"].unit, found["Fz"].interval.high
    (0.25, 'N', 0.25)
    """
    if draws and draws < 100:
        raise ValueError(f"draws {draws}: expected at least 100, or 0 for no interval")
    given, both = pair(truth, prediction, channels, points=points)
    wanted = SIX if given is None else tuple(given)
    if isinstance(channels, str):
        raise TypeError(f"channels: expected a list of names, found the text {channels!r}")
    if len(set(wanted)) < len(wanted):
        raise ValueError(f"channels {', '.join(wanted)}: a channel is named twice")
    tables = [_table(both.truth, "truth", len(wanted)), _table(both.prediction, "prediction", len(wanted))]
    rows = len(tables[0])
    if len(tables[1]) != rows:
        raise ValueError(f"prediction has {counted(len(tables[1]), 'row')}, truth has {rows}")
    refuse_invalid({"truth": tables[0], "prediction": tables[1]}, wanted, both.order, "leave out such rows first")
    clusters = _clusters(beside(both.points, both.index, "points"), rows, independent)
    called = name or str(getattr(function, "__name__", type(function).__name__))
    parts: dict[str, Any] = {"+".join(wanted): slice(None)} if together else {channel: at for at, channel in enumerate(wanted)}
    if isinstance(unit, Mapping) and (unknown := sorted(set(unit) - set(parts))):
        raise ValueError(f"unit: no channel {', '.join(unknown)}, expected channels among {', '.join(parts)}")
    scores = {}
    for channel, columns in parts.items():
        own = [np.ascontiguousarray(table[:, columns]) for table in tables]
        unit_of = unit.get(channel) if isinstance(unit, Mapping) else unit
        value = _value(function, own[0], own[1], called) if rows else None
        is_finite = value is not None and np.isfinite(value)
        interval = _interval(function, own, value, clusters, called, draws, seed) if value is not None and is_finite and draws else None
        scores[channel] = Score(
            metric=called,
            channel=channel,
            value=value if is_finite else None,
            unit=unit_of or _taceva.unit_of(channel) or "1",
            interval=interval,
            n=rows,
            n_invalid=0,
            reason=None if is_finite else f"{called} returned {value}" if rows else "no samples",
            standing=None,
            interval_reason=_why_no_interval(len(clusters), draws) if is_finite and interval is None else None,
        )
    return scores


def _why_no_interval(points: int, draws: int) -> str:
    """Return the reason why a defined score has no interval."""
    if not draws:
        return "draws=0"
    if points < _LEAST_POINTS:
        return f"{counted(points, 'contact point')}, {_LEAST_POINTS} are needed"
    return "the function returned no finite number for some drawn points"


def _table(array: Any, name: str, width: int) -> Numbers:
    found = np.asarray(numbers(array, name, allow_invalid=True), dtype=np.float64)
    if found.ndim == 1 and width == 1:
        found = found[:, np.newaxis]
    if found.ndim != 2 or found.shape[1] != width:
        raise ValueError(f"{name} has the shape {list(found.shape)}, expected [rows, {width}]: one column per channel")
    return found


def _clusters(points: Any, rows: int, independent: bool) -> list[npt.NDArray[np.intp]]:
    """Return the rows of each contact point, in the order of their first rows; empty without points."""
    if independent:
        return [np.asarray([row], dtype=np.intp) for row in range(rows)]
    if points is None:
        return []
    names = names_of_points(points)
    if len(names) != rows:
        raise ValueError(f"points has {counted(len(names), 'row')}, truth has {rows}")
    by_name: dict[Any, list[int]] = {}
    for row, name in enumerate(names if isinstance(names, list) else names.tolist()):
        by_name.setdefault(name, []).append(row)
    return [np.asarray(own, dtype=np.intp) for own in by_name.values()]


def _value(function: Metric, truth: Numbers, prediction: Numbers, name: str) -> float:
    found = function(truth, prediction)
    try:
        return float(found)
    except (TypeError, ValueError) as error:
        raise TypeError(f"{name} returned {type(found).__name__}, expected a number for {counted(len(truth), 'row')}") from error


def _interval(
    function: Metric,
    tables: list[Numbers],
    value: float,
    clusters: list[npt.NDArray[np.intp]],
    name: str,
    draws: int,
    seed: int,
) -> Interval | None:
    """Return the BCa interval of Efron (1987) over clusters; ``None`` for too few clusters, or a non-finite function value."""
    count = len(clusters)
    if count < _LEAST_POINTS:
        return None

    alone = np.concatenate(clusters) if all(len(own) == 1 for own in clusters) else None

    def of(chosen: npt.NDArray[Any]) -> float:
        rows = alone[chosen] if alone is not None else np.concatenate([clusters[at] for at in chosen.tolist()])
        return _value(function, tables[0][rows], tables[1][rows], name)

    generator = np.random.Generator(np.random.PCG64(seed))
    drawn = np.sort([of(generator.integers(0, count, count)) for _ in range(draws)])
    parts = np.arange(count) % min(count, _MOST_PARTS)
    without = np.asarray([of(np.flatnonzero(parts != part)) for part in range(min(count, _MOST_PARTS))])
    if not (np.isfinite(value) and np.isfinite(drawn).all() and np.isfinite(without).all()):
        return None
    normal = NormalDist()
    # Half of the ties count as below. A share of 0 or 1 has no quantile, so it is shifted by half a draw.
    below = (np.count_nonzero(drawn < value) + 0.5 * np.count_nonzero(drawn == value)) / draws
    shift = normal.inv_cdf(min(max(below, 0.5 / draws), 1 - 0.5 / draws))
    lean = without.mean() - without
    spread = float((lean**2).sum()) ** 1.5
    skew = float((lean**3).sum()) / (6 * spread) if spread > 0 else 0.0
    ends = []
    for share in (0.025, 0.975):
        at = shift + normal.inv_cdf(share)
        turned = normal.cdf(shift + at / (1 - skew * at)) if skew * at < 1 else float(at > 0)
        ends.append(float(np.quantile(drawn, turned)))
    return Interval(ends[0], ends[1], f"BCa over {count} points, {draws} draws, seed {seed}")
