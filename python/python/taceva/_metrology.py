"""Gauge studies, calibration curves and uncertainty budgets, by the commands of the program."""

from __future__ import annotations

import csv
import datetime
import io
import json
import os
import re
import tempfile
from collections.abc import Callable, Mapping, Sequence
from numbers import Integral, Real
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from taceva import _taceva
from taceva._arrays import real, require_rows
from taceva._column_names import beside, named_columns
from taceva._counted import counted
from taceva._result import Result


class Metrology:
    """Result of `gauge`, `curve` or `budget`: a dictionary, a data frame, or a table of text, HTML or LaTeX."""

    def __init__(self, found: Mapping[str, Any]) -> None:
        self._found = found

    @property
    def text(self) -> str:
        """JSON, with the same bytes as ``save`` writes."""
        return str(self._found["documents"][0])

    def to_dict(self) -> dict[str, Any]:
        """Return the JSON that the command writes by ``--format json``, as a dictionary."""
        return dict(json.loads(self.text))

    def to_frame(self) -> Any:
        """Return a ``pandas.DataFrame`` with all digits: the table that the command writes by ``--format csv``."""
        import pandas

        # pandas reads all digits by default from 3.1 on, where the argument is deprecated.
        is_exact = tuple(int(part) for part in pandas.__version__.split(".")[:2]) >= (3, 1)
        precision: dict[str, Any] = {} if is_exact else {"float_precision": "round_trip"}
        return pandas.read_csv(io.StringIO(self._found["numbers"]), **precision)

    def to_latex(self) -> str:
        """Return a LaTeX table for a paper; it needs ``booktabs``."""
        return str(self._found["latex"])

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the JSON to ``path``, which must not exist."""
        with Path(path).open("x", encoding="utf-8", newline="\n") as file:
            file.write(self.text)

    def __str__(self) -> str:
        return str(self._found["text"])

    def _repr_html_(self) -> str:
        return str(self._found["html"])


class GaugeStudy(Metrology):
    """Result of `gauge`: components of variance, their shares, and the number of distinct categories, each with its interval."""

    def __repr__(self) -> str:
        found = self.to_dict()
        size = ", ".join(counted(found[f"{noun}s"], noun) for noun in ("part", "operator", "trial"))
        return f"<taceva.GaugeStudy of {found['channel']}: {size}>"


class CalibrationCurve(Metrology):
    """Result of `curve`: coefficients, bands, and the other requested figures."""

    def __repr__(self) -> str:
        found = self.to_dict()
        axes = f"{found['y']['column']} over {found['x']['column']}"
        return f"<taceva.CalibrationCurve of {axes}, order {found['order']}, {counted(found['n'], 'row')}>"


class Budget(Metrology):
    """Result of `budget`: value, standard and expanded uncertainty, sources, and effects that no source covers."""

    def __repr__(self) -> str:
        found = self.to_dict()
        half = found["U"]
        if found["method"] == "monte_carlo":
            half = max(abs(end - found["value"]) for end in found["interval"])
        expanded = "U undefined" if half is None else f"U = {half:.2g} {found['unit']}"
        return f"<taceva.Budget of {found['measurand']}: {expanded}>"


def gauge(
    readings: Any,
    *,
    part: Any = ("point_id", "depth_step"),
    by: Any = "unit_id",
    trial: Any = "repeat",
    truth: Any = None,
    channel: str | None = None,
    nested: bool = False,
    method: str = "anova",
    response: str | None = None,
    tolerance: str | None = None,
    pool: float = 0.25,
    drop_incomplete: bool = False,
) -> GaugeStudy:
    """Study a measuring system, as ``taceva gauge`` does: shares of the variation of readings due to units, gels, days or persons.

    Parameters
    ----------
    readings
        An array ``[rows]``, a table with named columns (pandas, polars, Arrow, a dict of arrays), the path of a table, or a `Result` with its
        samples. NaN is a missing reading.
    part, by, trial
        Contact condition, operator and repeat of each row: arrays, or names of columns. The operator is the factor that differs between the
        measurements of a part.
    truth
        Reference values of an array of readings: errors are studied.
    channel
        Channel to study: ``"Fz"`` of a table with several, or the name of an array. Px, Py and Pz are in mm; Fx, Fy and Fz are in N.
    nested
        True if each operator measures its own parts.
    method
        ``"anova"`` or ``"range"``.
    response
        ``"error"`` or ``"prediction"``; by default errors if the table holds the truth.
    tolerance
        Width of the tolerance with its unit: ``"0.1 N"``.
    pool
        p value above which the interaction is pooled with repeatability.
    drop_incomplete
        True to leave out parts with a missing or surplus reading instead of refusing them.

    Raises
    ------
    ValueError
        For labels of another length, an unbalanced study, a missing column, and an infinite reading.
    DatasetError
        For a table that cannot be read.

    >>> import taceva
    >>> force = [0.21, 0.22, 0.23, 0.22, 0.48, 0.47, 0.50, 0.51, 0.83, 0.84, 0.85, 0.86]
    >>> place, unit, repeat = [row // 4 for row in range(12)], [row // 2 % 2 for row in range(12)], [row % 2 for row in range(12)]
    >>> taceva.gauge(force, part=place, by=unit, trial=repeat, channel="Fz")
    <taceva.GaugeStudy of Fz: 3 parts, 2 operators, 2 trials>
    """
    with tempfile.TemporaryDirectory() as folder:
        table = _Table.of(readings, "readings", Path(folder))
        if table.is_array:
            channel = channel or "reading"
            (values,) = table.columns.values()
            reference = beside(truth, table.index, "truth")
            table.columns = {channel: values} if truth is None else {channel: reference, f"{channel}_predicted": values}
        elif truth is not None:
            raise ValueError("truth: expected only with an array of readings; in a table, the truth is the column of the channel")
        factors = {name: table.names(given, name) for name, given in {"part": part, "by": by, "trial": trial}.items()}
        options = _options(
            **factors,
            channels=channel,
            nested=nested,
            method=method,
            response=response,
            tolerance=tolerance,
            pool=float(pool),
            drop_incomplete=drop_incomplete,
        )
        return _made(GaugeStudy, ["gauge", table.written(), *options], table.own, "channel")


def curve(
    table: Any = None,
    *,
    x: Any,
    y: Any,
    points: Any = None,
    independent: bool = False,
    order: int = 1,
    band: float = 0.95,
    simultaneous: bool = False,
    at: Sequence[float] = (),
    invert: Sequence[str] = (),
    detect: bool = False,
    iso7500: bool = False,
    iso376: Any = None,
    readings: int = 1,
) -> CalibrationCurve:
    """Fit a calibration curve of readings ``y`` over reference values ``x``, as ``taceva curve`` does.

    Parameters
    ----------
    table
        A table with named columns (pandas, polars, Arrow, a dict of arrays), the path of a table, or a `Result` with its samples. Without it,
        ``x`` and ``y`` are arrays.
    x, y
        Names of columns, ``"Fz"`` and ``"Fz_predicted"``, or arrays ``[rows]``. Rows with NaN are left out and counted.
    points
        Contact point of each row, an array, or the name of its column; by default a column ``point_id``.
    independent
        True to treat each row as independent of the others.
    order
        Order of the polynomial, 1 to 3.
    band
        Probability of bands and of inverse predictions.
    simultaneous
        True for a confidence band that holds at all reference values together.
    at
        Reference values of the bands; by default five.
    invert
        Readings to invert, with their unit: ``["0.35 N"]``.
    detect
        True for the critical and the detectable reference value.
    iso7500
        True for relative errors like those of ISO 7500-1.
    iso376
        Names of series like those of ISO 376, an array, or the name of its column.
    readings
        Number of new readings that are averaged.

    Raises
    ------
    ValueError
        For arrays of another length, too few rows, a missing column, and infinite numbers.
    DatasetError
        For a table that cannot be read.

    >>> import taceva
    >>> force, grey = [0.0, 0.25, 0.5, 0.75, 1.0, 1.25], [0.02, 0.26, 0.49, 0.77, 1.01, 1.24]
    >>> taceva.curve(x=force, y=grey)
    <taceva.CalibrationCurve of y over x, order 1, 6 rows>
    """
    with tempfile.TemporaryDirectory() as folder:
        held = _Table.of({} if table is None else table, "table", Path(folder))
        named: dict[str, str] = {}
        for name, given in {"x": x, "y": y, "point_id": points, "iso376": iso376}.items():
            if given is not None:
                (named[name],) = held.names(given, name)
        options = _options(
            x=named["x"],
            y=named["y"],
            point=named.get("point_id"),
            iso376=named.get("iso376"),
            order=order,
            band=float(band),
            simultaneous=simultaneous,
            at=[repr(float(value)) for value in at],
            invert=[invert] if isinstance(invert, str) else list(invert),
            detect=detect,
            iso7500=iso7500,
            readings=readings,
            independent=independent,
        )
        return _made(CalibrationCurve, ["curve", held.written(), *options], held.own, "y")


def budget(
    sources: Mapping[str, Any] | str | os.PathLike[str],
    *,
    results: Result | str | os.PathLike[str] | None = None,
    gauge: GaugeStudy | None = None,
    certificate: Mapping[str, Any] | str | os.PathLike[str] | None = None,
    date: datetime.date | str | None = None,
    at: str | None = None,
    draws: int = 1_000_000,
    seed: int = 1,
    most: str | None = None,
) -> Budget:
    """Combine uncertainties into the uncertainty of a reading, as ``taceva budget`` does.

    Parameters
    ----------
    sources
        The path of a ``budget.toml``, or its content as a mapping. ``budget_version`` may be absent from a mapping.
    results
        A result with its samples, or its path: sources name its figures, ``"from": "error.between"``.
    gauge
        A study whose components the sources of a mapping name: ``"from": "gauge.json#operator"``.
    certificate
        Certificate of the reference, instead of the certificate in the result: a path, or a mapping such as ``{"force": {"certificate": {…}}}``.
    date
        Day of the recording, on which the certificate must be valid.
    at
        Value of the measurand with its unit, ``"0.5 N"``; by default the value of the sources.
    draws, seed
        Greatest number of Monte Carlo draws, 0 for none, and their seed.
    most
        Greatest expanded uncertainty that is allowed, with its unit. The dictionary states ``passed``.

    Raises
    ------
    ValueError
        For a source without an origin, an unknown key or unit, and a figure that the result does not measure, each with its line and key.

    >>> import taceva
    >>> lamp = {"name": "lamp", "half_width": "10 mN", "shape": "rectangular"}
    >>> taceva.budget({"measurand": "Fz", "at": ["0.5 N"], "source": [lamp, {"name": "transducer", "U": "3 mN", "k": 2}]}, draws=0)
    <taceva.Budget of Fz: U = 0.012 N>
    """
    with tempfile.TemporaryDirectory() as created:
        folder = Path(created)
        own: dict[str, str] = {}
        if isinstance(sources, Mapping):
            path = folder / "budget.toml"
            path.write_text(_toml_text(_resolved(sources, has_gauge=gauge is not None)), encoding="utf-8")
            own[str(path)] = "sources"
        elif gauge is not None:
            raise ValueError("gauge: expected only with a mapping of sources; a file names its studies, gauge.json#operator")
        else:
            path = Path(os.path.abspath(sources))
        if gauge is not None:
            (folder / _GAUGE).write_text(gauge.text, encoding="utf-8")
            own[str(folder / _GAUGE)] = "gauge"
        if isinstance(certificate, Mapping):
            stated = folder / "certificate.toml"
            stated.write_text(_toml_text(certificate), encoding="utf-8")
            own[str(stated)] = "certificate"
            certificate = stated
        if isinstance(results, Result):
            results, samples = _written(results, folder)
            own.update({str(results): "results", str(samples): "samples of results"})
        options = _options(
            results=None if results is None else os.path.abspath(results),
            certificate=None if certificate is None else os.path.abspath(certificate),
            date=None if date is None else str(date),
            at=at,
            mc=int(draws),
            seed=int(seed),
            most_U=most,
        )
        return _made(Budget, ["budget", str(path), *options], own, "at")


#: File of the study that `budget` gets as an object.
_GAUGE = "gauge.json"

#: Options whose parameters have other names.
_PARAMETERS = {"channels": "channel", "mc": "draws", "most-U": "most", "point": "points"}

_Made = TypeVar("_Made", bound=Metrology)


class _Table:
    """A table of readings: a path, or columns that will be written."""

    def __init__(self, path: Path, columns: dict[str, Any] | None, index: Any, name: str) -> None:
        self._path = path
        #: Columns by name; ``None`` for a file of the user.
        self._columns = columns
        #: Index of the rows, if they have one.
        self.index = index
        self._name = name
        #: Paths that the user has never seen, with the words for them.
        self.own = {} if columns is None else {str(path): name}
        #: True for an array or a single column without other columns.
        self.is_array = False

    @staticmethod
    def of(given: Any, name: str, folder: Path) -> _Table:
        if isinstance(given, (str, os.PathLike)):
            return _Table(Path(os.path.abspath(given)), None, None, name)
        if isinstance(given, Result):
            table = _Table(_written(given, folder)[1], None, None, name)
            table.own[str(table._path)] = name
            return table
        named = named_columns(given, name)
        columns = {"": given} if named is None else named.columns
        table = _Table(folder / "table.csv", columns, None if named is None else named.index, name)
        # A series is an array with an index.
        table.is_array = named is None or (len(columns) == 1 and not hasattr(given, "columns") and not isinstance(given, Mapping))
        return table

    @property
    def columns(self) -> dict[str, Any]:
        return {} if self._columns is None else self._columns

    @columns.setter
    def columns(self, columns: dict[str, Any]) -> None:
        self._columns = columns

    def names(self, given: Any, name: str) -> list[str]:
        """Return the names of the columns ``given``. An array is added to the table as the column ``name``."""
        if self._columns is None:
            if isinstance(given, str):
                return [given]
            if isinstance(given, (list, tuple)) and all(isinstance(word, str) for word in given):
                return list(given)
            raise ValueError(f"{name}: expected the name of a column of the {self._name}, found {type(given).__name__}")
        if isinstance(given, str):
            known = [column for column in self._columns if column]
            plain = given.removeprefix("truth.")
            plain = f"{plain.removeprefix('prediction.')}_predicted" if plain.startswith("prediction.") else plain
            if not {given, plain} & set(known):
                raise ValueError(f"{name}: no column {given!r}, expected an array or one of {', '.join(known) or 'none'}")
            return [given]
        if isinstance(given, (list, tuple)) and given and all(isinstance(word, str) and word in self._columns for word in given):
            return list(given)
        if isinstance(given, tuple):
            # A tuple names columns; labels are a list or an array.
            absent = [word for word in given if word not in self._columns]
            if not absent:
                raise ValueError(f"{name}: an empty tuple, expected names of columns")
            raise ValueError(f"{name}: no column {absent[0]!r}, expected an array or names of columns")
        if name in self._columns:
            raise ValueError(f"{name}: an array and a column of this name are given, expected one of the two")
        if self.index is None and hasattr(given, "iloc"):
            self.index = given.index.to_numpy()
        self._columns[name] = beside(given, self.index, name)
        return [name]

    def written(self) -> str:
        """Return the path of the table, and write it if it holds columns."""
        if self._columns is not None:
            columns = {name: _cells(column, name) for name, column in self._columns.items()}
            (first, cells), *others = columns.items()
            for name, column in others:
                if len(column) != len(cells):
                    raise ValueError(f"{name} has {counted(len(column), 'row')}, {first} has {len(cells)}")
            with self._path.open("x", encoding="utf-8", newline="") as file:
                writer = csv.writer(file, lineterminator="\n")
                writer.writerow(columns)
                writer.writerows(zip(*columns.values(), strict=True))
        return str(self._path)


def _cells(column: Any, name: str) -> list[str]:
    """Return cells of numbers or labels; missing ones are empty.

    >>> _cells([0.5, float("nan")], "y"), _cells(["a", None], "part")
    (['0.5', ''], ['a', ''])
    >>> _cells(np.array(["2026-05-12", "NaT"], dtype="datetime64[ns]"), "by")
    ['2026-05-12T00:00:00.000000000', '']
    """
    if np.ma.isMaskedArray(column) or hasattr(column, "detach"):
        column = real(column, name)
    found = np.asarray(column)
    if found.ndim != 1:
        raise ValueError(f"{name} has the shape {list(found.shape)}, expected one value per row")
    require_rows(found, name)
    if found.dtype.kind in "fc":
        found = real(found, name)
        rows = np.flatnonzero(np.isinf(found))
        if len(rows):
            raise ValueError(f"{name} row {rows[0]}: {found[rows[0]]}, expected a finite number, or NaN for a missing number")
        return ["" if number != number else repr(number) for number in found.tolist()]
    if found.dtype.kind in "mM":
        # A list of nanoseconds has a number for NaT.
        return ["" if np.isnat(time) else str(time) for time in found]
    return ["" if _is_missing(cell) else str(cell) for cell in found.tolist()]


def _is_missing(cell: Any) -> bool:
    return cell is None or (isinstance(cell, float) and cell != cell) or type(cell).__name__ in ("NAType", "NaTType")


def _written(result: Result, folder: Path) -> tuple[Path, Path]:
    """Write a result and its samples side by side, and return their paths."""
    paths = folder / "result.json", folder / "result.samples.csv"
    result.save(paths[0])
    result.save_samples(paths[1])
    return paths


def _options(**given: Any) -> list[str]:
    """Return options of the command; absent ones are ``None``, ``False`` or empty.

    >>> _options(nested=True, part=["point_id", "depth_step"], tolerance=None, most_U="0.1 N")
    ['--nested', '--part=point_id,depth_step', '--most-U=0.1 N']
    """
    words = []
    for name, value in given.items():
        if value is None or value is False or value == []:
            continue
        option = f"--{name.replace('_', '-')}"
        listed = ",".join(value) if isinstance(value, list) else value
        words.append(option if value is True else f"{option}={listed}")
    return words


def _made(kind: Callable[[Mapping[str, Any]], _Made], words: list[str], own: Mapping[str, str], key: str) -> _Made:
    """Return the result of a command. In errors, ``own`` replaces paths of temporary files by names; ``key`` tells several results apart."""
    try:
        found = _taceva.metrology(["taceva", *words])
    except ValueError as error:
        message = str(error)
        for path, name in own.items():
            message = message.replace(path, name)
        message = re.sub(r"(?<![\w`-])--([a-z][\w-]*)", lambda option: _PARAMETERS.get(option[1], option[1].replace("-", "_")), message)
        raised = type(error)(message)
        vars(raised).update(vars(error))
        if str(vars(raised).get("path")) in own:
            vars(raised)["path"] = None
        raise raised from None
    if len(found["documents"]) != 1:
        several = [json.loads(document) for document in found["documents"]]
        unit = f" {several[0]['unit']}" if key == "at" else ""
        known = ", ".join(f"{one[key]}{unit}" for one in several)
        raise ValueError(f"{key} has several values: {known}; expected one, such as {key}={f'{several[0][key]}{unit}'!r}")
    return kind(found)


def _resolved(sources: Mapping[str, Any], *, has_gauge: bool) -> dict[str, Any]:
    """Return the sources with their version, and with absolute paths of gauge studies."""

    def whole(source: Any) -> Any:
        named = source.get("from") if isinstance(source, Mapping) else None
        if not isinstance(named, str) or "#" not in named:
            return source
        file, _, component = named.rpartition("#")
        if has_gauge and file == _GAUGE:
            return source
        return {**source, "from": f"{os.path.abspath(file)}#{component}"}

    found = {"budget_version": 1, **sources}
    if isinstance(found.get("source"), (list, tuple)):
        found["source"] = [whole(source) for source in found["source"]]
    return found


def _toml_text(table: Mapping[str, Any]) -> str:
    """Return a mapping as TOML.

    >>> print(_toml_text({"measurand": "Fz", "source": [{"name": "lamp", "u": 0.5}]}), end="")
    "measurand" = "Fz"
    "source" = [
    { "name" = "lamp", "u" = 0.5 }
    ]
    """
    return "".join(f"{_quoted(key)} = {_toml(value)}\n" for key, value in table.items())


def _toml(value: Any) -> str:
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{_quoted(key)} = {_toml(own)}" for key, own in value.items()) + " }"
    if isinstance(value, str):
        return _quoted(value)
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, Integral):
        return str(int(value))
    if isinstance(value, Real):
        return repr(float(value))
    if isinstance(value, datetime.date):
        return value.isoformat()
    if hasattr(value, "__array__"):
        value = np.asarray(value).tolist()
    if isinstance(value, (list, tuple)):
        of_tables = any(isinstance(own, Mapping) for own in value)
        opening, between, closing = ("[\n", ",\n", "\n]") if of_tables else ("[", ", ", "]")
        return opening + between.join(map(_toml, value)) + closing
    raise TypeError(f"{value!r}: expected a string, a number, a list or a mapping")


def _quoted(text: Any) -> str:
    if not isinstance(text, str):
        raise TypeError(f"{text!r}: expected a string as a key")
    return json.dumps(text, ensure_ascii=False)
