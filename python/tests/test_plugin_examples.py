"""The packages in `examples/python-plugins` pass all checks in the sandbox, if their libraries are installed."""

from __future__ import annotations

import os
import threading
import time
from pathlib import Path

import numpy as np
import pytest
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
