"""Reads an export by the libraries that it is for, and prints what it holds as one line of JSON behind `= `.

Numbers are texts, in the shortest form that reads back, so that no reader of JSON rounds them; what is absent is null.
"""

import csv
import hashlib
import io
import json
import math
import pathlib
import sys

form, folder = sys.argv[1], pathlib.Path(sys.argv[2])


def text(value):
    if value is None or isinstance(value, str):
        return value or None
    if isinstance(value, float):
        return None if math.isnan(value) else repr(value)
    return str(value)


def digest(array):
    return hashlib.sha256(array.tobytes()).hexdigest()


def of_image(image):
    import numpy

    return None if image is None else digest(numpy.asarray(image))


def of_csv():
    from PIL import Image

    with open(folder / "labels.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    columns = {name: [row[name] or None for row in rows] for name in rows[0]}
    taxels = [name for name in columns if name.startswith("taxel_")]
    pictures = [of_image(Image.open(folder / row["frame"])) for row in rows] if "frame" in columns else []
    signals = [[row[name] for name in taxels] for row in rows]
    return columns, pictures, signals


def of_huggingface():
    import datasets

    rows = datasets.load_dataset(str(folder), split="train")
    image = next((name for name, of in rows.features.items() if isinstance(of, datasets.Image)), None)
    taxels = [name for name in rows.features if name.startswith("signals") and rows.features[name] != datasets.Value("string")]
    plain = rows.remove_columns([image] if image else [])
    columns = {name: [text(value) for value in plain[name]] for name in plain.features if name not in taxels}
    pictures = [of_image(row[image]) for row in rows] if image else []
    signals = [[repr(value) for value in row] for name in taxels for row in plain[name]]
    return columns, pictures, signals


def of_hdf5():
    import h5py

    with h5py.File(folder / "recording.h5", "r") as file:
        assert file.attrs["source"] in ("recorded", "simulated", "synthetic"), file.attrs["source"]
        columns, pictures, signals = {}, [], []
        for name, array in file.items():
            if array.ndim == 1 and h5py.check_string_dtype(array.dtype):
                columns[name] = [value or None for value in array.asstr()[:]]
            elif array.ndim == 1:
                columns[name] = [text(value) for value in array[:].tolist()]
                columns[name + "@unit"] = [str(array.attrs.get("unit", ""))]
            elif "colours" in array.attrs:
                pictures = [digest(array[row]) for row in range(len(array))]
            else:
                signals = [[repr(value) for value in row.ravel().tolist()] for row in array[:]]
    return columns, pictures, signals


def of_layout():
    """LeRobot by its documented layout."""
    import datasets
    import pandas
    import pyarrow.parquet as pq

    info = json.loads((folder / "meta/info.json").read_text())
    assert info["codebase_version"] == "v3.0" and info["total_frames"] > 0, info
    paths = sorted(str(path) for path in (folder / "data").glob("*/*.parquet"))
    rows = datasets.Dataset.from_parquet(paths, cache_dir=str(folder) + "-cache")
    assert set(rows.features) == set(info["features"]), rows.features
    assert rows["index"][:] == list(range(info["total_frames"]))
    episodes = pq.read_table(sorted((folder / "meta/episodes").glob("*/*.parquet"))[0]).to_pylist()
    assert len(episodes) == info["total_episodes"]
    tasks = pandas.read_parquet(folder / "meta/tasks.parquet")
    for episode in episodes:
        first, end = episode["dataset_from_index"], episode["dataset_to_index"]
        assert end - first == episode["length"] > 0
        assert set(rows[first:end]["episode_index"]) == {episode["episode_index"]}
        assert rows[first:end]["frame_index"] == list(range(end - first))
        named = {tasks.iloc[index].name for index in rows[first:end]["task_index"]}
        assert named == set(episode["tasks"]), (named, episode)
    stats = json.loads((folder / "meta/stats.json").read_text())
    assert stats["index"]["max"] == [info["total_frames"] - 1] and stats["index"]["count"] == [info["total_frames"]]
    return lerobot_rows(info, rows, lambda image: of_image(image))


def lerobot_rows(info, rows, of_picture):
    columns, pictures, signals = {}, [], []
    for name, feature in info["features"].items():
        values = [row[name] for row in rows] if feature["dtype"] == "image" else rows[name]
        if feature["dtype"] == "image":
            pictures = [of_picture(value) for value in values]
        elif name == "observation.state":
            for position, channel in enumerate(feature["names"]):
                several = len(feature["names"]) > 1
                columns[channel] = [text(float(row[position] if several else row)) for row in values]
        elif name == "observation.tactile":
            signals = [[repr(float(value)) for value in row] for row in values]
        elif feature["dtype"] == "string":
            columns[name] = [text(value) for value in values]
        else:
            columns[name] = [text(value.item() if hasattr(value, "item") else value) for value in values]
    columns["@episodes"] = [str(info["total_episodes"])]
    return columns, pictures, signals


def of_lerobot():
    """LeRobot by its own package, which gives numbers in single precision."""
    import numpy
    from lerobot.datasets.lerobot_dataset import LeRobotDataset

    dataset = LeRobotDataset("local/exported", root=folder)
    items = [dataset[row] for row in range(len(dataset))]
    assert len({item["task"] for item in items}) == dataset.meta.total_tasks
    shape = lambda name: dataset.meta.stats[name]["mean"].shape
    assert all(shape(name) == (len(of["names"]), 1, 1) or len(shape(name)) == 3 for name, of in dataset.meta.features.items() if of["dtype"] == "image")

    def of_picture(tensor):
        array = (tensor.numpy() * 255).round().astype(numpy.uint8)
        array = array[0] if len(array) == 1 else array.transpose(1, 2, 0)
        return digest(numpy.ascontiguousarray(array))

    class Rows:
        def __iter__(self):
            return iter(items)

        def __getitem__(self, name):
            return [item[name] for item in items]

    return lerobot_rows(dataset.meta.info, Rows(), of_picture)


columns, pictures, signals = globals()["of_" + form]()
out = json.dumps({"columns": columns, "pictures": pictures, "signals": signals})
io.open(sys.stdout.fileno(), "w", encoding="utf-8", closefd=False).write("= " + out + "\n")
