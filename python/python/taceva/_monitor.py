"""Monitor of a sensor in use."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Any

from taceva import _taceva
from taceva._dataset import Dataset
from taceva._record import pixels


@dataclass(frozen=True)
class Alarm:
    """A change that a `Monitor` found. Its text is the line that ``taceva watch`` prints."""

    #: ``reference``, ``brightness``, ``pattern``, ``detail``, ``lines``, ``repeats`` or ``contact``.
    change: str
    #: Number of the picture, from 1, among all untouched pictures, or among all pictures of contact.
    picture: int
    #: Change relative to the change by contact; for ``repeats`` and ``contact``, the share of the newest 30 pictures.
    strength: float
    #: What to do.
    remedy: str
    text: str

    def __str__(self) -> str:
        return self.text


class Monitor:
    """Find changes of a sensor while it works: lost light, a moved camera, blur, wear, repeated pictures.

    The mean of the first 50 untouched pictures is the baseline, and the next 200 set the limits. From then on each kind of change raises one
    alarm. After the remedy of a change, begin with a new monitor.

    Parameters
    ----------
    calibration
        Recording of the calibration, with a reference picture and presses: an open recording or its folder.
    model
        Fitted model file; pictures of contact are then compared with its training pictures.

    Raises
    ------
    ValueError
        For a recording without a reference or contact.

    >>> import numpy as np
    >>> import taceva
    >>> noise = np.random.default_rng(0).integers(0, 3, size=(280, 8, 8), dtype=np.uint8)
    >>> monitor = taceva.Monitor.of_reference(100 + noise[0], contact=10 / 255)
    >>> [alarm for picture in noise[:250] for alarm in monitor.untouched(100 + picture)]
    []
    >>> [alarm.change for picture in noise[250:] for alarm in monitor.untouched(110 + picture)]
    ['brightness']
    """

    def __init__(self, calibration: Dataset | str | os.PathLike[str], model: str | os.PathLike[str] | None = None) -> None:
        dataset = calibration if isinstance(calibration, Dataset) else Dataset(calibration)
        self._inner = _taceva.PictureMonitor(dataset._inner, None if model is None else os.fspath(model))

    @classmethod
    def of_reference(cls, reference: Any, contact: float) -> Monitor:
        """Return a monitor with an untouched picture instead of a recording.

        Parameters
        ----------
        reference
            ``[height, width]`` (gray) or ``[height, width, 3]``, uint8 or uint16.
        contact
            Mean absolute change of pictures by contact, a share of full scale.
        """
        monitor = cls.__new__(cls)
        monitor._inner = _taceva.PictureMonitor.of_reference(pixels(reference, 2), contact)
        return monitor

    def untouched(self, frame: Any) -> list[Alarm]:
        """Take the next picture without contact, and return the changes that it shows for the first time."""
        return [Alarm(*parts) for parts in self._inner.untouched(pixels(frame, 2))]

    def touched(self, frame: Any) -> list[Alarm]:
        """Take the next picture of contact, and return the change that it shows for the first time."""
        return [Alarm(*parts) for parts in self._inner.touched(pixels(frame, 2))]

    @property
    def missing(self) -> int:
        """Number of untouched pictures until changes are found."""
        return self._inner.missing()

    @property
    def smallest(self) -> dict[str, float] | None:
        """Least change that is found, relative to the change by contact; ``None`` while pictures are missing."""
        found = self._inner.smallest()
        return None if found is None else dict(zip(("brightness", "pattern", "detail", "lines"), found, strict=True))

    @property
    def found(self) -> tuple[str, ...]:
        """Names of the changes found so far."""
        return tuple(self._inner.found())
