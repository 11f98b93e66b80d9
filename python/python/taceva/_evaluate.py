"""Evaluation of models on recordings, by the pipeline of the command."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Mapping, Sequence
from contextvars import ContextVar
from typing import Any

import numpy as np
import numpy.typing as npt

from taceva import _taceva
from taceva._bar import bar
from taceva._dataset import Dataset
from taceva._onnx import OnnxModel
from taceva._predictions import prediction_rows
from taceva._result import Result
from taceva._settings import metric_names, setting_words

#: Current depth of nested model evaluations.
_DEPTH: ContextVar[int] = ContextVar("_DEPTH", default=0)
#: Greatest depth. A model may evaluate others, but one that evaluates itself would never end.
_DEEPEST = 8


def evaluate(
    dataset: Dataset | str | os.PathLike[str],
    model: Any,
    *,
    settings: Mapping[str, Any] | None = None,
    channels: Sequence[str] = (),
    split: str | None = None,
    seed: int = 0,
    part: str | None = None,
    metrics: str | Sequence[str] = "all",
    bounded: bool = True,
    batch: int = 64,
    jobs: int = 0,
) -> Result:
    """Score the predictions of a model on samples that it has not seen. A model that can be fitted is first fitted on the training part.

    Parameters
    ----------
    model
        One of

        - a name, such as ``"ridge"``, ``"fast"``, ``"cnn"``, ``"auto"`` or ``"linfa/elastic-net"``, or the key of a plugin: fitted here; see `models`;
        - the file of a model from ``taceva fit``, which has its own split;
        - an object with ``fit(X, y)`` and ``predict(X)``, as in scikit-learn: fitted here on ``X``, float32 ``[rows, features]`` (see
          `Dataset.features`, 32×32 gray by default), and ``y``, float64 ``[rows, channels]`` in their units, or ``[rows]`` for one channel.
          The object stays fitted;
        - a model from `onnx`;
        - a ``torch.nn.Module``: called in ``eval`` mode without gradients, on its own device and in its own precision, with
          ``[rows, samples, height, width]`` from 0 to 1;
        - any other callable: called with frames ``[rows, height, width, samples]``, uint8 or uint16.

        Modules and callables are used without fitting and return ``[rows, channels]`` in the units of the channels. Give the ``split`` of their
        fit. Without it, every sample is scored, and a note states that the training samples of the model are unknown.
    settings
        Settings by name: for a named model and its features, ``{"size": "16x16"}``; for an object with ``fit``, only of the features.
    channels
        Channels to predict, in the order of the model; if empty, all labels in the order of `Dataset.channels`.
    split, seed
        As in `Dataset.split`. Only a named model is fitted for each fold of ``"cv:5"``; see `Dataset.folds` for an object.
    part
        ``test`` by default. The parts ``train``, ``validation`` and ``all`` are not a test, and a note states so.
    bounded
        ``False`` scores the predictions of an object with ``fit`` unchanged, and a note states so. Otherwise they are clipped to the range of its
        training labels plus a quarter of that range on each side, as for every model that is fitted here.
    metrics
        Metrics and groups by name; ``all`` selects every metric that the recording supports, and the result lists the skipped ones.
    batch
        Number of frames in one call of a module or a callable.
    jobs
        Number of threads; all cores if 0. Results do not depend on this number.

    Returns
    -------
    Result
        For a name or a file, the same bytes as ``taceva evaluate DATASET --model NAME --format json``.

    Raises
    ------
    ModelError
        For a model that does not fit the recording, and for one that calls or evaluates itself without end (`RecursionError`).
    ValueError
        For an unknown model, setting or split, and for predictions of a wrong shape or with non-finite numbers. Other exceptions
        of your model are raised unchanged.
    """
    recording = dataset if isinstance(dataset, Dataset) else Dataset(dataset)
    wanted = metric_names(metrics)
    words = setting_words(settings)
    if isinstance(model, str | os.PathLike):
        if not bounded:
            raise ValueError("bounded=False: a model given by name or file always keeps its bounds")
        named = _taceva.evaluate_named(
            recording._inner, os.fspath(model), words, list(channels), split, seed, part, wanted, jobs, bar()
        )
        return Result(*named)
    if isinstance(model, type):
        raise TypeError(f"model: {_name_of(model)} is a class, expected an object of it")
    learns = callable(getattr(model, "fit", None)) and callable(getattr(model, "predict", None))
    if not learns and not callable(model):
        raise TypeError(
            f"model: {_name_of(model)} has no fit and predict and cannot be called; "
            "expected a name, a file, an object with fit and predict, or a callable"
        )
    if split is not None and re.match(r"(cv:|loo\b|leave-one)", split):
        raise ValueError(
            f"split {split}: `evaluate` fits a model for each fold only by name, such as 'ridge'; for an object, fit and predict the rows of "
            f"each of dataset.folds({split!r}), and give all predictions to `score`, as docs/python.md shows"
        )
    if not bounded and not learns:
        raise ValueError("bounded=False: a model that is used without fitting has no bounds")
    if batch < 1:
        raise ValueError(f"batch {batch}: expected at least 1")
    if words and not learns:
        raise ValueError(f"settings {', '.join(words)}: a model that is used without fitting has no settings")
    reads_frames = recording.frame_shape is not None
    given = _taceva.Given(recording._inner, list(channels), learns, split, seed, part, reads_frames, not bounded)
    # The model uses the channel order of the caller, the recording its own.
    names = list(channels) or given.channels()
    described = model.settings if isinstance(model, OnnxModel) else _settings_of(model) if learns else {}

    def predicted() -> Any:
        if learns:
            return _fitted(recording, model, given, names, words, described, jobs)
        return _called(recording, model, given, names, batch, jobs)

    predictions = _ending(_name_of(model), predicted)
    found = prediction_rows(predictions, _name_of(model), len(given.target()), names)
    found = np.ascontiguousarray(found[:, [names.index(name) for name in given.channels()]])
    return Result(*given.score(recording._inner, _name_of(model), described, found, wanted, jobs))


def _ending(name: str, work: Callable[[], Any]) -> Any:
    """Return the result of ``work``, which runs the model ``name``. A recursion that is too deep becomes an error of that model."""
    depth = _DEPTH.get()
    if depth >= _DEEPEST:
        raise RecursionError(f"models call evaluate inside evaluate: {depth} levels deep, expected fewer than {_DEEPEST}")
    token = _DEPTH.set(depth + 1)
    try:
        return work()
    except RecursionError as error:
        why = f"{error}{_place_of(error)}"
    finally:
        _DEPTH.reset(token)
    # Raised here, because its context would otherwise keep every call of the recursion and their arrays.
    raise _taceva.ModelError(f"{name} recurses too deeply: {why}")


def _place_of(error: BaseException) -> str:
    """Return the innermost file and line outside of this package in the traceback of ``error``."""
    own = os.path.dirname(__file__)
    place, trace = "", error.__traceback__
    while trace is not None:
        file = trace.tb_frame.f_code.co_filename
        if os.path.dirname(file) != own:
            place = f" ({file}, line {trace.tb_lineno})"
        trace = trace.tb_next
    return place


def _fitted(
    recording: Dataset, model: Any, given: Any, names: list[str], words: list[str], described: dict[str, str], jobs: int
) -> Any:
    """Return the predictions of a model that is fitted on the training part."""
    seen, name, _ = _taceva.features(recording._inner, words, given.train(), jobs, bar())
    labels = np.asarray(given.labels(recording._inner))
    if names != given.channels():
        labels = np.ascontiguousarray(labels[:, [given.channels().index(name) for name in names]])
    # Models may write to their arguments.
    model.fit(np.array(seen), np.array(labels if labels.shape[1] > 1 else labels[:, 0]))
    described["features"] = name
    unseen, _, _ = _taceva.features(recording._inner, words, given.target(), jobs, bar())
    return model.predict(np.array(unseen))


def _called(recording: Dataset, model: Any, given: Any, names: list[str], batch: int, jobs: int) -> Any:
    """Return the predictions of a model that is used without fitting."""
    rows = given.target()
    call = _module(model) if _is_module(model) else model
    shown = bar()
    if shown is not None:
        shown.begin("predict", len(rows))
    try:
        predictions = []
        for first in range(0, len(rows), batch):
            own = rows[first : first + batch]
            frames = np.asarray(recording._inner.frames(own, jobs, None))
            predictions.append(prediction_rows(call(frames), _name_of(model), len(own), names))
            if shown is not None:
                shown.advance(len(own))
    finally:
        if shown is not None:
            shown.end()
    return np.concatenate(predictions)


def _is_module(model: Any) -> bool:
    import sys

    torch = sys.modules.get("torch")
    return torch is not None and isinstance(model, torch.nn.Module)


def _module(model: Any) -> Callable[[npt.NDArray[Any]], Any]:
    """Return a torch module as a callable of frames."""
    import torch

    weights = next(iter(model.parameters()), None)
    device = torch.device("cpu") if weights is None else weights.device
    # A module of double or half precision receives frames of its own precision.
    number = weights.dtype if weights is not None and weights.is_floating_point() else torch.float32

    def call(frames: npt.NDArray[Any]) -> Any:
        scale = np.float32(np.iinfo(frames.dtype).max)
        pictures = np.ascontiguousarray(frames.transpose(0, 3, 1, 2), dtype=np.float32) / scale
        was_training = model.training
        model.eval()
        try:
            with torch.inference_mode():
                return model(torch.from_numpy(pictures).to(device, number))
        finally:
            model.train(was_training)

    return call


def _name_of(model: Any) -> str:
    if isinstance(model, OnnxModel):
        return model.name
    of = model if isinstance(model, type) or hasattr(model, "__qualname__") else type(model)
    return f"{getattr(of, '__module__', '?')}.{getattr(of, '__qualname__', '?')}"


def _settings_of(model: Any) -> dict[str, str]:
    """Return the settings of a scikit-learn model."""
    if not callable(getattr(model, "get_params", None)):
        return {}
    return {str(name): repr(value) for name, value in model.get_params(deep=False).items()}
