"""Models in Python: fitted and scored by the same rules as built-in models."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import taceva

SPLIT = "random 60/0/40"
SMALL = {"size": "8x6"}


@pytest.fixture(scope="module")
def drawn(tmp_path_factory: pytest.TempPathFactory) -> taceva.Dataset:
    """Frames that show position and force, drawn from a fixed seed."""
    generator = np.random.default_rng(11)
    rows, height, width = 160, 24, 32
    labels = generator.uniform([-4, -3, 0.2], [4, 3, 2.0], size=(rows, 3))
    y, x = np.mgrid[0:height, 0:width]
    px, py, force = (labels[:, at, None, None] for at in range(3))
    squared = (x - 16 - 3 * px) ** 2 + (y - 12 - 3 * py) ** 2
    frames = (20 + 90 * force * np.exp(-squared / 40) + generator.uniform(0, 4, size=(rows, height, width))).astype(np.uint8)
    path = tmp_path_factory.mktemp("drawn") / "recording"
    points = [f"point {row // 4}" for row in range(rows)]
    return taceva.from_arrays(
        path, labels, frames, sensor="drawn gel", source="synthetic", channels=["Px", "Py", "Fz"], points=points
    )


class Mean:
    """A model that predicts the mean of its training labels."""

    def fit(self, seen: Any, labels: Any) -> None:
        self.mean = labels.mean(axis=0)

    def predict(self, seen: Any) -> Any:
        return np.tile(self.mean, (len(seen), 1))


def test_a_model_of_scikit_learn_is_fitted_on_the_training_part_and_scored_on_the_test_part(drawn: taceva.Dataset) -> None:
    linear = pytest.importorskip("sklearn.linear_model")
    result = taceva.evaluate(drawn, linear.Ridge(alpha=1.0), split=SPLIT, settings={"size": "16x12"})
    rows = drawn.split(SPLIT)
    features = drawn.features(settings={"size": "16x12"})
    labels = drawn.labels()
    by_hand = linear.Ridge(alpha=1.0).fit(features[rows.train], labels[rows.train])
    predicted = by_hand.predict(features[rows.test])
    low, high = labels[rows.train].min(axis=0), labels[rows.train].max(axis=0)
    predicted = np.clip(predicted, low - 0.25 * (high - low), high + 0.25 * (high - low))
    for at, channel in enumerate(drawn.channels):
        expected = np.abs(predicted[:, at] - labels[rows.test, at]).mean()
        assert result["mae", channel].value == pytest.approx(expected, abs=1e-12)
    provenance = result.to_dict()["provenance"]
    assert provenance["model"]["name"] == "sklearn.linear_model._ridge.Ridge"
    assert provenance["model"]["origin"] == "given"
    assert provenance["model"]["settings"]["alpha"] == "1.0"
    assert provenance["model"]["fitted_on"] == drawn.digest
    assert provenance["samples"]["test"] == len(rows.test)
    assert any("fitted here on the training part only" in note for note in result.notes)


def test_the_mean_has_no_skill_and_is_in_no_verdict(drawn: taceva.Dataset) -> None:
    result = taceva.evaluate(drawn, Mean(), split=SPLIT, settings=SMALL)
    for channel in drawn.channels:
        assert result["skill", channel].value == pytest.approx(0.0, abs=1e-12)
        assert result["mae", channel].standing == "no skill"


def test_features_are_those_that_our_models_see(drawn: taceva.Dataset) -> None:
    assert drawn.features([3, 1], settings={"size": "8x6"}).shape == (2, 48)
    with pytest.raises(ValueError, match="smaller than the requested features"):
        drawn.features()


def test_a_callable_is_taken_as_it_is_and_nobody_knows_what_it_has_learnt(drawn: taceva.Dataset) -> None:
    truth = drawn.labels()
    frames = drawn.frames()
    lookup = {frame.tobytes(): label for frame, label in zip(frames, truth, strict=True)}

    def perfect(batch: Any) -> Any:
        return [lookup[frame.tobytes()] for frame in batch]

    result = taceva.evaluate(drawn, perfect, batch=7)
    assert result["mae", "Fz"].value == 0.0
    assert result["mae", "Fz"].n == len(drawn)
    assert result.to_dict()["provenance"]["model"]["fitted_on"] == "unknown"
    assert any("training data are unknown" in note for note in result.notes)
    of_test = taceva.evaluate(drawn, perfect, split=SPLIT, batch=1000)
    assert of_test["mae", "Fz"].n == len(drawn.split(SPLIT).test)
    assert any("the caller states" in note for note in of_test.notes)


@pytest.mark.parametrize(
    ("predict", "error", "message"),
    [
        (lambda batch: np.zeros((len(batch), 2)), ValueError, r"predicted an array of the shape \[64, 2\], expected \[64, 3\]|expected \[160, 3\]"),
        (lambda batch: np.zeros((1, 3)), ValueError, r"shape \[1, 3\]"),
        (lambda batch: np.full((len(batch), 3), np.nan), ValueError, "NaN of Px for the sample 0: expected finite"),
        (lambda batch: "three", TypeError, "expected numbers"),
        (lambda batch: None, TypeError, "expected numbers"),
        (lambda batch: [][1], IndexError, "list index"),
    ],
    ids=["channels", "rows", "nan", "text", "nothing", "raises"],
)
def test_predictions_of_another_form_are_refused(
    drawn: taceva.Dataset, predict: Any, error: type[Exception], message: str
) -> None:
    with pytest.raises(error, match=message):
        taceva.evaluate(drawn, predict)


def test_a_model_that_calls_back_into_taceva_is_heard(drawn: taceva.Dataset) -> None:
    class Asks(Mean):
        def predict(self, seen: Any) -> Any:
            taceva.score(np.zeros((3, 6)), np.zeros((3, 6)))
            return super().predict(seen)

    assert taceva.evaluate(drawn, Asks(), split=SPLIT, settings=SMALL)["mae", "Fz"].value


def test_what_is_no_model_is_refused(drawn: taceva.Dataset) -> None:
    with pytest.raises(TypeError, match="expected an object of it"):
        taceva.evaluate(drawn, Mean)
    with pytest.raises(TypeError, match="cannot be called"):
        taceva.evaluate(drawn, 7)
    with pytest.raises(ValueError, match="has no settings"):
        taceva.evaluate(drawn, lambda batch: batch, settings={"size": "8x8"})
    with pytest.raises(ValueError, match="no such channel"):
        taceva.evaluate(drawn, Mean(), channels=["Mz"])


def test_a_torch_module_is_called_without_gradients_and_left_as_it_was(drawn: taceva.Dataset) -> None:
    torch = pytest.importorskip("torch")
    pixels = int(np.prod(drawn.frame_shape or ()))
    module = torch.nn.Sequential(torch.nn.Flatten(), torch.nn.Dropout(0.5), torch.nn.Linear(pixels, 3)).train()
    first = taceva.evaluate(drawn, module, split=SPLIT)
    assert module.training
    assert all(weights.grad is None for weights in module.parameters())
    assert taceva.evaluate(drawn, module, split=SPLIT, batch=5)["mae", "Fz"].value == pytest.approx(
        float(first["mae", "Fz"]), abs=1e-5
    )
    assert first.to_dict()["provenance"]["model"]["name"] == "torch.nn.modules.container.Sequential"


def test_one_channel_is_fitted_as_a_list(drawn: taceva.Dataset) -> None:
    linear = pytest.importorskip("sklearn.linear_model")
    result = taceva.evaluate(drawn, linear.LinearRegression(), split=SPLIT, channels=["Fz"], settings=SMALL)
    assert float(result["r2", "Fz"]) > 0.5


class Linear:
    """A linear model without a penalty."""

    def fit(self, seen: Any, labels: Any) -> None:
        self.weights = np.linalg.lstsq(np.c_[seen, np.ones(len(seen))], labels, rcond=None)[0]

    def predict(self, seen: Any) -> Any:
        return np.c_[seen, np.ones(len(seen))] @ self.weights


def test_two_models_on_one_test_part_are_compared_in_pairs(drawn: taceva.Dataset) -> None:
    split = "by-point 60/0/40"
    results = [taceva.evaluate(drawn, model, split=split, settings=SMALL) for model in ("ridge", Linear())]
    comparison = taceva.compare(*results, metrics=["mae"])
    answers = [answer for answer in comparison.to_dict()["answers"] if answer["channel"] == "Fz"]
    assert [answer["difference"]["test"].startswith("paired") for answer in answers] == [True], answers
    assert "no samples are kept" not in str(comparison)


def test_a_model_of_the_caller_is_cross_validated_by_folds_as_the_refusal_of_evaluate_says(drawn: taceva.Dataset) -> None:
    for split in ("cv:5", "loo by-point"):
        with pytest.raises(ValueError, match=rf"fit and predict the rows of each of dataset.folds\('{split}'\)"):
            taceva.evaluate(drawn, Mean(), split=split, settings=SMALL)
    seen, labels, model = drawn.features(settings=SMALL), drawn.labels(), Linear()
    predicted = np.full_like(labels, np.nan)
    for fold in drawn.folds("cv:5"):
        model.fit(seen[fold.train], labels[fold.train])
        predicted[fold.test] = model.predict(seen[fold.test])
    crossed = taceva.score(labels, predicted, channels=drawn.channels, points=drawn.points(), name="mine")
    assert crossed["mae", "Fz"].n == len(drawn) and crossed["mae", "Fz"].interval is not None
    assert float(crossed["r2", "Fz"]) > 0.5
