"""Scores of arrays equal those of the command, whatever the form, order and division of the arrays."""

from __future__ import annotations

import json
import pickle
import random
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
import taceva
from conftest import taceva as command

ROWS = 10_000
CHANNELS = ["Px", "Py", "Pz", "Fx", "Fy", "Fz"]


def arrays() -> tuple[Any, Any, Any]:
    """Truth, prediction and points, from a fixed seed."""
    generator = np.random.default_rng(7)
    truth = generator.normal(size=(ROWS, 6))
    return truth, truth + 0.1 * generator.normal(size=(ROWS, 6)), generator.integers(0, 50, size=ROWS)


def metrics_of(result: taceva.Result) -> dict[str, Any]:
    return dict(result.to_dict()["metrics"])


def write_tables(folder: Path, truth: Any, prediction: Any, points: Any) -> tuple[Path, Path]:
    """Write the arrays as tables for `taceva score`."""
    tables = folder / "truth.csv", folder / "prediction.csv"
    for path, values in zip(tables, (truth, prediction), strict=True):
        with path.open("w") as file:
            print("point_id", *CHANNELS, sep=",", file=file)
            for point, row in zip(points.tolist(), values.tolist(), strict=True):
                print(point, *map(repr, row), sep=",", file=file)
    return tables


def test_bits_equal_those_of_the_command(tmp_path: Path) -> None:
    truth, prediction, points = arrays()
    truth, prediction, points = truth[:500], prediction[:500], points[:500]
    paths = write_tables(tmp_path, truth, prediction, points)
    out = tmp_path / "scores.json"
    done = command("score", "--truth", paths[0], "--pred", paths[1], "--format", "json", "--out", out)
    assert done.returncode == 0, done.stderr
    tables = taceva.score_tables(*paths)
    assert tables.text == out.read_text()
    saved = tmp_path / "saved.json"
    tables.save(saved)
    assert saved.read_bytes() == out.read_bytes()
    of_arrays = taceva.score(truth, prediction, points=points)
    of_tables = json.loads(out.read_text())["metrics"]
    for metric, scores in metrics_of(of_arrays).items():
        assert scores == of_tables[metric], metric


def test_bits_do_not_depend_on_division_order_merging_or_pickles() -> None:
    truth, prediction, points = arrays()
    whole = taceva.TactileMetrics()
    whole.update(truth, prediction, points)
    order = list(range(0, ROWS, 777))
    random.Random(3).shuffle(order)
    parts = [taceva.TactileMetrics() for _ in range(3)]
    for at, first in enumerate(order):
        rows = slice(first, first + 777)
        parts[at % 3].update(truth[rows], prediction[rows], points[rows])
    merged = pickle.loads(pickle.dumps(parts[0]))
    merged.merge(parts[1])
    merged.merge_states(parts[2].states())
    assert merged.compute().text == whole.compute().text
    assert whole.compute().text == whole.compute().text


def test_values_are_those_of_scikit_learn() -> None:
    sklearn = pytest.importorskip("sklearn.metrics")
    truth, prediction, _ = arrays()
    result = taceva.score(truth, prediction)
    for at, channel in enumerate(CHANNELS):
        of = truth[:, at], prediction[:, at]
        assert result["mae", channel].value == pytest.approx(sklearn.mean_absolute_error(*of), abs=1e-12)
        assert result["r2", channel].value == pytest.approx(sklearn.r2_score(*of), abs=1e-12)


@pytest.mark.parametrize(
    "form",
    [
        lambda array: np.asfortranarray(array),
        lambda array: array.astype(">f8"),
        lambda array: np.repeat(array, 2, axis=0)[::2],
        lambda array: array[::-1][::-1],
        lambda array: array.tolist(),
    ],
    ids=["fortran", "byte order", "stride", "negative stride", "list"],
)
def test_an_array_of_another_form_gives_the_same_scores(form: Any) -> None:
    truth, prediction, points = arrays()
    expected = taceva.score(truth, prediction, points=points)
    assert taceva.score(form(truth), form(prediction), points=points).text == expected.text


def test_a_read_only_array_is_taken() -> None:
    truth, prediction, _ = arrays()
    truth.setflags(write=False)
    assert taceva.score(truth, prediction)["mae", "Fz"].n == ROWS


def test_points_by_number_and_by_text_are_the_same() -> None:
    truth, prediction, points = arrays()
    by_text = taceva.score(truth, prediction, points=[str(point) for point in points.tolist()])
    assert by_text.text == taceva.score(truth, prediction, points=points).text
    assert by_text["mae", "Fz"].interval is not None
    assert taceva.score(truth, prediction)["mae", "Fz"].interval is None


def test_no_rows_give_undefined_scores_with_a_reason() -> None:
    score = taceva.score(np.zeros((0, 6)), np.zeros((0, 6)))["mae", "Fz"]
    assert (score.value, score.n) == (None, 0)
    assert score.reason
    with pytest.raises(ValueError, match="undefined"):
        float(score)


@pytest.mark.parametrize(
    ("truth", "prediction", "error", "message"),
    [
        (np.zeros((3, 5)), np.zeros((3, 6)), ValueError, r"truth has the shape \[3, 5\], expected \[rows, 6\]"),
        (np.zeros((3, 6)), np.zeros((2, 6)), ValueError, "prediction has 2 rows, truth has 3"),
        (np.zeros((3, 6)), np.zeros((1, 6)), ValueError, "prediction has 1 row, truth has 3"),
        (np.zeros((3, 6), complex), np.zeros((3, 6)), TypeError, "complex128"),
        (np.full((3, 6), None), np.zeros((3, 6)), TypeError, "object"),
        (np.array([["a"] * 6]), np.zeros((1, 6)), TypeError, "truth: expected numbers"),
        (np.zeros((3, 6)), np.array([[0.0] * 6, [0.0] * 6, [0.0] * 5 + [np.nan]]), ValueError, "prediction row 2, column Fz: nan"),
        (np.zeros((1, 6)), np.array([[np.inf] + [0.0] * 5]), ValueError, "prediction row 0, column Px: inf"),
    ],
    ids=["shape", "length", "one row", "complex", "objects", "texts", "nan", "infinite"],
)
def test_what_is_no_array_of_numbers_is_refused_and_nothing_is_taken_in(
    truth: Any, prediction: Any, error: type[Exception], message: str
) -> None:
    metrics = taceva.TactileMetrics()
    with pytest.raises(error, match=message):
        metrics.update(truth, prediction)
    assert metrics.compute()["mae", "Fz"].n == 0


def test_invalid_samples_are_counted_where_that_is_allowed() -> None:
    truth = np.zeros((3, 6))
    prediction = np.zeros((3, 6))
    prediction[1, 5] = np.nan
    result = taceva.score(truth, prediction, allow_invalid=True)
    score = result["mae", "Fz"]
    assert (score.n, score.n_invalid) == (2, 1)
    assert result.notes == ["rows with NaN or an infinite number were left out: 1 of 3 of Fz"]


def test_unknown_names_are_refused_with_the_nearest() -> None:
    with pytest.raises(ValueError, match="mae"):
        taceva.TactileMetrics(metrics="maee")
    with pytest.raises(TypeError, match="list of names"):
        taceva.TactileMetrics("Fz")
    with pytest.raises(ValueError, match="Fz is in N, found mm"):
        taceva.TactileMetrics(["Fz"], units={"Fz": "mm"})
    with pytest.raises(ValueError, match="Mz, expected channels among Fz"):
        taceva.TactileMetrics(["Fz"], units={"Mz": "N·mm"})
    with pytest.raises(ValueError, match="no channel"):
        taceva.TactileMetrics([])
    with pytest.raises(ValueError, match=r"expected \[rows, 6\]: one column per channel, or give channels=\[…\]"):
        taceva.score([[0.0, 0.0]], [[0.0, 0.0]])
    result = taceva.score([[0.0]], [[0.0]], channels=["Fz"])
    with pytest.raises(KeyError, match="known are mae"):
        result["hausdorff", "Fz"]


def test_a_pickle_of_another_version_is_refused() -> None:
    metrics = taceva.TactileMetrics()
    state = metrics.__getstate__()
    state["version"] = 99
    with pytest.raises(ValueError, match="version 99"):
        metrics.__setstate__(state)


def test_a_result_that_was_changed_is_refused(tmp_path: Path) -> None:
    result = taceva.score([[0.0], [1.0]], [[0.5], [1.0]], channels=["Fz"])
    path = tmp_path / "scores.json"
    result.save(path)
    assert taceva.load(path) == result
    with pytest.raises(FileExistsError):
        result.save(path)
    path.write_text(path.read_text().replace("0.25", "0.35"))
    with pytest.raises(ValueError, match="seal|changed|digest"):
        taceva.load(path)


def test_a_result_is_a_frame_a_table_and_a_page(tmp_path: Path) -> None:
    truth, prediction, points = arrays()
    result = taceva.score(truth, prediction, points=points)
    assert "mae" in str(result)
    assert r"\begin{tabular}" in result.to_latex()
    assert "<table" in result._repr_html_()
    pytest.importorskip("pandas")
    frame = result.to_frame()
    assert list(frame["value"])[0] == result["mae", "Px"].value
    assert frame.attrs["source"] == "unknown"


def test_print_page_and_latex_state_the_number_of_samples_and_of_clusters_once() -> None:
    truth, prediction, points = (array[:600] for array in arrays())
    result = taceva.score(truth, prediction, points=points, name="mine")
    title = "Scores of mine on 600 samples in 50 clusters by contact point, with 95 "
    for shown in (str(result), result._repr_html_(), result.to_latex()):
        assert shown.count(title) >= 1, shown
    assert str(result).count(" 600 ") == 1
    alone = taceva.score(truth, prediction, independent=True)
    assert "Scores of predictions on 600 samples, with 95 % intervals." in str(alone)


def test_a_score_without_an_interval_has_the_reason_and_the_table_states_it_once() -> None:
    truth, prediction, points = (array[:600] for array in arrays())
    result, pointed = taceva.score(truth, prediction), taceva.score(truth, prediction, points=points)
    assert {score.interval_reason for score in result.scores()} == {"samples without point_id"}
    assert {score.interval_reason for score in pointed.scores()} == {None}
    assert str(result).count("samples without point_id") == 1
    assert set(result.to_frame()["interval_reason"]) == {"samples without point_id"}
    comparison = str(taceva.compare(result, result, metrics=["mae"]))
    assert "has an interval, so no difference is tested: samples without point_id" in " ".join(comparison.split())
    assert "skill" not in comparison


def test_a_report_is_the_page_of_the_command_and_replaces_none_by_itself(tmp_path: Path) -> None:
    truth, prediction, points = (array[:600] for array in arrays())
    result = taceva.score(truth, prediction, points=points, name="mine")
    page = taceva.report(result, tmp_path / "of_result")
    assert page == tmp_path / "of_result" / "report.html"
    result.save(tmp_path / "mine.json")
    result.save_samples(tmp_path / "mine.samples.csv")
    assert taceva.report(tmp_path / "mine.json", tmp_path / "of_file").read_bytes() == page.read_bytes()
    done = command("report", tmp_path / "mine.json", "--out", tmp_path / "of_command", "--quiet")
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "of_command" / "report.html").read_bytes() == page.read_bytes()
    assert (tmp_path / "of_result" / "figures" / "predicted-1.svg").is_file()
    with pytest.raises(ValueError, match="exists already"):
        taceva.report(result, tmp_path / "of_result")
    assert taceva.report(result, tmp_path / "of_result", replace=True) == page
    with pytest.raises(ValueError, match="no such file or folder"):
        taceva.report(tmp_path / "nowhere.json", tmp_path / "none")


def test_whatever_is_shown_of_samples_that_nobody_measured_says_so(tmp_path: Path) -> None:
    labels = np.random.default_rng(1).uniform(size=(40, 1))
    frames = (200 * labels[:, :, None] + np.arange(8)).astype(np.uint8).repeat(6, axis=1)
    made = taceva.from_arrays(tmp_path / "made", labels, frames, sensor="gel", source="synthetic", channels=["Fz"])
    drawn = taceva.evaluate(made, lambda seen: np.zeros((len(seen), 1)))
    of_arrays = taceva.score(labels, labels + 0.1, channels=["Fz"])
    said = "Nothing here was measured: the samples are synthetic."
    together = taceva.compare(drawn, drawn)
    for shown in (str(drawn), drawn.to_latex(), drawn._repr_html_(), str(together), together.to_latex(), together._repr_html_()):
        assert said in shown
    assert "training data are unknown" in str(drawn) and "training data are unknown" in drawn._repr_html_()
    assert "Not everything here was measured: all samples whose origin is named are synthetic." in str(taceva.compare(drawn, of_arrays))
    assert "measured" not in str(of_arrays)


def test_a_comparison_says_which_is_better() -> None:
    truth, prediction, points = arrays()
    near = taceva.score(truth, truth + 0.1 * (prediction - truth), points=points)
    far = taceva.score(truth, prediction, points=points)
    comparison = taceva.compare(near, far)
    assert comparison.to_dict()["schema"].startswith("taceva.comparison/")
    assert "better" in str(comparison)
    with pytest.raises(ValueError, match="at least two"):
        taceva.compare(near)
    with pytest.raises(ValueError, match="did you mean `mae`"):
        str(taceva.compare(near, far, metrics=["mea"]))


def deciding_tests(comparison: taceva.Comparison) -> set[str]:
    """Return the tests behind the answers for MAE."""
    answers = comparison.to_dict()["answers"]
    return {answer["difference"]["test"] for answer in answers if answer["metric"] == "mae" and answer["difference"]}


def test_results_of_the_same_samples_are_compared_in_pairs(tmp_path: Path) -> None:
    truth, prediction, points = (array[:600] for array in arrays())
    # Greater errors that both share hide the difference from the intervals.
    shared = np.random.default_rng(1).exponential(0.3, size=truth.shape)
    near, far = truth + shared, truth + shared + 0.02 * np.abs(prediction - truth)
    of_arrays = [taceva.score(truth, found, points=points) for found in (near, far)]
    tables = []
    for name, found in (("near", near), ("far", far)):
        (tmp_path / name).mkdir()
        tables.append(taceva.score_tables(*write_tables(tmp_path / name, truth, found, points), key="order"))
    for results in (of_arrays, tables, pickle.loads(pickle.dumps(of_arrays))):
        paired = taceva.compare(*results, metrics=["mae"])
        assert len(deciding_tests(paired)) == 1 and "sign" in str(deciding_tests(paired)), deciding_tests(paired)
        assert "no samples are kept" not in str(paired)
    answers = taceva.compare(*of_arrays, metrics=["mae"]).to_dict()["answers"]
    assert all(answer["difference"]["shown"] for answer in answers)


def test_arrays_that_change_after_they_were_scored_are_compared_as_they_were_scored() -> None:
    truth, prediction, points = (array[:600] for array in arrays())
    buffer, results = prediction.copy(), []
    for scale in (1.0, 1.5):
        buffer[:] = truth + scale * (prediction - truth)
        results.append(taceva.score(truth, buffer, points=points))
    buffer[:] = 0.0
    assert "sign" in str(deciding_tests(taceva.compare(*results, metrics=["mae"])))


def test_results_without_samples_are_compared_by_intervals_and_a_note_states_it(tmp_path: Path) -> None:
    truth, prediction, points = (array[:600] for array in arrays())
    result = taceva.score(truth, prediction, points=points)
    sums = taceva.TactileMetrics()
    sums.update(truth, truth + 2 * (prediction - truth), points)
    result.save(tmp_path / "scores.json")
    for other in (sums.compute(), taceva.load(tmp_path / "scores.json")):
        comparison = taceva.compare(result, other, metrics=["mae"])
        assert deciding_tests(comparison) == {"by the intervals of both"}
        for shown in (str(comparison), comparison._repr_html_()):
            assert "no samples are kept with result 2: compared by the intervals of both" in " ".join(shown.split())
    with pytest.raises(ValueError, match="no samples are kept"):
        sums.compute().save_samples(tmp_path / "none.csv")
    result.save_samples(tmp_path / "scores.samples.csv")
    loaded = taceva.load(tmp_path / "scores.json")
    far = taceva.score(truth, truth + 2 * (prediction - truth), points=points)
    assert "sign" in str(deciding_tests(taceva.compare(loaded, far, metrics=["mae"])))


def test_a_comparison_has_a_narrow_table_of_the_main_scores_for_a_paper() -> None:
    truth, prediction, points = (array[:600] for array in arrays())
    near, far = (taceva.score(truth, truth + scale * (prediction - truth), points=points, name=name) for scale, name in ((0.5, "near"), (1, "far")))
    comparison = taceva.compare(near, far)
    assert comparison.to_latex().count("p by Holm") and "p by Holm" not in comparison.to_latex("main")
    assert "near" in comparison.to_latex("main") and r"\toprule" in comparison.to_latex("main")
    with pytest.raises(ValueError, match="table 'wide': expected 'all' or 'main'"):
        comparison.to_latex("wide")


def test_the_first_figure_of_a_comparison_has_the_values_of_the_asked_metric_with_intervals(tmp_path: Path) -> None:
    truth, prediction, points = (array[:600] for array in arrays())
    results = [taceva.score(truth, truth + scale * (prediction - truth), points=points) for scale in (0.5, 1)]
    figures = taceva.compare(*results, metrics=["mae"]).figures()
    assert figures[0].name == "intervals-mae" and "n is 600." in figures[0].caption
    assert [figure.name for figure in figures].count("intervals-mae") == 1
    figures[0].save(tmp_path / "mae.pdf")
    assert (tmp_path / "mae.pdf").read_bytes().startswith(b"%PDF")
    assert all(not figure.name.startswith("intervals") for figure in results[0].figures())


def test_a_score_of_arrays_has_the_name_of_the_caller_in_tables_and_comparisons() -> None:
    truth, prediction, points = (array[:600] for array in arrays())
    results = [taceva.score(truth, prediction, points=points, name=name) for name in ("mine", "theirs")]
    assert "mine" in str(results[0]) and "mine" in results[0].to_latex() and "unknown" not in str(results[0])
    assert taceva.compare(*results).to_dict()["of"] == ["mine", "theirs"]
    metrics = taceva.TactileMetrics()
    metrics.update(truth, prediction, points)
    assert metrics.compute(name="mine")["mae", "Fz"] == results[0]["mae", "Fz"] and "mine" in str(metrics.compute(name="mine"))


def test_one_row_that_makes_most_of_the_squared_error_is_named() -> None:
    truth, prediction, _ = (array[:600] for array in arrays())
    assert not any("squared error" in note for note in taceva.score(truth, prediction).notes)
    prediction[17, 5] += 50.0
    expected = "Fz: row 17 makes 100 % of the squared error: look at its truth and its prediction"
    assert taceva.score(truth, prediction).notes == [expected]
    with_angle = taceva.score(truth[:, 5], prediction[:, 5], channels=["yaw"], periods={"yaw": 360})
    assert not any("squared error" in note for note in with_angle.notes)


def test_an_angle_that_is_probably_in_radians_is_named_in_every_way_to_score() -> None:
    truth = np.linspace(-3.0, 3.0, 40)
    start = "yaw: all values lie within ±6.28, as angles in radians do, but are scored as degrees with a period of 360"
    remedy = "give units={'yaw': 'rad'} for radians, or units={'yaw': 'deg'} for degrees"

    def notes(metrics: taceva.TactileMetrics) -> list[str]:
        return [note for note in metrics.compute().notes if note.startswith("yaw")]

    metrics = taceva.TactileMetrics(["yaw"], periods={"yaw": 360})
    assert not notes(metrics)
    metrics.update(truth, truth + 0.01)
    [note] = notes(metrics)
    assert note.startswith(start) and note.endswith(remedy)
    assert note in taceva.score(truth, truth + 0.01, channels=["yaw"], periods={"yaw": 360}).notes
    assert note in metrics.forward(truth, truth).notes
    merged = taceva.TactileMetrics(["yaw"], periods={"yaw": 360})
    merged.merge_states(metrics.states())
    assert notes(merged) == notes(pickle.loads(pickle.dumps(metrics))) == [note]
    # One value beyond a period in radians, in either column, shows degrees.
    merged.update([7.0], [0.0])
    assert not notes(merged)
    for units in ({"yaw": "rad"}, {"yaw": "deg"}):
        stated = taceva.TactileMetrics(["yaw"], periods={"yaw": 360}, units=units)
        stated.update(truth, truth)
        assert not notes(stated)
    metrics.reset()
    assert not notes(metrics)


def test_a_channel_that_is_probably_mistyped_is_refused_and_any_other_unknown_one_is_noted(tmp_path: Path) -> None:
    rows = [[0.0, 1.0], [1.0, 2.0]]
    for name in ("Fq", "fx", "PZ"):
        with pytest.raises(ValueError, match=f"channel '{name}' has no known unit: expected Px, Py, Pz, Fx, Fy or Fz, or its unit"):
            taceva.score(rows, rows, channels=["Fz", name])
        with pytest.raises(ValueError, match=f"channel '{name}' has no known unit"):
            taceva.from_arrays(tmp_path / name, rows, channels=["Fz", name], sensor="gel", source="synthetic")
        assert taceva.score(rows, rows, channels=["Fz", name], units={name: "N"})["mae", name].unit == "N"
    normal = taceva.score(rows, rows, channels=["Fn", "Ft"])
    assert normal["mae", "Fn"].value == 0.0 and any(note.startswith("Ft: not one of") for note in normal.notes)
    noted = taceva.score(rows, rows, channels=["Fz", "force_z"])
    assert any(note.startswith("force_z: not one of Px Py Pz Fx Fy Fz; scored as a channel with the unit 1") for note in noted.notes)
    assert not taceva.score(rows, rows, channels=["Fz", "force_z"], units={"force_z": "N"}).notes
    metrics = pickle.loads(pickle.dumps(taceva.TactileMetrics(["Fz", "force_z"])))
    assert any("force_z" in note for note in metrics(rows, rows).notes)


def test_skipped_metrics_name_the_place_of_their_reasons() -> None:
    result = taceva.score([[0.0], [1.0]], [[0.5], [1.0]], channels=["Fz"], metrics="all")
    assert result.skipped and "See result.skipped for the reasons." in str(result)


@pytest.mark.parametrize("channels", [["Fz", "Px"], ["Fz", "b", "Px", "a"], ["b", "a"]])
def test_columns_of_arrays_are_those_of_the_channels_in_any_order(channels: list[str]) -> None:
    truth = np.random.default_rng(3).uniform(1, 2, (50, len(channels)))
    errors = 0.25 * np.arange(len(channels))
    scores = taceva.score(truth, truth - errors, channels=channels, metrics="bias")
    assert [scores["bias", channel].value for channel in channels] == pytest.approx(errors.tolist())
    frame = pd.DataFrame(truth, columns=channels)
    named = taceva.score(frame, frame - errors, metrics="bias")
    assert [named["bias", channel].value for channel in channels] == pytest.approx(errors.tolist())
    parts = taceva.TactileMetrics(channels, "bias")
    parts.merge_states(parts.states())
    parts = pickle.loads(pickle.dumps(parts))
    parts(truth, truth - errors)
    assert [float(parts.compute()["bias", channel]) for channel in channels] == pytest.approx(errors.tolist())
