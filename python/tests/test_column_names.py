"""Columns matched by name and rows by key, for all kinds of labelled data."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import taceva

pd = pytest.importorskip("pandas")

ROWS = 12
ERROR = 0.1


def frames() -> tuple[Any, Any]:
    """Truth, and predictions with an error of 0.1 everywhere."""
    generator = np.random.default_rng(3)
    truth = pd.DataFrame({name: generator.normal(size=ROWS) for name in ("Px", "Fz")})
    return truth, truth + ERROR


def shuffled(frame: Any) -> Any:
    return frame.sample(frac=1.0, random_state=1)


def mae(result: taceva.Result, channel: str = "Fz") -> float:
    return float(result["mae", channel])


def test_columns_in_another_order_are_matched_by_name_and_named_in_the_result() -> None:
    truth, prediction = frames()
    result = taceva.score(truth, prediction[["Fz", "Px"]])
    assert mae(result) == pytest.approx(ERROR) and mae(result, "Px") == pytest.approx(ERROR)
    for other in (truth.to_dict("list"), truth.to_records(index=False)):
        assert mae(taceva.score(other, prediction[["Fz", "Px"]])) == pytest.approx(ERROR)
    assert mae(taceva.score(truth.to_numpy(), prediction, channels=["Px", "Fz"])) == pytest.approx(ERROR)


def test_polars_and_arrow_tables_are_matched_by_name() -> None:
    truth, prediction = frames()
    polars = pytest.importorskip("polars")
    assert mae(taceva.score(polars.DataFrame(truth.to_dict("list")), prediction[["Fz", "Px"]])) == pytest.approx(ERROR)
    arrow = pytest.importorskip("pyarrow")
    table = arrow.table(prediction[["Fz", "Px"]].to_dict("list"))
    assert mae(taceva.score(truth, table)) == pytest.approx(ERROR)


def test_shuffled_rows_are_paired_by_their_index_and_it_is_said() -> None:
    truth, prediction = frames()
    result = taceva.score(truth, shuffled(prediction))
    assert mae(result) == pytest.approx(ERROR)
    assert any("by the index" in note for note in result.notes)
    series = taceva.score(truth["Fz"], shuffled(prediction["Fz"]), channels=["Fz"])
    assert mae(series) == pytest.approx(ERROR)
    named = truth.set_axis([f"press {row}" for row in range(ROWS)])
    assert mae(taceva.score(named, shuffled(named + ERROR))) == pytest.approx(ERROR)


def test_a_key_column_pairs_rows_whatever_their_index() -> None:
    truth, prediction = frames()
    for key in ("sample", "id", "sample_id", "index"):
        names = [f"s{row}" for row in range(ROWS)]
        mixed = shuffled(prediction.assign(**{key: names})).reset_index(drop=True)
        result = taceva.score(truth.assign(**{key: names}), mixed)
        assert mae(result) == pytest.approx(ERROR)
        assert any(f"by `{key}`" in note for note in result.notes)


def test_indices_of_other_rows_or_that_repeat_are_refused_with_the_remedy() -> None:
    truth, prediction = frames()
    with pytest.raises(ValueError, match="no row of prediction has the index"):
        taceva.score(truth.iloc[4:8], pd.DataFrame(prediction.iloc[4:8].to_numpy(), columns=["Px", "Fz"]))
    with pytest.raises(ValueError, match="occurs twice in prediction"):
        taceva.score(truth, shuffled(prediction).set_axis([0, 0, *range(2, ROWS)]))
    twice = prediction.assign(sample=[0, 1, 1, *range(3, ROWS)])
    with pytest.raises(ValueError, match="key 'sample' 1 occurs twice in prediction"):
        taceva.score(truth.assign(sample=range(ROWS)), twice)


def test_keys_that_differ_in_blanks_or_case_are_refused_with_both() -> None:
    truth, prediction = frames()
    rest = [f"b{row}" for row in range(1, ROWS)]
    for one, other in (("press 1", "press1"), ("Press_1", "press_1"), ("P 1", "p1"), (" p1", "p1")):
        said = f"{one!r}, which row 0 of truth has, although {other!r} differs only in blanks or case"
        with pytest.raises(ValueError, match=said):
            taceva.score(truth.assign(sample=[one, *rest]), prediction.assign(sample=[other, *rest]))
        with pytest.raises(ValueError, match=said):
            taceva.score(truth.set_axis([one, *rest]), prediction.set_axis([other, *rest]))
    with pytest.raises(ValueError, match="'a', which row 0 of truth has; correct"):
        taceva.score(truth.assign(sample=["a", *rest]), prediction.assign(sample=["c", *rest]))


def test_two_keys_that_pair_rows_differently_are_refused() -> None:
    truth, prediction = frames()
    names = [f"s{row}" for row in range(ROWS)]
    one = truth.assign(sample=names).set_axis(range(100, 100 + ROWS))
    other = shuffled(prediction.assign(sample=names)).set_axis(range(100, 100 + ROWS))
    with pytest.raises(ValueError, match="paired by 'sample', but the index is"):
        taceva.score(one, other)


def test_rows_that_disagree_in_time_or_point_are_refused() -> None:
    truth, prediction = frames()
    times = np.arange(ROWS) / 30.0
    with pytest.raises(ValueError, match="row 0: t_s is"):
        taceva.score(truth.assign(t_s=times), prediction.assign(t_s=times + 0.1))
    with pytest.raises(ValueError, match="row 1: point_id is"):
        taceva.score(truth.assign(point_id=["a"] * ROWS), prediction.assign(point_id=["a", *["b"] * (ROWS - 1)]))


def test_other_columns_are_refused_by_name() -> None:
    truth, prediction = frames()
    with pytest.raises(ValueError, match="truth has no column 'force'"):
        taceva.score(truth, prediction.rename(columns={"Fz": "force"}), channels=["force"])
    with pytest.raises(ValueError, match="prediction has no column 'Px', which truth has"):
        taceva.score(truth, prediction[["Fz"]])
    assert mae(taceva.score(truth, prediction[["Fz"]], channels=["Fz"])) == pytest.approx(ERROR)


def test_contact_points_of_a_column_or_a_shuffled_series_go_with_their_rows() -> None:
    truth, prediction = frames()
    points = pd.Series([f"p{row // 2}" for row in range(ROWS)])
    expected = taceva.score(truth, prediction, points=points.to_list())
    for result in (
        taceva.score(truth.assign(point_id=points), shuffled(prediction)),
        taceva.score(truth, prediction, points=shuffled(points)),
    ):
        assert result["mae", "Fz"].interval == expected["mae", "Fz"].interval
        assert result["mae", "Fz"].interval is not None


def test_streamed_frames_are_matched_and_remembered_over_merge_and_pickle() -> None:
    import pickle

    truth, prediction = frames()
    metrics = taceva.TactileMetrics(["Px", "Fz"])
    metrics.update(truth, shuffled(prediction)[["Fz", "Px"]])
    again = taceva.TactileMetrics(["Px", "Fz"])
    again.merge(pickle.loads(pickle.dumps(metrics)))
    assert mae(again.compute()) == pytest.approx(ERROR)
    assert any("by the index" in note for note in again.compute().notes)


def test_a_key_of_the_caller_pairs_rows_and_is_no_channel() -> None:
    truth, prediction = frames()
    touched = truth.assign(touch=range(ROWS))
    mixed = shuffled(prediction.assign(touch=range(ROWS))).reset_index(drop=True)
    result = taceva.score(touched, mixed, key="touch")
    assert mae(result) == pytest.approx(ERROR) and ("mae", "touch") not in result
    assert any("by `touch`" in note for note in result.notes)
    metrics = taceva.TactileMetrics(["Px", "Fz"])
    metrics.update(touched, mixed, key="touch")
    assert mae(metrics.compute()) == pytest.approx(ERROR)
    by_order = taceva.score(truth.assign(sample=range(ROWS)), prediction.assign(sample=range(ROWS)[::-1]), key="order")
    assert mae(by_order) == pytest.approx(ERROR) and any("by order, as requested" in note for note in by_order.notes)
    with pytest.raises(ValueError, match="key='trial': truth has no such column: expected a column of both tables, or 'order'"):
        taceva.score(touched, mixed, key="trial")
    with pytest.raises(ValueError, match="key='touch' names a column, but truth and prediction are arrays without names"):
        taceva.score(truth.to_numpy(), prediction.to_numpy(), channels=["Px", "Fz"], key="touch")


def test_a_column_of_unique_whole_numbers_in_both_is_refused_as_a_channel() -> None:
    truth, prediction = (frame.assign(touch=range(ROWS)) for frame in frames())
    with pytest.raises(ValueError, match="the column 'touch' holds the same unique whole numbers .* pair rows with key='touch'"):
        taceva.score(truth, shuffled(prediction).reset_index(drop=True))
    assert taceva.score(truth, prediction, units={"touch": "1"})["mae", "touch"].value == 0.0
    assert taceva.score(truth, prediction, channels=["Fz", "touch"])["mae", "touch"].value == 0.0


def test_contact_points_may_be_named_by_their_column() -> None:
    truth, prediction = frames()
    points = [f"p{row // 2}" for row in range(ROWS)]
    expected = taceva.score(truth, prediction, points=points)["mae", "Fz"].interval
    assert expected is not None
    for result in (
        taceva.score(truth.assign(point=points), shuffled(prediction), points="point"),
        taceva.score(truth, prediction.assign(point=points), points="point"),
    ):
        assert result["mae", "Fz"].interval == expected
    unused = taceva.score(truth.assign(point=points), prediction)
    assert "the column `point` was not used: give points='point' if it names contact points" in unused.notes
    with pytest.raises(ValueError, match="points='pint': no such column, expected one of Px, Fz, point, or one value per row"):
        taceva.score(truth.assign(point=points), prediction, points="pint")


def test_a_number_that_is_not_finite_is_named_by_the_row_and_column_of_the_frame() -> None:
    truth, prediction = frames()
    mixed = shuffled(prediction.assign(id=range(ROWS))).reset_index(drop=True)
    mixed.loc[[3, 8], "Fz"] = np.nan
    row = min([3, 8], key=lambda at: mixed["id"][at])
    assert row != mixed["id"][row]
    with pytest.raises(ValueError, match=rf"prediction row {row} \(row {mixed['id'][row]} of truth\), column Fz: nan; 2 such rows"):
        taceva.score(truth.assign(id=range(ROWS)), mixed)


def test_arrays_without_names_are_scored_as_ever() -> None:
    truth, prediction = (frame.to_numpy() for frame in frames())
    assert taceva.score(truth, prediction, channels=["Px", "Fz"]).notes == []
