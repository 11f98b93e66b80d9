"""A recording as a torch dataset; imported only for torch."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import torch

if TYPE_CHECKING:
    import numpy.typing as npt

    from taceva._dataset import Dataset


class Labelled(torch.utils.data.Dataset):  # type: ignore[misc, type-arg, unused-ignore]
    """Frames or signals of each row, with labels. Each worker reopens the recording, so any number of workers may read."""

    def __init__(self, dataset: Dataset, rows: list[int]) -> None:
        self._dataset = dataset
        self._rows = rows
        self._labels = dataset.labels().astype(np.float32)

    def _seen(self, row: int) -> npt.NDArray[np.float32]:
        raise NotImplementedError

    def __len__(self) -> int:
        return len(self._rows)

    def __getitem__(self, index: int) -> tuple[Any, Any]:
        row = self._rows[index]
        return torch.from_numpy(self._seen(row)), torch.from_numpy(self._labels[row].copy())


class Frames(Labelled):
    """Frames, ``[samples, height, width]`` from 0 to 1."""

    def _seen(self, row: int) -> npt.NDArray[np.float32]:
        frame = self._dataset.frame(row)
        scale = np.float32(np.iinfo(frame.dtype).max)
        return np.ascontiguousarray(frame.transpose(2, 0, 1), dtype=np.float32) / scale


class Signals(Labelled):
    """Signals of taxels, ``[values]`` in the unit of the recording."""

    def _seen(self, row: int) -> npt.NDArray[np.float32]:
        return np.array(self._dataset.signals([row])[0])
