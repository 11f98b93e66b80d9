"""Monitor of a sensor in use: frames in, alarms out."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
import taceva

CONTACT = 10 / 255


def pictures(count: int, light: int, seed: int) -> npt.NDArray[np.uint8]:
    """Draw untouched pictures with a little noise."""
    noise = np.random.default_rng(seed).integers(0, 3, size=(count, 8, 8))
    return (light + noise).astype(np.uint8)


def learnt() -> taceva.Monitor:
    """Return a monitor that knows its limits."""
    monitor = taceva.Monitor.of_reference(pictures(1, 100, 0)[0], CONTACT)
    assert monitor.missing == 250 and monitor.smallest is None
    for picture in pictures(250, 100, 1):
        assert monitor.untouched(picture) == []
    return monitor


def test_a_change_of_light_raises_one_alarm_with_its_remedy() -> None:
    monitor = learnt()
    assert monitor.missing == 0
    smallest = monitor.smallest
    assert smallest is not None and set(smallest) == {"brightness", "pattern", "detail", "lines"}
    alarms = [alarm for picture in pictures(30, 112, 2) for alarm in monitor.untouched(picture)]
    assert [alarm.change for alarm in alarms] == ["brightness"]
    assert 250 < alarms[0].picture <= 280
    assert alarms[0].remedy in str(alarms[0])
    assert monitor.found == ("brightness",)


def test_unchanged_pictures_raise_none() -> None:
    monitor = learnt()
    assert [alarm for picture in pictures(60, 100, 3) for alarm in monitor.untouched(picture)] == []


def test_a_picture_of_another_size_or_type_is_refused() -> None:
    monitor = learnt()
    with pytest.raises(ValueError, match="expected"):
        monitor.untouched(np.zeros((8, 9), np.uint8))
    with pytest.raises(TypeError, match="uint8 or uint16"):
        monitor.untouched(np.zeros((8, 8)))
    with pytest.raises(ValueError, match="above 0"):
        taceva.Monitor.of_reference(np.zeros((8, 8), np.uint8), 0.0)


def test_a_recording_of_a_calibration_gives_reference_and_contact(tmp_path: Path) -> None:
    labels = np.linspace(0.2, 2.0, 40)[:, np.newaxis]
    frames = (100 + 20 * labels[:, :, np.newaxis] * np.ones((40, 8, 8))).astype(np.uint8)
    rest = np.full((8, 8), 100, np.uint8)
    recording: dict[str, Any] = {"sensor": "drawn", "source": "synthetic", "channels": ["Fz"], "points": [str(row) for row in range(40)]}
    taceva.from_arrays(tmp_path / "plain", labels, frames, **recording)
    with pytest.raises(ValueError, match="no reference"):
        taceva.Monitor(tmp_path / "plain")
    dataset = taceva.from_arrays(tmp_path / "monday", labels, frames, reference=rest, **recording)
    monitor = taceva.Monitor(dataset)
    assert monitor.untouched(rest) == [] and monitor.missing == 249
    assert taceva.Monitor(str(tmp_path / "monday")).touched(frames[0]) == []
