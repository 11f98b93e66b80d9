"""The packages in `examples/python-plugins` in a whole study on the wire bench, with an emulated arm, camera and gel in other processes.

`TACEVA_WIRE` names the program `taceva-wire`, which serves them; `TACEVA_WIRE_PRESSES` sets the number of presses, by default ten.
"""

from __future__ import annotations

import importlib.util
import json
import os
import random
import re
import socket
import subprocess
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
import taceva
from plugin_environment import Program, make_environment

EXAMPLES = Path(__file__).parents[2] / "examples"
PRESSES = int(os.environ.get("TACEVA_WIRE_PRESSES", "10"))
CAMERA, TRANSDUCER, NETWORK = "org.example.opencv-camera", "org.example.serial-transducer", "org.example.torch-estimator"
MODELS = {
    "ridge": 'name = "ridge"',
    "torch": f'name = "{NETWORK}/network"\nset = {{ size = "8x6", epochs = 50 }}',
}


@contextmanager
def wire_bench(rig: Path) -> Iterator[str]:
    """Emulated devices, and the text of their rig file."""
    program = os.environ.get("TACEVA_WIRE")
    if program is None:
        pytest.skip("TACEVA_WIRE names no program that serves emulated devices")
    served = subprocess.Popen([program, "--quiet", "--seed", "7", "--write", rig], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    assert served.stdin is not None and served.stdout is not None
    try:
        # The file is complete once the program prints its end time.
        while not (line := served.stdout.readline()).startswith("# It runs"):
            assert line, served.wait()
        yield rig.read_text()
    finally:
        # The program ends with its standard input.
        served.stdin.close()
        served.stdout.close()
        assert served.wait(timeout=30) == 0


@contextmanager
def serial_port(control: str) -> Iterator[str]:
    """A serial port with the normal force of the bench in N, one line every 5 ms. Noise of 1 mN avoids the detection of a frozen signal."""
    ours, theirs = os.openpty()
    port = os.ttyname(theirs)
    os.chmod(port, 0o666)
    os.set_blocking(ours, False)
    ended = threading.Event()
    host, _, number = control.rpartition(":")
    noise = random.Random(7)

    def send() -> None:
        with socket.create_connection((host, int(number))) as connection, connection.makefile("rw") as lines:
            while not ended.is_set():
                lines.write('"truth"\n')
                lines.flush()
                force = json.loads(lines.readline())["force_N"][2] + noise.gauss(0, 0.001)
                try:
                    os.write(ours, f"{force:.6f}\n".encode())
                except BlockingIOError:
                    # The port has no reader.
                    pass
                time.sleep(0.005)

    sender = threading.Thread(target=send)
    sender.start()
    try:
        yield port
    finally:
        ended.set()
        sender.join()
        os.close(ours)
        os.close(theirs)


def found(text: str, pattern: str) -> str:
    match = re.search(pattern, text)
    assert match is not None, text
    return match[1]


def with_plugins(rig: str, camera: str, transducer: str) -> str:
    """Rig file with another camera and another transducer, which measures only the normal force."""
    sections = re.split(r"\n(?=\[)", rig)
    kept = [section for section in sections if not section.startswith(("[force]", "[sensor]"))]
    kept.append(f'[force]\ndriver = "{transducer}"\naxes = ["x", "y", "z"]\nlatency_ms = 0.0\n')
    kept.append(f'[sensor]\ndriver = "{camera}"\nlatency_ms = 0.0\n')
    return "\n".join(kept)


@pytest.mark.parametrize("model", MODELS)
def test_the_example_packages_measure_in_a_whole_study_on_the_wire_bench(model: str, tmp_path: Path) -> None:
    for library in ["cv2", "serial", *(["torch"] if model == "torch" else [])]:
        # Not imported here, because torch causes its own warnings.
        if importlib.util.find_spec(library) is None:
            pytest.skip(f"no {library}")
    for above in [tmp_path, tmp_path.parent, tmp_path.parent.parent]:
        if above.stat().st_uid == os.geteuid() and above != Path("/"):
            above.chmod(above.stat().st_mode | 0o055)
    program = Program(tmp_path / "home", make_environment(tmp_path / "venv"))
    scene = (EXAMPLES / "scenes/wire.toml").read_text()
    scene = scene.replace("points = 100", f"points = {PRESSES}").replace("indentations = 4", "indentations = 1")
    scene = scene.replace('name = "fast"', MODELS[model])
    (tmp_path / "wire.toml").write_text(scene)
    with wire_bench(tmp_path / "rig.toml") as rig, serial_port(found(rig, r"JSON lines on ([0-9.]+:[0-9]+)")) as port:
        stream = re.search(r"http://([0-9.]+):([0-9]+)/", rig)
        assert stream is not None, rig
        camera = f"{CAMERA}/stream:host={stream[1]};port={stream[2]}"
        program.allow(CAMERA, f"tcp:{stream[1]}:{stream[2]}")
        program.allow(TRANSDUCER, f"serial:{port}")
        (tmp_path / "rig.toml").write_text(with_plugins(rig, camera, f"{TRANSDUCER}/line:port={port}"))
        given = []
        for name in ("opencv-camera", "serial-transducer", "torch-estimator"):
            given += ["--plugin-dir", str(EXAMPLES / "python-plugins" / name / "src" / name.replace("-", "_"))]
        done = program.run(
            "run", str(tmp_path / "wire.toml"), "--rig", str(tmp_path / "rig.toml"), "--out", str(tmp_path / "run"), "--no-cache",
            "--format", "json", "--quiet", *given,
        )
    assert done.returncode == 0, done.stderr
    study: dict[str, Any] = json.loads(done.stdout)["studies"][0]
    assert study["metrics"]["mae"]["Fz"]["value"] > 0
    recording = taceva.open(tmp_path / "run/recordings/1-wire")
    assert recording.frame_shape == (240, 320, 3)
    assert len(recording) == 2 * PRESSES
    labels = dict(zip(recording.channels, recording.labels().T, strict=True))
    # The transducer measured the presses of the arm; force grows with depth.
    assert labels["Fz"].max() > 0.1
    deepest, shallowest = labels["Pz"].argmax(), labels["Pz"].argmin()
    assert labels["Fz"][deepest] > labels["Fz"][shallowest]
    # The frames come from the bench: a press changes them.
    assert recording.frame(int(deepest)).std() > 0
    assert not (recording.frame(int(deepest)) == recording.frame(int(shallowest))).all()

