"""Metrics over arrays."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from taceva import _taceva
from taceva._arrays import BLOCK_ROWS, column_order, in_order, native, real, refuse_invalid, with_units
from taceva._arrays import points as names_of_points
from taceva._bar import bar
from taceva._fields import columns, require_unweighted
from taceva._column_names import PairedArrays, beside, pair
from taceva._counted import counted
from taceva._pickles import PICKLE_VERSION, require_version
from taceva._radians import LikelyRadians
from taceva._result import Result
from taceva._samples import Samples
from taceva._settings import metric_names
from taceva._states import gathered, opened, sealed

#: Channels of the TacEva paper: position and depth in mm, forces in N.
SIX = ("Px", "Py", "Pz", "Fx", "Fy", "Fz")

#: Default metrics of arrays: MAE, R² and sMAPE, which are the group ``accuracy`` of the command, and RMSE and bias.
DEFAULT_METRICS = ("accuracy", "rmse", "bias")


class TactileMetrics:
    """Accumulates pairs of truth and prediction into exact sums, and returns their scores at any time.

    The scores depend only on the set of samples. Their order, their division into updates, and their distribution over merged objects do not
    matter. The object stores sums, not samples.

    Parameters
    ----------
    channels
        Names of the columns of the arrays; by default the six, ``Px Py Pz`` in mm and ``Fx Fy Fz`` in N.
    metrics
        Metrics and groups by name (see `metrics`); by default MAE, RMSE, bias, R² and sMAPE. ``accuracy`` is MAE, R² and sMAPE.
        Skill is always added. Bias is the mean of truth − prediction, and sMAPE a fraction from 0 to 2.
    units
        Units of channels other than the six, such as ``{"Mz": "N·mm"}``; ``1`` by default.
    periods
        Periods of angles in degrees, such as ``{"yaw": 360}``: 359 and 1 are 2 apart. A channel named only here is in degrees.
        The period of a channel with unit ``rad`` is in degrees too.
    independent
        True for independent samples, with intervals that ignore points. If false and without points, there are no intervals.
    fields
        Additional fields of every row, among ``scene``, ``unit_id``, ``phase``, ``depth_step``, ``repeat``, ``t_s`` and ``intensity``. Metrics
        that need a missing field are skipped.

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
        metrics: str | Sequence[str] = DEFAULT_METRICS,
        *,
        units: Mapping[str, str] | None = None,
        periods: Mapping[str, int] | None = None,
        independent: bool = False,
        fields: Sequence[str] = (),
    ) -> None:
        for name, listed in (("channels", channels), ("fields", fields)):
            if isinstance(listed, str):
                raise TypeError(f"{name}: expected a list of names, found the text {listed!r}")
        if not channels:
            raise ValueError("no channels: expected the names of the columns")
        periods = dict(periods or {})
        units = dict(units or {})
        unknown = sorted(set(periods) - set(channels))
        if unknown:
            raise ValueError(f"periods: no channel {', '.join(unknown)}, expected channels among {', '.join(channels)}")
        self._angles = LikelyRadians.of(periods, stated=units)
        units = dict.fromkeys(periods, "deg") | units
        own_units = with_units(channels, units)
        #: Channels without a known unit.
        self._unknown = [name for name in channels if name not in units and _taceva.unit_of(name) is None]
        self._begin((own_units, metric_names(metrics), independent, list(fields), periods))
        self._paired: set[str] = set()

    def _begin(self, asked: tuple[list[tuple[str, str]], list[str], bool, list[str], dict[str, int]]) -> None:
        """Create empty sums for the request ``asked``."""
        self._asked = asked
        self._sums = _taceva.Sums(*asked)
        #: Positions of the columns in the order of the sums; ``None`` if already in that order.
        self._order = column_order(asked[0])

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
        key: str | None = None,
        allow_invalid: bool = False,
        **fields: Any,
    ) -> None:
        """Add samples. Adds no sample if one sample is rejected or Ctrl-C interrupts.

        Parameters
        ----------
        truth, prediction
            ``[rows, channels]``, or ``[rows]`` for one channel: numpy arrays or torch tensors, float32 or float64, in the unit of their channel.
            Whole numbers are converted. Named columns (pandas, polars, Arrow, a dict of arrays) are matched by name. Rows are matched by a
            common column ``sample``, ``id``, ``sample_id`` or ``index``, else by the pandas index. Two default indices pair rows by order.
        points
            Contact point of each row, a whole number or a text, or the name of the column that holds them. Intervals treat the samples of one
            point as dependent. By default a column ``point_id`` is used.
        key
            Common column that pairs rows, or ``"order"``.
        allow_invalid
            True to count and skip rows with NaN or an infinite number instead of rejecting them.
        fields
            Values of the declared fields, one per row: ``scene=["dark", …]``, ``repeat=[0, …]``.

        Raises
        ------
        ValueError
            For arrays of wrong shapes or lengths, for NaN, and for rows that cannot be paired.
        TypeError
            For arrays of other types than real numbers.
        """
        _, both = pair(truth, prediction, self.channels, points=points, key=key)
        self._add(both, fields, allow_invalid)

    def _add(self, both: PairedArrays, fields: Mapping[str, Any], allow_invalid: bool) -> None:
        """Add paired samples."""
        points = beside(both.points, both.index, "points")
        fields = {name: beside(column, both.index, name) for name, column in fields.items()}
        tables = {"truth": real(both.truth, "truth"), "prediction": real(both.prediction, "prediction")}
        width = len(self.channels)
        for name, table in tables.items():
            if table.shape[1:] != (width,) and not (width == 1 and table.ndim == 1):
                raise ValueError(f"{name} has the shape {list(table.shape)}, expected [rows, {width}]: one column per channel, or give channels=[…]")
        names = None if points is None else names_of_points(points)
        rows = len(tables["truth"])
        for name, column in {"prediction": tables["prediction"], "points": names}.items():
            if column is not None and len(column) != rows:
                raise ValueError(f"{name} has {counted(len(column), 'row')}, truth has {rows}")
        said = columns(fields, self._asked[3], rows)
        # A later block may be rejected or interrupted, so several blocks are summed separately and merged at the end.
        sums = self._sums if rows <= BLOCK_ROWS else _taceva.Sums(*self._asked)
        for first in range(0, rows, BLOCK_ROWS):
            block = slice(first, first + BLOCK_ROWS)
            rows_of = {name: native(in_order(table[block], self._order), name, allow_invalid=True) for name, table in tables.items()}
            points_of = None if names is None else names[block]
            fields_of = [(name, column[block]) for name, column in said]
            is_apart = sums is not self._sums
            if not sums.update(rows_of["truth"], rows_of["prediction"], points_of, fields_of, allow_invalid, is_apart):
                refuse_invalid(tables, self.channels, both.order)
        if sums is not self._sums:
            self._sums.merge(sums)
        for table in tables.values():
            self._angles.add(self.channels, table)
        if both.paired_by is not None:
            self._paired.add(both.paired_by)

    def forward(
        self,
        truth: Any,
        prediction: Any,
        points: Any = None,
        *,
        key: str | None = None,
        allow_invalid: bool = False,
        **fields: Any,
    ) -> Result:
        """Add samples like `update`, and return the scores of these samples alone. Calling the object does the same.

        >>> import taceva
        >>> metrics = taceva.TactileMetrics(["Fz"])
        >>> [float(metrics([[0.0]], [[error]])["mae", "Fz"]) for error in (0.5, 0.25)], float(metrics.compute()["mae", "Fz"])
        ([0.5, 0.25], 0.375)
        """
        batch = self._emptied()
        batch.update(truth, prediction, points, key=key, allow_invalid=allow_invalid, **fields)
        self.merge(batch)
        return batch.compute()

    __call__ = forward

    def sync(self, gather: Callable[[bytes], Sequence[bytes]] | None = None) -> TactileMetrics:
        """Return the samples of all processes in a new object, equal in each process. This object keeps only its own samples.

        ``gather`` passes bytes to every process and returns the bytes of all processes, like ``allgather`` of mpi4py. The default is
        ``torch.distributed``, if initialised. Every process must call this method, with the same channels and metrics.
        """
        whole = self._emptied()
        for states in (gather or gathered)(self.states()):
            whole.merge_states(states)
        return whole

    def _emptied(self) -> TactileMetrics:
        """Return an object with the same channels and metrics but without samples."""
        found = TactileMetrics.__new__(TactileMetrics)
        found._begin(self._asked)
        found._paired = set()
        found._unknown = self._unknown
        found._angles = LikelyRadians(self._angles.periods)
        return found

    def compute(self, *, name: str | None = None) -> Result:
        """Return the scores of all samples so far; more samples may follow. Without samples, the scores are undefined.

        ``name`` is the name of the sensor or the model, for tables.
        """
        return Result(self._scored(name, []))

    def _scored(self, name: str | None, notes: Sequence[str]) -> str:
        """Return the results file of all samples, with ``notes``."""
        own = [
            f"{channel}: not one of {' '.join(SIX)}; scored as a channel with the unit 1; give its unit as units={{{channel!r}: …}}"
            for channel in self._unknown
        ]
        return self._sums.compute(sorted(self._paired), name, [*own, *self._angles.notes(), *notes])

    def merge(self, other: TactileMetrics) -> None:
        """Add the samples of ``other``, which does not change.

        Raises
        ------
        ValueError
            If ``other`` has other channels or metrics.
        """
        self._sums.merge(other._sums)
        self._paired |= other._paired
        self._angles.merge(other._angles.greatest)

    def reset(self) -> None:
        """Remove all samples."""
        self._sums.reset()
        self._paired.clear()
        self._angles.greatest.clear()

    def states(self) -> bytes:
        """Return the sums of all samples and their keys, with a digest, a few kB, for ``merge_states`` in another process."""
        # JSON of one list has no line break.
        return sealed(json.dumps([sorted(self._paired), self._angles.greatest]).encode() + b"\n" + self._sums.states_bytes())

    def merge_states(self, states: bytes) -> None:
        """Add the samples in the ``states`` of another process; edited bytes are rejected."""
        beside_sums, _, sums = opened(states).partition(b"\n")
        self._sums.merge_bytes(sums)
        paired, greatest = json.loads(beside_sums)
        self._paired |= set(paired)
        self._angles.merge(greatest)

    def __getstate__(self) -> dict[str, Any]:
        return {"version": PICKLE_VERSION, "asked": self._asked, "unknown": self._unknown, "angles": self._angles.periods, "states": self.states()}

    def __setstate__(self, state: dict[str, Any]) -> None:
        require_version(state.get("version"))
        self._begin(state["asked"])
        self._paired = set()
        self._unknown = state["unknown"]
        self._angles = LikelyRadians(state["angles"])
        self.merge_states(state["states"])

    def __repr__(self) -> str:
        return f"TactileMetrics({list(self.channels)}, {self._asked[1]})"


def score(
    truth: Any,
    prediction: Any,
    *,
    points: Any = None,
    channels: Sequence[str] | None = None,
    metrics: str | Sequence[str] = DEFAULT_METRICS,
    units: Mapping[str, str] | None = None,
    periods: Mapping[str, int] | None = None,
    independent: bool = False,
    key: str | None = None,
    name: str | None = None,
    allow_invalid: bool = False,
    **fields: Any,
) -> Result:
    """Return the scores of ``prediction`` against ``truth``.

    Parameters
    ----------
    truth, prediction, points, key, allow_invalid
        As in `TactileMetrics.update`: ``[rows, channels]`` in the unit of each channel, and the contact point of each row.
    channels
        Names of the columns; by default the columns of data frames, or the six, ``Px Py Pz`` in mm and ``Fx Fy Fz`` in N.
    metrics, units, periods, independent
        As in `TactileMetrics`.
    name
        Name of the sensor or the model, for tables and comparisons.
    fields
        Additional fields of the rows, such as ``scene=["dark", …]``.

    Raises
    ------
    ValueError, TypeError
        As `TactileMetrics.update`.

    >>> import numpy as np
    >>> import taceva
    >>> truth = np.zeros((4, 6))
    >>> taceva.score(truth, truth + 0.5)["mae", "Pz"].value
    0.5
    """
    require_unweighted(fields)
    channels, both = pair(truth, prediction, channels, points=points, key=key, declared={*(units or {}), *(periods or {})})
    wanted = SIX if channels is None else channels
    found = TactileMetrics(wanted, metrics, units=units, periods=periods, independent=independent, fields=list(fields))
    found._add(both, fields, allow_invalid)
    of_truth, of_prediction = real(both.truth, "truth"), real(both.prediction, "prediction")
    if not _taceva.keeps_samples(len(of_truth)):
        return Result(found._scored(name, both.notes))
    points = beside(both.points, both.index, "points")
    samples = Samples.of(wanted, of_truth, of_prediction, None if points is None else names_of_points(points), both.names)
    return Result(found._scored(name, [*both.notes, *samples.notes(periods or {})]), samples.table)


def score_tables(
    truth: str | os.PathLike[str],
    prediction: str | os.PathLike[str],
    *,
    metrics: str | Sequence[str] = "all",
    sensor: str | os.PathLike[str] | None = None,
    key: str | None = None,
    allow_invalid: bool = False,
    jobs: int = 0,
) -> Result:
    """Return the scores of two CSV tables, with the same bytes as ``taceva score --truth … --pred …``.

    Parameters
    ----------
    truth, prediction
        Files with a header, one row per sample and one column per channel, in mm and N.
    sensor
        TOML file with facts of the sensor, as in ``taceva score --sensor``.
    key
        Common column that pairs rows, or ``"order"``. By default a column ``sample``, ``id``, ``sample_id`` or ``index``.
    allow_invalid
        True to count and skip rows with NaN or an infinite number instead of rejecting them.
    jobs
        Number of threads; all cores if 0. Results do not depend on this number.
    """
    scored = _taceva.score_tables(
        os.fspath(truth),
        os.fspath(prediction),
        metric_names(metrics),
        None if sensor is None else os.fspath(sensor),
        key,
        allow_invalid,
        jobs,
        bar(),
    )
    return Result(*scored)
