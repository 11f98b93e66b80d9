"""Results from Python against golden numbers, and against the command on golden sets and real recordings, bit for bit.

`TACEVA_GOLDEN` names a folder with another `pairs.json`. `TACEVA_DATA` names the folder of external recordings, which are not part of the
project. `TACEVA_GOLDEN_ALL=1` tests every golden set and every recording; otherwise a few sets and the smallest recording.
"""

from __future__ import annotations

import json
import math
import os
import struct
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import taceva
from conftest import taceva as command

WORKSPACE = Path(__file__).resolve().parents[2]
PAIRS = Path(os.environ.get("TACEVA_GOLDEN", WORKSPACE / "taceva-metrics" / "tests" / "golden")) / "pairs.json"
CASES = json.loads(PAIRS.read_text())["cases"]
GAMMA, FIRST, SECOND = 0x9E3779B97F4A7C15, 0xBF58476D1CE4E5B9, 0x94D049BB133111EB
MANTISSA = np.uint64(2**52 - 1)


def draws(seed: int, count: int) -> Any:
    """Return numbers of splitmix64, in order."""
    with np.errstate(over="ignore"):
        state = np.uint64(seed) + np.arange(1, count + 1, dtype=np.uint64) * np.uint64(GAMMA)
        state = (state ^ (state >> np.uint64(30))) * np.uint64(FIRST)
        state = (state ^ (state >> np.uint64(27))) * np.uint64(SECOND)
        return state ^ (state >> np.uint64(31))


def unit(drawn: Any) -> Any:
    return (drawn >> np.uint64(11)).astype(np.float64) * 2.0**-53


def normal(drawn: Any) -> Any:
    """Use twelve draws per row, summed from left to right."""
    total = unit(drawn[..., 0])
    for at in range(1, 12):
        total = total + unit(drawn[..., at])
    return total - 6.0


def wide(drawn: Any, low: int, high: int) -> Any:
    """Use two draws per row: sign and significand, then the exponent."""
    significand = 1.0 + (drawn[..., 0] & MANTISSA).astype(np.float64) * 2.0**-52
    exponent = low + (drawn[..., 1] % np.uint64(high - low + 1)).astype(np.int64)
    return np.where(drawn[..., 0] >> np.uint64(63), -1.0, 1.0) * np.ldexp(significand, exponent)


def tiny(drawn: Any) -> Any:
    """Use two draws per row: the significand, then the sign."""
    sign = (drawn[..., 1] >> np.uint64(63)) << np.uint64(63)
    return ((drawn[..., 0] & MANTISSA) | sign).view(np.float64)


def generated(case: dict[str, Any]) -> tuple[Any, Any]:
    """Return truth and prediction of a recipe, as described in the file."""
    kind, rows, parameters = case["kind"], case["n"], case.get("p", {})
    a, b, s = (parameters.get(name, 0.0) for name in "abs")
    low, high = (parameters.get(name, 0) for name in ("lo", "hi"))

    def drawn(width: int) -> Any:
        return draws(case["seed"], rows * width).reshape(rows, width)

    if kind in ("lab", "offset", "f32", "decimal3"):
        own = drawn(13)
        truth = a + (b - a) * unit(own[:, 0])
        if kind == "offset":
            truth = parameters["off"] + truth
        if kind == "f32":
            truth = truth.astype(np.float32).astype(np.float64)
        if kind == "decimal3":
            truth = (int(a) + (own[:, 0] % np.uint64(int(b) - int(a) + 1)).astype(np.int64)).astype(np.float64) / 1000.0
        prediction = truth + s * normal(own[:, 1:])
        return truth, prediction.astype(np.float32).astype(np.float64) if kind == "f32" else prediction
    if kind == "smallerr":
        own = drawn(3)
        truth = a + (b - a) * unit(own[:, 0])
        return truth, truth + wide(own[:, 1:], low, high)
    if kind == "wide":
        own = drawn(4)
        return wide(own[:, :2], low, high), wide(own[:, 2:], low, high)
    if kind == "wide_near":
        own = drawn(14)
        truth = wide(own[:, :2], low, high)
        return truth, truth * (1.0 + s * normal(own[:, 2:]))
    if kind == "denorm":
        own = drawn(4)
        return tiny(own[:, :2]), tiny(own[:, 2:])
    if kind == "const":
        return np.full(rows, a), a + s * normal(drawn(12))
    if kind == "const_eq":
        return np.full(rows, a), np.full(rows, a)
    if kind == "cancel":
        own = draws(case["seed"], -(-rows // 2) * 26).reshape(-1, 26)
        even = wide(own[:, :2], low, high)
        truth = np.stack([even, -even], axis=1).reshape(-1)[:rows]
        errors = np.stack([normal(own[:, 2:14]), normal(own[:, 14:])], axis=1).reshape(-1)[:rows]
        return truth, truth + s * errors
    raise AssertionError(f"a kind that this reader does not know: {kind}")


def number(bits: str) -> float:
    return float(struct.unpack("<d", struct.pack("<Q", int(bits, 16)))[0])


def runs(listed: Any) -> Any:
    repeated = [number(bits) for run in listed for _ in range(run["times"]) for bits in run["values"]]
    return np.array(repeated, dtype=np.float64)


def arrays(case: dict[str, Any]) -> tuple[Any, Any]:
    if "y_runs" in case:
        return runs(case["y_runs"]), runs(case["yhat_runs"])
    if "y" in case:
        return np.array([*map(number, case["y"])]), np.array([*map(number, case["yhat"])])
    truth, prediction = generated(case)
    order = case.get("order", "none")
    if order == "reverse":
        truth, prediction = truth[::-1], prediction[::-1]
    if order == "sort":
        sorted_rows = np.lexsort((prediction, truth))
        truth, prediction = truth[sorted_rows], prediction[sorted_rows]
    if order == "shuffle":
        rows = list(range(case["n"]))
        for at, drawn in zip(range(case["n"] - 1, 0, -1), draws(case["seed2"], case["n"]).tolist(), strict=False):
            other = drawn % (at + 1)
            rows[at], rows[other] = rows[other], rows[at]
        truth, prediction = truth[rows], prediction[rows]
    for place, row in (("first", 0), ("last", -1)):
        if case.get(place):
            assert [number(bits) for bits in case[place]] == [truth[row], prediction[row]], (case["name"], place)
    return truth, prediction


def root_mean_square(truth: Any, prediction: Any) -> float | None:
    """Return the exact root of the exact mean square of finite pairs, rounded once; `None` if it exceeds binary64."""
    pairs = [pair for pair in zip(truth.tolist(), prediction.tolist(), strict=True) if all(map(math.isfinite, pair))]
    if not pairs:
        return None
    # Every binary64 is a whole multiple of 2^-1074. 128 more bits and a sticky last bit for any remainder decide every rounding.
    whole = [[top * (2**1074 // bottom) for top, bottom in map(float.as_integer_ratio, pair)] for pair in pairs]
    square, rest = divmod(sum((one - other) ** 2 for one, other in whole) << 256, len(pairs))
    root = math.isqrt(square)
    root = root * 2 + (root * root != square or rest > 0)
    try:
        return root / (1 << (1074 + 128 + 1))
    except OverflowError:
        return None


def bits(value: float) -> str:
    return f"0x{struct.unpack('<Q', struct.pack('<d', value))[0]:016x}"


@pytest.mark.parametrize("case", CASES, ids=[case["name"] for case in CASES])
def test_scores_of_arrays_have_the_golden_bits(case: dict[str, Any]) -> None:
    truth, prediction = arrays(case)
    result = taceva.score(truth, prediction, channels=["Fz"], metrics=["mae", "bias", "r2", "rmse", "smape"], allow_invalid=True)
    golden, compared = case["expected"].get("canonical", {}), 0
    expected = {name: golden.get(name) for name in ("mae", "bias", "r2", "smape")}
    root = root_mean_square(truth, prediction) if golden.get("rmse_sq") else None
    if root is not None:
        expected["rmse"] = bits(root)
    for metric, wanted in expected.items():
        score = result[metric, "Fz"]
        if wanted is not None and math.isfinite(number(wanted)):
            assert score.value is not None and bits(score.value) == wanted, (metric, score)
            compared += 1
    for metric, status in case["expected"]["status"].items():
        score = result[metric, "Fz"]
        assert (score.value is None) == (golden.get(metric) is None or not math.isfinite(number(golden[metric]))), (metric, status, score)
        compared += 1
    assert compared
    assert result["mae", "Fz"].n == case["expected"]["n"]


ALL = os.environ.get("TACEVA_GOLDEN_ALL") == "1"
SMALL = [case for case in CASES if 0 < case.get("n", case["expected"]["n"]) <= 5_000][:: 1 if ALL else 8]


@pytest.mark.parametrize("case", SMALL, ids=[case["name"] for case in SMALL])
def test_the_command_writes_the_same_bytes_of_a_golden_set(case: dict[str, Any], tmp_path: Path) -> None:
    columns = dict(zip(("truth", "prediction"), arrays(case), strict=True))
    for name, column in columns.items():
        (tmp_path / f"{name}.csv").write_text("Fz\n" + "".join(f"{value!r}\n" for value in column.tolist()))
    tables, out = (tmp_path / "truth.csv", tmp_path / "prediction.csv"), tmp_path / "scores.json"
    done = command("score", "--truth", tables[0], "--pred", tables[1], "--format", "json", "--out", out)
    assert done.returncode == 0, done.stderr
    assert taceva.score_tables(*tables).text.encode() == out.read_bytes()
    of_arrays = taceva.score(columns["truth"], columns["prediction"], channels=["Fz"]).to_dict()["metrics"]
    of_command = json.loads(out.read_text())["metrics"]
    assert of_arrays == {metric: of_command[metric] for metric in of_arrays}


REAL = {
    "tactip-force": ("tactip-force", "ridge", "chronological 90/0/10"),
    "gelsight-wedge-grasp": ("gelsight-wedge-grasp", "knn", "random 70/10/20"),
    "tactip-shear-pose": ("tactip-shear-pose/cr_tactip", "pls", "random 70/10/20"),
}


@pytest.mark.parametrize("name", REAL if ALL else ["tactip-force"])
def test_a_real_recording_is_scored_as_the_command_scores_it(name: str, tmp_path: Path) -> None:
    folder, model, split = REAL[name]
    source = Path(os.environ.get("TACEVA_DATA", WORKSPACE.parent / "shared" / "data")) / folder
    if not source.is_dir():
        pytest.skip(f"no recording {name}: TACEVA_DATA names the folder that holds it")
    maps = WORKSPACE / "tests" / "fixtures" / "maps"
    map_file = maps / (f"{name}-32.toml" if name == "tactip-shear-pose" else f"{name}.toml")
    imported = command("import", source, "--map", map_file, "--out", tmp_path / "by command", "--quiet")
    assert imported.returncode == 0, imported.stderr
    dataset = taceva.import_recording(source, map_file, tmp_path / "by python")
    assert dataset.digest == taceva.open(tmp_path / "by command").digest
    out = tmp_path / "scores.json"
    asked = ("--model", model, "--split", split, "--seed", "2", "--no-cache", "--quiet", "--format", "json", "--out", out)
    done = command("evaluate", dataset.path, *asked)
    assert done.returncode == 0, done.stderr
    result = taceva.evaluate(dataset, model, split=split, seed=2)
    assert result.text.encode() == out.read_bytes()
    assert taceva.load(out) == result
