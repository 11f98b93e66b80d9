"""Common first attempts in notebooks: each works, or is rejected with a clear message."""

from __future__ import annotations

import pickle
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import taceva

SIX = ["Px", "Py", "Pz", "Fx", "Fy", "Fz"]


def arrays(rows: int = 120) -> tuple[Any, Any, Any]:
    generator = np.random.default_rng(8)
    truth = generator.normal(size=(rows, 6))
    return truth, truth + 0.1 * generator.normal(size=(rows, 6)), np.arange(rows) // 6


def test_a_result_is_a_mapping_of_metric_and_channel() -> None:
    truth, prediction, points = arrays()
    result = taceva.score(truth, prediction, points=points)
    assert isinstance(result, Mapping)
    assert list(result) == [(score.metric, score.channel) for score in result.scores()] == list(result.keys())
    assert len(result) == len(result.scores()) == len(list(result.items()))
    assert {channel: score.value for channel, score in result["mae"].items()}["Fz"] == result["mae", "Fz"].value
    assert "mae" in result and ("mae", "Fz") in result
    assert "sr" not in result and ("mae", "Mz") not in result and 3 not in result
    assert result.get(("mae", "Mz")) is None
    for wrong in (0, ("mae", "Fz", "Fz"), slice(None)):
        with pytest.raises(KeyError, match="expected a metric and a channel"):
            result[wrong]  # type: ignore[index]
    with pytest.raises(KeyError, match="known are Px"):
        result["mae", "Mz"]
    assert pickle.loads(pickle.dumps(result)) == result and result in {result}


def test_a_score_is_a_number_that_can_be_formatted_rounded_and_compared() -> None:
    truth = np.array([0.0, 1.0, 2.0, 4.0])
    result = taceva.score(truth, truth + 0.125, channels=["Fz"])
    mae = result["mae", "Fz"]
    assert (f"{mae:.2f}", f"{mae:8.3f}", f"{mae}", str(mae)) == ("0.12", "   0.125", "0.125 N", "0.125 N")
    assert str(result["r2", "Fz"]) == str(result["r2", "Fz"].value)
    assert round(mae, 2) == 0.12 and np.asarray([float(score) for score in result["mae"].values()]).tolist() == [0.125]
    assert mae < 0.2 <= 0.2 and mae <= 0.125 and mae > 0.1 and mae >= result["bias", "Fz"]
    with pytest.raises(ValueError, match="expected one unit"):
        assert mae < result["r2", "Fz"]
    nothing = taceva.score(np.zeros((0, 1)), np.zeros((0, 1)), channels=["Fz"])["mae", "Fz"]
    assert "undefined" in str(nothing)
    with pytest.raises(ValueError, match="undefined"):
        f"{nothing:.3f}"


def test_rmse_and_bias_are_there_and_a_table_says_what_it_leaves_out() -> None:
    truth, prediction, points = arrays()
    result = taceva.score(truth, prediction, points=points)
    error = prediction - truth
    for at, channel in enumerate(SIX):
        assert result["rmse", channel].value == pytest.approx(np.sqrt((error[:, at] ** 2).mean()), rel=1e-12)
        assert result["bias", channel].value == pytest.approx(-error[:, at].mean(), rel=1e-9)
    for shown in (str(result), result._repr_html_()):
        assert "Left out, since scores of their planes are shown: Px, Py, Fx, Fy" in shown
        assert "No intervals" not in shown
    assert "No intervals: they need at least 5 contact points" in str(taceva.score(truth, prediction))
    assert "independent=True" in taceva.score(truth, prediction)._repr_html_()
    alone = taceva.score(truth[:, 5], prediction[:, 5], channels=["Fz"], metrics="all", independent=True)
    assert "Left out" not in str(alone) and "No intervals" not in str(alone)
    skipped = [what.removeprefix("metric:") for what in alone.skipped]
    assert skipped and f"Skipped: {', '.join(skipped)}." in str(alone)


def test_weights_functions_and_names_that_are_none_are_refused_with_the_remedy() -> None:
    truth, prediction, _ = arrays()
    metrics = taceva.TactileMetrics()
    for call in (lambda: taceva.score(truth, prediction, weights=np.ones(len(truth))), lambda: metrics.update(truth, prediction, sample_weight=[1])):
        with pytest.raises(TypeError, match="metrics count every sample once"):
            call()
    for wrong in (np.mean, ["mae", np.mean]):
        with pytest.raises(TypeError, match="a function, expected names; taceva.score_function"):
            taceva.score(truth, prediction, metrics=wrong)  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="metrics: 3, expected names"):
        taceva.score(truth, prediction, metrics=["mae", 3])  # type: ignore[list-item]


def test_points_may_be_texts_of_any_kind() -> None:
    truth, prediction, points = arrays()
    expected = taceva.score(truth, prediction, points=points).text
    assert taceva.score(truth, prediction, points=points.astype(str)).text == expected
    strings = getattr(np.dtypes, "StringDType", None)
    if strings is not None:
        assert taceva.score(truth, prediction, points=points.astype(str).astype(strings())).text == expected


def test_frames_of_numbers_that_may_be_absent_are_taken() -> None:
    pandas = pytest.importorskip("pandas")
    truth, prediction, points = arrays()
    expected = taceva.score(truth, prediction, points=points)
    frames = [pandas.DataFrame(array, columns=SIX).astype("Float64") for array in (truth, prediction)]
    found = taceva.score(*frames, points=points)
    assert [score.value for score in found.scores()] == [score.value for score in expected.scores()]
    frames[1].iloc[0, 0] = pandas.NA
    with pytest.raises(ValueError, match="prediction row 0, column Px: nan"):
        taceva.score(*frames, points=points)


@pytest.fixture(scope="module")
def drawn(tmp_path_factory: pytest.TempPathFactory) -> taceva.Dataset:
    generator = np.random.default_rng(2)
    labels = generator.uniform(size=(30, 2))
    frames = (generator.integers(0, 40, size=(30, 12, 16)) + 200 * labels[:, 1, None, None]).astype(np.uint8)
    path = tmp_path_factory.mktemp("drawn") / "recording"
    return taceva.from_arrays(path, labels, frames, sensor="gel", source="synthetic", channels=["Pz", "Fz"], points=np.arange(30) // 3)


def test_a_dataset_is_indexed_as_numpy_indexes(drawn: taceva.Dataset) -> None:
    frames, labels = drawn.frames(), drawn.labels()
    mask = labels[:, 1] > 0.5
    for rows in (slice(3, 20, 4), slice(None, None, -1), slice(-4, None), mask, mask.tolist(), [-1, 0, 5], np.array([2, 2], np.uint64)):
        wanted = np.arange(30)[rows]
        assert np.array_equal(drawn.frames(rows), frames[wanted])
        found = drawn[rows]
        assert np.array_equal(found.labels, labels[wanted]) and found.seen is not None and np.array_equal(found.seen, frames[wanted])
        assert np.array_equal(drawn.features(rows, settings={"size": "8x6"}), drawn.features(settings={"size": "8x6"})[wanted])
    for row in (0, -1, np.int64(7)):
        frame, own = drawn[row]
        assert frame is not None and np.array_equal(frame, frames[row]) and np.array_equal(own, labels[row])
    assert [own[1] for _, own in drawn] == labels[:, 1].tolist()
    with pytest.raises(IndexError, match="row 30: the recording has 30 rows"):
        drawn[30]
    with pytest.raises(IndexError, match="row -31"):
        drawn.frames([-31])
    with pytest.raises(IndexError, match="a mask of 29 rows"):
        drawn.frames(mask[:-1])
    with pytest.raises(TypeError, match="a mask or a slice"):
        drawn.frames(np.array([0.5]))


def test_a_module_of_double_precision_gets_pictures_of_its_own_precision(drawn: taceva.Dataset) -> None:
    torch = pytest.importorskip("torch")
    module = torch.nn.Sequential(torch.nn.Flatten(), torch.nn.Linear(12 * 16, 2))
    single = taceva.evaluate(drawn, module)
    double = taceva.evaluate(drawn, module.double())
    assert float(double["mae", "Fz"]) == pytest.approx(float(single["mae", "Fz"]), rel=1e-4)


def test_forward_gives_the_value_of_a_batch_and_adds_it() -> None:
    truth, prediction, points = arrays()
    metrics, whole = taceva.TactileMetrics(), taceva.TactileMetrics()
    whole.update(truth, prediction, points)
    for first in range(0, len(truth), 40):
        rows = slice(first, first + 40)
        batch = metrics(truth[rows], prediction[rows], points[rows])
        assert batch == taceva.score(truth[rows], prediction[rows], points=points[rows])
    assert metrics.compute() == whole.compute()
    with pytest.raises(ValueError):
        metrics.forward(truth, prediction[:3])
    assert metrics.compute() == whole.compute()


def test_sync_gives_the_samples_of_all_processes_and_counts_none_twice() -> None:
    truth, prediction, points = arrays()
    whole, parts = taceva.TactileMetrics(), [taceva.TactileMetrics() for _ in range(3)]
    whole.update(truth, prediction, points)
    for at, part in enumerate(parts):
        part.update(truth[at::3], prediction[at::3], points[at::3])
    sent: list[bytes] = []
    for part in parts:
        part.sync(lambda own: [sent.append(own) or own])  # type: ignore[func-returns-value]
    for part in parts:
        own = part.compute()
        assert part.sync(lambda _: sent).compute() == part.sync(lambda _: sent).compute() == whole.compute()
        assert part.compute() == own
    assert whole.sync().compute() == whole.compute()
    with pytest.raises(ValueError, match="states"):
        whole.sync(lambda own: [own[:-1]])


def test_sync_of_torch_gathers_every_process(tmp_path: Path) -> None:
    torch = pytest.importorskip("torch")
    if not torch.distributed.is_available():
        pytest.skip("torch without torch.distributed")
    torch.distributed.init_process_group("gloo", init_method=f"file://{tmp_path / 'group'}", rank=0, world_size=1)
    try:
        metrics = taceva.TactileMetrics(["Fz"])
        metrics.update([[0.0], [1.0]], [[0.5], [1.0]])
        assert metrics.sync().compute() == metrics.compute()
    finally:
        torch.distributed.destroy_process_group()


def test_a_function_is_a_metric_with_intervals_by_point() -> None:
    truth, prediction, points = arrays(600)

    def mean_error(true: Any, found: Any) -> Any:
        assert true.ndim == 1
        return np.abs(found - true).mean()

    ours = taceva.score(truth, prediction, points=points)
    scores = taceva.score_function(mean_error, truth, prediction, points=points)
    assert list(scores) == SIX
    for channel, score in scores.items():
        mae = ours["mae", channel]
        assert (score.metric, score.unit, score.n) == ("mean_error", mae.unit, 600)
        assert float(score) == pytest.approx(float(mae), rel=1e-12)
        assert score.interval is not None and mae.interval is not None
        width = mae.interval.high - mae.interval.low
        assert score.interval.low == pytest.approx(mae.interval.low, abs=0.3 * width)
        assert score.interval.high == pytest.approx(mae.interval.high, abs=0.3 * width)
    again = taceva.score_function(mean_error, truth, prediction, points=points)
    assert again == scores
    # Equal samples of one point widen the interval, as if each point were one sample.
    level = np.repeat(np.random.default_rng(3).normal(size=100), 6)[:, None]
    by_point, by_sample = (
        taceva.score_function(lambda true, found: (found - true).mean(), truth[:, :1], truth[:, :1] + level, channels=["Px"], **how)["Px"].interval
        for how in ({"points": points}, {"independent": True})
    )
    assert by_point is not None and by_sample is not None
    assert 1.8 < (by_point.high - by_point.low) / (by_sample.high - by_sample.low) < 3.2
    together = taceva.score_function(lambda true, found: np.linalg.norm(found - true, axis=1).max(), truth, prediction, together=True, draws=0, unit="1")
    assert list(together) == ["+".join(SIX)] and next(iter(together.values())).interval is None


def test_a_function_that_gives_no_number_is_refused_and_what_it_raises_comes_out() -> None:
    truth, prediction, points = arrays()
    with pytest.raises(TypeError, match="wrong returned list, expected a number for 120 rows"):
        taceva.score_function(lambda true, found: [1, 2], truth, prediction, name="wrong")
    with pytest.raises(ZeroDivisionError):
        taceva.score_function(lambda true, found: 1 / 0, truth, prediction)
    undefined = taceva.score_function(lambda true, found: float("nan"), truth, prediction, points=points, name="gap")["Fz"]
    assert (undefined.value, undefined.interval, undefined.reason) == (None, None, "gap returned nan")
    few = taceva.score_function(lambda true, found: 1.0, truth[:20], prediction[:20], points=points[:20])["Fz"]
    assert few.value == 1.0 and few.interval is None
    assert few.interval_reason and few.interval_reason.endswith("6 are needed")
    with pytest.raises(ValueError, match="draws 5: expected at least 100"):
        taceva.score_function(lambda true, found: 1.0, truth, prediction, draws=5)
    with pytest.raises(ValueError, match="points has 3 rows, truth has 120"):
        taceva.score_function(lambda true, found: 1.0, truth, prediction, points=[1, 2, 3])
    prediction[[7, 9], 5] = np.nan
    with pytest.raises(ValueError, match="prediction row 7, column Fz: nan; 2 such rows: expected finite numbers; leave out such rows first"):
        taceva.score_function(lambda true, found: 1.0, truth, prediction)


def test_labels_with_names_are_recorded_by_name(tmp_path: Path) -> None:
    columns = {"Fz": [1.0, 2.0, 3.0], "point_id": ["a", "a", "b"], "Px": [0.0, 0.1, 0.2]}
    dataset = taceva.from_arrays(tmp_path / "dict", columns, sensor="gel", source="synthetic")
    # A dataset has a fixed order of channels, whatever the order of the columns.
    assert dataset.channels == ("Px", "Fz") and dataset.points() == ["a", "a", "b"]
    assert dataset.labels().tolist() == [[0.0, 1.0], [0.1, 2.0], [0.2, 3.0]]
    plain = taceva.from_arrays(tmp_path / "plain", [[1.0, 0.0], [2.0, 0.1]], channels=["Fz", "Px"], sensor="gel", source="synthetic")
    assert plain.channels == ("Px", "Fz") and plain.labels().tolist() == [[0.0, 1.0], [0.1, 2.0]]
    with pytest.raises(ValueError, match="expected .rows, 2."):
        taceva.from_arrays(tmp_path / "wide", [[1.0, 0.0, 7.0]], channels=["Fz", "Px"], sensor="gel", source="synthetic")
    chosen = taceva.from_arrays(tmp_path / "chosen", columns, sensor="gel", source="synthetic", channels=["Px"])
    assert chosen.labels()[:, 0].tolist() == [0.0, 0.1, 0.2]
    with pytest.raises(ValueError, match="no column 'Py'"):
        taceva.from_arrays(tmp_path / "none", columns, sensor="gel", source="synthetic", channels=["Px", "Py"])


def test_labelled_arrays_of_xarray_go_out_and_come_in_by_name(drawn: taceva.Dataset) -> None:
    pytest.importorskip("xarray")
    labelled = drawn.to_xarray()
    assert labelled.sel(channel="Fz").values.tolist() == drawn.labels()[:, 1].tolist()
    assert labelled.unit.values.tolist() == ["mm", "N"] and labelled.attrs["source"] == "synthetic"
    shuffled = (labelled + 0.25).isel(sample=slice(None, None, -1), channel=[1, 0])
    result = taceva.score(labelled, shuffled)
    assert float(result["mae", "Fz"]) == pytest.approx(0.25) and float(result["mae", "Pz"]) == pytest.approx(0.25)


def test_a_model_has_the_channels_in_the_order_of_the_caller(tmp_path: Path) -> None:
    truth = np.random.default_rng(5).uniform(1, 2, (60, 3))
    names = ["Mz", "Fz", "Px"]
    frames = np.random.default_rng(6).integers(0, 255, (60, 32, 32), np.uint8)
    points = [str(row // 2) for row in range(60)]
    dataset = taceva.from_arrays(tmp_path / "three", truth, frames, channels=names, points=points, sensor="gel", source="synthetic")
    in_order = {name: truth[:, at] for at, name in enumerate(names)}
    by_frame = {frame.tobytes(): row for row, frame in enumerate(frames)}
    for asked in (["Fz", "Px"], ["Px", "Fz"], names):
        errors = {"Fz": 0.1, "Px": 10.0, "Mz": 3.0}

        def rows_of(seen: Any) -> list[int]:
            return [by_frame[np.ascontiguousarray(frame).tobytes()] for frame in np.asarray(seen).reshape(-1, 32, 32)]

        def called(seen: Any, asked: list[str] = asked) -> Any:
            return np.column_stack([in_order[name][rows_of(seen)] - errors[name] for name in asked])

        found = taceva.evaluate(dataset, called, channels=asked, split="by-point", part="all", metrics="bias")
        assert {name: round(float(found["bias", name]), 6) for name in asked} == {name: errors[name] for name in asked}

        class Learner:
            def fit(self, seen: Any, labels: Any) -> None:
                self.mean = labels.mean(axis=0)

            def predict(self, seen: Any) -> Any:
                return np.tile(self.mean, (len(seen), 1))

        learnt = taceva.evaluate(dataset, Learner(), channels=asked, split="by-point", metrics="mae")
        assert all(float(learnt["mae", name]) < 0.6 for name in asked), learnt


def test_rows_of_xarray_are_matched_in_every_form(drawn: taceva.Dataset) -> None:
    pytest.importorskip("xarray")
    labelled = drawn.to_xarray()
    force, by_name = labelled.sel(channel="Fz"), labelled.to_dataset(dim="channel")
    assert float(taceva.score(force, force[::-1], channels=["Fz"])["mae", "Fz"]) == 0.0
    assert all(float(score) == 0.0 for key, score in taceva.score(by_name, by_name.isel(sample=slice(None, None, -1)), metrics="mae").items() if key[0] == "mae")
    with pytest.raises(ValueError, match="transpose"):
        taceva.score(labelled.T.drop_vars("sample"), labelled.T.drop_vars("sample"))


def test_names_that_are_typed_wrong_are_refused(tmp_path: Path) -> None:
    rows = [[0.0, 1.0], [1.0, 2.0]]
    with pytest.raises(ValueError, match="units: no channel mz"):
        taceva.from_arrays(tmp_path / "a", rows, channels=["Fz", "Mz"], units={"mz": "N·mm"}, sensor="gel", source="synthetic")
    with pytest.raises(TypeError, match="found the text 'Fz'"):
        taceva.from_arrays(tmp_path / "b", rows, channels="Fz", sensor="gel", source="synthetic")
    worst = lambda truth, prediction: float(np.abs(prediction - truth).max())  # noqa: E731
    with pytest.raises(ValueError, match="named twice"):
        taceva.score_function(worst, rows, rows, channels=["Fz", "Fz"])
    with pytest.raises(ValueError, match="unit: no channel Pz"):
        taceva.score_function(worst, rows, rows, channels=["Fz", "Mz"], unit={"Pz": "m"})
