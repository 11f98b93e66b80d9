"""Models in ONNX files, run by the installed onnxruntime."""

from __future__ import annotations

import hashlib
import os
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from taceva._arrays import numbers
from taceva._counted import counted
from taceva._pickles import PICKLE_VERSION, require_version

#: Input types by their names in onnxruntime, with the numpy type and whether pixels are scaled to 0…1.
_INPUTS = {
    "tensor(float)": (np.float32, True),
    "tensor(float16)": (np.float16, True),
    "tensor(double)": (np.float64, True),
    "tensor(uint8)": (np.uint8, False),
    "tensor(uint16)": (np.uint16, False),
}


class OnnxModel:
    """A model of an ONNX file for `evaluate`. Calling it with frames returns ``[rows, channels]``; see `onnx`."""

    def __init__(self, path: str | os.PathLike[str], providers: list[str] | None, order: str | None) -> None:
        try:
            import onnxruntime
        except ImportError as error:
            raise ImportError("models of ONNX need the package onnxruntime: pip install 'taceva[onnx]'") from error
        if order not in (None, "nchw", "nhwc"):
            raise ValueError(f"order {order!r}: expected nchw or nhwc")
        self._path = Path(path)
        self._asked = (os.fspath(path), providers, order)
        content = self._path.read_bytes()
        self._digest = f"sha256:{hashlib.sha256(content).hexdigest()}"
        options = onnxruntime.SessionOptions()
        options.log_severity_level = 3
        try:
            # Opened by path, because weights may be in files beside it.
            self._session = onnxruntime.InferenceSession(
                os.fspath(path), options, providers=providers or onnxruntime.get_available_providers()
            )
        except Exception as error:
            raise ValueError(f"{path}: onnxruntime {onnxruntime.__version__} cannot run this model: {error}") from error
        inputs, outputs = self._session.get_inputs(), self._session.get_outputs()
        if len(inputs) != 1 or len(outputs) != 1:
            raise ValueError(
                f"{path}: {len(inputs)} inputs ({', '.join(one.name for one in inputs)}) and {len(outputs)} outputs "
                f"({', '.join(one.name for one in outputs)}), expected one of each: frames in, [rows, channels] out"
            )
        self._input = inputs[0]
        if self._input.type not in _INPUTS:
            raise ValueError(f"{path}: the input {self._input.name} is {self._input.type}, expected one of {', '.join(_INPUTS)}")
        self._shape: list[Any] = list(self._input.shape)
        if len(self._shape) != 4:
            raise ValueError(
                f"{path}: the input {self._input.name} has the shape {self._shape}, expected four axes: "
                "[rows, samples, height, width] or [rows, height, width, samples]"
            )
        self._order = order

    @property
    def name(self) -> str:
        """Name in the provenance."""
        return f"onnx:{self._path.name}"

    @property
    def settings(self) -> dict[str, str]:
        """Settings in the provenance: the digest of the file, and the runtime."""
        import onnxruntime

        return {"digest": self._digest, "runtime": f"onnxruntime {onnxruntime.__version__}"}

    def __call__(self, frames: npt.NDArray[Any]) -> npt.NDArray[Any]:
        """Return ``[rows, channels]`` for ``[rows, height, width, samples]``, uint8 or uint16."""
        number, is_scaled = _INPUTS[self._input.type]
        pictures = frames if self._wants(frames) == "nhwc" else frames.transpose(0, 3, 1, 2)
        if is_scaled:
            pictures = np.ascontiguousarray(pictures, dtype=np.float32) / np.float32(np.iinfo(frames.dtype).max)
        elif frames.dtype != number:
            raise ValueError(f"{self._path}: the input is {self._input.type}, the frames are {frames.dtype}")
        pictures = np.ascontiguousarray(pictures, dtype=number)
        size = self._shape[0] if isinstance(self._shape[0], int) else len(pictures)
        found = []
        for first in range(0, len(pictures), size):
            batch = pictures[first : first + size]
            missing = size - len(batch)
            if missing:
                # A model with a fixed batch size receives the last frame again; its additional predictions are dropped.
                batch = np.concatenate([batch, np.repeat(batch[-1:], missing, axis=0)])
            (predicted,) = self._session.run(None, {self._input.name: batch})
            found.append(self._rows(predicted, size)[: size - missing])
        return np.concatenate(found)

    def _rows(self, predicted: Any, rows: int) -> npt.NDArray[Any]:
        seen = numbers(predicted, f"prediction of {self.name}", allow_invalid=True)
        if seen.ndim == 0 or len(seen) != rows:
            raise ValueError(f"{self.name} predicted an array of the shape {list(seen.shape)} for {counted(rows, 'frame')}, expected [{rows}, channels]")
        return seen

    def _wants(self, frames: npt.NDArray[Any]) -> str:
        """Return the axis order in which the frames fit the input."""
        _, height, width, samples = frames.shape
        orders = {"nchw": (samples, height, width), "nhwc": (height, width, samples)}
        fit = [
            name
            for name, sizes in orders.items()
            if self._order in (None, name)
            and all(not isinstance(asked, int) or asked == size for asked, size in zip(self._shape[1:], sizes, strict=True))
        ]
        if not fit:
            raise ValueError(
                f"{self._path}: the input {self._input.name} has the shape {self._shape}, expected a shape that fits "
                f"frames of {height}×{width} pixels of {counted(samples, 'sample')}"
            )
        return fit[0]

    def __reduce__(self) -> tuple[Any, tuple[int, tuple[str, list[str] | None, str | None], str]]:
        return _arrived, (PICKLE_VERSION, self._asked, self._digest)

    def __repr__(self) -> str:
        return f"<taceva.OnnxModel {os.fspath(self._path)!r}>"


def onnx(path: str | os.PathLike[str], *, providers: list[str] | None = None, order: str | None = None) -> OnnxModel:
    """Return the model in an ONNX file for `evaluate`, run by the installed onnxruntime: ``pip install 'taceva[onnx]'``.

    The model has one input of four axes: ``[rows, samples, height, width]``, as exported by torch, or ``[rows, height, width, samples]``. A
    floating-point input receives pixels from 0 to 1, a whole-number input the original pixels. A fixed number of rows is supported. Its only
    output is ``[rows, channels]`` in the units of the channels.

    Parameters
    ----------
    providers
        Providers of onnxruntime, such as ``["CUDAExecutionProvider"]``; all available providers if ``None``.
    order
        ``nchw`` or ``nhwc``; ``None`` chooses the order that matches the frames, ``nchw`` if both match.

    Raises
    ------
    ImportError
        Without onnxruntime.
    FileNotFoundError
        If the file does not exist.
    ValueError
        For a file that is not a model, or a model with other inputs and outputs.
    """
    return OnnxModel(path, providers, order)


def _arrived(version: object, asked: tuple[str, list[str] | None, str | None] = ("", None, None), digest: str = "") -> OnnxModel:
    require_version(version)
    model = OnnxModel(*asked)
    if model.settings["digest"] != digest:
        raise ValueError(f"{asked[0]}: not the pickled model, its digest differs")
    return model
