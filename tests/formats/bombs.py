"""Files of at most 1 MB that become far more once they are unpacked, made anew in a folder, and what an import and a draft of each take.

    python tests/formats/bombs.py TACEVA [FOLDER]

Prints a line a file and command: bytes of the file, exit code, seconds of processor time, peak memory in MB, what was said. The exit code is 1 if one
took more than 300 MB or 20 s. Needs numpy, h5py, zarr 3, pyarrow, mcap and lz4.
"""

import bz2
import gzip
import io
import json
import os
import sqlite3
import struct
import subprocess
import sys
import tarfile
import tempfile
import zlib

# The measuring process stays small: the memory of its children is counted from its own.
if "--make" in sys.argv:
    import h5py
    import lz4.frame
    import numpy as np
    import pyarrow as pa
    import pyarrow.parquet as pq
    import zarr
    from mcap.writer import Writer

MOST_MB, MOST_S, MOST_BYTES = 300, 20, 1_000_000
ENDS = '[time]\nclock = "unknown"\n[sensor]\nmodel = "m"\nserial = "unknown"\ngel = "unknown"\nopaque = "unknown"\n'
FRAMES = '[frame]\narray = "{}"\nchannel_order = "gray"\nreference = "unknown"\n'
FZ = '[columns]\nFz = {{ from = "{}", unit = "N" }}\n'
SIDES = (480, 640)


def lab(base, name, table, keys):
    folder = os.path.join(base, name)
    os.makedirs(folder)
    with open(os.path.join(base, name + ".toml"), "w") as file:
        file.write(f"map_version = 2\ntable = {table}\n{keys}{ENDS}")
    return folder


def frames_hdf5(base):
    for name, count, chunk in [("hdf5-planes", 1200, (1200, 8, 640)), ("hdf5-small", 400, (400, 8, 640)), ("hdf5-frames", 900, (1, *SIDES))]:
        folder = lab(base, name, '"run.h5"', FRAMES.format("/frames"))
        with h5py.File(folder + "/run.h5", "w") as file:
            file.create_dataset("frames", (count, *SIDES), "u1", chunks=chunk, compression="gzip", compression_opts=9, data=np.zeros((count, *SIDES), "u1"))
    folder = lab(base, "hdf5-labels", '"run.h5"', FZ.format("/z"))
    with h5py.File(folder + "/run.h5", "w") as file:
        file.create_dataset("z", (60_000_000,), "f8", chunks=(10_000_000,), compression="gzip", compression_opts=9, data=np.zeros(60_000_000))


def frames_numpy(base):
    pictures = np.zeros((900, *SIDES), "u1")
    folder = lab(base, "npz", '"run.npz"', FRAMES.format("images"))
    np.savez_compressed(folder + "/run.npz", images=pictures)
    folder = lab(base, "npz-labels", '"run.npz"', FZ.format("z"))
    np.savez_compressed(folder + "/run.npz", z=np.zeros(60_000_000))
    folder = lab(base, "npy-gz", '"run.npy.gz"', FRAMES.format("run"))
    packed = io.BytesIO()
    np.save(packed, pictures)
    with open(folder + "/run.npy.gz", "wb") as file:
        file.write(gzip.compress(packed.getvalue(), 9))


def stores_zarr(base):
    # The default codec of version 2 packs a little less.
    for version, count in [(2, 750), (3, 900)]:
        folder = lab(base, f"zarr-v{version}", '"run.zarr"', FRAMES.format("frames"))
        group = zarr.open_group(folder + "/run.zarr", mode="w", zarr_format=version)
        array = group.create_array("frames", shape=(count, *SIDES), chunks=(count, 8, 640), dtype="u1", fill_value=1)
        array[:] = 0


def tables(base):
    three = '[columns]\nFx = { from = "a", unit = "N" }\nFy = { from = "b", unit = "N" }\nFz = { from = "c", unit = "N" }\n'
    for name, rows, codec in [("parquet-zstd", 20_000_000, "zstd"), ("parquet-gzip", 2_000_000, "gzip")]:
        folder = lab(base, name, '"run.parquet"', three)
        pq.write_table(pa.table({key: np.zeros(rows) for key in "abc"}), folder + "/run.parquet", compression=codec, row_group_size=rows)
    folder = lab(base, "parquet-texts", '"run.parquet"', FZ.format("a"))
    table = pa.table({"a": np.arange(3000.0), "b": ["x" * 300_000] * 3000})
    pq.write_table(table, folder + "/run.parquet", compression="zstd")


def messages(base):
    folder = lab(base, "mcap", '{ file = "run.mcap", rows = "/a" }', FZ.format("z"))
    with open(folder + "/run.mcap", "wb") as file:
        writer = Writer(file, chunk_size=64 << 20)
        writer.start()
        schema = writer.register_schema("a", "jsonschema", b"{}")
        channel = writer.register_channel("/a", "json", schema)
        for number in range(60):
            writer.add_message(channel, number, json.dumps({"z": 1.0, "pad": " " * 15_000_000}).encode(), number)
        writer.finish()
    for codec, pack in (("lz4", lz4.frame.compress), ("bz2", bz2.compress)):
        folder = lab(base, f"bag-{codec}", '{ file = "run.bag", rows = "/a" }', FZ.format("data"))
        with open(folder + "/run.bag", "wb") as file:
            file.write(bag(codec, pack))


def record(fields, data):
    head = b"".join(struct.pack("<I", len(key) + 1 + len(value)) + key + b"=" + value for key, value in fields.items())
    return struct.pack("<I", len(head)) + head + struct.pack("<I", len(data)) + data


def bag(codec, pack):
    """A closed bag of ROS 1 with chunks of zeros behind one message."""
    words = {b"topic": b"/a", b"type": b"std_msgs/Float64", b"md5sum": b"fdb28210bfa9d7c91146260178d9a584", b"message_definition": b"float64 data\n"}
    own = b"".join(struct.pack("<I", len(key) + 1 + len(value)) + key + b"=" + value for key, value in words.items())
    connection = record({b"op": b"\x07", b"conn": bytes(4), b"topic": b"/a"}, own)
    start = b"#ROSBAG V2.0\n"
    header = 4096 + 13
    chunks, infos = b"", b""
    for number in range(4):
        stamp = struct.pack("<II", number + 1, 0)
        inside = (connection if number == 0 else b"") + record({b"op": b"\x02", b"conn": bytes(4), b"time": stamp}, struct.pack("<d", 1.0))
        inside += record({b"op": b"\x02", b"conn": bytes(4), b"time": stamp}, bytes(60_000_000))
        place = header + len(chunks)
        chunks += record({b"op": b"\x05", b"compression": codec.encode(), b"size": struct.pack("<I", len(inside))}, pack(inside))
        chunks += record({b"op": b"\x04", b"ver": struct.pack("<I", 1), b"conn": bytes(4), b"count": struct.pack("<I", 1)}, stamp + struct.pack("<I", len(connection) if number == 0 else 0))
        infos += record({b"op": b"\x06", b"ver": struct.pack("<I", 1), b"chunk_pos": struct.pack("<Q", place), b"start_time": stamp, b"end_time": stamp, b"count": struct.pack("<I", 1)}, bytes(4) + struct.pack("<I", 1))
    fields = {b"op": b"\x03", b"index_pos": struct.pack("<Q", header + len(chunks)), b"conn_count": struct.pack("<I", 1), b"chunk_count": struct.pack("<I", 4)}
    first = record(fields, b"")
    first = record(fields, b" " * (4096 - len(first)))
    return start + first + chunks + connection + infos


ROSBAG2 = """
PRAGMA page_size = {page};
CREATE TABLE schema(schema_version INTEGER PRIMARY KEY, ros_distro TEXT NOT NULL);
CREATE TABLE metadata(id INTEGER PRIMARY KEY, metadata_version INTEGER NOT NULL, metadata TEXT NOT NULL);
CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL);
CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL, data BLOB NOT NULL);
INSERT INTO schema VALUES(3, 'humble');
INSERT INTO topics VALUES(1, '/a', 'std_msgs/msg/Float64', 'cdr', '');
"""


def varint(number):
    groups = [number & 0x7F]
    while number := number >> 7:
        groups.insert(0, number & 0x7F | 0x80)
    return bytes(groups)


def table_page(kind, page, cells, last=b"", places=None):
    """A page of a table of SQLite: its cells from the end on; with `places`, so many that are all the one cell."""
    ends = [page - sum(map(len, cells[: at + 1])) for at in range(len(cells))]
    places = ends if places is None else ends * places
    head = struct.pack(">BHHHB", kind, 0, len(places), ends[-1] % 65536, 0) + last + struct.pack(f">{len(places)}H", *places)
    return head.ljust(ends[-1], b"\0") + b"".join(reversed(cells))


def databases(base):
    """Databases of rosbag2 whose messages all end in the same pages, and whose cells are all the same one."""
    # Of the long message a page holds as little as SQLite ever leaves there.
    for name, page, size in [("db3-chain", 512, 787 * 508 + 20), ("db3-cell", 32768, 21_000)]:
        folder = lab(base, name, '{ file = "run.db3", rows = "/a" }', FZ.format("data"))
        path = folder + "/run.db3"
        database = sqlite3.connect(path)
        database.executescript(ROSBAG2.format(page=page))
        message = bytes([0, 1, 0, 0]) + struct.pack("<d", 1.0) + bytes(size)
        database.execute("INSERT INTO messages VALUES(1, 1, 1, ?)", (message,))
        database.commit()
        root = database.execute("SELECT rootpage FROM sqlite_schema WHERE name = 'messages'").fetchone()[0]
        database.close()
        with open(path, "rb") as file:
            pages = bytearray(file.read())
        at = (root - 1) * page
        # The cell of the message: its length, its number (1), and the bytes in its page.
        cell = bytes(pages[at + struct.unpack_from(">H", pages, at + 8)[0] : at + page])
        row = cell[cell.index(1) + 1 :]
        length = cell[: cell.index(1)]
        room = MOST_BYTES // page - len(pages) // page
        added, children, number = [], [], 1
        for _ in range(room - room // 40 - 2):
            cells, places = [], None
            if name == "db3-cell":
                # As many cells as SQLite accepts in a page.
                cells, places = [length + varint(number) + row], (page - 8) // 6
                number += places
            else:
                while sum(map(len, cells)) + 2 * len(cells) + len(cell) + 16 < page:
                    cells.append(length + varint(number) + row)
                    number += 1
            added.append(table_page(13, page, cells, places=places))
            children.append((len(pages) // page + len(added), number - 1))
        fan = (page - 12) // 12
        while len(children) > fan:
            groups = [children[at : at + fan] for at in range(0, len(children), fan)]
            children = []
            for group in groups:
                added.append(inner_page(page, group))
                children.append((len(pages) // page + len(added), group[-1][1]))
        pages[at : at + page] = inner_page(page, children)
        whole = bytes(pages) + b"".join(added)
        with open(path, "wb") as file:
            file.write(whole[:28] + struct.pack(">I", len(whole) // page) + whole[32:])


def inner_page(page, children):
    cells = [struct.pack(">I", child) + varint(key) for child, key in children[:-1]]
    return table_page(5, page, cells, last=struct.pack(">I", children[-1][0]))


def pictures(base):
    """A grey PNG of 16,384 by 16,384 pixels, and others side by side."""
    names = '[frame]\ncolumn = "frame"\nchannel_order = "gray"\nreference = "unknown"\n' + FZ.format("z")
    for name, side, count in [("png-large", 16_384, 1), ("png-many", 5_600, 24)]:
        folder = lab(base, name, '"labels.csv"', names)
        packer = zlib.compressobj(9)
        row = b"\0" * (side + 1)
        data = b"".join(packer.compress(row) for _ in range(side)) + packer.flush()
        part = lambda kind, body: struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
        whole = b"\x89PNG\r\n\x1a\n" + part(b"IHDR", struct.pack(">IIBBBBB", side, side, 8, 0, 0, 0, 0)) + part(b"IDAT", data) + part(b"IEND", b"")
        rows = "frame,z\n"
        for number in range(count):
            with open(f"{folder}/{number}.png", "wb") as file:
                file.write(whole)
            rows += f"{number}.png,{number}\n"
        with open(folder + "/labels.csv", "w") as file:
            file.write(rows)


def others(base):
    folder = lab(base, "tar-gz", '"labels.csv"', FZ.format("z"))
    os.rmdir(folder)
    with tarfile.open(folder + ".tar.gz", "w:gz", compresslevel=9) as tar:
        text = b"z\n" + b"1\n" * 40 + b"\n" * 400_000_000
        member = tarfile.TarInfo("labels.csv")
        member.size = len(text)
        tar.addfile(member, io.BytesIO(text))
    folder = lab(base, "mat", '"run.mat"', FZ.format("z"))
    count = 60_000_000
    parts = [struct.pack("<IIII", 6, 8, 6, 0), struct.pack("<IIII", 5, 8, count, 1), struct.pack("<HHI", 1, 1, ord("z")), struct.pack("<II", 9, 8 * count), bytes(8 * count)]
    body = b"".join(parts)
    packed = zlib.compress(struct.pack("<II", 14, len(body)) + body, 9)
    with open(folder + "/run.mat", "wb") as file:
        file.write(b"MATLAB 5.0 MAT-file".ljust(124) + b"\x00\x01IM" + struct.pack("<II", 15, len(packed)) + packed)
    folder = lab(base, "csv-gz", '"run.csv.gz"', FZ.format("z"))
    with gzip.open(folder + "/run.csv.gz", "wb", 9) as file:
        file.write(b"z\n" + b"1\n" * 200_000_000)


def measured(command):
    """Exit code, processor time in s, peak memory in MB and the last line of a command."""
    child = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    said = child.stderr.read().strip().splitlines()
    _, status, usage = os.wait4(child.pid, 0)
    return os.waitstatus_to_exitcode(status), usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1000, (said or [""])[-1]


def make(base):
    for one in (frames_hdf5, frames_numpy, stores_zarr, tables, messages, databases, pictures, others):
        one(base)


def main():
    if "--make" in sys.argv:
        return make(sys.argv[2])
    taceva = sys.argv[1]
    with tempfile.TemporaryDirectory() as own:
        base = os.path.join(sys.argv[2] if len(sys.argv) > 2 else own, "bombs")
        if not os.path.isdir(base):
            os.makedirs(base)
            subprocess.run([sys.executable, __file__, "--make", base], check=True)
        bad = 0
        for name in sorted(name[:-5] for name in os.listdir(base) if name.endswith(".toml")):
            source = os.path.join(base, name)
            source = source if os.path.isdir(source) else source + ".tar.gz"
            files = [os.path.join(folder, file) for folder, _, files in os.walk(source) for file in files] or [source]
            size = sum(os.path.getsize(file) for file in files)
            for words in (["--map", f"{base}/{name}.toml", "--out", f"{own}/set-{name}"], ["--draft", "--out", f"{own}/{name}.draft"]):
                code, seconds, memory, said = measured([taceva, "import", source, *words, "-q"])
                is_bad = size <= MOST_BYTES and (memory > MOST_MB or seconds > MOST_S)
                bad += is_bad
                mark = "TOO MUCH" if is_bad else "ok" if size <= MOST_BYTES else "larger"
                print(f"{name:14} {words[0][2:]:6} {size:9} B  exit {code:2}  {seconds:6.1f} s  {memory:7.0f} MB  {mark:8} {said[:150]}", flush=True)
    sys.exit(1 if bad else 0)


if __name__ == "__main__":
    main()
