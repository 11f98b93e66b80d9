"""Recordings on disk."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from taceva import _taceva
from taceva._bar import bar
from taceva._settings import setting_words

IntArray = npt.NDArray[np.intp]


@dataclass(frozen=True)
class Rows:
    """Rows of a recording by part, from 0, as ``taceva evaluate`` divides them."""

    train: IntArray
    validation: IntArray
    test: IntArray
    #: How the rows were divided, in the words of ``--split``.
    split: str


class Dataset:
    """A recording: labels of every sample, and frames or signals.

    It is pickled as its path and its digest; unpickling raises `DatasetError` where the recording at that path is another.
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self._inner = _taceva.Recording(os.fspath(path))

    @property
    def path(self) -> str:
        """The folder."""
        return str(self._inner.path())

    @property
    def digest(self) -> str:
        """The digest of all that the recording says."""
        return self._inner.digest()

    @property
    def sensor(self) -> str:
        """The sensor model."""
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
        """Height, width and samples a pixel of frames; ``None`` without frames."""
        return self._inner.frame_shape()

    def __len__(self) -> int:
        return self._inner.rows()

    def labels(self) -> npt.NDArray[np.float64]:
        """Return ``[rows, channels]``, read-only; NaN where a label is absent."""
        return np.asarray(self._inner.labels())

    def points(self) -> list[str | None]:
        """Return the contact point of each row."""
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
        """Return ``[height, width, samples]`` of one row."""
        found: npt.NDArray[Any] = self.frames([row], jobs=1)[0]
        return found

    def frames(self, rows: Sequence[int] | IntArray | None = None, *, jobs: int = 0) -> npt.NDArray[Any]:
        """Return ``[rows, height, width, samples]`` of some rows, in their order, or of all: uint8 or uint16, read-only, decoded on ``jobs`` threads.

        Raises
        ------
        DatasetError
            For a row without a frame, or a frame that is damaged.
        """
        return np.asarray(self._inner.frames(self._rows(rows), jobs, bar()))

    def batches(self, rows: Sequence[int] | IntArray | None = None, *, size: int = 64, jobs: int = 0) -> Iterator[npt.NDArray[Any]]:
        """Yield frames of at most ``size`` rows after each other; no more than one batch is in memory."""
        if size < 1:
            raise ValueError(f"size {size}: expected at least 1")
        wanted = self._rows(rows)
        for first in range(0, len(wanted), size):
            yield np.asarray(self._inner.frames(wanted[first : first + size], jobs, None))

    def reference(self) -> npt.NDArray[Any] | None:
        """Return the picture of the untouched gel, if the recording has one."""
        found = self._inner.reference()
        return None if found is None else np.asarray(found)[0]

    def features(
        self,
        rows: Sequence[int] | IntArray | None = None,
        *,
        settings: Mapping[str, Any] | None = None,
        jobs: int = 0,
    ) -> npt.NDArray[np.float32]:
        """Return ``[rows, values]``: what a model by name sees of frames, or of signals, 32×32 gray where nothing is asked for.

        ``settings`` are those of ``--set``: ``{"size": "16x16", "color": "rgb", "difference": "true"}``.
        """
        words = setting_words(settings)
        found, _, _ = _taceva.features(self._inner, words, self._rows(rows), jobs, bar())
        return np.asarray(found)

    def signals(self, rows: Sequence[int] | IntArray | None = None) -> npt.NDArray[np.float32]:
        """Return ``[rows, values]`` of the signals of some rows, taxel by taxel, read-only."""
        return np.asarray(self._inner.signals(self._rows(rows)))

    def split(self, split: str | None = None, seed: int = 0) -> Rows:
        """Divide the rows as ``taceva evaluate --split`` does: ``by-point 70/15/15``, ``random 80/0/20``, ``chronological 90/0/10`` and others."""
        parts, name = self._inner.split(split, seed)
        train, validation, test = (np.asarray(part, dtype=np.intp) for part in parts)
        return Rows(train, validation, test, name)

    def check(self, *, jobs: int = 0) -> dict[str, Any]:
        """Return what ``taceva check --format json`` finds: what spoils the recording or what a reader should know."""
        return dict(json.loads(self._inner.check(jobs, bar())))

    def to_frame(self) -> Any:
        """Return the labels as a ``pandas.DataFrame`` with points and units; ``attrs["units"]`` holds units by channel."""
        import pandas

        frame = pandas.DataFrame(np.array(self.labels()), columns=list(self.channels))
        frame.insert(0, "sample", self.column("sample"))
        frame.insert(1, "point_id", self.points())
        frame.attrs["units"] = self.units
        return frame

    def torch(self, rows: Sequence[int] | IntArray | None = None) -> Any:
        """Return a ``torch.utils.data.Dataset`` of ``(frame, labels)``: the frame ``[samples, height, width]`` in float32 from 0 to 1, labels in float32."""
        from taceva._torch import Frames

        return Frames(self, self._rows(rows))

    def _rows(self, rows: Sequence[int] | IntArray | None) -> list[int]:
        if rows is None:
            return list(range(len(self)))
        wanted = np.asarray(rows)
        if wanted.size == 0:
            return []
        if wanted.ndim != 1 or wanted.dtype.kind not in "iu":
            raise TypeError(f"rows: expected whole numbers, found an array of {wanted.dtype} of the shape {list(wanted.shape)}")
        beyond = wanted[(wanted < 0) | (wanted >= len(self))]
        if beyond.size:
            raise IndexError(f"row {int(beyond[0])} of a recording of {len(self)}")
        return [int(row) for row in wanted.tolist()]

    def __repr__(self) -> str:
        return f"<taceva.Dataset {self.path!r}: {len(self)} rows of {self.sensor}, {self.source}>"

    def __reduce__(self) -> tuple[Any, tuple[str, str]]:
        return _arrived, (self.path, self.digest)


def open(path: str | os.PathLike[str]) -> Dataset:
    """Open the recording in the folder ``path``, which ``taceva import``, ``run`` or ``capture`` wrote.

    Raises
    ------
    DatasetError
        For a folder that is no recording, or one that was changed after it was sealed.
    """
    return Dataset(path)


def _arrived(path: str, digest: str) -> Dataset:
    dataset = Dataset(path)
    if dataset.digest != digest:
        raise _taceva.DatasetError(f"{path}: another recording than the one that was sent, its digest differs")
    return dataset
