"""Progress bars: shown only where visible, without effect on a result."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
import taceva


@pytest.fixture
def drawn(tmp_path: Path) -> Iterator[taceva.Dataset]:
    labels = np.random.default_rng(1).uniform(size=(40, 1))
    frames = (200 * labels[:, :, None] + np.arange(8)).astype(np.uint8).repeat(6, axis=1)
    yield taceva.from_arrays(tmp_path / "recording", labels, frames, sensor="drawn gel", source="synthetic", channels=["Fz"])
    taceva.progress(None)


def test_a_bar_names_the_stage_and_leaves_when_it_is_over(drawn: taceva.Dataset, capfd: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("tqdm")
    capfd.readouterr()
    taceva.progress(True)
    taceva.evaluate(drawn, lambda frames: np.zeros((len(frames), 1)), batch=10)
    assert "predict:" in capfd.readouterr().err
    drawn.frames()
    shown = capfd.readouterr().err
    assert shown.endswith("\r")
    taceva.progress(False)
    drawn.frames()
    assert capfd.readouterr().err == ""
    taceva.progress(None)
    drawn.frames()
    assert capfd.readouterr().err == "", "standard error is no terminal here"


def test_a_bar_is_closed_where_a_model_fails(drawn: taceva.Dataset, capfd: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("tqdm")
    taceva.progress(True)
    with pytest.raises(ZeroDivisionError):
        taceva.evaluate(drawn, lambda frames: 1 / 0)
    assert capfd.readouterr().err.endswith("\r")


def test_without_tqdm_nothing_is_shown_and_nothing_fails(drawn: taceva.Dataset, capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "tqdm.auto", None)
    capfd.readouterr()
    taceva.progress(True)
    assert len(drawn.frames()) == 40
    assert capfd.readouterr().err == ""
