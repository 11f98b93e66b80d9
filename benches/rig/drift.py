"""Forces and depths of a study with a turned tool frame, a low pass and a drifting zero, by this program and by an earlier one.

    cargo build --release -p taceva-cli -p taceva-wire
    git worktree add ../earlier 4652bc02b^ && (cd ../earlier && cargo build --release -p taceva-cli)
    python3 benches/rig/drift.py target/release/taceva target/release/taceva-wire ../earlier/target/release/taceva

4652bc02b reads the page of a box, so the program before it is the last that does not. Each row is one study of six presses on emulated
devices: an xArm, a Net F/T box and a camera. The box is plain, or it turns forces by 90 degrees about x, delays them by 32 ms and drifts by
0.02 N a minute. A program that refuses a file is quoted, and then gets files as its own documents ask for them: without `frame=tool`, turned
axes, a latency and `depth_from`. Forces are compared with those of this program and a plain box, depths with those of the gel. Readings
32 ms old become stale at 50 ms, so the machine must be quiet. Exits with 1 if this program misses 2 % of the greatest force or 0.02 mm.
"""
import csv
import json
import pathlib
import re
import socket
import subprocess
import sys
import tempfile
import threading

OWN = 'axes = ["x", "-y", "-z"]'
TURNED = 'axes = ["x", "z", "-y"]'
BENT = ["--tool", "0;0;0;90;0;0", "--filter", "8", "--drift", "0.02"]
SCENE = pathlib.Path(__file__).parents[2] / "examples/scenes/wire.toml"
PRESSES = 6
# Restarts of a run that a busy machine ended, and longest time of one.
PATIENCE, LONGEST_S = 6, 600
# Height between two presses, and greatest distance of a sheared sample from the place of its press.
IN_AIR_MM, NEAR_MM = -0.5, 1.0
FORCE_PART, DEPTH_MM = 0.02, 0.02


def scene(is_fitted):
    """Scene of six presses, with depths from a fitted surface or from the first reading in contact."""
    text = SCENE.read_text()
    changes = [("points = 100", f"points = {PRESSES}"), ("indentations = 4", "indentations = 1"), ('name = "fast"', 'name = "ridge"')]
    threshold = "threshold_N = 0.021"
    for before, after in changes + ([(threshold, f'{threshold}\ndepth_from = "surface"')] if is_fitted else []):
        assert before in text, f"{SCENE} has no `{before}`"
        text = text.replace(before, after)
    return text


def rig(text, is_stated):
    """Rig file of the emulated devices; `is_stated` writes down what a turned and filtered box does."""
    if not is_stated:
        return text
    robot, rest = text.split("[force]\n", 1)
    driver, rest = rest.split('"\n', 1)
    rest = rest.replace(OWN, TURNED, 1).replace("latency_ms = 0.0", "latency_ms = 31.8", 1)
    return f'{robot}[force]\n{driver};frame=tool"\n{rest}'


class Watch(threading.Thread):
    """Deepest places of the tip between two ways through the air, as the gel knows them."""

    def __init__(self, rig_file):
        super().__init__(daemon=True)
        host, port = re.search(r"JSON lines on ([0-9.]+):(\d+)", rig_file).groups()
        self.control = socket.create_connection((host, int(port))).makefile("rw")
        self.touches, self.is_over = [], threading.Event()

    def run(self):
        deepest = None
        while not self.is_over.wait(0.005):
            self.control.write('"truth"\n')
            self.control.flush()
            truth = json.loads(self.control.readline())
            x, y, z = truth["tip_mm"]
            if z < IN_AIR_MM:
                self.touches += [deepest] if deepest else []
                deepest = None
            elif truth["depth_mm"] > (deepest[2] if deepest else 0.0):
                deepest = (x, y, truth["depth_mm"])
        self.touches += [deepest] if deepest else []

    def end(self):
        self.is_over.set()
        self.join()
        return self.touches


def study(program, folder):
    """Runs the study to its end. Returns its samples, or what the program said."""
    for _ in range(PATIENCE):
        command = [program, "run", "wire.toml", "--rig", "rig.toml", "--out", "run", "--no-cache", "--quiet"]
        command += ["--resume"] if (folder / "run").exists() else []
        try:
            ended = subprocess.run(command, cwd=folder, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=LONGEST_S)
        except subprocess.TimeoutExpired:
            return f"no end within {LONGEST_S} s"
        if ended.returncode == 0:
            with open(folder / "run/reports/1-wire.samples.csv", newline="") as file:
                return list(csv.DictReader(file))
        if "ms old" not in ended.stderr and "ms late" not in ended.stderr:
            said = [line for line in ended.stderr.splitlines() if line.strip()]
            errors = [line for line in said if "error" in line.lower()]
            return (errors or said or ["no word"])[0]
    return "the machine is too busy"


def measure(program, server, box, is_stated, is_fitted):
    """Samples of a study and the touches of its gel, or what the program said."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        served = subprocess.Popen(
            [server, "--quiet", "--seed", "7", "--force", "netft", *box, "--write", str(folder / "served.toml")],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
        )
        try:
            for line in served.stdout:
                if line.startswith("# It runs"):
                    break
            text = (folder / "served.toml").read_text()
            (folder / "rig.toml").write_text(rig(text, is_stated))
            (folder / "wire.toml").write_text(scene(is_fitted))
            watch = Watch(text)
            watch.start()
            samples = study(program, folder)
            return samples, watch.end()
        finally:
            served.stdin.close()
            served.terminate()
            served.wait()


def numbers(sample, names):
    return [float(sample[name]) for name in names]


def differences(samples, touches, expected):
    """Greatest difference of a force from `expected`, as a part of the greatest force, and of a depth from that of the gel, mm."""
    axes, places = ["Fx", "Fy", "Fz"], ["Px", "Py", "Pz"]
    pairs = list(zip(samples, expected))
    greatest = max(abs(force) for sample in expected for force in numbers(sample, axes))
    apart = max(abs(a - b) for one, other in pairs for a, b in zip(numbers(one, axes), numbers(other, axes)))
    depth = 0.0
    for sample in samples:
        x, y, z = numbers(sample, places)
        near = [abs(touch[2] - z) for touch in touches if (touch[0] - x) ** 2 + (touch[1] - y) ** 2 < NEAR_MM**2]
        depth = max(depth, min(near, default=float("inf")))
    return apart / greatest, depth


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    today, server, earlier = (str(pathlib.Path(path).resolve()) for path in sys.argv[1:])
    runs = [
        ("this program", today, "plain"),
        ("this program", today, "turned, late, drifting"),
        ("earlier program", earlier, "plain"),
        ("earlier program", earlier, "turned, late, drifting"),
    ]
    print("| program | box | forces differ by | depths differ by |\n|---|---|---|---|")
    expected, is_met = None, True
    for name, program, box in runs:
        is_bent = box != "plain"
        samples, touches = measure(program, server, BENT if is_bent else [], is_bent, True)
        if isinstance(samples, str) and program == earlier:
            print(f"| {name} | {box} | refused: {samples} | |", flush=True)
            box += ", files as its documents ask"
            samples, touches = measure(program, server, BENT if is_bent else [], False, False)
        if isinstance(samples, str):
            print(f"| {name} | {box} | {samples} | |", flush=True)
            is_met &= program == earlier
            continue
        expected = expected or samples
        if len(samples) != len(expected):
            print(f"| {name} | {box} | {len(samples)} samples, expected {len(expected)} | |", flush=True)
            is_met &= program == earlier
            continue
        part, depth = differences(samples, touches, expected)
        print(f"| {name} | {box} | {100 * part:.2f} % of the greatest force | {depth:.4f} mm |", flush=True)
        is_met &= program == earlier or (part <= FORCE_PART and depth <= DEPTH_MM)
    sys.exit(not is_met)


if __name__ == "__main__":
    main()
