"""Models in ONNX files, run by a real onnxruntime."""

from __future__ import annotations

import pickle
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import taceva

ROWS, HEIGHT, WIDTH = 50, 6, 8


@pytest.fixture(scope="module")
def drawn(tmp_path_factory: pytest.TempPathFactory) -> taceva.Dataset:
    """Gray frames whose mean is ten times the force, from a fixed seed."""
    generator = np.random.default_rng(2)
    frames = generator.integers(0, 255, size=(ROWS, HEIGHT, WIDTH), dtype=np.uint8)
    labels = frames.reshape(ROWS, -1).mean(axis=1, keepdims=True) / 255 * 10
    path = tmp_path_factory.mktemp("drawn") / "recording"
    return taceva.from_arrays(path, labels, frames, sensor="drawn gel", source="synthetic", channels=["Fz"])


def file_of(path: Path, axes: list[Any], kind: str = "FLOAT", *, outputs: int = 1, scale: float = 10.0) -> Path:
    """A model that returns `scale` times the mean of each frame, as `[rows, 1]`."""
    onnx = pytest.importorskip("onnx")
    pytest.importorskip("onnxruntime")
    helper, number = onnx.helper, getattr(onnx.TensorProto, kind)
    nodes = [helper.make_node("Cast", ["frames"], ["numbers"], to=onnx.TensorProto.FLOAT)]
    nodes += [helper.make_node("Flatten", ["numbers"], ["flat"], axis=1)]
    nodes += [helper.make_node("ReduceMean", ["flat", "one"], ["mean"], keepdims=1)]
    nodes += [helper.make_node("Mul", ["mean", "scale"], [f"labels{at}"]) for at in range(outputs)]
    graph = helper.make_graph(
        nodes,
        "mean",
        [helper.make_tensor_value_info("frames", number, axes)],
        [helper.make_tensor_value_info(f"labels{at}", onnx.TensorProto.FLOAT, [axes[0], 1]) for at in range(outputs)],
        [onnx.numpy_helper.from_array(np.array([1]), "one"), onnx.numpy_helper.from_array(np.float32([[scale]]), "scale")],
    )
    model = helper.make_model(graph, opset_imports=[helper.make_opsetid("", 18)], ir_version=9)
    onnx.checker.check_model(model)
    onnx.save(model, str(path))
    return path


@pytest.mark.parametrize(
    "axes",
    [["n", 1, HEIGHT, WIDTH], ["n", HEIGHT, WIDTH, 1], ["n", "c", "h", "w"], [1, 1, HEIGHT, WIDTH], [7, HEIGHT, WIDTH, 1]],
    ids=["nchw", "nhwc", "any size", "one at a time", "seven at a time"],
)
def test_a_file_of_any_order_and_batch_is_scored_as_the_function_that_it_holds(drawn: taceva.Dataset, tmp_path: Path, axes: list[Any]) -> None:
    model = taceva.onnx(file_of(tmp_path / "mean.onnx", axes))
    result = taceva.evaluate(drawn, model, batch=16)
    assert result["mae", "Fz"].n == ROWS
    assert float(result["mae", "Fz"]) < 1e-5
    said = result.to_dict()["provenance"]["model"]
    assert said["name"] == "onnx:mean.onnx"
    assert said["origin"] == "given"
    assert said["settings"]["digest"].startswith("sha256:")
    assert said["settings"]["runtime"].startswith("onnxruntime")
    assert any("training data are unknown" in note for note in result.notes)


def test_whole_numbers_get_pixels_as_they_are(drawn: taceva.Dataset, tmp_path: Path) -> None:
    model = taceva.onnx(file_of(tmp_path / "mean.onnx", ["n", 1, HEIGHT, WIDTH], "UINT8", scale=10 / 255))
    assert float(taceva.evaluate(drawn, model)["mae", "Fz"]) < 1e-5
    deep = taceva.onnx(file_of(tmp_path / "deep.onnx", ["n", 1, HEIGHT, WIDTH], "UINT16"))
    with pytest.raises(ValueError, match="the frames are uint8"):
        taceva.evaluate(drawn, deep)


def test_a_file_that_is_no_model_of_frames_is_refused_with_its_name(drawn: taceva.Dataset, tmp_path: Path) -> None:
    pytest.importorskip("onnxruntime")
    with pytest.raises(FileNotFoundError, match="nowhere.onnx"):
        taceva.onnx(tmp_path / "nowhere.onnx")
    text = tmp_path / "text.onnx"
    text.write_text("no model")
    with pytest.raises(ValueError, match="text.onnx: onnxruntime"):
        taceva.onnx(text)
    with pytest.raises(ValueError, match="expected four axes"):
        taceva.onnx(file_of(tmp_path / "flat.onnx", ["n", 48]))
    with pytest.raises(ValueError, match="2 outputs"):
        taceva.onnx(file_of(tmp_path / "two.onnx", ["n", 1, HEIGHT, WIDTH], outputs=2))
    with pytest.raises(ValueError, match=r"is tensor\(int64\)"):
        taceva.onnx(file_of(tmp_path / "int.onnx", ["n", 1, HEIGHT, WIDTH], "INT64"))
    with pytest.raises(ValueError, match="expected nchw or nhwc"):
        taceva.onnx(file_of(tmp_path / "order.onnx", ["n", 1, HEIGHT, WIDTH]), order="chwn")
    larger = taceva.onnx(file_of(tmp_path / "larger.onnx", ["n", 3, 64, 64]))
    with pytest.raises(ValueError, match=f"{HEIGHT}×{WIDTH} pixels of 1 sample"):
        taceva.evaluate(drawn, larger)


def test_a_model_that_predicts_more_channels_than_there_are_is_refused(drawn: taceva.Dataset, tmp_path: Path) -> None:
    onnx = pytest.importorskip("onnx")
    model = onnx.load(file_of(tmp_path / "mean.onnx", ["n", 1, HEIGHT, WIDTH]))
    (scale,) = [tensor for tensor in model.graph.initializer if tensor.name == "scale"]
    scale.CopyFrom(onnx.numpy_helper.from_array(np.float32([[1, 2, 3]]), "scale"))
    model.graph.output[0].type.tensor_type.shape.dim[1].dim_value = 3
    onnx.save(model, tmp_path / "three.onnx")
    with pytest.raises(ValueError, match=rf"onnx:three.onnx predicted an array of the shape \[{ROWS}, 3\], expected \[{ROWS}, 1\]"):
        taceva.evaluate(drawn, taceva.onnx(tmp_path / "three.onnx"))


def test_a_file_travels_by_its_path_and_arrives_as_itself_or_not_at_all(drawn: taceva.Dataset, tmp_path: Path) -> None:
    path = file_of(tmp_path / "mean.onnx", ["n", 1, HEIGHT, WIDTH])
    sent = pickle.dumps(taceva.onnx(path))
    expected = taceva.evaluate(drawn, taceva.onnx(path)).text
    assert taceva.evaluate(drawn, pickle.loads(sent)).text == expected
    file_of(path, ["n", 1, HEIGHT, WIDTH], scale=9.0)
    with pytest.raises(ValueError, match="not the pickled model"):
        pickle.loads(sent)


def test_without_onnxruntime_its_package_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "onnxruntime", None)
    with pytest.raises(ImportError, match=r"pip install 'taceva\[onnx\]'"):
        taceva.onnx(tmp_path / "model.onnx")
