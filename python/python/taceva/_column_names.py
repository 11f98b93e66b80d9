"""Arrays with named columns or rows: pandas, polars, Arrow, xarray, structured numpy arrays and dicts of arrays.

Columns are matched by name and rows by key, like files in ``taceva score``; disagreeing values are rejected.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

#: Columns that identify rows, in the order of trial; the same as for the command.
KEYS = ("sample", "id", "sample_id", "index")

#: Columns in which paired rows must agree, with the tolerance of numbers.
_AGREE = {"point_id": 0.0, "frame_sha256": 0.0, "t_s": 0.0005}

#: Columns that are no channels.
_BESIDE = {*KEYS, *_AGREE, "scene", "unit_id", "repeat", "depth_step", "phase", "part", "kind", "spacing_mm", "zero_u_mm", "intensity"}

#: Columns that probably hold contact points, under another name than ``point_id``.
_LIKE_POINTS = {"point", "points", "contact", "contact_point"}

#: Least number of rows for which equal sets of unique whole numbers are unlikely to be chance; the same as for the command.
_LEAST_KEYS = 5

_SIX = ("Px", "Py", "Pz", "Fx", "Fy", "Fz")

#: Remedy for an index without meaning.
_REMEDY = "to pair rows by order, pass .to_numpy() or reset_index(drop=True)"


@dataclass
class NamedColumns:
    """Columns by name, and the index of their rows, if any."""

    columns: dict[str, Any]
    #: Index of pandas; ``None`` if rows have no names.
    index: npt.NDArray[Any] | None = None
    #: True if the index is the default count from 0 of pandas.
    is_counted: bool = True
    #: Columns that are no channels because the caller names them as key or contact points.
    beside: set[str] = field(default_factory=set)

    def channels(self) -> list[str]:
        """Return the names of columns that are channels."""
        return [name for name in self.columns if name not in _BESIDE and name not in self.beside]

    def array(self, channels: Sequence[str], name: str) -> npt.NDArray[Any]:
        """Return ``[rows, channels]``, in the order of ``channels``.

        Raises
        ------
        ValueError
            For a missing channel.
        """
        missing = [channel for channel in channels if channel not in self.columns]
        if missing:
            known = ", ".join(self.columns)
            raise ValueError(f"{name} has no column {missing[0]!r}: its columns are {known}; rename them, or give their names as channels=[…]")
        return np.column_stack([_numbers(self.columns[channel]) for channel in channels])

    def column(self, name: str) -> Any:
        """Return the column called ``name``, or ``None``."""
        return self.columns.get(name)


@dataclass
class PairedArrays:
    """Truth and prediction of the same rows and channels."""

    truth: Any
    prediction: Any
    #: Contact points of the caller, or in the columns.
    points: Any
    #: Pairing of rows: the name of a key, ``the index``, ``the order`` as requested, or ``""`` for order.
    paired_by: str | None
    #: Index of the rows of the truth, if any, to align further columns.
    index: npt.NDArray[Any] | None = field(default=None)
    #: Row of the prediction for each row of the truth; ``None`` for the same order.
    order: npt.NDArray[np.intp] | None = field(default=None)
    #: Names of the rows of the truth, if known.
    names: Any = field(default=None)
    #: Notes on columns that were not used.
    notes: list[str] = field(default_factory=list)


def named_columns(table: Any, name: str) -> NamedColumns | None:
    """Return the columns of a table with names; ``None`` for a plain array or tensor.

    Raises
    ------
    ValueError
        For a repeated name.
    """
    if hasattr(table, "dims") and hasattr(table, "coords"):
        return _of_xarray(table, name)
    if isinstance(table, Mapping):
        return NamedColumns({str(key): np.asarray(column) for key, column in table.items()})
    if isinstance(table, np.ndarray) and table.dtype.names and table.ndim == 1:
        return NamedColumns({key: table[key] for key in table.dtype.names})
    if hasattr(table, "iloc") and hasattr(table, "index"):
        return _of_pandas(table, name)
    if hasattr(table, "get_column") and hasattr(table, "columns"):
        return NamedColumns({str(key): table.get_column(key).to_numpy() for key in table.columns})
    if hasattr(table, "column_names") and hasattr(table, "column"):
        return NamedColumns({str(key): np.asarray(table.column(key)) for key in table.column_names})
    return None


def _of_pandas(table: Any, name: str) -> NamedColumns:
    """Return the columns of a data frame; for a series, its only column, with the name of the series or ``""``."""
    index = table.index
    is_counted = bool(getattr(index, "start", None) == 0 and getattr(index, "step", None) == 1)
    rows = index.to_numpy()
    if not hasattr(table, "columns"):
        called = table.name if isinstance(table.name, str) else ""
        return NamedColumns({called: _of_extension(table)}, rows, is_counted)
    names = list(table.columns)
    if not all(isinstance(key, str) for key in names):
        # Numbered columns have no names; they are an array with an index.
        return NamedColumns({"": np.column_stack([_of_extension(table.iloc[:, at]) for at in range(len(names))])}, rows, is_counted)
    for key in names:
        if names.count(key) > 1:
            raise ValueError(f"{name}: the column {key!r} occurs twice")
    return NamedColumns({key: _of_extension(table[key]) for key in names}, rows, is_counted)


def _of_xarray(table: Any, name: str) -> NamedColumns | None:
    """Return the variables of a data set, the columns of a named table, or a single column; ``None`` for any other array."""
    if hasattr(table, "data_vars"):
        dims = list(dict.fromkeys(dim for column in table.data_vars.values() for dim in column.dims))
        if len(dims) != 1:
            raise ValueError(f"{name}: the Dataset has the dimensions {dims}, expected only the dimension of the rows")
        columns = {str(key): np.asarray(column.values) for key, column in table.data_vars.items()}
        return _with_rows(table, dims[0], columns)
    if table.ndim == 1:
        return _with_rows(table, table.dims[0], {"": np.asarray(table.values)})
    if table.ndim != 2:
        return None
    rows, channels = table.dims
    if channels not in table.coords:
        if rows in table.coords and set(map(str, table.coords[rows].values.tolist())) & set(_SIX):
            raise ValueError(f"{name}: the dimensions are {rows}, {channels}, expected rows before channels: transpose it")
        return None
    names = [str(key) for key in table.coords[channels].values.tolist()]
    for key in names:
        if names.count(key) > 1:
            raise ValueError(f"{name}: the column {key!r} occurs twice")
    values = np.asarray(table.values)
    return _with_rows(table, rows, {key: values[:, at] for at, key in enumerate(names)})


def _with_rows(table: Any, rows: Any, columns: dict[str, npt.NDArray[Any]]) -> NamedColumns:
    """Return ``columns`` with the names of their rows, and with row coordinates that must agree."""
    beside_rows = {key: np.asarray(table.coords[key].values) for key in _AGREE if key in table.coords and table.coords[key].dims == (rows,)}
    # A single unnamed column stays unnamed.
    columns = columns if "" in columns else beside_rows | columns
    if rows not in table.coords:
        return NamedColumns(columns)
    index = np.asarray(table.coords[rows].values)
    return NamedColumns(columns, index, index.dtype.kind in "iu" and bool(np.array_equal(index, np.arange(len(index)))))


def _of_extension(column: Any) -> npt.NDArray[Any]:
    """Return a pandas series as an array; nullable numbers as float64 with NaN."""
    if hasattr(column.dtype, "na_value") and getattr(column.dtype, "kind", "O") in "iuf":
        return np.asarray(column.to_numpy(dtype="float64", na_value=np.nan))
    return np.asarray(column.to_numpy())


def _numbers(column: Any) -> npt.NDArray[Any]:
    found = np.asarray(column)
    if found.dtype.kind == "f" and found.dtype.itemsize <= 4:
        return found.astype(np.float32)
    return found


def pair(
    truth: Any,
    prediction: Any,
    channels: Sequence[str] | None,
    *,
    points: Any = None,
    key: str | None = None,
    declared: Collection[str] = (),
) -> tuple[Sequence[str] | None, PairedArrays]:
    """Return the common channels, and both arrays with the rows of the truth.

    Plain arrays are returned unchanged, with ``channels``. ``points`` may be the name of a column. ``key`` is the column that pairs rows, or
    ``order``. Channels in ``declared`` have a unit or a period.

    Raises
    ------
    ValueError
        For different columns, for rows that cannot be paired or disagree, and for a column that probably names rows.
    """
    of_truth, of_prediction = named_columns(truth, "truth"), named_columns(prediction, "prediction")
    if of_truth is None and of_prediction is None:
        for name, column in (("points", points), ("key", None if key == "order" else key)):
            if isinstance(column, str):
                raise ValueError(f"{name}={column!r} names a column, but truth and prediction are arrays without names")
        return channels, PairedArrays(truth, prediction, points, None)
    for columns in (of_truth, of_prediction):
        if columns is not None:
            columns.beside.update(name for name in (points, key) if isinstance(name, str))
    wanted = _channels(of_truth, of_prediction, channels)
    order, paired_by = _order(of_truth, of_prediction, key)
    if channels is None and of_truth is not None and of_prediction is not None:
        _refuse_keys(of_truth, of_prediction, [name for name in wanted or () if name not in _SIX and name not in declared])
    arrays = []
    for columns, given, name in ((of_truth, truth, "truth"), (of_prediction, prediction, "prediction")):
        if columns is None:
            arrays.append(given)
        elif list(columns.columns) == [""] or (len(columns.columns) == 1 and len(wanted or _SIX) == 1 and not _is_known(columns, wanted)):
            # A single column, or numbered columns, are matched by position.
            arrays.append(next(iter(columns.columns.values())))
        else:
            arrays.append(columns.array(wanted or _SIX, name))
    if order is not None:
        arrays[1] = arrays[1][order]
    notes = [] if points is not None else _unused_points(of_truth, of_prediction, wanted or _SIX)
    if points is None or isinstance(points, str):
        points = _points(of_truth, of_prediction, order, points)
    if of_truth is not None and of_prediction is not None:
        _check_agreement(of_truth, of_prediction, order, paired_by)
    index = None if of_truth is None else of_truth.index
    return wanted, PairedArrays(arrays[0], arrays[1], points, paired_by, index, order, _names(of_truth, paired_by), notes)


def _points(truth: NamedColumns | None, prediction: NamedColumns | None, order: npt.NDArray[np.intp] | None, name: str | None) -> Any:
    """Return the contact points in the column called ``name``, else in ``point_id`` if there is one."""
    wanted = "point_id" if name is None else name
    points = None if truth is None else truth.column(wanted)
    if points is None and prediction is not None:
        points = prediction.column(wanted)
        points = points if points is None or order is None else points[order]
    if points is None and name is not None:
        known = ", ".join(dict.fromkeys(key for columns in (truth, prediction) if columns is not None for key in columns.columns))
        raise ValueError(f"points={name!r}: no such column, expected one of {known}, or one value per row")
    return points


def _unused_points(truth: NamedColumns | None, prediction: NamedColumns | None, channels: Sequence[str]) -> list[str]:
    """Return notes on columns that probably hold contact points but are not used."""
    there = {name for columns in (truth, prediction) if columns is not None for name in columns.columns}
    unused = sorted(name for name in there if name in _LIKE_POINTS and name not in channels)
    return [f"the column `{name}` was not used: give points={name!r} if it names contact points" for name in unused if "point_id" not in there]


def _names(truth: NamedColumns | None, paired_by: str | None) -> Any:
    """Return the names of the rows of the truth by which they were paired; ``None`` for rows paired by order."""
    if truth is None or not paired_by:
        return None
    return truth.index if paired_by == "the index" else truth.column(paired_by)


def _refuse_keys(truth: NamedColumns, prediction: NamedColumns, names: Sequence[str]) -> None:
    """Reject a column with the same unique whole numbers in both tables, which probably names rows."""
    for name in names:
        both = [columns.column(name) for columns in (truth, prediction)]
        if any(column is None or np.asarray(column).dtype.kind not in "iuf" for column in both):
            continue
        own, other = (np.unique(np.asarray(column)) for column in both)
        is_unique = len(own) >= _LEAST_KEYS and len(own) == len(both[0]) and len(other) == len(both[1])
        if is_unique and np.array_equal(own, other) and bool(np.all(own == np.floor(own))):
            raise ValueError(
                f"the column {name!r} holds the same unique whole numbers in truth and prediction, so it probably names rows: "
                f"leave it out, list the channels in channels=[…], or in `score` pair rows with key={name!r}"
            )


def _is_known(columns: NamedColumns, wanted: Sequence[str] | None) -> bool:
    """Return whether the only column has the name of a channel."""
    (name,) = columns.columns
    return name in (*_SIX, *(wanted or ()))


def _channels(truth: NamedColumns | None, prediction: NamedColumns | None, given: Sequence[str] | None) -> Sequence[str] | None:
    """Return the given channels, or else the columns of the prediction, which the truth must also have."""
    if given is not None:
        return given
    found = [columns.channels() for columns in (prediction, truth) if columns is not None]
    found = [names for names in found if names != [""]]
    if not found:
        return None
    names = found[0]
    if not names:
        raise ValueError("no column is a channel: expected Px, Py, Pz, Fx, Fy, Fz, or other names in channels=[…]")
    if truth is not None and prediction is not None and len(found) == 2:
        absent = [name for name in found[1] if name in _SIX and name not in names]
        if absent:
            raise ValueError(f"prediction has no column {absent[0]!r}, which truth has: give both the same channels, or select some with channels=[…]")
    return names


def _order(
    truth: NamedColumns | None, prediction: NamedColumns | None, given: str | None
) -> tuple[npt.NDArray[np.intp] | None, str | None]:
    """Return the row of the prediction for each row of the truth, ``None`` for the same order, and the name of the key."""
    if given == "order":
        return None, "the order"
    if given is not None:
        for columns, name in ((truth, "truth"), (prediction, "prediction")):
            if columns is None or given not in columns.columns:
                known = "none" if columns is None else ", ".join(columns.columns)
                raise ValueError(f"key={given!r}: {name} has no such column: expected a column of both tables, or 'order'; its columns are {known}")
    if truth is None or prediction is None:
        return None, None
    for key in KEYS if given is None else (given,):
        own, other = truth.column(key), prediction.column(key)
        if own is not None and other is not None:
            order = aligned(own, other, f"the key {key!r}", "correct the keys, or remove the column")
            _check_index(truth, prediction, order, key)
            return order, key
    if truth.index is None or prediction.index is None:
        return None, ""
    if truth.is_counted and prediction.is_counted:
        return None, ""
    return aligned(truth.index, prediction.index, "the index", _REMEDY), "the index"


def _check_index(truth: NamedColumns, prediction: NamedColumns, order: npt.NDArray[np.intp] | None, key: str) -> None:
    """Reject rows with equal keys but different indices, if both have a meaningful index."""
    if truth.index is None or prediction.index is None or truth.is_counted or prediction.is_counted:
        return
    other = prediction.index if order is None else prediction.index[order]
    differs = [at for at, (one, two) in enumerate(zip(truth.index.tolist(), other.tolist(), strict=True)) if one != two]
    if differs:
        at = differs[0]
        raise ValueError(f"row {at}: paired by {key!r}, but the index is {truth.index[at]!r} in truth and {other[at]!r} in prediction; {_REMEDY}")


def aligned(own: Any, other: Any, what: str, remedy: str) -> npt.NDArray[np.intp] | None:
    """Return the position of each of the names ``own`` in ``other``, or ``None`` if both are equal row by row.

    Raises
    ------
    ValueError
        For a repeated name, or a name that only ``own`` or only ``other`` has.
    """
    wanted, found = list(np.asarray(own).tolist()), list(np.asarray(other).tolist())
    if wanted == found and len(set(map(_hashable, found))) == len(found):
        return None
    places: dict[Any, int] = {}
    for at, name in enumerate(found):
        if places.setdefault(_hashable(name), at) != at:
            raise ValueError(f"{what} {name!r} occurs twice in prediction, in rows {places[_hashable(name)]} and {at}; {remedy}")
    seen: dict[Any, int] = {}
    order = []
    for at, name in enumerate(wanted):
        if seen.setdefault(_hashable(name), at) != at:
            raise ValueError(f"{what} {name!r} occurs twice in truth, in rows {seen[_hashable(name)]} and {at}; {remedy}")
        if _hashable(name) not in places:
            raise ValueError(f"no row of prediction has {what} {name!r}, which row {at} of truth has{_nearly(name, found)}; {remedy}")
        order.append(places[_hashable(name)])
    more = [name for name in found if _hashable(name) not in seen]
    if more:
        raise ValueError(f"no row of truth has {what} {more[0]!r}, which prediction has; {remedy}")
    return np.asarray(order, dtype=np.intp)


def _nearly(name: Any, others: Sequence[Any]) -> str:
    """Return a remark on the first of ``others`` that differs from ``name`` only in blanks or case, or an empty text."""

    def bare(text: str) -> str:
        return "".join(text.split()).lower()

    found = [other for other in others if isinstance(name, str) and isinstance(other, str) and bare(other) == bare(name)]
    return f", although {found[0]!r} differs only in blanks or case: write both alike" if found else ""


def _hashable(name: Any) -> Any:
    """Return a whole ``float`` as an ``int``: pandas may store the same row names in either type."""
    return int(name) if isinstance(name, float) and name.is_integer() else name


def _check_agreement(truth: NamedColumns, prediction: NamedColumns, order: npt.NDArray[np.intp] | None, paired_by: str | None) -> None:
    """Reject pairs of rows that differ in a common column that identifies the row."""
    for name, tolerance in _AGREE.items():
        own, other = truth.column(name), prediction.column(name)
        if own is None or other is None or len(own) != len(other):
            continue
        own, other = np.asarray(own), np.asarray(other) if order is None else np.asarray(other)[order]
        if tolerance and own.dtype.kind in "iuf" and other.dtype.kind in "iuf":
            differs = np.abs(own - other) > tolerance
        else:
            differs = np.asarray([str(one) != str(two) for one, two in zip(own.tolist(), other.tolist(), strict=True)], dtype=bool)
        if differs.any():
            at = int(np.nonzero(differs)[0][0])
            by = "order" if paired_by in ("", "the order", None) else repr(paired_by)
            raise ValueError(
                f"row {at}: {name} is {own[at]!r} in truth and {other[at]!r} in prediction, which were paired by {by}: "
                "the rows do not belong together; give both a column `sample` that names their rows"
            )


def beside(values: Any, index: npt.NDArray[Any] | None, name: str) -> Any:
    """Return ``values`` in the order of the rows of the truth, if they are a series with its own index.

    Raises
    ------
    ValueError
        For an index of other rows.
    """
    has_index = (hasattr(values, "iloc") and hasattr(values, "index")) or (hasattr(values, "dims") and hasattr(values, "coords"))
    columns = named_columns(values, name) if has_index else None
    if columns is None or columns.index is None:
        return values
    column = next(iter(columns.columns.values()))
    if index is None or columns.is_counted or len(column) != len(index):
        return column
    order = aligned(index, columns.index, "the index", _REMEDY)
    return column if order is None else column[order]


def predicted(table: Any, channels: Sequence[str], name: str) -> Any:
    """Return a prediction as a plain array with ``channels`` as columns, in the order of the rows given to the model.

    Raises
    ------
    ValueError
        For different columns, or an index of other rows.
    """
    columns = named_columns(table, name)
    if columns is None:
        return table
    is_lone = len(columns.columns) == 1 and (list(columns.columns) == [""] or (len(channels) == 1 and not _is_known(columns, channels)))
    array = next(iter(columns.columns.values())) if is_lone else columns.array(channels, name)
    if columns.index is None or columns.is_counted:
        return array
    order = aligned(np.arange(len(array)), columns.index, "the index", "number the rows of the prediction from 0, in the order of the samples")
    return array if order is None else array[order]
