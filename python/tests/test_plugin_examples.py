"""The packages in `examples/python-plugins` pass all checks in the sandbox, if their libraries are installed."""

from __future__ import annotations

import json
import os
import shutil
import threading
import time
from pathlib import Path

import numpy as np
import pytest
import taceva
from plugin_environment import Program, make_environment

EXAMPLES = Path(__file__).parents[2] / "examples/python-plugins"


@pytest.fixture(scope="module")
def program(tmp_path_factory: pytest.TempPathFactory) -> Program:
    folder = tmp_path_factory.mktemp("examples")
    for above in [folder, *folder.parents][:3]:
        if above.stat().st_uid == os.geteuid() and above != Path("/"):
            above.chmod(above.stat().st_mode | 0o055)
    return Program(folder / "home", make_environment(folder / "venv"))


def package(name: str) -> Path:
    return EXAMPLES / name / "src" / name.replace("-", "_")


def test_a_camera_of_opencv_that_plays_a_file_keeps_every_promise_without_trust(program: Program) -> None:
    cv2 = pytest.importorskip("cv2")
    video = str(program.home / "press.avi")
    writer = cv2.VideoWriter(video, cv2.VideoWriter_fourcc(*"MJPG"), 30, (320, 240))
    for number in range(20):
        picture = np.full((240, 320, 3), 10, np.uint8)
        picture[100:140, 10 * number : 10 * number + 40] = (30, 120, 250)
        writer.write(picture)
    writer.release()
    key, given = "org.example.opencv-camera", f"file={video}"
    refused = program.check(key, package("opencv-camera"), "--with", f"{key}/video:{given}", "--only", "sensor/gives")
    assert "taceva plugin allow" in refused["failed"][0], refused
    program.allow(key, f"read:{video}")
    groups = "library/,driver/opens,driver/discovers,driver/other-thread,sensor/"
    done = program.check(key, package("opencv-camera"), "--with", f"{key}/video:{given}", "--only", groups)
    assert done["failed"] == []
    assert any(line.startswith("sensor/interrupt-within-50-ms") for line in done["passed"]), done


def test_a_transducer_on_a_serial_port_keeps_every_promise_without_trust(program: Program) -> None:
    pytest.importorskip("serial")
    ours, theirs = os.openpty()
    port = os.ttyname(theirs)
    os.chmod(port, 0o666)
    ended = threading.Event()

    def send() -> None:
        number = 0
        os.set_blocking(ours, False)
        while not ended.is_set():
            number += 1
            try:
                os.write(ours, f"{1.5 + 0.001 * (number % 7):.3f}\n".encode())
            except BlockingIOError:
                pass
            time.sleep(0.01)

    sender = threading.Thread(target=send)
    sender.start()
    try:
        key = "org.example.serial-transducer"
        program.allow(key, f"serial:{port}")
        arguments = ["--with", f"{key}/line:port={port}", "--only", "library/,driver/opens,driver/other-thread,force/"]
        done = program.check(key, package("serial-transducer"), *arguments)
    finally:
        ended.set()
        sender.join()
        os.close(ours)
        os.close(theirs)
    assert done["failed"] == []
    assert any(line.startswith("force/") for line in done["passed"]), done


def test_an_estimator_of_torch_keeps_every_promise_without_trust(program: Program) -> None:
    pytest.importorskip("torch")
    key = "org.example.torch-estimator"
    groups = "library/loads,library/needs,estimator/fits-and,estimator/keeps,estimator/ends,estimator/predicts-nothing"
    done = program.check(key, package("torch-estimator"), "--only", groups, "--limit", "240")
    assert done["failed"] == []
    assert len(done["passed"]) >= 5, done


def test_a_fault_of_pictures_is_tested_beside_the_others_and_one_that_fails_is_named(program: Program) -> None:
    folder = program.home.parent
    force = np.tile(np.linspace(0.4, 2.0, 5), 12)
    place = np.repeat(np.arange(12), 5)
    across = np.arange(24)[None, None, :] - 4 - 1.4 * place[:, None, None]
    light = force[:, None, None] * np.exp(-(across**2) / 12) * np.ones((1, 16, 1))
    noise = np.random.default_rng(5).integers(0, 3, light.shape)
    frames = (75 + 50 * light + noise).astype(np.uint8)
    taceva.from_arrays(folder / "presses", force, frames, channels=["Fz"], points=place, sensor="drawn", source="synthetic")
    model = str(folder / "m.taceva")
    fitted = program.run("fit", str(folder / "presses"), "--model", "ridge", "--set", "size=8x8", "--out", model, "-q")
    assert fitted.returncode == 0, fitted.stderr
    key = "org.example.fogged-lens-python/fog"
    words = ["stress", str(folder / "presses"), "--model", model, "--faults", f"dust,{key}", "--severity", "1,4", "--by", "parameter"]
    words += ["--format", "json", "--plugin-dir"]
    tested = program.run(*words, str(package("fogged-lens")))
    assert tested.returncode == 0, tested.stderr
    report = json.loads(tested.stdout)
    assert report["list"]["name"] == "dust,fog"
    low, high = (severity["stimulus"] for severity in report["faults"][1]["severities"])
    assert 0 < low < high, report
    broken = folder / "broken/fogged_lens"
    shutil.copytree(package("fogged-lens"), broken, ignore=shutil.ignore_patterns("__pycache__"))
    code = (broken / "__init__.py").read_text()
    assert code.count("return mean + (") == 1
    (broken / "__init__.py").write_text(code.replace("return mean + (", "return np.nan * ("))
    failed = program.run(*words, str(broken))
    assert failed.returncode == 4, failed.stderr
    assert "fault fog failed: " in failed.stderr, failed.stderr
    report = json.loads(failed.stdout)
    assert [fault["id"] for fault in report["faults"]] == ["dust"]
    assert [fault["fault"] for fault in report["failed"]] == ["fog"]


def test_a_fault_refuses_other_bytes_than_those_of_a_fault(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(package("fogged-lens").parent))
    fogged_lens = __import__("fogged_lens")
    fog = fogged_lens.Fog.load(b"taceva.fault/1\nseverity=2\nseed=7\n", ["gray"], (1, 1, 1))
    darkest, brightest = fog.predict(np.array([0, 100], np.float32).reshape(2, 1, 1, 1))[:, 0]
    assert (darkest, brightest) == pytest.approx((15, 85))
    for other in (b"", b"taceva.fault/2\nseverity=2\n", b"taceva.fault/1\nseverity=6\n"):
        with pytest.raises(ValueError, match="expected the lines of a fault"):
            fogged_lens.Fog.load(other, ["gray"], (1, 1, 1))
