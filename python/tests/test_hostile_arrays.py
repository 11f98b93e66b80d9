"""Unusual arrays: each is read correctly, or rejected with a message before anything is copied."""

from __future__ import annotations

import resource
import subprocess
import sys
import textwrap
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import taceva

ROWS = 70_000  # more than a block


def arrays() -> tuple[Any, Any]:
    generator = np.random.default_rng(9)
    truth = generator.normal(size=(ROWS, 6))
    return truth, truth + 0.1 * generator.normal(size=(ROWS, 6))


EXPECTED: dict[str, str] = {}


def expected() -> str:
    if not EXPECTED:
        EXPECTED["text"] = taceva.score(*arrays()).text
    return EXPECTED["text"]


def test_another_byte_order_gives_the_same_bits() -> None:
    truth, prediction = arrays()
    assert taceva.score(truth.astype(">f8"), prediction.astype("<f8")).text == expected()


def test_negative_strides_give_the_same_bits() -> None:
    truth, prediction = (np.ascontiguousarray(array[::-1, ::-1]) for array in arrays())
    assert taceva.score(truth[::-1, ::-1], prediction[::-1, ::-1]).text == expected()


def test_read_only_arrays_are_taken_and_left_as_they_are() -> None:
    truth, prediction = arrays()
    kept = truth.copy()
    for array in (truth, prediction):
        array.setflags(write=False)
    assert taceva.score(truth, prediction).text == expected()
    assert np.array_equal(truth, kept)


def test_every_second_column_of_a_wider_array_is_taken_without_the_others() -> None:
    truth, prediction = arrays()
    wide = np.full((ROWS, 12), np.nan)
    wide[:, ::2] = truth
    assert taceva.score(wide[:, ::2], prediction).text == expected()


def test_memory_maps_and_subclasses_are_arrays(tmp_path: Path) -> None:
    truth, prediction = arrays()
    np.save(tmp_path / "truth.npy", truth)
    assert taceva.score(np.load(tmp_path / "truth.npy", mmap_mode="r"), prediction).text == expected()
    assert taceva.score(np.ma.masked_array(truth), prediction).text == expected()
    with pytest.raises(ValueError, match="truth: a masked array"):
        taceva.score(np.ma.masked_invalid(np.full((3, 6), np.nan)), np.zeros((3, 6)))


def test_an_empty_array_adds_nothing() -> None:
    truth, prediction = arrays()
    metrics = taceva.TactileMetrics()
    metrics.update(np.zeros((0, 6)), np.zeros((0, 6)), np.zeros(0, int))
    metrics.update(truth, prediction)
    metrics.update(np.zeros((0, 6), np.float32), [[0.0] * 6][:0] or np.zeros((0, 6)))
    assert metrics.compute()["mae", "Fz"].n == ROWS


def test_no_channel_is_refused_wherever_it_is_asked_for(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="no channels: expected the names of the columns"):
        taceva.TactileMetrics([])
    with pytest.raises(ValueError, match=r"truth has the shape \[3, 0\], expected \[rows, 6\]"):
        taceva.score(np.zeros((3, 0)), np.zeros((3, 0)))
    with pytest.raises(ValueError, match="no channels and no frames"):
        taceva.from_arrays(tmp_path / "recording", np.zeros((3, 0)), sensor="gel", source="synthetic", channels=[])
    assert not (tmp_path / "recording").exists()


def test_as_many_rows_as_nobody_has_are_refused_before_anything_is_copied(tmp_path: Path) -> None:
    many = np.broadcast_to(np.zeros(6), (2**31, 6))
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    with pytest.raises(ValueError, match=r"truth has 2147483648 rows, expected at most 2147483647 in one call"):
        taceva.score(many, many)
    with pytest.raises(ValueError, match="points has 2147483648 rows"):
        taceva.score(np.zeros((3, 6)), np.zeros((3, 6)), points=np.broadcast_to(np.zeros(1, np.int64), (2**31,)))
    with pytest.raises(ValueError, match="labels has 2147483648 rows"):
        taceva.from_arrays(tmp_path / "recording", many, sensor="gel", source="synthetic")
    with pytest.raises(ValueError, match="frames has 2147483648 rows, labels has 3"):
        pictures = np.broadcast_to(np.zeros((1, 1), np.uint8), (2**31, 1, 1))
        taceva.from_arrays(tmp_path / "recording", np.zeros((3, 6)), pictures, sensor="gel", source="synthetic")
    with pytest.raises(ValueError, match="prediction has 2147483647 rows, truth has 3"):
        taceva.score(np.zeros((3, 6)), many[:-1])
    assert (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) < 200_000  # kB
    assert not (tmp_path / "recording").exists()


def test_a_large_array_of_another_form_is_never_copied_as_a_whole() -> None:
    program = textwrap.dedent(
        """
        import resource
        import numpy as np, taceva
        # 3,000,000 rows of whole numbers that lie in the memory of one row: as float64 they would be 144 MB each.
        rows = np.broadcast_to(np.arange(6, dtype=np.int8), (3_000_000, 6))
        taceva.score(rows[:10], rows[:10])
        before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        result = taceva.score(rows, rows)
        assert result["mae", "Fz"].n == 3_000_000
        print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before)
        """
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=240, check=False)
    assert done.returncode == 0, done.stderr
    assert int(done.stdout) < 60_000, "kB"


def test_a_number_that_is_none_is_named_by_its_place_in_the_whole_array() -> None:
    truth, prediction = arrays()
    prediction[68_000, 2] = np.inf
    metrics = taceva.TactileMetrics()
    with pytest.raises(ValueError, match="prediction row 68000, column Pz: inf; 1 such row: expected finite numbers"):
        metrics.update(truth, prediction)
    assert metrics.compute()["mae", "Fz"].n == 0
    metrics.update(truth, prediction, allow_invalid=True)
    score = metrics.compute()["mae", "Pz"]
    assert (score.n, score.n_invalid) == (ROWS - 1, 1)


@pytest.mark.parametrize(
    ("array", "message"),
    [
        (np.zeros((3, 6), "M8[s]"), "datetime64"),
        (np.zeros((3, 6), [("x", "f8")]), "'x'"),
        (np.zeros((3, 6), np.longdouble), "longdouble|float128"),
        (np.zeros((3, 6), "S1"), "S1"),
    ],
    ids=["times", "records", "long doubles", "bytes"],
)
def test_arrays_of_other_things_than_numbers_are_refused_by_their_type(array: Any, message: str) -> None:
    with pytest.raises(TypeError, match=f"truth: expected numbers, found an array of .*({message})"):
        taceva.score(array, np.zeros((3, 6)))


def test_rows_of_unequal_length_are_refused() -> None:
    with pytest.raises(ValueError, match="inhomogeneous|shape"):
        taceva.score([[0.0] * 6, [0.0] * 5], np.zeros((2, 6)))
    with pytest.raises(ValueError, match=r"shape \[\]"):
        taceva.score(1.0, 2.0)


@pytest.mark.parametrize(
    ("names", "error", "message"),
    [
        (np.zeros(3), TypeError, "float64"),
        ([None, "a", "b"], TypeError, "object"),
        (np.zeros((3, 1), int), ValueError, r"shape \[3, 1\]"),
        ([1, 2], ValueError, "points has 2 rows, truth has 3"),
    ],
    ids=["fractions", "nothing", "axes", "length"],
)
def test_points_that_are_no_names_are_refused(names: Any, error: type[Exception], message: str) -> None:
    with pytest.raises(error, match=message):
        taceva.score(np.zeros((3, 6)), np.zeros((3, 6)), points=names)


def test_points_of_every_width_of_number_are_the_same_points() -> None:
    truth, prediction = arrays()
    names = np.arange(ROWS) % 40
    whole = taceva.score(truth, prediction, points=names).text
    for kind in ("u1", ">i4", "u8", "i2"):
        assert taceva.score(truth, prediction, points=names.astype(kind)).text == whole
    huge = taceva.score(truth[:3], prediction[:3], points=np.array([2**63, 2**63 + 1, 2**63], np.uint64))
    assert huge["mae", "Fz"].n == 3
