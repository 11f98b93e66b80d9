"""Writes the small files that are not shared recordings with pyarrow, and the values that pyarrow reads back as JSON.

    python make.py [KIND ...]      kinds: nested arrow plain times mcap lerobot

pyarrow 26, numpy, mcap 1.6, mcap-ros2-support 0.6, pillow. Numbers come from closed formulas."""
import datetime, decimal, json, sys
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

HERE = Path(__file__).parent


def plain(value):
    """Converts a value for the Rust test: bytes as hexadecimal digits, times as integers, NaN as a text."""
    if isinstance(value, dict):
        return {k: plain(v) for k, v in value.items()}
    if isinstance(value, list):
        return [plain(v) for v in value]
    if isinstance(value, tuple):  # entry of a map
        return {"key": plain(value[0]), "value": plain(value[1])}
    if isinstance(value, bytes):
        return value.hex()
    if isinstance(value, float) and value != value:
        return "NaN"
    if isinstance(value, decimal.Decimal):
        return float(value)
    return value


def nested():
    """Writes nulls, empty lists and structures at every depth, in every encoding of pyarrow, with several pages per group."""
    rows = 700
    some = lambda k, value: None if k % 7 == 3 else value
    deep = pa.list_(pa.list_(pa.struct([("a", pa.list_(pa.int32())), ("b", pa.string())])))
    columns = {
        "deep": pa.array([some(k, [some(k + i, [some(k + i + j, {"a": some(k + j, [i, j, None][: k % 4]), "b": some(k + i, f"é{k}")}) for j in range(i % 3)]) for i in range(k % 5)]) for k in range(rows)], deep),
        "flag": pa.array([some(k, k % 3 == 0) for k in range(rows)]),
        "small": pa.array([some(k, k % 256 - 128) for k in range(rows)], pa.int8()),
        "unsigned": pa.array([some(k, 2**64 - 1 - k) for k in range(rows)], pa.uint64()),
        "unsigned32": pa.array([some(k, 2**32 - 1 - k) for k in range(rows)], pa.uint32()),
        "half": pa.array(np.array([k / 8 for k in range(rows)], np.float16)),
        "single": pa.array([some(k, 0.1 * k) for k in range(rows)], pa.float32()),
        "double": pa.array([float("nan") if k == 5 else 1 / (k + 1) for k in range(rows)]),
        "money": pa.array([some(k, decimal.Decimal(k) / 100) for k in range(rows)], pa.decimal128(12, 2)),
        "text": pa.array([some(k, "gel" * (k % 4)) for k in range(rows)]),
        "kind": pa.array([some(k, ["cube", "ball"][k % 2]) for k in range(rows)]).dictionary_encode(),
        "bytes": pa.array([some(k, bytes([k % 256]) * (k % 5)) for k in range(rows)]),
        "fixed": pa.array([bytes([k % 256, 0xFF, 0]) for k in range(rows)], pa.binary(3)),
        "map": pa.array([some(k, [(f"k{i}", some(i + k, float(i))) for i in range(k % 3)]) for k in range(rows)], pa.map_(pa.string(), pa.float64())),
        "stamp": pa.array([some(k, 1_700_000_000_000_000_000 + k) for k in range(rows)], pa.timestamp("ns")),
        "matrix": pa.array([[[k, k + 0.5], [1.0, None]] for k in range(rows)], pa.list_(pa.list_(pa.float64(), 2), 2)),
        "odd.name[0]": pa.array(range(rows), pa.int64()),
    }
    table = pa.table(columns)
    read = {name: plain(column.to_pylist()) for name, column in columns.items() if name != "stamp"}
    read["stamp"] = columns["stamp"].cast(pa.int64()).to_pylist()
    read["kind"] = columns["kind"].cast(pa.string()).to_pylist()
    folder = HERE / "nested"
    folder.mkdir(exist_ok=True)
    how = {
        "snappy": dict(compression="snappy", data_page_version="1.0"),
        "plain": dict(compression="none", use_dictionary=False, write_page_checksum=True, data_page_version="2.0"),
        "delta": dict(compression="zstd", use_dictionary=False, write_page_checksum=True, data_page_version="2.0", column_encoding={
            "small": "DELTA_BINARY_PACKED", "unsigned": "DELTA_BINARY_PACKED", "text": "DELTA_BYTE_ARRAY", "bytes": "DELTA_LENGTH_BYTE_ARRAY",
            "single": "BYTE_STREAM_SPLIT", "double": "BYTE_STREAM_SPLIT", "odd.name[0]": "DELTA_BINARY_PACKED"}),
        "old": dict(compression="gzip", version="1.0", use_deprecated_int96_timestamps=True, use_compliant_nested_type=False),
    }
    for name, options in how.items():
        pq.write_table(table, folder / f"{name}.parquet", row_group_size=300, data_page_size=600, write_statistics=name == "snappy", **options)
        assert pq.read_table(folder / f"{name}.parquet").num_rows == rows
    keep = [0, 3, 5, 8, 17, 24, 299, 300, 511, 699]
    (folder / "expected.json").write_text(json.dumps({str(k): {name: column[k] for name, column in read.items()} for k in keep}, indent=1, ensure_ascii=False) + "\n")


def arrow():
    """Writes the first rows of `nested` and columns of types that Parquet lacks, as a stream and as files with a footer. Writes the documentation example."""
    rows = 300
    table = pq.read_table(HERE / "nested" / "plain.parquet").slice(0, rows)
    table = table.set_column(table.schema.get_field_index("kind"), "kind", table["kind"].cast(pa.string()))
    some = lambda k, value: None if k % 5 == 2 else value
    more = {
        "wide.text": pa.array([some(k, "é" * (k % 3)) for k in range(rows)], pa.large_string()),
        "wide.bytes": pa.array([some(k, bytes([k % 256]) * (k % 4)) for k in range(rows)], pa.large_binary()),
        "wide.list": pa.array([some(k, list(range(k % 4))) for k in range(rows)], pa.large_list(pa.int16())),
        "nothing": pa.nulls(rows),
        "date": pa.array([some(k, k) for k in range(rows)], pa.int32()).cast(pa.date32()),
        "time": pa.array([some(k, k) for k in range(rows)], pa.time64("us")),
        "lasts": pa.array([some(k, k) for k in range(rows)], pa.duration("ms")),
        "seconds": pa.array([some(k, k) for k in range(rows)], pa.timestamp("s")),
        "half.list": pa.array([some(k, [k / 8, None]) for k in range(rows)], pa.list_(pa.float16(), 2)),
    }
    for name, column in more.items(): table = table.append_column(name, column)
    folder = HERE / "arrow"; folder.mkdir(exist_ok=True)
    def write(path, form, table, **options):
        with form(path, table.schema, options=pa.ipc.IpcWriteOptions(**options)) as sink:
            for batch in table.to_batches(max_chunksize=130): sink.write_batch(batch)
    write(folder / "stream.arrow", pa.ipc.new_stream, table)
    write(folder / "zstd.arrow", pa.ipc.new_file, table, compression="zstd")
    write(folder / "lz4.feather", pa.ipc.new_file, table, compression="lz4")
    for name, column in (("dictionary", pa.array(["a", "b"]).dictionary_encode()), ("view", pa.array(["a"], pa.string_view())), ("union", pa.UnionArray.from_sparse(pa.array([0], pa.int8()), [pa.array([1])]))):
        write(folder / f"{name}.arrow", pa.ipc.new_stream, pa.table({"Fz": pa.array([1.0] * len(column)), "odd": column}))
    picture = pa.struct([("bytes", pa.binary()), ("path", pa.string())])
    presses = pa.table({"t": [0.0, 0.5], "ft": pa.array([[0.0, 0.25, 2.0], [0.5, 0.25, 3.5]], pa.list_(pa.float32())), "image": pa.array([{"bytes": b"\x89PNG", "path": "0.png"}, None], picture)})
    write(HERE.parents[1] / "examples" / "presses.arrow", pa.ipc.new_stream, presses)


def plain():
    """Writes cells of bytes in plain pages of both versions and every codec, with nulls at both depths."""
    rows = 90
    cell = lambda k: None if k % 6 == 4 else {"bytes": None if k % 10 == 7 else bytes((k * i) % 251 for i in range(k * 7 % 400)) + bytes([k]) * (k % 50)}
    table = pa.table({"image": pa.array([cell(k) for k in range(rows)], pa.struct([("bytes", pa.binary())])), "raw": pa.array([bytes([k, 255 - k]) * k for k in range(rows)], pa.binary()), "row": list(range(rows))},
                     schema=pa.schema([("image", pa.struct([("bytes", pa.binary())])), pa.field("raw", pa.binary(), nullable=False), ("row", pa.int64())]))
    folder = HERE / "plain"
    folder.mkdir(exist_ok=True)
    for codec in ["none", "snappy", "gzip", "brotli", "lz4", "zstd"]:
        for version in ["1.0", "2.0"]:
            pq.write_table(table, folder / f"{codec}-{version[0]}.parquet", compression=codec, data_page_version=version, use_dictionary=False, row_group_size=50, data_page_size=1500, write_batch_size=8,
                           write_statistics=False, write_page_checksum=codec in ("none", "gzip"), store_schema=False)


def times():
    """Writes every time type of pyarrow, and the seconds of each value as exact decimals."""
    counts = [-1, 0, 1, 86_399, None, 1_700_000_000]
    per = {"s": 1, "ms": 10**3, "us": 10**6, "ns": 10**9}
    def seconds(count, unit):
        if count is None:
            return None
        text = format(decimal.Decimal(count) / per[unit], "f")
        return text.rstrip("0").rstrip(".") if "." in text else text

    columns, read = {}, {}
    for unit in per:
        own = [None if c is None else c * per[unit] + (c % per[unit]) // 2 for c in counts]
        for name, kind in [("stamp", pa.timestamp(unit)), ("zoned", pa.timestamp(unit, "+02:00")), ("duration", pa.duration(unit))]:
            columns[f"{name}_{unit}"] = pa.array(own, pa.int64()).cast(kind)
            read[f"{name}_{unit}"] = [seconds(c, unit) for c in own]
        day = [None if c is None else (c * per[unit] + 1) % (86_400 * per[unit]) for c in counts]
        width, kind = (pa.int32(), pa.time32(unit)) if unit in ("s", "ms") else (pa.int64(), pa.time64(unit))
        columns[f"time_{unit}"] = pa.array(day, width).cast(kind)
        read[f"time_{unit}"] = [seconds(c, unit) for c in day]
    days = [-1, 0, 1, 2, None, 19_675]
    columns["date32"] = pa.array(days, pa.int32()).cast(pa.date32())
    columns["date64"] = pa.array([None if d is None else d * 86_400_000 for d in days], pa.int64()).cast(pa.date64())
    read["date32"] = read["date64"] = [None if d is None else str(d * 86_400) for d in days]
    columns["nested"] = pa.array([{"at": [1500, None], "n": 7}] * 6, pa.struct([("at", pa.list_(pa.duration("ms"))), ("n", pa.int64())]))
    read["nested.at"] = ["[1.5, null]"] * 6
    columns["count"] = pa.array(counts, pa.int64())
    read["count"] = [None if c is None else str(c) for c in counts]
    columns["Fz"] = pa.array([0.5 * k for k in range(6)])
    table = pa.table(columns)
    folder = HERE / "times"
    folder.mkdir(exist_ok=True)
    pq.write_table(table, folder / "times.parquet", compression="snappy", write_statistics=False)
    pq.write_table(table, folder / "old.parquet", compression="snappy", write_statistics=False, version="1.0", use_deprecated_int96_timestamps=True)
    for name in ("times", "old"):
        back = pq.read_table(folder / f"{name}.parquet")
        for column in columns:
            if column.startswith(("stamp", "zoned")):
                assert [None if v is None else v.value for v in back[column].cast(pa.timestamp("ns", back[column].type.tz))] == [None if v is None else int(decimal.Decimal(v) * 10**9) for v in read[column]], column
    (folder / "expected.json").write_text(json.dumps(read, indent=1) + "\n")


HEADER = "std_msgs/Header header\n"
DEFINED = """
================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
"""
VECTOR = "================================================================================\nMSG: geometry_msgs/Vector3\nfloat64 x\nfloat64 y\nfloat64 z\n"
SCHEMAS = {
    "sensor_msgs/msg/Image": HEADER + "uint32 height\nuint32 width\nstring encoding\nuint8 is_bigendian\nuint32 step\nuint8[] data" + DEFINED,
    "geometry_msgs/msg/WrenchStamped": HEADER + "geometry_msgs/Wrench wrench" + DEFINED + "================================================================================\nMSG: geometry_msgs/Wrench\nVector3 force\nVector3 torque\n" + VECTOR,
    "sensor_msgs/msg/JointState": HEADER + "string[] name\nfloat64[] position\nfloat64[] velocity\nfloat64[] effort" + DEFINED,
    "geometry_msgs/msg/PoseStamped": HEADER + "Pose pose" + DEFINED + "================================================================================\nMSG: geometry_msgs/Pose\nPoint position\nQuaternion orientation\n================================================================================\nMSG: geometry_msgs/Point\nfloat64 x\nfloat64 y\nfloat64 z\n================================================================================\nMSG: geometry_msgs/Quaternion\nfloat64 x 0\nfloat64 y 0\nfloat64 z 0\nfloat64 w 1\n",
    "std_msgs/msg/Float64MultiArray": "MultiArrayLayout layout\nfloat64[] data\n================================================================================\nMSG: std_msgs/MultiArrayLayout\nMultiArrayDimension[] dim\nuint32 data_offset\n================================================================================\nMSG: std_msgs/MultiArrayDimension\nstring label\nuint32 size\nuint32 stride\n",
    "taxels_msgs/msg/Taxels": "uint8 FIRST=1\nbool is_touched\nint8 a\nuint16 b\nint64 c\nfloat32 d\nuint8[4] raw\nfloat32[<=3] some\nstring[2] names\nTaxel[] taxels\nduration_msgs/Empty nothing\nuint64 last\n================================================================================\nMSG: taxels_msgs/Taxel\nint16 place\nfloat64 value\n================================================================================\nMSG: duration_msgs/Empty\n",
}


def stamp(ns):
    return {"stamp": {"sec": ns // 10**9, "nanosec": ns % 10**9}, "frame_id": "gel"}


def messages(k):
    """Messages at tick k, every 100 ms."""
    ns = 1_700_000_000_000_000_000 + k * 100_000_007
    v = lambda a: dict(zip("xyz", a))
    yield "/pose", "geometry_msgs/msg/PoseStamped", ns, {"header": stamp(ns), "pose": {"position": v([0.1 * k, -0.5, 1e-12]), "orientation": {**v([0.0, 0.0, 0.1]), "w": 0.9}}}
    yield "/joints", "sensor_msgs/msg/JointState", ns, {"header": stamp(ns), "name": ["a", "joint_b"], "position": [0.5 * k, 1 / 3], "velocity": [], "effort": [float(k)]}
    yield "/array", "std_msgs/msg/Float64MultiArray", ns, {"layout": {"dim": [{"label": "row" * (k % 3), "size": 2, "stride": 4}], "data_offset": 0}, "data": [k + 0.25 * i for i in range(k % 4)]}
    yield "/taxels", "taxels_msgs/msg/Taxels", ns - 250_000_000 * (k % 2), {"is_touched": k % 2 == 0, "a": -k, "b": 60_000 + k, "c": -(2**40) * k, "d": 0.1 * k, "raw": [k, 1, 2, 255], "some": [0.5] * (k % 4), "names": ["x" * k, ""], "taxels": [{"place": -i, "value": i / 7} for i in range(k % 3)], "nothing": {}, "last": 2**63 + k}
    if k % 4 == 0:
        width, height = 5, 3
        a = (np.arange(height * width) * 1000 + k).astype("<u2").reshape(height, width)
        padded = np.concatenate([a.view("u1"), np.full((height, 2), 0xEE, "u1")], 1)
        yield "/depth", "sensor_msgs/msg/Image", ns, {"header": stamp(ns), "height": height, "width": width, "encoding": "mono16", "is_bigendian": 0, "step": 2 * width + 2, "data": padded.tobytes()}


def attributes(value):
    """Message of the peer as JSON."""
    if hasattr(value, "__slots__"):
        return {name: attributes(getattr(value, name)) for name in value.__slots__}
    if isinstance(value, (list, tuple)) or type(value).__module__ == "numpy":
        return [attributes(v) for v in value]
    if isinstance(value, (bytes, bytearray, memoryview)):
        return list(bytes(value))
    return value


def mcap():
    from mcap.reader import make_reader
    from mcap.writer import CompressionType, IndexType, Writer
    from mcap_ros2._dynamic import generate_dynamic, serialize_dynamic
    from mcap_ros2.reader import read_ros2_messages

    folder = HERE / "mcap"
    folder.mkdir(exist_ok=True)

    def write(path, of=messages, ticks=12, **options):
        with open(path, "wb") as file:
            writer = Writer(file, **{"compression": CompressionType.NONE, "chunk_size": 3000, **options})
            writer.start("ros2", "drawn")
            schemas, channels, encoders = {}, {}, {}
            for k in range(ticks):
                for topic, kind, ns, message in of(k):
                    if kind not in schemas:
                        schemas[kind] = writer.register_schema(kind, "ros2msg", SCHEMAS[kind].encode())
                        encoders[kind] = serialize_dynamic(kind, SCHEMAS[kind])[kind]
                    if topic not in channels:
                        channels[topic] = writer.register_channel(topic, "cdr", schemas[kind])
                    writer.add_message(channels[topic], ns, encoders[kind](message), ns + 5)
            if of is messages:
                schema = writer.register_schema("Note", "jsonschema", b"{}")
                channel = writer.register_channel("/notes", "json", schema)
                for k in range(3):
                    writer.add_message(channel, 10**9 * k, json.dumps({"object": {"name": f"cube{k}"}, "grip": [k, 0.5]}).encode(), 10**9 * k)
            writer.finish()

    write(folder / "chunks.mcap", compression=CompressionType.LZ4, enable_data_crcs=True)
    write(folder / "loose.mcap", use_chunking=False, enable_data_crcs=True)
    write(folder / "no_index.mcap", compression=CompressionType.ZSTD, index_types=IndexType.NONE)
    write(folder / "no_summary.mcap", index_types=IndexType.NONE, use_statistics=False, use_summary_offsets=False, repeat_channels=False, repeat_schemas=False)
    read = {}
    for m in read_ros2_messages(str(folder / "chunks.mcap"), topics=["/pose", "/joints", "/array", "/taxels", "/depth"]):
        read.setdefault(m.channel.topic, []).append({"log_time.ns": m.log_time_ns, "publish_time.ns": m.publish_time_ns, "message": attributes(m.ros_msg)})
    (folder / "expected.json").write_text(json.dumps(read, indent=0) + "\n")

    def presses(k):
        ns = 1_700_000_000_000_000_000 + k * 500_000_000
        v = lambda a: dict(zip("xyz", a))
        yield "/ft/wrench", "geometry_msgs/msg/WrenchStamped", ns, {"header": stamp(ns), "wrench": {"force": v([0.0, 0.0, [2.0, 3.5, 1.25][k]]), "torque": v([0.0, 0.0, 0.0])}}
        if k == 0:
            yield "/tactile/image_raw", "sensor_msgs/msg/Image", ns, {"header": stamp(ns), "height": 3, "width": 4, "encoding": "rgb8", "is_bigendian": 0, "step": 12, "data": bytes(range(36))}

    write(HERE.parent.parent / "examples" / "presses.mcap", of=presses, ticks=3, chunk_size=1 << 20)


def picture(value):
    import io

    from PIL import Image

    file = io.BytesIO()
    Image.new("RGB", (4, 3), (value, 2 * value, 3 * value)).save(file, "PNG")
    return file.getvalue()


def lerobot():
    """Writes LeRobot folders of the documented layout: 2.1 with one file per episode, 3.0 with several files of data, videos and descriptions."""
    import shutil

    fps = 10

    def info(folder, version, rows, data, video, extra):
        features = {"observation.state": {"dtype": "float32", "shape": [2], "names": ["Fx", "Fz"]}, **extra}
        for name, dtype in [("timestamp", "float32"), ("frame_index", "int64"), ("episode_index", "int64"), ("index", "int64"), ("task_index", "int64")]:
            features[name] = {"dtype": dtype, "shape": [1], "names": None}
        (folder / "meta").mkdir(parents=True)
        (folder / "meta/info.json").write_text(json.dumps({"codebase_version": version, "robot_type": "none", "total_episodes": len(rows), "total_frames": sum(rows), "total_tasks": 2, "chunks_size": 2, "fps": fps, "splits": {"train": f"0:{len(rows)}"}, "data_path": data, "video_path": video, "features": features}, indent=1) + "\n")

    def table(episode, count, begin, states, with_picture):
        columns = {"observation.state": pa.array(states, pa.list_(pa.float32()))}
        if with_picture:
            columns["observation.images.tip"] = pa.array([{"bytes": picture(10 * episode + k), "path": f"frame-{k:06d}.png"} for k in range(count)])
        columns |= {
            "timestamp": pa.array([k / fps for k in range(count)], pa.float32()),
            "frame_index": pa.array(range(count), pa.int64()),
            "episode_index": pa.array([episode] * count, pa.int64()),
            "index": pa.array(range(begin, begin + count), pa.int64()),
            "task_index": pa.array([episode % 2] * count, pa.int64()),
        }
        return pa.table(columns)

    def state(episode, count):
        return [[0.1 * (k + 1), episode + 0.25 * k] for k in range(count)]

    def lines(path, rows):
        path.write_text("".join(json.dumps(row) + "\n" for row in rows))

    v21 = dict(data="data/chunk-{episode_chunk:03d}/episode_{episode_index:06d}.parquet", video="videos/chunk-{episode_chunk:03d}/{video_key}/episode_{episode_index:06d}.mp4")
    video = {"observation.images.gel": {"dtype": "video", "shape": [3, 4, 3], "names": ["height", "width", "channels"], "info": {"video.fps": float(fps), "video.codec": "av1"}}}
    image = {"observation.images.tip": {"dtype": "image", "shape": [3, 4, 3], "names": ["height", "width", "channels"]}}

    def write_v21(folder, rows, states, extra):
        shutil.rmtree(folder, ignore_errors=True)
        info(folder, "v2.1", rows, v21["data"], v21["video"], extra)
        lines(folder / "meta/tasks.jsonl", [{"task_index": k, "task": f"press the {name}"} for k, name in enumerate(["cube", "ball"])])
        lines(folder / "meta/episodes.jsonl", [{"episode_index": e, "tasks": [f"press the {['cube', 'ball'][e % 2]}"], "length": n} for e, n in enumerate(rows)])
        for e, n in enumerate(rows):
            path = folder / v21["data"].format(episode_chunk=e // 2, episode_index=e)
            path.parent.mkdir(parents=True, exist_ok=True)
            pq.write_table(table(e, n, sum(rows[:e]), states(e, n), "observation.images.tip" in extra), path, compression="snappy", write_statistics=False)

    write_v21(HERE / "lerobot-v2.1", [3, 2, 4], state, video | image)
    write_v21(HERE.parent.parent / "examples/presses-lerobot", [2, 2], lambda e, n: [[0.0, [2.0, 3.5, 2.5, 1.25][2 * e + k]] for k in range(n)], video)

    folder = HERE / "lerobot-v3-files"
    shutil.rmtree(folder, ignore_errors=True)
    rows = [3, 2, 4, 1, 2]
    data, clip = "data/chunk-{chunk_index:03d}/file-{file_index:03d}.parquet", "videos/{video_key}/chunk-{chunk_index:03d}/file-{file_index:03d}.mp4"
    info(folder, "v3.0", rows, data, clip, video | image)
    # Episodes 0 and 1 in the first file of data, 2 in the second, 3 and 4 in the first of another chunk. The video is split elsewhere.
    of_data, of_video = [(0, 0), (0, 0), (0, 1), (1, 0), (1, 0)], [(0, 0), (0, 1), (0, 1), (0, 1), (1, 0)]
    for place in dict.fromkeys(of_data):
        path = folder / data.format(chunk_index=place[0], file_index=place[1])
        path.parent.mkdir(parents=True, exist_ok=True)
        pq.write_table(pa.concat_tables([table(e, rows[e], sum(rows[:e]), state(e, rows[e]), True) for e in range(5) if of_data[e] == place]), path, write_statistics=False)
    key = "videos/observation.images.gel"
    described = [{"episode_index": e, "tasks": ["press"], "length": rows[e], "data/chunk_index": of_data[e][0], "data/file_index": of_data[e][1], f"{key}/chunk_index": of_video[e][0], f"{key}/file_index": of_video[e][1],
                  f"{key}/from_timestamp": sum(rows[f] for f in range(e) if of_video[f] == of_video[e]) / fps} for e in range(5)]
    for at, part in enumerate([described[:3], described[3:]]):
        path = folder / f"meta/episodes/chunk-000/file-{at:03d}.parquet"
        path.parent.mkdir(parents=True, exist_ok=True)
        pq.write_table(pa.Table.from_pylist(part), path, write_statistics=False)
    pq.write_table(pa.table({"task_index": [0, 1], "__index_level_0__": ["press the cube", "press the ball"]}), folder / "meta/tasks.parquet", write_statistics=False)


if __name__ == "__main__":
    for kind in sys.argv[1:] or ["nested", "arrow", "plain", "times", "mcap", "lerobot"]:
        globals()[kind]()
