"""Writes the small files of these tests with the libraries that own the formats, then reads every file of this folder back with them
into expected.json: shape, type and SHA-256 of the elements, row by row, little-endian, 16 bit floats widened to 32.

    python -m venv v && v/bin/pip install numpy h5py hdf5storage scipy zarr numcodecs && v/bin/python make.py [KIND ...]

Kinds: npy npz hdf5 zarr pickle matlab; all of them without an argument. The folders named as recordings are (`npz-stored` and others)
are copies of drawn recordings, which nothing here writes."""
import hashlib, json, pickle, shutil, struct, sys
from pathlib import Path
import numpy as np
HERE = Path(__file__).parent

def fresh(name):
    folder = HERE / name
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    return folder

def told(a):
    """Shape, element and digest of an array as the crate gives it."""
    a = np.asarray(a)
    if a.dtype.kind in "SUO":
        def one(x):
            if isinstance(x, np.ndarray): return b"b" + struct.pack("<Q", x.size) + x.tobytes()
            x = x.decode() if isinstance(x, bytes) else str(x)
            return b"t" + struct.pack("<Q", len(x.encode())) + x.encode()
        body = b"".join(one(x) for x in a.ravel())
        kind = "bytes" if body[:1] == b"b" else "text"
    else:
        if a.dtype == np.float16: a, kind = a.astype("<f4"), "16 bit floating point"
        else: kind = {"b": "true or false", "u": f"{8*a.itemsize} bit unsigned", "i": f"{8*a.itemsize} bit signed", "f": f"{8*a.itemsize} bit floating point"}[a.dtype.kind]
        body = np.ascontiguousarray(a.astype(a.dtype.newbyteorder("<"))).tobytes()
    return {"shape": list(a.shape), "element": kind, "sha256": hashlib.sha256(body).hexdigest()}

def flat(name, a):
    """A record's fields, each as an array of its own."""
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

def read_npy(file): return flat("value", np.load(file))

WRITE = {k[6:]: f for k, f in list(globals().items()) if k.startswith("write_")}
READ = {".npy": read_npy}
if __name__ == "__main__":
    for kind in sys.argv[1:] or WRITE: WRITE[kind]()
    found = {}
    for file in sorted(p for p in HERE.rglob("*") if p.suffix in READ and not any(q.suffix == ".zarr" for q in p.parents) and "refused" not in p.parts):
        found[str(file.relative_to(HERE))] = READ[file.suffix](file)
    (HERE / "expected.json").write_text("{\n" + ",\n".join(f" {json.dumps(k)}: {json.dumps(v, ensure_ascii=False)}" for k, v in found.items()) + "\n}\n")
    print(len(found), "files")
