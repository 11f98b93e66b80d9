"""Writes the small files that are not among the shared recordings, by pyarrow, and what pyarrow reads back of them as JSON.

    python make.py [KIND ...]      kinds: nested

pyarrow 26, numpy. Numbers are drawn in closed form."""
import datetime, decimal, json, sys
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

HERE = Path(__file__).parent


def plain(value):
    """As Rust's test compares it: bytes in hexadecimal digits, times as integers, NaN as a text."""
    if isinstance(value, dict):
        return {k: plain(v) for k, v in value.items()}
    if isinstance(value, list):
        return [plain(v) for v in value]
    if isinstance(value, tuple):  # an entry of a map
        return {"key": plain(value[0]), "value": plain(value[1])}
    if isinstance(value, bytes):
        return value.hex()
    if isinstance(value, float) and value != value:
        return "NaN"
    if isinstance(value, decimal.Decimal):
        return float(value)
    return value


def nested():
    """Nulls, empty lists and structures at every depth, in every encoding that pyarrow writes, several pages a group."""
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


if __name__ == "__main__":
    for kind in sys.argv[1:] or ["nested"]:
        globals()[kind]()
