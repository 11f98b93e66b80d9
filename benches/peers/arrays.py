"""Arrays of other programs' files, read row by row, against the library of each form, in turn.

usage: python3 benches/peers/arrays.py [FRAMES]

Ours: `cargo run --release -p taceva-arrays --example read`, a process of its own, its start included. Theirs: one process each that
imports the library, opens the file and reads frame after frame; only the latter two are counted. Both in seconds of processor time (one
thread of each library, where it has more), with the peak of the memory of the whole process. Frames of 240 x 320 x 3 bytes: a bump over a
pattern with noise, so that it can be compressed, but not far.
"""
import os
import pathlib
import pickle
import shutil
import subprocess
import sys
import tempfile

from common import ROOT, need
from machine import Machine, in_turn

READERS = {
    "npy": "a = np.load(path)\nfor k in range(len(a)): t += int(a[k][0, 0, 0])",
    "npy mapped": "a = np.load(path, mmap_mode='r')\nfor k in range(len(a)): t += int(np.array(a[k])[0, 0, 0])",
    "npy float32": "a = np.load(path)\nfor k in range(len(a)): t += float(a[k][0, 0, 0])",
    "npy column by column": "a = np.load(path)\nfor k in range(len(a)): t += int(np.ascontiguousarray(a[k])[0, 0, 0])",
    "npz stored": "a = np.load(path)['rgb']\nfor k in range(len(a)): t += int(a[k][0, 0, 0])",
    "npz deflated": "a = np.load(path)['rgb']\nfor k in range(len(a)): t += int(a[k][0, 0, 0])",
    "pickle": "a = pickle.load(open(path, 'rb'))['rgb']\nfor k in range(len(a)): t += int(a[k][0, 0, 0])",
    **{f"hdf5 {kind}": "a = h5py.File(path)['rgb']\nfor k in range(len(a)): t += int(a[k][0, 0, 0])" for kind in ("contiguous", "gzip", "lzf")},
    **{f"zarr {kind}": "a = zarr.open(path, mode='r')['rgb']\nfor k in range(a.shape[0]): t += int(a[k][0, 0, 0])" for kind in ("gzip", "zstd", "blosc")},
}
ENDINGS = {"npy": "npy", "npz": "npz", "pickle": "pkl", "hdf5": "h5", "zarr": "zarr"}
PROGRAM = """import time, sys, pickle
import numpy as np
{imports}
path, t = sys.argv[1], 0
begun = time.process_time()
{reader}
print(time.process_time() - begun)
print(*[line for line in open('/proc/self/status') if line.startswith('VmHWM')])
"""


def write(folder, count):
    import h5py
    import numpy as np
    import zarr
    import numcodecs

    y, x = np.mgrid[0:240, 0:320]
    noise = np.random.default_rng(1).integers(0, 4, (8, 240, 320, 3), dtype=np.uint8)

    def frame(k):
        bump = 100 * np.exp(-((x - 160 - 60 * np.sin(k / 9)) ** 2 + (y - 120) ** 2) / 2000)
        marks = 40 * ((x % 16 < 4) & (y % 16 < 4))
        return (60 + bump + marks).astype(np.uint8)[..., None] + noise[k % 8]

    frames = np.stack([frame(k) for k in range(count)])

    def path(name):
        return folder / f"{name.replace(' ', '-')}.{ENDINGS[name.split()[0]]}"

    np.save(path("npy"), frames)
    np.save(path("npy mapped"), frames)
    np.save(path("npy float32"), frames[: count // 4].astype("f4"))
    np.save(path("npy column by column"), np.asfortranarray(frames))
    np.savez(path("npz stored"), rgb=frames)
    np.savez_compressed(path("npz deflated"), rgb=frames)
    with open(path("pickle"), "wb") as f:
        pickle.dump({"rgb": frames}, f, protocol=4)
    for kind, how in (("contiguous", {}), ("gzip", dict(chunks=(1, 240, 320, 3), compression="gzip")), ("lzf", dict(chunks=(1, 240, 320, 3), compression="lzf"))):
        with h5py.File(path(f"hdf5 {kind}"), "w", libver=("earliest", "v114")) as f:
            f.create_dataset("rgb", data=frames, **how)
    for kind, codec in (("gzip", numcodecs.GZip(5)), ("zstd", numcodecs.Zstd(3)), ("blosc", numcodecs.Blosc("lz4"))):
        g = zarr.open_group(str(path(f"zarr {kind}")), mode="w", zarr_format=2)
        a = g.create_array("rgb", shape=frames.shape, chunks=(8, 240, 320, 3), dtype="u1", compressors=codec)
        a[:] = frames


def main(count):
    need("numpy", "h5py", "zarr", "numcodecs")
    target = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
    subprocess.run(["cargo", "build", "--release", "-p", "taceva-arrays", "--example", "read"], cwd=ROOT, check=True)
    binary = target / "release" / "examples" / "read"
    folder = pathlib.Path(tempfile.mkdtemp())
    os.environ |= {name: "1" for name in ("OMP_NUM_THREADS", "BLOSC_NTHREADS", "NUMEXPR_NUM_THREADS")}
    try:
        subprocess.run([sys.executable, __file__, str(count), str(folder)], check=True)
        machine = Machine()
        files = {name: folder / f"{name.replace(' ', '-')}.{ENDINGS[name.split()[0]]}" for name in READERS}
        print(f"{count} frames; {machine.said()}")
        print(f"{'form':<22}{'ours s':>9}{'theirs s':>10}{'ratio':>8}{'ours MiB':>10}{'theirs MiB':>12}")
        for name, path in files.items():
            imports = {"hdf5": "import h5py", "zarr": "import zarr, numcodecs; numcodecs.blosc.use_threads = False; zarr.config.set({'threading.max_workers': 1})"}.get(name.split()[0], "")
            program = PROGRAM.format(imports=imports, reader=READERS[name])
            array = {"npy": "value"}.get(name.split()[0], "rgb")
            (mine, my_peak), (other, other_peak) = in_turn([str(binary), str(path), array, "1"], [sys.executable, "-c", program, str(path)])
            print(f"{name:<22}{mine:>9.3f}{other:>10.3f}{machine.ratio(mine, other):>8}{my_peak:>10.0f}{other_peak:>12.0f}", flush=True)
        print(f"medians of 5, in turn; {machine.said()}")
    finally:
        shutil.rmtree(folder)


if __name__ == "__main__":
    if len(sys.argv) > 3:
        sys.exit(__doc__)
    if len(sys.argv) == 3:
        write(pathlib.Path(sys.argv[2]), int(sys.argv[1]))
        sys.exit()
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 300)
