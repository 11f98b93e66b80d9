"""Table of a recording for readers of Arrow, for pandas and for Hugging Face, with units."""

from __future__ import annotations

import gc
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import taceva
from conftest import taceva as command


def made(path: Path, rows: int = 40) -> taceva.Dataset:
    """A recording with missing labels, contact points, times and frames, from a fixed seed."""
    generator = np.random.default_rng(3)
    labels = generator.uniform(size=(rows, 2))
    labels[3, 0] = np.nan
    frames = generator.integers(0, 255, size=(rows, 6, 8, 3), dtype=np.uint8)
    return taceva.from_arrays(
        path / "recording",
        labels,
        frames,
        sensor="drawn gel",
        source="synthetic",
        channels=["Pz", "Fz"],
        points=[f"point {row // 4}, µ" for row in range(rows)],
        times=np.arange(rows) / 30,
    )


def test_pyarrow_reads_the_table_with_units_and_absent_labels_as_null(tmp_path: Path) -> None:
    pyarrow = pytest.importorskip("pyarrow")
    dataset = made(tmp_path)
    table = pyarrow.table(dataset)
    table.validate(full=True)
    assert table.num_rows == len(dataset)
    assert table.column("sample").to_pylist() == dataset.column("sample")
    assert table.column("point_id").to_pylist() == dataset.points()
    assert table.column("t_s").to_pylist() == pytest.approx((np.arange(40) / 30).tolist())
    for at, channel in enumerate(dataset.channels):
        expected = [None if np.isnan(label) else label for label in dataset.labels()[:, at].tolist()]
        assert table.column(channel).to_pylist() == expected
        assert table.schema.field(channel).metadata == {b"unit": dataset.units[channel].encode()}
    assert table.column("Pz").null_count == 1
    assert table.schema.field("t_s").metadata == {b"unit": b"s"}
    said = table.schema.metadata
    assert said[b"taceva.sensor"] == b"drawn gel"
    assert said[b"taceva.source"] == b"synthetic"
    assert said[b"taceva.digest"] == dataset.digest.encode()
    assert table.column("frame_sha256").null_count == 0


def test_a_stream_is_read_once_outlives_the_recording_and_may_be_left_unread(tmp_path: Path) -> None:
    pyarrow = pytest.importorskip("pyarrow")
    dataset = made(tmp_path)
    capsule = dataset.__arrow_c_stream__()

    class Once:
        def __arrow_c_stream__(self, requested_schema: object = None) -> object:
            return capsule

    reader = pyarrow.RecordBatchReader.from_stream(Once())
    names, expected = reader.schema.names, dataset.labels()[:, 1].tolist()
    del dataset
    gc.collect()
    batches = list(reader)
    assert [batch.num_rows for batch in batches] == [40]
    assert batches[0].column(names.index("Fz")).to_pylist() == expected
    # One column outlives the others and the batch.
    column = batches[0].column(names.index("Fz"))
    del batches, reader
    gc.collect()
    assert column.to_pylist() == expected
    with pytest.raises(ValueError):
        pyarrow.RecordBatchReader.from_stream(Once())
    unread = taceva.open(tmp_path / "recording").__arrow_c_stream__()
    del unread
    gc.collect()


def test_many_streams_leave_no_memory_behind(tmp_path: Path) -> None:
    pyarrow = pytest.importorskip("pyarrow")
    dataset = made(tmp_path, 2000)

    def resident() -> int:
        return int(Path("/proc/self/statm").read_text().split()[1]) * 4096

    def read(times: int) -> None:
        for _ in range(times):
            pyarrow.table(dataset)
            dataset.__arrow_c_stream__()
        gc.collect()

    read(20)
    before = resident()
    # A table of 2,000 rows is about 0.4 MB, so a leak of two hundred tables would be 80 MB or more.
    read(200)
    assert resident() - before < 30_000_000


def test_pandas_reads_the_table_with_units(tmp_path: Path) -> None:
    pytest.importorskip("pandas")
    dataset = made(tmp_path)
    frame = dataset.to_pandas()
    assert frame.attrs == {"units": {"Pz": "mm", "Fz": "N", "t_s": "s"}, "source": "synthetic", "sensor": "drawn gel"}
    assert np.array_equal(frame[["Pz", "Fz"]].to_numpy(), dataset.labels(), equal_nan=True)
    assert list(frame["point_id"]) == dataset.points()
    assert frame["t_s"].dtype == np.float64


def test_hugging_face_reads_pictures_labels_and_units_and_keeps_them_on_disk(tmp_path: Path, monkeypatch: Any) -> None:
    pytest.importorskip("PIL")
    monkeypatch.setenv("HF_HUB_OFFLINE", "1")
    datasets = pytest.importorskip("datasets")
    datasets.disable_progress_bars()
    dataset = made(tmp_path)
    exported = dataset.to_huggingface(tmp_path / "exported")
    assert exported.num_rows == len(dataset)
    assert isinstance(exported.features["image"], datasets.Image)
    assert np.array_equal(np.asarray(exported[5]["image"]), dataset.frame(5))
    assert exported["Fz"][:] == dataset.labels()[:, 1].tolist()
    exported.save_to_disk(tmp_path / "saved")
    said = json.loads(datasets.load_from_disk(tmp_path / "saved").info.description)
    assert said == {
        "sensor": "drawn gel",
        "source": "synthetic",
        "digest": dataset.digest,
        "units": {"t_s": "s", "Pz": "mm", "Fz": "N"},
    }
    parquet = pytest.importorskip("pyarrow.parquet")
    (file,) = (tmp_path / "exported").glob("data/*.parquet")
    assert parquet.read_schema(file).metadata[b"unit.Fz"] == b"N"


def test_an_export_comes_back_the_same(tmp_path: Path) -> None:
    dataset = made(tmp_path)
    for form in ("csv", "huggingface", "hdf5"):
        assert isinstance(dataset.export(tmp_path / form, form), list)
        again = taceva.import_recording(tmp_path / form, tmp_path / form / "map.toml", tmp_path / f"{form} again")
        assert np.array_equal(again.labels(), dataset.labels(), equal_nan=True)
        assert np.array_equal(again.frames(), dataset.frames())
    with pytest.raises(taceva.DatasetError):
        dataset.export(tmp_path / "csv", "csv")
    with pytest.raises(ValueError, match="expected csv, huggingface, hdf5, lerobot"):
        dataset.export(tmp_path / "other", "xlsx")


def test_labels_of_tasks_are_columns_with_names_of_classes_and_numbers_of_poses(tmp_path: Path) -> None:
    pyarrow = pytest.importorskip("pyarrow")
    lab = tmp_path / "lab"
    lab.mkdir()
    (lab / "t.csv").write_text("stroke,slip,x,y,z,qx,qy,qz,qw,map\na,1,0.5,0,0,0,0,0,1,a.npy\nb,,,,,,,,,\n")
    np.save(lab / "a.npy", np.zeros((2, 3)))
    (lab / "map.toml").write_text(
        'map_version = 2\ntable = "t.csv"\n[ids]\npoint_id = "stroke"\n[time]\nclock = "unknown"\n'
        '[task.slip]\nkind = "event"\nfrom = "slip"\nnames = ["no_slip", "slip"]\npositive = "slip"\n'
        '[task.moved]\nkind = "pose"\nunit = "mm"\nfrom = { t = ["x", "y", "z"], q = ["qx", "qy", "qz", "qw"] }\n'
        '[task.touched]\nkind = "place"\nunit = "mm"\nfrom = { t = ["x", "y", "z"] }\n'
        '[task.shape]\nkind = "depth"\nunit = "mm"\nfrom = "map"\n'
        '[sensor]\nmodel = "drawn gel"\nserial = "unknown"\ngel = "unknown"\nopaque = true\n'
    )
    out = tmp_path / "recording"
    done = command("import", lab, "--map", lab / "map.toml", "--out", out)
    assert done.returncode == 0, done.stderr
    table = pyarrow.table(taceva.open(out))
    assert table.column("task.touched.x").to_pylist() == [0.5, None]
    digest, absent = table.column("task.shape.sha256").to_pylist()
    assert digest.startswith("sha256:")
    assert absent is None
    assert table.column("task.slip").to_pylist() == ["slip", None]
    assert table.column("task.moved.x").to_pylist() == [0.5, None]
    assert table.column("task.moved.qw").to_pylist() == [1.0, None]
