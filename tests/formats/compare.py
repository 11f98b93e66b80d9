"""Compares datasets that `cargo run -p taceva-import --example formats -- FILES DATASETS` made with what the packages read of the same files.

    pip install numpy pyarrow pandas tables h5py zarr datasets webdataset mcap rosbags pillow
    python tests/formats/compare.py FILES DATASETS

Every label, time and number of a taxel is compared, and every picture whose source is pixels. Labels must be equal to the last bit, those of
another unit within one unit in the last place, since units are shifted as decimals; times within a microsecond, taxels in single precision.
A folder that was not imported, or that no reader below knows, is named.
"""

import io
import json
import re
import sys
import tomllib
import zipfile
from pathlib import Path

import numpy as np
import pyarrow.parquet as parquet
from PIL import Image

# Lengths are kept in mm, forces in N, torques in N mm, times in s.
PER_UNIT = {"N": 1.0, "mN": 1e-3, "Nm": 1e3, "mm": 1.0, "s": 1.0, "ns": 1e-9, "1": 1.0}


def table(frame):
    """Columns of a data frame of pandas."""

    def column(name):
        values = frame[name]
        if hasattr(values, "dt"):
            values = values.dt
        kind = str(getattr(frame[name], "dtype", ""))
        if kind.startswith("datetime64"):
            return frame[name].astype("datetime64[ns]").astype("int64").to_numpy() / 1e9
        return frame[name].to_numpy()

    return column


def of_arrow(loaded):
    def column(name):
        parts = name.split(".") if name not in loaded.column_names else [name]
        values = loaded[parts[0]].to_pylist()
        for part in parts[1:]:
            values = [value[part] for value in values]
        if hasattr(values[0], "timestamp"):
            import datetime

            return np.array([value.replace(tzinfo=datetime.timezone.utc).timestamp() for value in values])
        return np.array(values)

    return column


def hugging_face(path):
    import datasets

    whole = path.name == "saved"
    loaded = datasets.load_from_disk(str(path)) if whole else datasets.Dataset.from_parquet(str(path))
    plain = of_arrow(loaded.data.table)
    return plain, lambda: [np.asarray(image) for image in loaded["image"]]


def robomimic(path):
    import h5py

    def column(name):
        with h5py.File(path) as file:
            demos = sorted(file["data"], key=lambda demo: int(demo.split("_")[1]))
            return np.concatenate([file["data"][demo][name][()] for demo in demos])

    return column, None


def hdf5(path):
    import h5py

    def column(name):
        with h5py.File(path) as file:
            return file[name][()]

    return column, lambda: list(column("/frames"))


def lerobot(path):
    files = sorted(path.glob("data/**/*.parquet"))
    import pyarrow

    loaded = pyarrow.concat_tables([parquet.read_table(file) for file in files])
    pictures = [name for name in loaded.column_names if name.startswith("observation.images")]
    shown = None
    if pictures:
        shown = lambda: [np.asarray(Image.open(io.BytesIO(cell["bytes"]))) for cell in loaded[pictures[0]].to_pylist()]
    return of_arrow(loaded), shown


def pandas_hdf(path):
    import pandas

    frame = pandas.read_hdf(path)
    return lambda name: np.array(frame[["Fz"]]) if name == "values_block_0" else None, None


def pandas_parquet(path):
    import pandas

    frame = pandas.read_parquet(path / "run.parquet")
    return table(frame), lambda: [np.asarray(Image.open(path / name)) for name in frame["file"]]


def text(path):
    import pandas

    frame = pandas.read_csv(path, comment="#")
    return table(frame), None


def pictures_and_table(path):
    import pandas

    (file,) = path.glob("*.csv")
    frame = pandas.read_csv(file)
    return table(frame), None


def mcap_json(path):
    from mcap.reader import make_reader

    with open(path, "rb") as stream:
        messages = [json.loads(message.data) for *_, message in make_reader(stream).iter_messages()]

    def column(name):
        if name == "taxels":
            import base64

            return np.array([np.frombuffer(base64.b64decode(m["taxels"]["data_b64"]), m["taxels"]["dtype"]) for m in messages])
        return np.array([message[name] for message in messages])

    return column, None


def foxglove(path):
    from mcap.reader import make_reader

    with open(path / "run.mcap", "rb") as stream:
        messages = [json.loads(message.data) for _, channel, message in make_reader(stream).iter_messages() if channel.message_encoding == "json"]

    def column(name):
        return np.array([message["force"][name[-1]] for message in messages]) if name.startswith("ft.force") else None

    return column, None


def rosbag2(path):
    from rosbags.highlevel import AnyReader

    topics = {}
    folder = next(entry.parent for entry in path.rglob("metadata.yaml"))
    with AnyReader([folder]) as reader:
        for connection, _, raw in reader.messages():
            topics.setdefault(connection.topic, []).append(reader.deserialize(raw, connection.msgtype))
    forces = next(messages for messages in topics.values() if hasattr(messages[0], "wrench"))
    images = next(messages for messages in topics.values() if hasattr(messages[0], "encoding"))

    def column(name):
        if name == "header.stamp":
            return np.array([message.header.stamp.sec + message.header.stamp.nanosec / 1e9 for message in images])
        part, axis = name.split(".")[-2:]
        return np.array([getattr(getattr(message.wrench, part), axis) for message in forces])

    return column, None


def haptix(path):
    if path.is_dir():
        manifest = json.loads((path / "manifest.json").read_text())
        times = np.array(manifest["sampling"]["timestamps_s"])
        data = np.load(path / "raw/data.npy")
    else:
        import zarr

        # Names repeat in the archive; the last counts, as Python's zipfile takes it.
        with zipfile.ZipFile(path) as archive:
            members = {name: archive.read(name) for name in archive.namelist()}
        unpacked = Path(sys.argv[2]) / "unpacked-haptix.zarr"
        for name, content in members.items():
            (unpacked / name).parent.mkdir(parents=True, exist_ok=True)
            (unpacked / name).write_bytes(content)
        data, times = zarr.open(str(unpacked), mode="r")["raw/data"][:], None
    return lambda name: times if name == "times.value" else data, None


def webdataset(path):
    import webdataset

    shards = sorted(str(file) for file in path.glob("*.tar"))
    samples = list(webdataset.WebDataset(shards, shardshuffle=False).decode("rgb8"))
    picture = next(name for name, value in samples[0].items() if getattr(value, "ndim", 0) == 3)

    def column(name):
        field, _, member = name.partition("/")
        values = [sample[field] for sample in samples]
        return np.array([value[member] if member else value for value in values])

    return column, lambda: [sample[picture] for sample in samples]


def zarr_store(path):
    import zarr

    store = zarr.open(str(next(path.glob("*.zarr"))), mode="r")
    return lambda name: store[name][:], lambda: list(store["frames"][:])


def json_lines(path):
    lines = [json.loads(line) for line in (path / "run.jsonl").read_text().splitlines()]
    return lambda name: np.array([line[name.strip("/")] for line in lines]), None


def json_frames(path):
    frames = json.loads(path.read_text())["frames"]

    def column(name):
        def at(value):
            for step in name.strip("/").split("/"):
                value = value and (value[int(step)] if isinstance(value, list) else value[step])
            return np.nan if value is None else value

        return np.array([at(frame) for frame in frames], dtype=float)

    return column, None


def npz(path):
    loaded = np.load(path / "run.npz")
    return lambda name: loaded[name], None


READERS = [
    ("datasets520/*", hugging_face),
    ("forge020-src/demo.hdf5", robomimic),
    ("foxglove0303", foxglove),
    ("fulai105", json_lines),
    ("h5py316/*", hdf5),
    ("haptix020/*", haptix),
    ("lerobot061-*", lerobot),
    ("nbtouch010", npz),
    ("pandas311/run.h5", pandas_hdf),
    ("pandas311", pandas_parquet),
    ("paxini010/*", text),
    ("paxini-camera010", pictures_and_table),
    ("rosbags0119-mcap", rosbag2),
    ("tacstack010/*", mcap_json),
    ("tacstack010-lerobot", lerobot),
    ("tlabel0233/run.csv", text),
    ("tlabel0233/run.h5", hdf5),
    ("tlabel0233/run.json", json_frames),
    ("tlabel0233/lerobot", lerobot),
    ("webdataset102", webdataset),
    ("zarr342", zarr_store),
]


def picked(column, name):
    """Value of the source for a name of a map, perhaps an index within a cell."""
    found = None
    try:
        found = column(name)
    except (KeyError, ValueError, TypeError, IndexError):
        pass
    place = re.fullmatch(r"(.*)\[(\d+)\]", name)
    if found is None and place:
        found = picked(column, place[1])
        found = None if found is None else found[:, int(place[2])]
    return found


# Clips alone, whose frames no package decodes to the pixels of their source.
CLIPS = ["imageio2381"]


def compared(source, dataset):
    """Counts equal numbers and pictures; raises at the first difference."""
    reader = next((reader for pattern, reader in READERS if re.fullmatch(pattern.replace("*", "[^/]*"), source)), None)
    if reader is None:
        raise LookupError("no reader here knows it")
    column, pictures = reader(Path(sys.argv[1]) / source)
    header = tomllib.loads((dataset / "dataset.toml").read_text())
    samples = parquet.read_table(dataset / "samples.parquet")
    rows = np.array(samples["source_row"].to_pylist()) if "source_row" in samples.column_names else np.arange(samples.num_rows)
    tables = samples["source_table"].to_pylist() if "source_table" in samples.column_names else []
    if len(set(tables)) > 1 or len(set(rows)) < len(rows):
        rows = np.arange(samples.num_rows)
    numbers = images = 0
    left = []
    for mapped in header["columns"]:
        names, label = mapped["from"], mapped["label"]
        if any(name.startswith("…") for name in names):
            import pandas

            names = [name for name in pandas.read_csv(Path(sys.argv[1]) / source, nrows=0).columns if "-NxN-" in name]
        found = [picked(column, name) for name in names]
        if any(values is None for values in found):
            left.append(label)
            continue
        expected = found[0] if len(found) == 1 else np.stack(found, axis=1)
        if expected.dtype.kind not in "fiub":
            left.append(label)
            continue
        expected = expected[rows].astype(float) * PER_UNIT[mapped["unit"]] * mapped.get("sign", 1)
        expected = expected * (mapped.get("factors") or [1.0])[0]
        if label == "signals":
            kept = parquet.read_table(dataset / "signals.parquet")
            own = np.stack([kept[name].to_numpy() for name in kept.column_names if name.startswith("taxel")], axis=1)
            expected = expected.reshape(len(rows), -1)
            close = np.sort(own, axis=1), np.sort(expected.astype(np.float32), axis=1)
            if own.shape == expected.shape and np.array_equal(own, expected.astype(np.float32)):
                close = own, expected.astype(np.float32)
            np.testing.assert_allclose(*close, rtol=2e-7)
        else:
            own = samples[label].to_numpy().astype(float)
            if label == "t_s":
                own, expected = own - own[0], expected - expected[0]
            is_kept = PER_UNIT[mapped["unit"]] == 1 and "factors" not in mapped
            last_place = 0 if is_kept else np.finfo(float).eps
            is_time = label == "t_s"
            np.testing.assert_allclose(own, expected, rtol=1e-9 if is_time else last_place, atol=1e-6 if is_time else 0)
        numbers += expected.size
    if pictures is not None and "frame" in samples.column_names:
        shown = pictures()
        for row, name in zip(rows, samples["frame"].to_pylist()):
            own = np.asarray(Image.open(dataset / name))
            assert np.array_equal(own, np.squeeze(shown[row])), f"{name} differs"
            images += 1
    return numbers, images, left


def main():
    packages = json.loads((Path(__file__).parents[2] / "crates/recordings/import/examples/formats/packages.json").read_text())
    totals = [0, 0, 0]
    failed = []
    for source in (package["path"] for package in packages):
        dataset = Path(sys.argv[2]) / source.replace("/", "-") / "dataset"
        if not dataset.is_dir():
            print(f"{source}: not imported")
            continue
        if source in CLIPS:
            print(f"{source}: clips alone are not compared")
            continue
        try:
            numbers, images, left = compared(source, dataset)
        except Exception as problem:  # noqa: BLE001 a package may raise anything
            failed.append(source)
            print(f"{source}: DIFFERS or was not read: {type(problem).__name__} {str(problem).strip()[:300]}")
            continue
        not_compared = f"; not compared: {' '.join(left)}" if left else ""
        print(f"{source}: {numbers} numbers and {images} pictures are equal{not_compared}")
        totals = [totals[0] + 1, totals[1] + numbers, totals[2] + images]
    print(f"{totals[0]} compared: {totals[1]} numbers and {totals[2]} pictures are equal; {len(failed)} not: {' '.join(failed)}")
    return int(bool(failed))


if __name__ == "__main__":
    sys.exit(main())
