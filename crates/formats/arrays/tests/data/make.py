"""Writes the small files of these tests with the library of each format.

Then reads every file of this folder, and the recordings that these tests use, with the same libraries into expected.json.
Each array has its shape, type and SHA-256 of the elements, row by row, little-endian, 16 bit floats widened to 32.

    python -m venv v && v/bin/pip install numpy h5py hdf5storage scipy zarr numcodecs && v/bin/python make.py [KIND ...]

Kinds: npy npz hdf5 zarr pickle matlab; all of them without an argument. `tests/recordings` has its own scripts."""
import hashlib, json, pickle, shutil, struct, sys
from pathlib import Path
import numpy as np
HERE = Path(__file__).parent
RECORDINGS = HERE.parents[4] / "tests" / "recordings"
SHARED = "hdf5-fletcher-earliest hdf5-fletcher-latest hdf5-groups hdf5-gzip-shuffle-earliest hdf5-gzip-shuffle-latest hdf5-lzf-earliest hdf5-lzf-latest hdf5-vlen-compound npy-fortran npz-deflated npz-stored pickle taxels-npy zarr-v2 zarr-v3".split()

def fresh(name):
    folder = HERE / name
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    return folder

def told(a):
    """Shape, element and digest of an array, as the crate returns them."""
    a = np.asarray(a)
    if a.dtype.kind in "SUO":
        def one(x):
            if isinstance(x, np.ndarray): return b"b" + struct.pack("<Q", x.size) + x.tobytes()
            x = x.decode() if isinstance(x, bytes) else str(x)
            return b"t" + struct.pack("<Q", len(x.encode())) + x.encode()
        body = b"".join(one(x) for x in a.ravel())
        kind = "bytes" if isinstance(a.ravel()[0], np.ndarray) else "text"
    else:
        if a.dtype.kind == "f" and a.itemsize == 2: a, kind = a.astype("<f4"), "16 bit floating point"
        else: kind = {"b": "true or false", "u": f"{8*a.itemsize} bit unsigned", "i": f"{8*a.itemsize} bit signed", "f": f"{8*a.itemsize} bit floating point"}[a.dtype.kind]
        body = np.ascontiguousarray(a.astype(a.dtype.newbyteorder("<"))).tobytes()
    return {"shape": list(a.shape), "element": kind, "sha256": hashlib.sha256(body).hexdigest()}

def flat(name, a):
    """Fields of a record, each as a separate array."""
    if a.dtype.names is None: return {name: told(a)}
    return {k: v for field in a.dtype.names for k, v in flat(f"{name}.{field}", a[field]).items()}

def numbers(shape, dtype, seed):
    r = np.random.default_rng(seed)
    dtype = np.dtype(dtype)
    if dtype.kind == "f": return r.normal(size=shape).astype(dtype)
    if dtype.kind == "b": return r.integers(0, 2, shape).astype(dtype)
    if dtype.kind in "SU": return np.array([["", "a", "gel", "ü中" if dtype.kind == "U" else "xyz"][k] for k in r.integers(0, 4, int(np.prod(shape)))], dtype).reshape(shape)
    i = np.iinfo(dtype)
    return r.integers(i.min, i.max, shape, dtype.newbyteorder("="), endpoint=True).astype(dtype)

TYPES = ["|b1", "|u1", "|i1", "<u2", ">u2", "<i2", ">i2", "<u4", ">u4", "<i4", ">i4", "<u8", ">u8", "<i8", ">i8", "<f2", ">f2", "<f4", ">f4", "<f8", ">f8", "|S6", "<U3", ">U3"]

def write_npy():
    folder = fresh("npy")
    for n, dtype in enumerate(TYPES):
        a = numbers((5, 3, 2), dtype, n)
        name = dtype.replace("<", "little-").replace(">", "big-").replace("|", "")
        np.save(folder / f"{name}.npy", a)
        if dtype in ("<u2", ">f8", "<U3"): np.save(folder / f"{name}-fortran.npy", np.asfortranarray(a))
    a = numbers((4, 7), "<f4", 100)
    for version in ((1, 0), (2, 0), (3, 0)):
        with open(folder / f"version-{version[0]}.npy", "wb") as f: np.lib.format.write_array(f, a, version)
    np.save(folder / "scalar.npy", np.float64(2.5))
    np.save(folder / "empty.npy", np.zeros((0, 4)))
    np.save(folder / "no-columns.npy", np.zeros((4, 0), "f4"))
    record = np.zeros(6, [("t", "<f8"), ("ft", ">f4", (3, 2)), ("pose", [("x", "<i2"), ("name", "S4")]), ("größe", "u1")])
    record["t"], record["ft"], record["pose"]["x"], record["größe"] = np.arange(6)/10, numbers((6, 3, 2), "f4", 101), range(6), range(6)
    record["pose"]["name"] = ["a", "bc", "", "def", "g", "h"]
    np.save(folder / "record.npy", record)
    np.save(folder / "aligned.npy", np.zeros(3, np.dtype([("a", "u1"), ("b", "<f8")], align=True)))

def write_npz():
    folder = fresh("npz")
    import zipfile
    a, b = numbers((9, 4, 3), "<f4", 200), numbers((9,), ">i2", 201)
    np.savez_compressed(folder / "plain.npz", a=np.asfortranarray(a), b=b, **{"größe": np.array(["x", "yz"])})
    limit, zipfile.ZIP64_LIMIT = zipfile.ZIP64_LIMIT, 100                 # 64-bit fields for every size and for the directory
    with zipfile.ZipFile(folder / "zip64.npz", "w", zipfile.ZIP_DEFLATED) as z:
        for name, array in (("a", a), ("b", b)):
            with z.open(name + ".npy", "w", force_zip64=True) as f: np.lib.format.write_array(f, array)
        z.writestr("notes.txt", "no array")
        z.comment = b"a comment behind the directory"
    zipfile.ZIP64_LIMIT = limit
    np.savez_compressed(folder / "empty.npz")

def write_hdf5():
    import h5py
    folder = fresh("hdf5")
    with h5py.File(folder / "types.h5", "w", libver=("earliest", "v114")) as f:
        for n, dtype in enumerate(t for t in TYPES if t[1] != "U"):
            f.create_dataset(f"plain/{'big' if dtype[0] == '>' else 'little'}-{dtype[1:]}", data=numbers((5, 3, 2), dtype, n + 300))
        record = np.zeros(7, [("t", ">f8"), ("ft", "<f4", (3, 2)), ("pose", [("x", "<i2"), ("name", "S4")]), ("is_pressed", "?")])
        record["t"], record["ft"], record["pose"]["x"], record["is_pressed"] = np.arange(7)/10, numbers((7, 3, 2), "f4", 301), range(7), [0, 1, 1, 0, 1, 0, 0]
        record["pose"]["name"] = ["a", "bc", "", "def", "g", "h", "ij"]
        f["record"] = record
        f.create_dataset("packed-record", data=record, chunks=(3,), compression="gzip", shuffle=True)
        f["scalar"] = 2.5
        f["empty"] = np.zeros((0, 4))
        f["texts"] = ["gel", "", "ü中", "a" * 5000, "z"]
        texts = f.create_dataset("texts-in-chunks", (9,), chunks=(2,), dtype=h5py.string_dtype()); texts[:7] = [f"object {k}" for k in range(7)]
        b = f.create_dataset("bytes", (6,), dtype=h5py.vlen_dtype(np.uint8))
        for k in range(5): b[k] = np.arange(k * 300, dtype="u1")
        f.create_dataset("grown", data=numbers((11, 4), "<i4", 302), chunks=(4, 3), maxshape=(None, None), compression="lzf")
        f.create_dataset("unwritten", (7, 2), "<f4", chunks=(2, 2), fillvalue=1.5)
        f.create_dataset("filled", (3,), "<i2", fillvalue=-4)
        f.create_dataset("half-chunk", data=numbers((5, 70), "<u2", 303), chunks=(3, 64), fletcher32=True)
        f.attrs["sensor"] = "drawn gel"; f["record"].attrs["rate_hz"] = 0.1; f["plain"].attrs["offset"] = np.array([1, -2, 3], "i4"); f["plain"].attrs["scale"] = np.float32(0.1)
        f["soft"] = h5py.SoftLink("/record"); f["outside"] = h5py.ExternalLink("other.h5", "/x")
        f["plain/deeper/still/x"] = np.arange(3)
    with h5py.File(folder / "userblock.h5", "w", userblock_size=1024) as f: f["texts"] = ["a", "bc"]; f["x"] = np.arange(12.0).reshape(4, 3)
    refused = HERE / "refused"; refused.mkdir(exist_ok=True)
    with h5py.File(refused / "kinds.h5", "w") as f:
        f["complex"] = np.ones(3, "c8"); f.create_dataset("lists", (3,), dtype=h5py.vlen_dtype(np.float32)); f["reference"] = f["complex"].ref; f["x"] = np.arange(4)
        f.create_dataset("elsewhere", (4,), "f8", external=[("../../secret.bin", 0, 32)])
        f.create_virtual_dataset("virtual", h5py.VirtualLayout((4,), "f8"))
    with h5py.File(refused / "cycle.h5", "w") as f: f["a/b/x"] = np.arange(2); f["a/b/up"] = f["a"]; f["a/b/root"] = f["/"]

def write_latest():
    """Data layout version 5 of HDF5 2.0, with every kind of index except the unsupported index of two growing axes."""
    import h5py
    folder = HERE / "hdf5"; folder.mkdir(exist_ok=True)
    for name in ("latest", "latest-ordered"):
        # Headers with creation order have messages with another head.
        h5py.get_config().track_order = name == "latest-ordered"
        with h5py.File(folder / f"{name}.h5", "w", libver="latest") as f:
            f.create_dataset("rgb", data=numbers((6, 40), "u1", 304), chunks=(2, 40), compression="gzip"); f["t"] = np.arange(6.0)
            f.create_dataset("whole", data=numbers((6, 40), "<f4", 305), chunks=(6, 40), compression="gzip", shuffle=True)
            f.create_dataset("grows", data=numbers((37, 3), "<f8", 306), chunks=(2, 3), maxshape=(None, 3), compression="lzf")
            f.create_dataset("grows-plain", data=numbers((37, 3), "<i2", 307), chunks=(5, 3), maxshape=(None, 3))
            # More chunks than one page of the index, and missing chunks.
            x = f.create_dataset("pages", (1100, 3), "<u2", chunks=(1, 3), fletcher32=True, fillvalue=7); x[::5] = numbers((220, 3), "<u2", 308)
            f.create_dataset("unfiltered", data=numbers((7, 5), ">i4", 309), chunks=(2, 2))
            f["group/deeper/half"] = numbers((5, 3), "<f2", 310)
            f.create_dataset("group/texts", data=["gel", "", "ü中"]); f.create_dataset("group/record", data=np.array([(1, 2.5), (3, 4.5)], [("n", "<i4"), ("Fz", "<f8")]), chunks=(1,), compression="gzip")
            # So many that the header needs a continuation block.
            for k in range(7): f["whole"].attrs[f"note{k}"] = "x" * 90
    h5py.get_config().track_order = False
    with h5py.File(HERE / "refused" / "two-growing-axes.h5", "w", libver="latest") as f:
        f.create_dataset("rgb", data=numbers((6, 40), "u1", 311), chunks=(2, 40), maxshape=(None, None), compression="gzip"); f["t"] = np.arange(6.0)

def write_links():
    """Soft links in the default layout, a dead soft link, and links in the newer layout, which are rejected by name."""
    import h5py
    refused = HERE / "refused"; refused.mkdir(exist_ok=True)
    with h5py.File(refused / "soft-links.h5", "w") as f:
        f["run/frames"] = np.arange(24, dtype="u1").reshape(6, 2, 2); f["run/ft"] = np.arange(6.0)
        f["frames"] = h5py.SoftLink("/run/frames"); f["latest"] = h5py.SoftLink("run"); f["twice"] = h5py.SoftLink("latest/ft"); f["run/first"] = h5py.SoftLink("ft")
    with h5py.File(refused / "dangling.h5", "w") as f:
        f["ft"] = np.arange(6.0); f["frames"] = h5py.SoftLink("/nowhere")
    with h5py.File(refused / "cycle-soft.h5", "w") as f:
        f["ft"] = np.arange(6.0); f["a"] = h5py.SoftLink("/b"); f["b"] = h5py.SoftLink("/a")
    with h5py.File(refused / "dead-links.h5", "w") as f:
        for k in range(20):
            f[f"data/x{k:02}"] = np.array([k, k + 1], "u1")
            if k % 5 == 0: f[f"data/x{k:02}-dead"] = h5py.SoftLink("/gone"); f[f"data/x{k:02}-far"] = h5py.SoftLink("../data/gone")
        f["data/live"] = h5py.SoftLink("/data/x07")
    with h5py.File(refused / "links.h5", "w", libver=("v110", "v110")) as f:
        f["run/frames"] = np.arange(24, dtype="u1").reshape(6, 2, 2)
        f["frames"] = h5py.SoftLink("/run/frames"); f["elsewhere"] = h5py.ExternalLink("other.h5", "/x")

def write_zarr():
    import zarr
    from numcodecs import GZip, LZ4, Zlib, Zstd, Blosc, Delta
    folder = fresh("zarr")
    smooth = lambda shape, dtype: (np.arange(int(np.prod(shape))).reshape(shape) // 3 % 100).astype(dtype)
    g = zarr.open_group(str(folder / "two.zarr"), mode="w", zarr_format=2)
    g.attrs["sensor"] = "drawn gel"; g.attrs["rate_hz"] = 0.1
    def two(name, a, chunks, **more):
        x = g.create_array(name, shape=a.shape, chunks=chunks, dtype=a.dtype, **more); x[:] = a
    two("raw", numbers((7, 5), ">i4", 400), (3, 2), compressors=None)
    two("column-major", numbers((7, 5, 3), "<f4", 401), (3, 2, 3), compressors=GZip(5), order="F")
    for name, codec in (("zlib", Zlib(5)), ("gzip", GZip(5)), ("zstd", Zstd(3)), ("zstd-sum", Zstd(3, checksum=True)), ("lz4", LZ4())): two(f"packed/{name}", smooth((9, 70), "<u2"), (4, 70), compressors=codec)
    for cname in ("lz4", "lz4hc", "zstd", "zlib"):
        for shuffle in (0, 1, 2):
            for dtype in ("|u1", "<u2", "<f8"): two(f"blosc/{cname}-{shuffle}-{dtype[1:]}", smooth((10, 300), dtype), (8, 300), compressors=Blosc(cname, shuffle=shuffle))
    two("blosc/random", numbers((3, 500), "<f8", 402), (2, 500), compressors=Blosc("lz4"))
    two("blosc/record", np.zeros((300,), [("a", "<f8"), ("b", "u1")]), (256,), compressors=Blosc("zstd"))
    record = np.zeros(7, [("t", "<f8"), ("fz", "<f4"), ("name", "S4")]); record["t"] = np.arange(7); record["fz"] = numbers((7,), "f4", 403); record["name"] = [b"a", b"bc", b"", b"d", b"e", b"f", b"gh"]
    two("record", record, (3,), compressors=None)
    two("texts/bytes", numbers((7,), "|S6", 404), (3,)); two("texts/wide", numbers((7,), "<U3", 405), (3,))
    for name, dtype, fill in (("whole", "<i2", -4), ("float", "<f4", 1.5), ("true", "|b1", True)):
        x = g.create_array(f"unwritten/{name}", shape=(7, 3), chunks=(2, 2), dtype=dtype, fill_value=fill)
        x[2:4] = np.ones((2, 3), dtype)
    x = g.create_array("scalar", shape=(), chunks=(), dtype="<f8"); x[...] = 2.5
    g.create_array("empty", shape=(0, 4), chunks=(1, 4), dtype="<f8")
    (folder / "two.zarr" / "somebody-else").mkdir(); (folder / "two.zarr" / "somebody-else" / "notes.txt").write_text("no array")
    g = zarr.open_group(str(folder / "three.zarr"), mode="w", zarr_format=3)
    g.create_group("deeper").attrs["object"] = ["cube", 3]
    def three(name, a, chunks, **more):
        x = g.create_array(name, shape=a.shape, chunks=chunks, dtype=a.dtype, **more); x[:] = a
    C = zarr.codecs
    for n, dtype in enumerate(t for t in TYPES if t[0] != ">" and t[1] not in "SU"): three("plain/" + dtype[1:], numbers((5, 3, 2), dtype, n + 410), (2, 3, 1))
    three("big", numbers((5, 3), "<f8", 440), (2, 3), serializer=C.BytesCodec(endian="big"), compressors=None)
    three("turned", numbers((5, 3, 4), "<i4", 441), (2, 3, 4), filters=[C.TransposeCodec(order=(2, 0, 1))])
    three("sum", smooth((9, 70), "<u2"), (4, 70), compressors=[C.ZstdCodec(level=3, checksum=True), C.Crc32cCodec()])
    three("twice", smooth((9, 70), "<u2"), (4, 70), compressors=[C.GzipCodec(), C.ZstdCodec()])
    three("dots", smooth((9, 7), "<u2"), (4, 7), chunk_key_encoding={"name": "v2", "separator": "."})
    for shuffle in ("noshuffle", "shuffle", "bitshuffle"): three(f"blosc/{shuffle}", smooth((10, 300), "<f4"), (8, 300), compressors=C.BloscCodec(cname="zstd", shuffle=shuffle))
    three("texts", numbers((7,), "<U3", 442), (3,)); three("texts-bytes", numbers((7,), "|S6", 443), (3,))
    x = g.create_array("unwritten", shape=(7, 3), chunks=(2, 2), dtype="<f4", fill_value=np.nan); x[2:4] = 1
    x = g.create_array("scalar", shape=(), chunks=(), dtype="<i4"); x[...] = 7
    x = zarr.create_array(str(folder / "alone.zarr"), shape=(5, 2), chunks=(2, 2), dtype="<i4", zarr_format=3); x[:] = numbers((5, 2), "<i4", 444)
    (HERE / "refused").mkdir(exist_ok=True); shutil.rmtree(HERE / "refused" / "kinds.zarr", ignore_errors=True)
    g = zarr.open_group(str(HERE / "refused" / "kinds.zarr"), mode="w", zarr_format=2)
    two("blosclz", smooth((9, 700), "<u2"), (9, 700), compressors=Blosc("blosclz")); two("delta", smooth((9, 7), "<u2"), (4, 7), filters=[Delta("<u2")]); two("complex", np.ones(3, "c8"), (3,)); two("x", np.arange(4), (4,))
    g3 = zarr.open_group(str(HERE / "refused" / "shards.zarr"), mode="w", zarr_format=3)
    x = g3.create_array("shards", shape=(8, 4), chunks=(2, 4), shards=(4, 4), dtype="<i4"); x[:] = 1

def write_pickle():
    from collections import OrderedDict
    folder = fresh("pickle-kinds")
    arrays = {t.replace("<", "little-").replace(">", "big-").replace("|", ""): numbers((5, 3), t, n + 500) for n, t in enumerate(TYPES)}
    arrays["fortran"] = np.asfortranarray(numbers((5, 3, 2), "<f8", 530)); arrays["scalar"] = np.array(2.5); arrays["empty"] = np.zeros((0, 3)); arrays["strided"] = numbers((6, 4), "<i4", 531)[::2, 1:]
    plain = OrderedDict(floats=[0.5, -1.5, 1e300], whole=[1, -2, 2**40, -2**63, 255, 256, 65535, -1], mixed=[1, 2.5, 3], texts=["a", "", "ü中", "x" * 300], bytes=[b"a", b"", b"z" * 300],
        truth=[True, False], nested=[[1, 2, 3], [4, 5, 6]], deeper=[[[1.5], [2.5]], [[3.5], [4.5]]], tuple=(1, 2, 3), one=7, text="gel", number=2.5, numpy=[np.float32(1.5), np.float32(2.5)], numpy_one=np.int16(-3),
        several=[numbers((2, 3), "<f4", 532), numbers((2, 3), "<f4", 533)], inner={"a": [1, 2], "b": {"c": np.arange(3)}}, nothing=[], objects=np.array([1, 2, 3], object))
    plain[3] = [1.0, 2.0]
    for p in (2, 3, 4, 5):
        pickle.dump(arrays, open(folder / f"arrays-{p}.pkl", "wb"), protocol=p)
        pickle.dump(plain, open(folder / f"plain-{p}.pickle", "wb"), protocol=p)
    pickle.dump(numbers((4, 2), "<f8", 534), open(folder / "array.pkl", "wb"), protocol=4)
    pickle.dump([1.5, 2.5, 3.5], open(folder / "list.p", "wb"), protocol=4)
    pickle.dump([{"Fz": k / 2, "name": f"o{k}", "ft": np.arange(3.0) + k, "image": bytes([k] * k)} for k in range(5)], open(folder / "table.pkl", "wb"), protocol=4)
    big = list(range(3000)); pickle.dump({"big": big, "again": big}, open(folder / "batches.pkl", "wb"), protocol=4)
    np.save(folder / "objects.npy", np.array([{"Fz": k / 2, "ft": np.arange(3) + k} for k in range(4)], object), allow_pickle=True)
    np.save(folder / "dictionary.npy", {"Fz": np.arange(4.0), "name": ["a", "b", "c", "d"]}, allow_pickle=True)
    np.savez(folder / "objects.npz", x=np.arange(3), meta={"rate": 30.0, "gel": "soft"})
    refused = HERE / "refused"; refused.mkdir(exist_ok=True)
    class Ran:
        def __reduce__(self): return (exec, ("raise SystemExit('a pickle was run')",))
    pickle.dump({"x": np.arange(3), "y": Ran()}, open(refused / "exec.pkl", "wb"), protocol=4)
    np.savez(refused / "exec.npz", x=np.arange(3), y=np.array([Ran()], object))
    pickle.dump({"ragged": [[1], [2, 3]], "set": None, "x": [1, 2], "mixed": [1, "a"]}, open(refused / "ragged.pkl", "wb"), protocol=4)
    for p in (0, 1): pickle.dump([1.5], open(refused / f"protocol-{p}.pkl", "wb"), protocol=p)

def write_matlab():
    import scipy.io, scipy.sparse, hdf5storage
    folder = fresh("matlab")
    def cells_of(items, shape):
        a = np.empty(len(items), object)
        for k, item in enumerate(items): a[k] = item
        return a.reshape(shape)
    x = {f"x_{t[1:]}": numbers((5, 3), t, n + 600) for n, t in enumerate(t for t in TYPES if t[0] != ">" and t[1] not in "SU" and t != "<f2")}
    x |= {"frames": numbers((4, 3, 6), "u1", 620), "row": np.arange(7.0), "column": np.arange(7.0)[:, None], "scalar": np.array(2.5), "empty": np.zeros((0, 3)), "whole_doubles": np.arange(12.0).reshape(4, 3), "text": "gel ü", "lines": np.array(["ab", "cde", "f"])}
    more = {"cells": cells_of([numbers((2, 3), "f8", 621), numbers((2, 3), "f8", 622)], (2, 1)), "numbers_in_cells": cells_of([np.array([[k + 0.5]]) for k in range(6)], (2, 3)), "names": cells_of(["cube", "ball", "gel"], (3, 1)), "session": {"Fz": np.arange(4.0)[:, None], "inner": {"name": "gel", "rate": np.array([[30.0]])}},
        "presses": np.array([[(np.array([[k * 1.0, 2.0]]), np.array([[k]], "i4"))] for k in range(3)], [("ft", "O"), ("id", "O")])}
    scipy.io.savemat(folder / "plain-5.mat", x | more, do_compression=False); scipy.io.savemat(folder / "packed-5.mat", x | more, do_compression=True)
    refused = HERE / "refused"; refused.mkdir(exist_ok=True)
    scipy.io.savemat(refused / "kinds.mat", {"complex": np.ones((2, 2)) * 1j, "sparse": scipy.sparse.eye(3).tocsc(), "ragged": cells_of([np.ones((1, 2)), np.ones((1, 3))], (2, 1)), "x": np.arange(3.0)[:, None]})
    scipy.io.savemat(refused / "four.mat", {"x": np.arange(3.0)}, format="4")
    (folder / "seven-3.mat").unlink(missing_ok=True)
    del x["empty"], x["lines"]
    hdf5storage.savemat(str(folder / "seven-3.mat"), x | {"session": {"Fz": np.arange(4.0)[:, None]}}, format="7.3", oned_as="row", store_python_metadata=False, matlab_compatible=True)
    with __import__("h5py").File(folder / "seven-3.mat", "a") as f:                            # as MATLAB writes long variables
        d = f.create_dataset("chunked", data=numbers((20, 6, 5), "<u2", 623), chunks=(4, 6, 5), compression="gzip"); d.attrs["MATLAB_class"] = np.bytes_("uint16")

def matlab(name, x):
    """Variables of a loadmat value, named as in the crate."""
    full = lambda key: f"{name}.{key}"
    if x.dtype.names:
        one = x.shape in ((1, 1), ())
        return {k: v for field in x.dtype.names for k, v in (matlab(full(field), x[field].ravel()[0]) if one else matlab(full(field), x[field])).items()}
    if x.dtype == object:
        items = [i if isinstance(i, np.ndarray) else np.asarray(i) for i in x.ravel()]
        inner = items[0].shape if items[0].size != 1 else ()
        return {name: told(np.stack([i.reshape(inner) for i in items]).reshape(x.shape + inner))}
    return {name: told(x)}

def read_mat(file):
    import scipy.io, h5py
    if not h5py.is_hdf5(file):
        return {k: v for name, x in scipy.io.loadmat(file, mat_dtype=True).items() if not name.startswith("__") for k, v in matlab(name, x).items()}
    found = {}
    def one(name, d):
        if not isinstance(d, h5py.Dataset) or name.startswith("#"): return
        kind = d.attrs["MATLAB_class"].decode(); a = d[()].T
        if kind == "char": a = np.array(["".join(map(chr, row)) for row in a])
        elif kind == "logical": a = a.astype(bool)
        found.update({name.replace("/", "."): told(a)})
    with h5py.File(file) as f: f.visititems(one)
    return found

def columns(name, x):
    """Columns of a value, named as in the crate."""
    if isinstance(x, np.ndarray) and x.dtype == object: x = x[()] if x.shape == () else list(x)
    full = lambda key: f"{name}.{key}" if name else str(key)
    if isinstance(x, dict): return {k: v for key, value in x.items() for k, v in columns(full(key), value).items()}
    if isinstance(x, (list, tuple)) and x and isinstance(x[0], dict): return {k: v for key in x[0] for k, v in columns(full(key), [row[key] for row in x]).items()}
    if isinstance(x, bytes) or (isinstance(x, list) and x and isinstance(x[0], bytes)):
        many = [np.frombuffer(b, "u1") for b in (x if isinstance(x, list) else [x])]
        a = np.empty(len(many), object)
        for k, b in enumerate(many): a[k] = b
        x = a
    return {name or "value": told(x)}

def read_pickle(file):
    with open(file, "rb") as f: return columns("", pickle.load(f))

def read_zarr(folder):
    import zarr
    root, found = zarr.open(str(folder), mode="r"), {}
    if isinstance(root, zarr.Array): return flat("/", root[...])
    for name, node in root.members(max_depth=None):
        if isinstance(node, zarr.Array): found.update(flat("/" + name, np.asarray(node[...])))
    return found

def read_hdf5(file):
    import h5py
    found = {}
    def one(name, node):
        if isinstance(node, h5py.Dataset):
            a = node.asstr()[()] if h5py.check_string_dtype(node.dtype) and h5py.check_string_dtype(node.dtype).length is None else node[()]
            if h5py.check_vlen_dtype(node.dtype) and not h5py.check_string_dtype(node.dtype):
                a = np.empty(node.shape, object); a[:] = [np.asarray(x, "u1") for x in node[()]]
            found.update(flat("/" + name, np.asarray(a)))
    with h5py.File(file) as f: f.visititems(one)
    return found

def read_npz(file):
    with np.load(file, allow_pickle=True) as z: return {k: v for name in z.files if name != "notes.txt" for k, v in (columns if z[name].dtype == object else lambda n, a: flat(n, a))(name, z[name]).items()}

def read_npy(file):
    a = np.load(file, allow_pickle=True)
    return columns("", a) if a.dtype == object else flat("value", a)

WRITE = {k[6:]: f for k, f in list(globals().items()) if k.startswith("write_")}
READ = {".npy": read_npy, ".npz": read_npz, ".h5": read_hdf5, ".hdf5": read_hdf5, ".zarr": read_zarr, ".pkl": read_pickle, ".pickle": read_pickle, ".p": read_pickle, ".mat": read_mat}
if __name__ == "__main__":
    for kind in sys.argv[1:] or WRITE: WRITE[kind]()
    found = {}
    kept = lambda p: p.suffix in READ and not any(q.suffix == ".zarr" for q in p.parents) and "refused" not in p.parts
    files = [(str(p.relative_to(HERE)), p) for p in HERE.rglob("*") if kept(p)]
    files += [(str(p.relative_to(RECORDINGS)), p) for name in SHARED for p in (RECORDINGS / name).rglob("*") if kept(p) and p.name not in ("evil.pkl", "dataframe.pkl")]
    for name, file in sorted(files): found[name] = READ[file.suffix](file)
    (HERE / "expected.json").write_text("{\n" + ",\n".join(f" {json.dumps(k)}: {json.dumps(v, ensure_ascii=False)}" for k, v in found.items()) + "\n}\n")
    print(len(found), "files")
