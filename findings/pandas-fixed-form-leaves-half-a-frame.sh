#!/usr/bin/env bash
# pandas 3.1.1: `DataFrame.to_hdf` in its fixed form, the default, stops at a column of categories with a clear error, and leaves a file that holds
# the columns before it under the key. `read_hdf` of that file ends in an AttributeError of PyTables, not in a word that the frame is not whole; a
# program that caught the first error, or a reader by h5py, finds numbers without the rest of their table.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet pandas==3.1.1 tables==3.11.1 numpy==2.4.6
cd "$folder"
"$folder/venv/bin/python" - <<'PY'
import numpy as np
import pandas as pd

frame = pd.DataFrame({"Fz": np.arange(3.0), "object": pd.Categorical(["cube", "ball", "cube"])})
try:
    frame.to_hdf("run.h5", key="run")
    raise SystemExit("changed: categories are written")
except NotImplementedError as problem:
    print("to_hdf:", problem)
try:
    read = pd.read_hdf("run.h5")
    raise SystemExit(f"changed: what is left reads as {read}")
except AttributeError as problem:
    print("read_hdf:", type(problem).__name__, str(problem)[:80])
import tables

with tables.open_file("run.h5") as file:
    names = sorted(node._v_name for node in file.root.run)
    print("nblocks", file.root.run._v_attrs.nblocks, "left in the file:", names)
    assert file.root.run._v_attrs.nblocks == 2 and "block1_values" not in names
PY
