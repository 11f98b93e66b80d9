"""Bags written by `rosbags` 0.11.9, and their contents. Run: python3 make.py (needs rosbags==0.11.9, numpy)."""
import json, shutil, sqlite3, tempfile
from pathlib import Path

import numpy as np
from rosbags.rosbag1 import Writer as Writer1
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer as Writer2
from rosbags.typesys import Stores, get_typestore, get_types_from_msg

HERE = Path(__file__).parent
PRESS = "std_msgs/Header header\nfloat64 depth\nstring tool\nbool[2] flags"


def store(of):
    known = get_typestore(of)
    known.register(get_types_from_msg(PRESS, "lab_msgs/msg/Press"))
    return known


def messages(known, is_ros_1):
    t = known.types
    header = lambda k, at: t["std_msgs/msg/Header"](
        stamp=t["builtin_interfaces/msg/Time"](sec=at // 10**9, nanosec=at % 10**9), frame_id="gel",
        **({"seq": k} if is_ros_1 else {}))
    vector = t["geometry_msgs/msg/Vector3"]
    for k in range(4):
        at = 1_700_000_000_000_000_000 + k * 40_000_000
        pixels = np.full((36, 40, 3), k * 3, np.uint8)
        pixels[5:10, k:k + 6] = (10, 120, 230)
        yield "/gel/image", "sensor_msgs/msg/Image", at + 3_000_000, t["sensor_msgs/msg/Image"](
            header(k, at), 36, 40, "bgr8", 0, 120, pixels.reshape(-1))
        for half in (0, 1):
            stamp = at + half * 20_000_000
            yield "/ft", "geometry_msgs/msg/WrenchStamped", stamp + 1_000_000, t["geometry_msgs/msg/WrenchStamped"](
                header(k, stamp), t["geometry_msgs/msg/Wrench"](
                    vector(0.25 * k, -0.5, 1.5 * k + half), vector(0.0625 * (k + 1), 0.125, 0.01 * k)))
        yield "/press", "lab_msgs/msg/Press", at + 2_000_000, t["lab_msgs/msg/Press"](
            header(k, at), 0.1 * k, f"ball {k}", np.array([k % 2 == 0, True]))


def database(name, version, **options):
    known = store(Stores.ROS2_JAZZY)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "bag"
        writer = Writer2(path, version=version, storage_plugin=StoragePlugin.SQLITE3)
        for key, value in options.items():
            getattr(writer, key)(*value)
        with writer:
            there = {}
            for topic, kind, at, message in messages(known, False):
                if topic not in there:
                    there[topic] = writer.add_connection(topic, kind, typestore=known)
                writer.write(there[topic], at, known.serialize_cdr(message, kind))
        [file] = path.glob("*.db3*")
        shutil.copy(file, HERE / name)


def bag(name, compression=None):
    known = store(Stores.ROS1_NOETIC)
    (HERE / name).unlink(missing_ok=True)
    writer = Writer1(HERE / name)
    if compression:
        writer.set_compression(compression)
    with writer:
        there = {}
        for topic, kind, at, message in messages(known, True):
            if topic not in there:
                there[topic] = writer.add_connection(topic, kind, typestore=known)
            writer.write(there[topic], at, known.serialize_ros1(message, kind))


database("iron.db3", 9)
database("messages.db3", 9, set_compression=(CompressionMode.MESSAGE, CompressionFormat.ZSTD))
(HERE / "small_pages.db3").unlink(missing_ok=True)
connection = sqlite3.connect(HERE / "iron.db3")
connection.execute("PRAGMA page_size = 512")
connection.execute("VACUUM INTO ?", (str(HERE / "small_pages.db3"),))
connection.close()
# Schema 3 of rosbag2 in ROS 2 Humble, without definitions of messages.
(HERE / "humble.db3").unlink(missing_ok=True)
connection = sqlite3.connect(HERE / "humble.db3")
connection.executescript("""
CREATE TABLE schema(schema_version INTEGER PRIMARY KEY,ros_distro TEXT NOT NULL);
CREATE TABLE metadata(id INTEGER PRIMARY KEY,metadata_version INTEGER NOT NULL,metadata TEXT NOT NULL);
CREATE TABLE topics(id INTEGER PRIMARY KEY,name TEXT NOT NULL,type TEXT NOT NULL,serialization_format TEXT NOT NULL,offered_qos_profiles TEXT NOT NULL);
CREATE TABLE messages(id INTEGER PRIMARY KEY,topic_id INTEGER NOT NULL,timestamp INTEGER NOT NULL, data BLOB NOT NULL);
CREATE INDEX timestamp_idx ON messages (timestamp ASC);
INSERT INTO schema VALUES(3, 'humble');
""")
connection.execute("ATTACH ? AS iron", (str(HERE / "iron.db3"),))
connection.execute("INSERT INTO topics SELECT id, name, type, serialization_format, '' FROM iron.topics")
connection.execute("INSERT INTO messages SELECT * FROM iron.messages")
connection.commit()
connection.close()
bag("none.bag")
bag("lz4.bag", Writer1.CompressionFormat.LZ4)
bag("bz2.bag", Writer1.CompressionFormat.BZ2)
for path in sorted(HERE.iterdir()):
    print(path.name, path.stat().st_size)
