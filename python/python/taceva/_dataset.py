"""Recordings on disk."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from taceva import _taceva
from taceva._bar import bar
from taceva._counted import counted
from taceva._pickles import PICKLE_VERSION, require_version
from taceva._settings import setting_words

IntArray = npt.NDArray[np.intp]

#: Row indices as in numpy: whole numbers, with negative ones from the end, a boolean mask, or a slice.
RowIndex = Sequence[int] | Sequence[bool] | npt.NDArray[Any] | slice


@dataclass(frozen=True)
class Rows:
    """Row numbers from 0 of each part, divided like ``taceva evaluate``."""

    train: IntArray
    validation: IntArray
    test: IntArray
    #: Method of the division, in the format of ``--split``.
    split: str


class Samples(NamedTuple):
    """Frames or signals of some rows, with their labels. A single row has no row axis."""

    #: Frames ``[rows, height, width, samples]``, with one sample per pixel (gray) or three (red, green, blue); or signals ``[rows, values]``.
    #: ``None`` in a recording of labels alone.
    seen: npt.NDArray[Any] | None
    #: ``[rows, channels]``; NaN for a missing label.
    labels: npt.NDArray[np.float64]


class Dataset:
    """A recording: labels of every sample, and frames or signals. `open` opens a recording, `from_arrays` writes one.

    ``dataset[3]``, ``dataset[-1]``, ``dataset[10:20]`` and ``dataset[mask]`` are `Samples`. ``frames``, ``features`` and the other methods
    accept the same kinds of rows.

    A recording is pickled as its path and digest. Unpickling raises `DatasetError` if the recording at that path has another digest.
    """

    def __init__(self, path: str | os.PathLike[str], view: str | None = None) -> None:
        self._inner = _taceva.Recording(os.fspath(path), view)
        self._labels: npt.NDArray[np.float64] | None = None

    @property
    def path(self) -> str:
        """Folder of the recording."""
        return str(self._inner.path())

    @property
    def views(self) -> tuple[str, ...]:
        """Names of the views, if each sample has several pictures: ``("left", "right")``; empty otherwise."""
        return tuple(self._inner.views())

    @property
    def view(self) -> str | None:
        """Selected view of the frames: ``left``, or ``left+right`` side by side."""
        return self._inner.view()

    @property
    def digest(self) -> str:
        """Digest of the content of the recording."""
        return self._inner.digest()

    @property
    def sensor(self) -> str:
        """Sensor model."""
        return self._inner.sensor()

    @property
    def source(self) -> str:
        """``recorded`` by a real sensor, ``simulated`` or ``synthetic``."""
        return self._inner.source()

    @property
    def channels(self) -> tuple[str, ...]:
        """Names of the labels."""
        return tuple(name for name, _ in self._inner.channels())

    @property
    def units(self) -> dict[str, str]:
        """Units of the labels by channel."""
        return dict(self._inner.channels())

    @property
    def frame_shape(self) -> tuple[int, int, int] | None:
        """Height, width and samples per pixel (1 gray, 3 red, green, blue) of frames; ``None`` without frames."""
        return self._inner.frame_shape()

    def __len__(self) -> int:
        return self._inner.rows()

    def __getitem__(self, rows: int | np.integer[Any] | RowIndex) -> Samples:
        if isinstance(rows, int | np.integer):
            seen, labels = self[[int(rows)]]
            return Samples(None if seen is None else seen[0], labels[0])
        wanted = self._rows(rows)
        if self._labels is None:
            self._labels = self.labels()
        if self.frame_shape is not None:
            return Samples(np.asarray(self._inner.frames(wanted, 0, None)), self._labels[wanted])
        has_signals = self._inner.signal_values() is not None
        return Samples(np.asarray(self._inner.signals(wanted)) if has_signals else None, self._labels[wanted])

    def labels(self) -> npt.NDArray[np.float64]:
        """Return ``[rows, channels]``, float64 in `units`, read-only; NaN for a missing label."""
        return np.asarray(self._inner.labels())

    def points(self) -> list[str | None]:
        """Return the name of the contact point of each row, ``None`` for a row without one.

        Raises
        ------
        KeyError
            If the recording has no contact points.
        """
        return self.column("point_id")

    def column(self, name: str) -> list[str | None]:
        """Return a column of the table as texts, such as ``t_s``, ``scene``, ``sample`` or an attribute.

        Raises
        ------
        KeyError
            If the recording has no such column.
        """
        found = self._inner.column(name)
        if found is None:
            known = ["sample", "point_id", "unit_id", "scene", "repeat", "depth_step", "phase", "t_s", *self._inner.attributes()]
            raise KeyError(f"no column {name!r}; columns may be {', '.join(known)}")
        return found

    def frame(self, row: int) -> npt.NDArray[Any]:
        """Return ``[height, width, samples]`` of one row, as in `frames`."""
        found: npt.NDArray[Any] = self.frames([row], jobs=1)[0]
        return found

    def frames(self, rows: RowIndex | None = None, *, jobs: int = 0) -> npt.NDArray[Any]:
        """Return ``[rows, height, width, samples]`` of some or all rows, in order: uint8 or uint16, read-only, decoded on ``jobs`` threads.

        Raises
        ------
        DatasetError
            For a row without a frame, or a damaged frame.
        """
        return np.asarray(self._inner.frames(self._rows(rows), jobs, bar()))

    def batches(self, rows: RowIndex | None = None, *, size: int = 64, jobs: int = 0) -> Iterator[npt.NDArray[Any]]:
        """Yield frames in batches of at most ``size`` rows; only one batch is in memory."""
        if size < 1:
            raise ValueError(f"size {size}: expected at least 1")
        wanted = self._rows(rows)
        for first in range(0, len(wanted), size):
            yield np.asarray(self._inner.frames(wanted[first : first + size], jobs, None))

    def reference(self) -> npt.NDArray[Any] | None:
        """Return the reference frame of the untouched gel, if any."""
        found = self._inner.reference()
        return None if found is None else np.asarray(found)[0]

    def features(
        self,
        rows: RowIndex | None = None,
        *,
        settings: Mapping[str, Any] | None = None,
        jobs: int = 0,
    ) -> npt.NDArray[np.float32]:
        """Return ``[rows, values]``: features of frames or signals for a model, 32×32 gray by default.

        ``settings`` are as in ``--set``: ``{"size": "16x16", "color": "rgb", "difference": "true"}``.
        """
        words = setting_words(settings)
        found, _, _ = _taceva.features(self._inner, words, self._rows(rows), jobs, bar())
        return np.asarray(found)

    def signals(self, rows: RowIndex | None = None) -> npt.NDArray[np.float32]:
        """Return ``[rows, values]`` of the signals of some rows, taxel by taxel, read-only."""
        return np.asarray(self._inner.signals(self._rows(rows)))

    def split(self, split: str | None = None, seed: int = 0) -> Rows:
        """Divide the rows like ``taceva evaluate --split``: ``by-point 70/15/15``, ``random 80/0/20``, ``chronological 90/0/10`` and others.

        The numbers are percentages of training, validation and test. ``by-point`` keeps the samples of one contact point together. ``None``
        selects the default of ``taceva evaluate``.

        Raises
        ------
        ValueError
            For an unknown split, or one that does not fit the recording.
        """
        parts, name = self._inner.split(split, seed)
        return _rows_by_part(parts, name)

    def folds(self, split: str = "cv:5", seed: int = 0) -> list[Rows]:
        """Divide the rows once for each fold of a cross-validation, like ``taceva evaluate --split cv:5``; each row is tested in one fold.

        ``split`` may be ``cv:10``, ``cv:5 by-point``, ``loo by-column:object``, ``leave-one-recording-out`` and others. Fit a model of your own on
        ``features[fold.train]``, predict ``features[fold.test]``, and give the predictions of all folds to `score`.

        Raises
        ------
        ValueError
            For a split with a single division, and for more folds than groups.
        """
        folds, name = self._inner.folds(split, seed)
        return [_rows_by_part(parts, name) for parts in folds]

    def check(self, *, jobs: int = 0) -> dict[str, Any]:
        """Return the findings of ``taceva check --format json``: defects of the recording and notes."""
        return dict(json.loads(self._inner.check(jobs, bar())))

    def to_pandas(self) -> Any:
        """Return labels and table columns as a ``pandas.DataFrame``, one row per sample; ``attrs["units"]`` has the units by column."""
        import pandas

        frame = pandas.DataFrame(np.array(self.labels()), columns=list(self.channels))
        known = ("sample", "point_id", "unit_id", "scene", "repeat", "depth_step", "phase", "t_s")
        there = [name for name in known if self._inner.column(name) is not None]
        for at, name in enumerate(there):
            column = pandas.Series(self.column(name), index=frame.index, dtype=object)
            is_number = name in ("repeat", "depth_step", "t_s")
            frame.insert(at, name, pandas.to_numeric(column) if is_number else column)
        for name in self._inner.attributes():
            frame[name] = self.column(name)
        frame.attrs.update(units=self._units_of(list(frame.columns)), source=self.source, sensor=self.sensor)
        return frame

    def to_xarray(self) -> Any:
        """Return the labels as an ``xarray.DataArray`` of ``sample`` and ``channel``, with the names of both, units and contact points as coordinates."""
        import xarray

        points = self._inner.column("point_id")
        coordinates: dict[str, Any] = {
            "sample": self.column("sample"),
            "channel": list(self.channels),
            "unit": ("channel", list(self.units.values())),
        }
        if points is not None:
            coordinates["point_id"] = ("sample", points)
        facts = {"sensor": self.sensor, "source": self.source, "digest": self.digest}
        return xarray.DataArray(np.array(self.labels()), dims=("sample", "channel"), coords=coordinates, name="labels", attrs=facts)

    def _units_of(self, columns: Sequence[str]) -> dict[str, str]:
        units = {"t_s": "s", "spacing_mm": "mm", "zero_u_mm": "mm", **self.units}
        return {name: units[name] for name in columns if name in units}

    def __arrow_c_stream__(self, requested_schema: object = None) -> object:
        """Return the table as an Arrow stream, which pyarrow, polars, DuckDB and others read: ``pyarrow.table(dataset)``.

        A missing label is null. The metadata of a column has its ``unit``, the metadata of the table ``taceva.sensor`` and ``taceva.source``.
        ``requested_schema`` is ignored, as the interface allows: the table keeps its own types.
        """
        return self._inner.arrow_stream()

    def export(self, out: str | os.PathLike[str], form: str = "csv", *, jobs: int = 0) -> list[str]:
        """Export to the new folder ``out`` for other programs, like ``taceva export --format``: ``csv``, ``huggingface``, ``hdf5`` or ``lerobot``.

        `import_recording` with the exported ``map.toml`` restores the recording. Returns a list of everything that the format cannot store.
        """
        return self._inner.export(form, os.fspath(out), jobs, bar())

    def to_huggingface(self, folder: str | os.PathLike[str], *, jobs: int = 0) -> Any:
        """Export to the new ``folder`` and return it as a ``datasets.Dataset`` of Hugging Face: frames as ``Image``, labels as numbers.

        Units survive ``save_to_disk`` and ``map``: ``info.description`` is JSON with sensor, source, digest and units by column.
        The metadata of the Parquet file also have them, as ``unit.Fz``.
        """
        try:
            import datasets
        except ImportError as error:
            raise ImportError("to_huggingface needs the package datasets: pip install datasets") from error
        self.export(folder, "huggingface", jobs=jobs)
        files = sorted(str(path) for path in Path(folder).glob("data/*.parquet"))
        found = datasets.Dataset.from_parquet(files, cache_dir=str(Path(folder) / ".cache"))
        said = {"sensor": self.sensor, "source": self.source, "digest": self.digest, "units": self._units_of(found.column_names)}
        found.info.description = json.dumps(said)
        return found

    def torch(self, rows: RowIndex | None = None) -> Any:
        """Return a ``torch.utils.data.Dataset`` of ``(frame, labels)``: the frame ``[samples, height, width]`` in float32 from 0 to 1, labels in float32.

        For a recording of taxels the items are ``(signals, labels)``: ``[values]``, taxel by taxel, as from `signals`.

        Raises
        ------
        DatasetError
            For a recording without frames and signals.
        """
        wanted = self._rows(rows)
        has_frames = self.frame_shape is not None
        if not has_frames and self._inner.signal_values() is None:
            error = _taceva.DatasetError(f"{self.path}: the recording has neither frames nor signals, and a data set of torch needs one of them")
            error.path = Path(self.path)
            raise error
        from taceva._torch import Frames, Signals

        return Frames(self, wanted) if has_frames else Signals(self, wanted)

    def _rows(self, rows: RowIndex | None) -> list[int]:
        if rows is None:
            return list(range(len(self)))
        if isinstance(rows, slice):
            return list(range(*rows.indices(len(self))))
        wanted = np.asarray(rows)
        if wanted.size == 0:
            return []
        if wanted.ndim != 1 or wanted.dtype.kind not in "iub":
            raise TypeError(
                f"rows: expected whole numbers, a mask or a slice, found an array of {wanted.dtype} of the shape {list(wanted.shape)}"
            )
        if wanted.dtype.kind == "b":
            if len(wanted) != len(self):
                raise IndexError(f"a mask of {counted(len(wanted), 'row')} for a recording of {len(self)}")
            return [int(row) for row in np.flatnonzero(wanted).tolist()]
        beyond = wanted[(wanted < -len(self)) | (wanted >= len(self))]
        if beyond.size:
            raise IndexError(f"row {int(beyond[0])}: the recording has {counted(len(self), 'row')}")
        return [int(row) + len(self) if row < 0 else int(row) for row in wanted.tolist()]

    def __repr__(self) -> str:
        return f"<taceva.Dataset {self.path!r}: {counted(len(self), 'row')} of {self.sensor}, {self.source}>"

    def __reduce__(self) -> tuple[Any, tuple[int, str, str, str | None]]:
        return _arrived, (PICKLE_VERSION, self.path, self.digest, self.view)


def _rows_by_part(parts: list[list[int]], split: str) -> Rows:
    train, validation, test = (np.asarray(part, dtype=np.intp) for part in parts)
    return Rows(train, validation, test, split)


def open(path: str | os.PathLike[str], view: str | None = None) -> Dataset:
    """Open the recording in the folder ``path``, from ``taceva import``, ``run`` or ``capture``.

    If each sample has several pictures, ``view`` selects one (``"left"``) or several side by side (``"left+right"``).

    Raises
    ------
    DatasetError
        For a folder that is not a recording, or was edited after it was sealed.
    """
    return Dataset(path, view)


def _arrived(version: object, path: str = "", digest: str = "", view: str | None = None) -> Dataset:
    require_version(version)
    dataset = Dataset(path, view)
    if dataset.digest != digest:
        raise _taceva.DatasetError(f"{path}: not the pickled recording, its digest differs")
    return dataset
