"""Data frames in the fixed format of pandas (pandas 3.1.1, tables 3.11): `python make.py` in this folder."""

import numpy as np
import pandas as pd

n = 24
mixed = pd.DataFrame(
    {
        "Fz": np.arange(n) * 0.25,
        "Fx": np.arange(n) * -0.5,
        "obj": ["cube", "ball"] * 12,
        "t": pd.to_datetime(1_700_000_000_000_000_000 + np.arange(n) * 33_000_000),
        "k": np.arange(n) * 3,
        "ok": np.arange(n) % 3 == 0,
        "Fy32": np.arange(n, dtype=np.float32) / 3,
    }
)
mixed.to_hdf("mixed.h5", key="run", complevel=9, complib="zlib")
mixed[["Fx", "Fz"]].to_hdf("two.h5", key="lab/day1")
mixed[["Fz", "k"]].set_index(pd.date_range("2026-11-28", periods=n, freq="20ms")).to_hdf("timed.h5", key="run")
pd.DataFrame(np.arange(72.0).reshape(24, 3)).to_hdf("numbered.h5", key="f")
levels = pd.MultiIndex.from_tuples([("F", "x"), ("F", "y"), ("F", "z")])
pd.DataFrame(np.arange(72.0).reshape(24, 3), columns=levels).to_hdf("levels.h5", key="f")
try:
    pd.DataFrame({"Fz": np.arange(3.0), "c": pd.Categorical(["a", "b", "a"])}).to_hdf("cut.h5", key="run")
except NotImplementedError as problem:
    print("cut.h5:", problem)
