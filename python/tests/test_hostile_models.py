"""Misbehaving models: their exceptions are raised unchanged, and they neither hang nor spoil a result."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import textwrap
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import taceva

SPLIT = "random 60/0/40"
SMALL = {"size": "8x6"}
ROWS = 60


@pytest.fixture(scope="module")
def drawn(tmp_path_factory: pytest.TempPathFactory) -> taceva.Dataset:
    generator = np.random.default_rng(4)
    labels = generator.uniform(size=(ROWS, 3))
    frames = (generator.integers(0, 40, size=(ROWS, 12, 16)) + 200 * labels[:, 2, None, None]).astype(np.uint8)
    path = tmp_path_factory.mktemp("drawn") / "recording"
    return taceva.from_arrays(path, labels, frames, sensor="drawn gel", source="synthetic", channels=["Px", "Py", "Fz"])


class Mean:
    """A model that predicts the mean of its training labels, after running a given function."""

    def __init__(self, before: Callable[[Any], Any] = len) -> None:
        self._before = before

    def fit(self, seen: Any, labels: Any) -> None:
        self.mean = labels.mean(axis=0)

    def predict(self, seen: Any) -> Any:
        found = self._before(seen)
        return found if isinstance(found, np.ndarray) else np.tile(self.mean, (len(seen), 1))


def called(predict: Callable[[Any], Any]) -> Callable[[Any], Any]:
    return predict


KINDS = [pytest.param(Mean, id="fitted"), pytest.param(called, id="called")]


class OwnError(Exception):
    """An error class of the model."""


@pytest.mark.parametrize("kind", KINDS)
def test_what_a_model_raises_comes_out_unchanged(drawn: taceva.Dataset, kind: Any) -> None:
    raised = OwnError("the gripper is open", 7)

    def fail(seen: Any) -> Any:
        raise raised

    with pytest.raises(OwnError) as caught:
        taceva.evaluate(drawn, kind(fail), split=SPLIT, settings=SMALL if kind is Mean else None)
    assert caught.value is raised


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(
    ("predicted", "error", "message"),
    [
        (lambda rows: np.zeros((rows, 2)), ValueError, "2], expected"),
        (lambda rows: np.zeros((rows + 1, 3)), ValueError, "one row per sample, one column per channel"),
        (lambda rows: np.zeros((rows, 3, 1)), ValueError, "3, 1], expected"),
        (lambda rows: np.zeros(()), ValueError, r"shape \[1\]"),
        (lambda rows: np.full((rows, 3), np.nan), ValueError, "NaN of Px for the sample"),
        (lambda rows: np.where(np.arange(3) == 2, -np.inf, np.zeros((rows, 3))), ValueError, "-inf of Fz for the sample"),
        (lambda rows: np.zeros((rows, 3), complex), TypeError, "complex128"),
        (lambda rows: np.full((rows, 3), None), TypeError, "object"),
    ],
    ids=["channels", "rows", "axes", "a number", "nan", "infinite", "complex", "objects"],
)
def test_what_is_no_prediction_is_refused_and_says_whose_it_was(
    drawn: taceva.Dataset, kind: Any, predicted: Any, error: type[Exception], message: str
) -> None:
    with pytest.raises(error, match=message):
        taceva.evaluate(drawn, kind(lambda seen: predicted(len(seen))), split=SPLIT, settings=SMALL if kind is Mean else None)


@pytest.mark.parametrize("kind", KINDS)
def test_a_model_that_prints_is_heard_and_changes_nothing(drawn: taceva.Dataset, kind: Any, capfd: pytest.CaptureFixture[str]) -> None:
    def loud(seen: Any) -> Any:
        print("predicting")
        os.write(2, b"quietly\n")
        return np.zeros((len(seen), 3))

    settings = SMALL if kind is Mean else None
    found = taceva.evaluate(drawn, kind(loud), split=SPLIT, settings=settings)
    heard = capfd.readouterr()
    assert "predicting" in heard.out and "quietly" in heard.err
    silent = taceva.evaluate(drawn, kind(lambda seen: np.zeros((len(seen), 3))), split=SPLIT, settings=settings)
    assert {name: scores for name, scores in found.to_dict()["metrics"].items()} == silent.to_dict()["metrics"]


def test_a_model_that_calls_back_into_taceva_gets_an_answer(drawn: taceva.Dataset) -> None:
    inner = []

    def asks(frames: Any) -> Any:
        inner.append(taceva.evaluate(drawn, "ridge", split=SPLIT, settings=SMALL, jobs=2).text)
        assert np.array_equal(drawn.frame(0), taceva.open(drawn.path).frame(0))
        return np.zeros((len(frames), 3))

    assert taceva.evaluate(drawn, asks, split=SPLIT)["mae", "Fz"].n == len(drawn.split(SPLIT).test)
    assert inner == [taceva.evaluate(drawn, "ridge", split=SPLIT, settings=SMALL).text]


@pytest.mark.parametrize("kind", KINDS)
def test_a_model_that_calls_itself_without_end_is_named_with_its_line_and_nothing_of_it_is_kept(
    drawn: taceva.Dataset, kind: Any
) -> None:
    def endless(seen: Any) -> Any:
        return endless(seen)

    said = r"test_hostile_models\..*(Mean|endless) recurses too deeply: .*recursion.*test_hostile_models\.py, line \d+\)$"
    with pytest.raises(taceva.ModelError, match=said) as caught:
        taceva.evaluate(drawn, kind(endless), split=SPLIT, settings=SMALL if kind is Mean else None)
    assert caught.value.__context__ is None
    assert taceva.evaluate(drawn, lambda frames: np.zeros((len(frames), 3)))["mae", "Fz"].n == ROWS


def test_a_fit_that_calls_itself_without_end_is_an_error_of_its_model(drawn: taceva.Dataset) -> None:
    class Endless(Mean):
        def fit(self, seen: Any, labels: Any) -> None:
            self.fit(seen, labels)

    with pytest.raises(taceva.ModelError, match="Endless recurses too deeply"):
        taceva.evaluate(drawn, Endless(), split=SPLIT, settings=SMALL)


def test_a_model_that_evaluates_itself_ends_after_a_few_evaluations_in_an_error_of_that_model(drawn: taceva.Dataset) -> None:
    calls = []

    def evaluates_itself(frames: Any) -> Any:
        calls.append(len(frames))
        return taceva.evaluate(drawn, evaluates_itself, split=SPLIT)

    for _ in range(2):
        calls.clear()
        with pytest.raises(taceva.ModelError, match=r"evaluates_itself recurses too deeply: models call evaluate inside evaluate.*hostile_models\.py, line"):
            taceva.evaluate(drawn, evaluates_itself, split=SPLIT)
        assert len(calls) == 8


def test_a_model_that_writes_to_what_it_is_given_spoils_no_truth(drawn: taceva.Dataset) -> None:
    class Greedy(Mean):
        def fit(self, seen: Any, labels: Any) -> None:
            super().fit(seen, labels)
            seen[:], labels[:] = 0, 99

        def predict(self, seen: Any) -> Any:
            seen[:] = 0
            return super().predict(seen)

    before = drawn.labels().copy()
    greedy = taceva.evaluate(drawn, Greedy(), split=SPLIT, settings=SMALL).to_dict()["metrics"]
    assert greedy == taceva.evaluate(drawn, Mean(), split=SPLIT, settings=SMALL).to_dict()["metrics"]
    assert np.array_equal(drawn.labels(), before)

    def overwrites(frames: Any) -> Any:
        frames[:] = 0
        return np.zeros((len(frames), 3))

    with pytest.raises(ValueError, match="read-only"):
        taceva.evaluate(drawn, overwrites)


def test_control_c_ends_a_model_that_hangs_and_the_next_one_is_scored(drawn: taceva.Dataset) -> None:
    begun = threading.Event()

    def hangs(frames: Any) -> Any:
        begun.set()
        # Short sleeps: a signal just before one long sleep would be handled only after it.
        for _ in range(12_000):
            time.sleep(0.05)

    pressed: list[float] = []

    def press() -> None:
        begun.wait()
        pressed.append(time.monotonic())
        os.kill(os.getpid(), signal.SIGINT)

    presser = threading.Thread(target=press)
    with pytest.raises(KeyboardInterrupt):
        presser.start()
        taceva.evaluate(drawn, hangs)
    # On an idle machine it is 0.1 s at most (see benches/peers/python_update.py). Here it only has to end.
    assert time.monotonic() - pressed[0] < 30
    presser.join()
    assert taceva.evaluate(drawn, lambda frames: np.zeros((len(frames), 3)))["mae", "Fz"].n == ROWS


def test_control_c_ends_a_large_update_and_nothing_of_it_is_kept(tmp_path: Path) -> None:
    program = textwrap.dedent(
        """
        import os, signal, threading, time
        import numpy as np, taceva
        metrics = taceva.TactileMetrics()
        metrics.update(np.zeros((5, 6)), np.ones((5, 6)))
        before = metrics.states()
        many = np.broadcast_to(np.arange(6.0), (2**31 - 1, 6))
        threading.Timer(1.0, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
        try:
            metrics.update(many, many)
        except KeyboardInterrupt:
            assert metrics.states() == before
            print("interrupted")
        """
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=240, check=False)
    assert done.stdout == "interrupted\n", done.stderr


def test_a_model_that_has_fit_but_no_predict_is_refused(drawn: taceva.Dataset) -> None:
    class Half:
        def fit(self, seen: Any, labels: Any) -> None: ...

    with pytest.raises(TypeError, match="has no fit and predict and cannot be called"):
        taceva.evaluate(drawn, Half())
    with pytest.raises(ValueError, match="expected at least 1"):
        taceva.evaluate(drawn, lambda frames: frames, batch=0)


def test_a_torch_module_without_memory_is_refused_in_words(drawn: taceva.Dataset) -> None:
    torch = pytest.importorskip("torch")
    module = torch.nn.Sequential(torch.nn.Flatten(), torch.nn.Linear(12 * 16, 3, device="meta"))
    with pytest.raises(ValueError, match="on the device meta, which holds no numbers"):
        taceva.evaluate(drawn, module)
    with pytest.raises(ValueError, match="on the device meta"):
        taceva.score(torch.zeros(3, 6, device="meta"), torch.zeros(3, 6))


def test_a_torch_module_on_two_devices_fails_in_the_words_of_torch(drawn: taceva.Dataset) -> None:
    torch = pytest.importorskip("torch")

    class Elsewhere(torch.nn.Module):  # type: ignore[misc, name-defined, unused-ignore]
        def __init__(self) -> None:
            super().__init__()
            self.here = torch.nn.Linear(12 * 16, 3)
            self.there = torch.nn.Linear(3, 3, device="meta")

        def forward(self, frames: Any) -> Any:
            return self.there.weight.add(1).cpu() @ self.here(frames.flatten(1)).T

    module = Elsewhere().train()
    with pytest.raises((RuntimeError, NotImplementedError), match="meta"):
        taceva.evaluate(drawn, module)
    assert module.training


def test_a_torch_module_sees_pictures_from_0_to_1_with_samples_first(drawn: taceva.Dataset) -> None:
    torch = pytest.importorskip("torch")
    seen = []

    class Looks(torch.nn.Module):  # type: ignore[misc, name-defined, unused-ignore]
        def forward(self, frames: Any) -> Any:
            assert not torch.is_grad_enabled() and not self.training
            seen.append(frames)
            return torch.zeros(len(frames), 3, dtype=torch.bfloat16)

    taceva.evaluate(drawn, Looks(), batch=ROWS)
    (frames,) = seen
    assert tuple(frames.shape) == (ROWS, 1, 12, 16)
    assert frames.dtype == torch.float32
    assert np.array_equal(frames.numpy()[:, 0], drawn.frames()[..., 0].astype(np.float32) / np.float32(255))
