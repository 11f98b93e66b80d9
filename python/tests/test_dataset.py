"""Recordings and models, with the same results as the command."""

from __future__ import annotations

import json
import multiprocessing
import pickle
import signal
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest
import taceva
from conftest import RECORDINGS
from conftest import taceva as command

EXAMPLES = Path(__file__).parents[2] / "examples"


def test_labels_frames_and_columns_are_those_of_the_recording(recording: Path) -> None:
    dataset = taceva.open(recording)
    expected = json.loads((RECORDINGS / "names" / "expected.json").read_text())
    assert len(dataset) > 0
    assert dataset.labels().shape == (len(dataset), len(dataset.channels))
    frames = dataset.frames()
    assert frames.shape == (len(dataset), *(dataset.frame_shape or ()))
    assert not frames.flags.writeable
    assert np.array_equal(dataset.frame(1), frames[1])
    assert np.array_equal(np.concatenate(list(dataset.batches(size=3))), frames)
    assert np.array_equal(dataset.frames([2, 0], jobs=2), frames[[2, 0]])
    assert dataset.column("sample")
    assert len(dataset.points()) == len(dataset)
    assert expected


def test_an_array_shares_the_memory_it_was_decoded_into(recording: Path) -> None:
    inner = taceva.open(recording)._inner.frames([0, 1], 1)
    assert np.shares_memory(np.asarray(inner), np.asarray(inner))


def test_rows_that_are_none_are_refused(recording: Path) -> None:
    dataset = taceva.open(recording)
    with pytest.raises(IndexError, match=f"row {len(dataset)}: the recording has {len(dataset)} rows"):
        dataset.frames([len(dataset)])
    with pytest.raises(IndexError, match=f"row -{len(dataset) + 1}: the recording has {len(dataset)} rows"):
        dataset.frame(-len(dataset) - 1)
    with pytest.raises(IndexError, match=f"a mask of 2 rows for a recording of {len(dataset)}"):
        dataset.frames([True, False])
    with pytest.raises(TypeError, match="float64"):
        dataset.frames(np.array([0.5]))
    with pytest.raises(KeyError, match="no column 'colour'"):
        dataset.column("colour")
    with pytest.raises(ValueError, match="split"):
        dataset.split("sideways 80/20")


def test_a_folder_that_is_no_recording_is_refused(tmp_path: Path) -> None:
    with pytest.raises(taceva.DatasetError, match=str(tmp_path)):
        taceva.open(tmp_path)


def test_an_error_names_the_file_and_the_row_that_are_at_fault(tmp_path: Path) -> None:
    labels, frames, points = drawn()
    made = {"sensor": "my gel", "source": "synthetic", "channels": ["Pz", "Fz"]}
    dataset = taceva.from_arrays(tmp_path / "recording", labels, frames, points=points, **made)
    with pytest.raises(taceva.DatasetError) as nothing_there:
        taceva.open(tmp_path / "nothing")
    assert nothing_there.value.path == tmp_path / "nothing"
    assert (nothing_there.value.row, nothing_there.value.line) == (None, None)
    with pytest.raises(taceva.DatasetError) as no_signals:
        dataset.signals()
    assert no_signals.value.path == tmp_path / "recording"
    (pack,) = [path for path in (tmp_path / "recording").rglob("*") if path.is_file() and path.stat().st_size > 5_000]
    content = bytearray(pack.read_bytes())
    content[len(content) // 2] ^= 1
    pack.chmod(0o644)
    pack.write_bytes(content)
    with pytest.raises(taceva.DatasetError) as damaged:
        taceva.open(tmp_path / "recording").frames(jobs=2)
    assert damaged.value.path == pack
    row = damaged.value.row
    assert row is not None and 0 < row < len(labels)
    assert np.array_equal(taceva.open(tmp_path / "recording").frames(range(row)), frames[:row])
    with pytest.raises(taceva.DatasetError):
        taceva.open(tmp_path / "recording").frame(row)
    assert taceva.DatasetError("words alone").path is None


def test_a_recording_travels_and_refuses_to_arrive_as_another(recording: Path) -> None:
    dataset = taceva.open(recording)
    assert pickle.loads(pickle.dumps(dataset)).digest == dataset.digest
    with pytest.raises(taceva.DatasetError, match="not the pickled recording"):
        taceva._dataset._arrived(taceva._pickles.PICKLE_VERSION, str(recording), "sha256:0")
    with multiprocessing.get_context("fork").Pool(2) as pool:
        assert pool.map(len, [dataset, dataset]) == [len(dataset)] * 2


@pytest.mark.parametrize("model", ["ridge", "smartcore/knn"])
def test_an_evaluation_equals_the_command_byte_for_byte(recording: Path, tmp_path: Path, model: str) -> None:
    split = "random 60/0/40"
    out = tmp_path / "scores.json"
    done = command("evaluate", recording, "--model", model, "--split", split, "--seed", "3", "--format", "json", "--out", out)
    assert done.returncode == 0, done.stderr
    result = taceva.evaluate(recording, model, split=split, seed=3)
    assert result.text == out.read_text()
    assert taceva.evaluate(recording, model, split=split, seed=3, jobs=2).text == result.text
    rows = taceva.open(recording).split(split, 3)
    assert result.to_dict()["provenance"]["samples"]["test"] == len(rows.test)


def test_a_model_that_does_not_exist_is_refused_with_the_nearest(recording: Path) -> None:
    with pytest.raises(ValueError, match="ridge"):
        taceva.evaluate(recording, "rigde")


def test_a_check_finds_what_the_command_finds(recording: Path) -> None:
    done = command("check", recording, "--format", "json")
    assert taceva.open(recording).check() == json.loads(done.stdout)


def test_control_c_ends_long_work_at_once(recording: Path) -> None:
    if threading.current_thread() is not threading.main_thread():
        pytest.skip("signals reach the main thread alone")
    interrupt = threading.Timer(0.5, lambda: signal.raise_signal(signal.SIGINT))
    begun = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        interrupt.start()
        settings = {"size": "32x24", "epochs": 100_000, "batch": 8}
        taceva.evaluate(recording, "cnn", split="random 60/0/40", settings=settings)
    # A wide bound: the work must end, however loaded the machine is.
    assert time.monotonic() - begun < 10


def test_the_command_runs_within_python(tmp_path: Path) -> None:
    done = command("--version")
    assert (done.returncode, done.stdout) == (0, f"taceva {taceva.__version__}\n")
    done = command("evaluate", tmp_path, "--model", "ridge")
    assert done.returncode == 3
    assert "dataset.toml" in done.stderr
    assert command("nonsense").returncode == 2


def test_a_torch_dataset_gives_frames_and_labels(recording: Path) -> None:
    torch = pytest.importorskip("torch")
    dataset = taceva.open(recording)
    loader = torch.utils.data.DataLoader(dataset.torch(), batch_size=2, num_workers=2)
    frames, labels = next(iter(loader))
    height, width, samples = dataset.frame_shape or (0, 0, 0)
    assert frames.shape == (2, samples, height, width)
    assert labels.shape == (2, len(dataset.channels))
    assert sys.modules["torch"]


def test_a_torch_dataset_of_taxels_gives_signals_and_labels(tmp_path: Path) -> None:
    torch = pytest.importorskip("torch")
    source = EXAMPLES / "taxels/magnetic"
    done = command("import", source, "--map", source / "map.toml", "--out", tmp_path / "taxels")
    assert done.returncode == 0, done.stderr
    dataset = taceva.open(tmp_path / "taxels")
    rows = [3, 0, 2]
    signals, labels = next(iter(torch.utils.data.DataLoader(dataset.torch(rows), batch_size=3, num_workers=1)))
    assert signals.dtype == torch.float32 and np.array_equal(signals.numpy(), dataset.signals(rows))
    assert np.array_equal(labels.numpy(), dataset.labels()[rows].astype(np.float32))


def test_a_recording_of_labels_alone_is_refused_as_a_torch_dataset_whether_or_not_torch_is_there(tmp_path: Path) -> None:
    dataset = taceva.from_arrays(tmp_path / "labels", np.ones((3, 1)), sensor="plate", source="synthetic", channels=["Fz"])
    with pytest.raises(taceva.DatasetError, match="neither frames nor signals") as refused:
        dataset.torch()
    assert refused.value.path == tmp_path / "labels"


def drawn(rows: int = 24) -> tuple[np.ndarray, np.ndarray, list[str]]:
    """Frames whose brightness follows the force, with labels and points, from a fixed seed."""
    generator = np.random.default_rng(5)
    labels = generator.uniform(size=(rows, 2))
    pixels = generator.integers(0, 40, size=(rows, 12, 16, 3))
    frames = (pixels + 200 * labels[:, 1, None, None, None]).astype(np.uint8)
    return labels, frames, [f"point {row // 4}" for row in range(rows)]


@pytest.mark.parametrize("kind", ["rgb8", "gray8", "gray16", "none"])
def test_arrays_become_a_recording_that_gives_them_back(tmp_path: Path, kind: str) -> None:
    labels, frames, points = drawn()
    labels[3, 0] = np.nan
    forms = {"rgb8": frames, "gray8": frames[..., 0], "gray16": frames[..., 0].astype(">u2") * 256, "none": None}
    written = forms[kind]
    path = tmp_path / "recording"
    dataset = taceva.from_arrays(
        path,
        labels,
        written,
        sensor="my gel",
        source="synthetic",
        channels=["Pz", "Fz"],
        points=points,
        times=np.arange(len(labels)) / 30,
        reference=None if written is None else written[0],
        footprint_mm=(16.0, 12.0),
    )
    assert np.array_equal(dataset.labels(), labels, equal_nan=True)
    assert dataset.points() == points
    assert (dataset.sensor, dataset.source, dataset.units) == ("my gel", "synthetic", {"Pz": "mm", "Fz": "N"})
    assert float(dataset.column("t_s")[30 % len(labels)] or "nan") == pytest.approx((30 % len(labels)) / 30)
    if written is not None:
        expected = written if written.ndim == 4 else written[..., None]
        assert np.array_equal(dataset.frames(), expected)
        reference = dataset.reference()
        assert reference is not None and np.array_equal(reference, expected[0])
    # Width and height are given; their halves are stored.
    header = (path / "dataset.toml").read_text()
    assert "half_x_mm = 8.0" in header and "half_y_mm = 6.0" in header, header
    with pytest.raises(taceva.DatasetError):
        taceva.from_arrays(path, labels, sensor="my gel", source="synthetic", channels=["Pz", "Fz"])


def test_arrays_of_other_forms_are_refused_before_anything_is_written(tmp_path: Path) -> None:
    labels, frames, points = drawn()
    path = tmp_path / "recording"
    made = {"sensor": "my gel", "source": "synthetic", "channels": ["Pz", "Fz"]}
    with pytest.raises(ValueError, match="frames has 3 rows, labels has 24"):
        taceva.from_arrays(path, labels, frames[:3], **made)
    with pytest.raises(TypeError, match="float64"):
        taceva.from_arrays(path, labels, frames / 255, **made)
    with pytest.raises(ValueError, match="2 samples per pixel"):
        taceva.from_arrays(path, labels, frames[..., :2], **made)
    with pytest.raises(ValueError, match="expected recorded, simulated or synthetic"):
        taceva.from_arrays(path, labels, frames, **{**made, "source": "invented"})
    with pytest.raises(ValueError, match="infinite"):
        taceva.from_arrays(path, np.full((24, 2), np.inf), frames, **made)
    with pytest.raises(ValueError, match="points has 2 rows"):
        taceva.from_arrays(path, labels, frames, points=points[:2], **made)
    assert not path.exists()


def test_an_imported_folder_is_what_the_command_imports(recording: Path, tmp_path: Path) -> None:
    source = RECORDINGS / "names"
    dataset = taceva.import_recording(source, source / "map.toml", tmp_path / "out")
    assert dataset.digest == taceva.open(recording).digest
    with pytest.raises(taceva.DatasetError):
        taceva.import_recording(source, source / "map.toml", tmp_path / "out")
    again = taceva.import_recording(source, source / "map.toml", tmp_path / "out", replace=True)
    assert again.digest == dataset.digest
