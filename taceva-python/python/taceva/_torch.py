"""A recording as torch sees it; imported where torch is asked for."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import torch

if TYPE_CHECKING:
    from taceva._dataset import Dataset


class Frames(torch.utils.data.Dataset):  # type: ignore[misc, type-arg, unused-ignore]
    """Frames with labels; each worker opens the recording anew, so any number of workers may read."""

    def __init__(self, dataset: Dataset, rows: list[int]) -> None:
        self._dataset = dataset
        self._rows = rows
        self._labels = dataset.labels().astype(np.float32)

    def __len__(self) -> int:
        return len(self._rows)

    def __getitem__(self, index: int) -> tuple[Any, Any]:
        row = self._rows[index]
        frame = self._dataset.frame(row)
        scale = np.float32(np.iinfo(frame.dtype).max)
        picture = np.ascontiguousarray(frame.transpose(2, 0, 1), dtype=np.float32) / scale
        return torch.from_numpy(picture), torch.from_numpy(self._labels[row].copy())
