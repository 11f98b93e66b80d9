"""Pictures in other programs' tables, read one by one, against the library of each format, in turn.

usage: python3 benches/peers/tables.py [FRAMES]

Ours: `cargo run --release -p taceva-tables --example measure`, a process of its own, its start included. Theirs: one process each that imports the
library (pyarrow, mcap), opens the file and goes through every picture; only the latter two are counted. Both in seconds of processor time,
one thread, with the peak of the memory of the whole process. Raw pictures of 240 x 320 x 3 bytes, "noisy" with a camera's noise over a pattern of
markers, which compresses little, and "smooth" without.
"""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

from common import ROOT, need
from machine import Machine, in_turn

CODECS = {"parquet": ("none", "snappy", "gzip", "zstd"), "mcap": ("none", "lz4", "zstd")}
KINDS = ("noisy", "smooth")
ENDINGS = {"parquet": "parquet", "mcap": "mcap"}
TOPIC = "/camera"
READERS = {
    "parquet": """import pyarrow, pyarrow.parquet as pq
pyarrow.set_cpu_count(1); pyarrow.set_io_thread_count(1)""",
    "mcap": "from mcap.reader import make_reader",
}
LOOPS = {
    "parquet": """for batch in pq.ParquetFile(path).iter_batches(batch_size=16, columns=['image'], use_threads=False):
    for cell in batch.column(0): t += len(cell.as_buffer())""",
    "mcap": """for _, _, message in make_reader(open(path, 'rb')).iter_messages(topics=['/camera']): t += len(message.data)""",
}
PROGRAM = """import time, sys
{imports}
path, t = sys.argv[1], 0
begun = time.process_time()
{loop}
print(time.process_time() - begun, t)
print(*[line for line in open('/proc/self/status') if line.startswith('VmHWM')])
"""
IMAGE = """std_msgs/Header header
uint32 height
uint32 width
string encoding
uint8 is_bigendian
uint32 step
uint8[] data
================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
"""


def drawn(count, kind):
    """So many pictures: a bump that moves over a pattern of markers."""
    import numpy as np

    y, x = np.mgrid[0:240, 0:320]
    noise = np.random.default_rng(1).integers(0, 16, (8, 240, 320, 3), dtype=np.uint8)
    for place in range(count):
        bump = 100 * np.exp(-((x - 160 - 60 * np.sin(place / 9)) ** 2 + (y - 120) ** 2) / 2000)
        markers = 40 * ((x % 16 < 4) & (y % 16 < 4))
        flat = np.repeat((60 + bump + markers).astype(np.uint8)[..., None], 3, axis=2)
        yield flat + noise[place % 8] if kind == "noisy" else flat


def file_of(folder, form, codec, kind):
    return folder / f"{form}-{codec}-{kind}.{ENDINGS[form]}"


def write_parquet(path, codec, pictures):
    import pyarrow as pa
    import pyarrow.parquet as pq

    rows = [picture.tobytes() for picture in pictures]
    table = pa.table({"image": pa.array(rows, pa.binary()), "Fz": pa.array([0.1 * place for place in range(len(rows))])})
    pq.write_table(table, path, compression=codec, row_group_size=64, use_dictionary=False)


def write_mcap(path, codec, pictures):
    from mcap.writer import CompressionType
    from mcap_ros2.writer import Writer

    with open(path, "wb") as file:
        writer = Writer(file, compression=CompressionType[codec.upper()])
        schema = writer.register_msgdef("sensor_msgs/msg/Image", IMAGE)
        for place, picture in enumerate(pictures):
            header = {"stamp": {"sec": 1_700_000_000 + place // 30, "nanosec": place % 30 * 33_000_000}, "frame_id": "gel"}
            message = {"header": header, "height": 240, "width": 320, "encoding": "rgb8", "is_bigendian": 0, "step": 960, "data": picture.tobytes()}
            stamp = 1_700_000_000_000_000_000 + place * 33_000_000
            writer.write_message(TOPIC, schema, message, log_time=stamp, publish_time=stamp)
        writer.finish()


def write(folder, count):
    for kind in KINDS:
        pictures = list(drawn(count, kind))
        for form, codecs in CODECS.items():
            for codec in codecs:
                globals()[f"write_{form}"](file_of(folder, form, codec, kind), codec, pictures)


def main(count, rounds=5):
    need("numpy", "pyarrow", "mcap", "mcap_ros2")
    target = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
    subprocess.run(["cargo", "build", "--release", "-p", "taceva-tables", "--example", "measure"], cwd=ROOT, check=True)
    binary = str(target / "release" / "examples" / "measure")
    folder = pathlib.Path(tempfile.mkdtemp())
    try:
        subprocess.run([sys.executable, __file__, str(count), str(folder)], check=True)
        machine = Machine()
        print(f"{count} pictures; {machine.said()}")
        print(f"{'form':<10}{'codec':<8}{'pictures':<10}{'MB':>6}{'ours s':>9}{'theirs s':>10}{'ratio':>8}{'ours MiB':>10}{'theirs MiB':>12}")
        for form, codecs in CODECS.items():
            program = PROGRAM.format(imports=READERS[form], loop=LOOPS[form])
            column = {"parquet": ["image"], "mcap": ["data", TOPIC]}[form]
            for codec in codecs:
                for kind in KINDS:
                    path = str(file_of(folder, form, codec, kind))
                    (mine, my_peak), (other, other_peak) = in_turn([binary, path, *column], [sys.executable, "-c", program, path], rounds)
                    size = os.path.getsize(path) / 1e6
                    print(f"{form:<10}{codec:<8}{kind:<10}{size:>6.1f}{mine:>9.3f}{other:>10.3f}{machine.ratio(mine, other):>8}{my_peak:>10.0f}{other_peak:>12.0f}", flush=True)
        print(f"medians of {rounds}, in turn; {machine.said()}")
    finally:
        shutil.rmtree(folder)


if __name__ == "__main__":
    if len(sys.argv) > 3:
        sys.exit(__doc__)
    if len(sys.argv) == 3:
        write(pathlib.Path(sys.argv[2]), int(sys.argv[1]))
        sys.exit()
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 300)
