"""Python plugins: found without import, confined, and rejected with a message if something is wrong."""

from __future__ import annotations

import json
import os
import re
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
import taceva
from plugin_environment import Program, add_package, make_environment

HEAD = "import taceva.plugin as tp\n"
SCALE = """
class Scale(tp.Force, title="scale", source="simulated", axes=["Fz"]):
    readings = 0
    def read(self, deadline):
        self.readings += 1
        return tp.Reading(1.5, self.readings * 0.01)
plugin = tp.Plugin("org.example.scale", "1.0.0", {"scale": Scale})
"""
MANIFEST = """manifest_version = 1
id = "org.example.scale"
name = "scale"
version = "1.0.0"
license = "MIT"

[program]
python = "lab_scale"
wire = 2

[[provides]]
kind = "force"
key = "scale"
title = "scale"
source = "simulated"
axes = ["Fz"]
"""
KEY = "org.example.scale"


@pytest.fixture(scope="module")
def environment(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return make_environment(opened(tmp_path_factory.mktemp("environment")) / "venv")


def opened(folder: Path) -> Path:
    """Return the folder, made accessible for every user; pytest closes its own."""
    for above in [folder, folder.parent, folder.parent.parent]:
        if above.stat().st_uid == os.geteuid():
            above.chmod(above.stat().st_mode | 0o055)
    return folder


@pytest.fixture
def program(tmp_path: Path, environment: Path) -> Program:
    return Program(opened(tmp_path) / "home", environment)


def package(folder: Path, code: str = SCALE, manifest: str = MANIFEST, name: str = "lab_scale") -> Path:
    made = folder / "src" / name
    made.mkdir(parents=True)
    (made / "__init__.py").write_text(HEAD + code)
    (made / "plugin.toml").write_text(manifest)
    for part in [folder, folder / "src", made]:
        part.chmod(0o755)
    return made


def failure(program: Program, made: Path, only: str, *more: str) -> str:
    """Return the reason why the checks of a plugin fail."""
    done = program.check(KEY, made, "--only", only, *more)
    assert done["failed"], done
    return "\n".join(done["failed"])


def test_an_editable_installation_is_found_by_its_entry_point_and_nothing_of_it_is_imported(
    tmp_path: Path, program: Program
) -> None:
    mark = tmp_path / "imported"
    made = package(tmp_path, f"open({str(mark)!r}, 'w').close()\n" + SCALE)
    own = make_environment(tmp_path / "venv")
    add_package(own, made.parent, "lab_scale", KEY)
    add_package(own, made.parent, "lab_nothing", "org.example.nothing")
    add_package(own, made.parent, "lab_part", "org.example.part", "lab_scale.part")
    program.python = own
    listed = program.run("plugin", "list", "--all")
    assert listed.returncode == 0, listed.stderr
    assert f"{KEY}/scale" in listed.stdout, listed.stdout
    assert "names `lab_nothing`: there is no module 'lab_nothing' in this environment" in listed.stdout
    assert "names `lab_scale.part`: expected the name of a top-level package" in listed.stdout
    assert not mark.exists()
    told = program.run("plugin", "info", KEY)
    assert f"lab_scale (interpreter), run by {own}" in told.stdout, told.stdout + told.stderr


def test_a_new_project_of_every_kind_says_what_its_manifest_says_and_keeps_every_promise(
    tmp_path: Path, program: Program
) -> None:
    groups = {
        "sensor": "sensor/",
        "force": "force/",
        "robot": "robot/",
        "lighting": "lighting/",
        "changer": "changer/",
        "estimator": "estimator/fits,estimator/keeps,estimator/refuses,estimator/ends",
    }
    for kind, only in groups.items():
        made = new(tmp_path, kind, f"my-{kind}")
        command = [sys.executable, "-m", "taceva.plugin", "manifest", f"my_{kind}"]
        said = subprocess.run(command, cwd=made.parent, capture_output=True, text=True, check=False)
        assert said.returncode == 0, said.stdout + said.stderr
        done = program.check(f"org.example.my-{kind}", made, "--only", f"library/loads,library/quiet,driver/opens,{only}")
        assert done["failed"] == [], (kind, done)
        assert len(done["passed"]) >= 6, (kind, done)


def test_a_manifest_of_another_wire_is_refused_with_both_numbers_and_the_remedy(tmp_path: Path, program: Program) -> None:
    made = package(tmp_path, manifest=MANIFEST.replace("wire = 2", "wire = 3"))
    listed = program.run("plugin", "list", "--all", "--plugin-dir", str(made)).stdout
    assert "written for wire version 3, but this TacEva has 2" in listed
    assert "python -m taceva.plugin manifest MODULE --write" in listed


def test_an_interpreter_that_is_gone_or_has_no_taceva_is_named_with_the_remedy(tmp_path: Path, program: Program) -> None:
    made = package(tmp_path)
    program.python = tmp_path / "gone/bin/python"
    listed = program.run("plugin", "list", "--all").stdout
    assert f"{program.python}: " in listed and "expected the interpreter of an environment" in listed
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", str(tmp_path / "bare")], check=True)
    program.python = tmp_path / "bare/bin/python"
    listed = program.run("plugin", "list", "--all").stdout
    assert "the package `taceva` is not installed in its environment" in listed
    assert f"{program.python} -m pip install PATH/TO/dist/taceva-" in listed
    other = package(tmp_path / "other", name="lab_other")
    listed = program.run("plugin", "list", "--all", "--plugin-dir", str(other)).stdout
    assert "the manifest of a module must be in its package, expected a folder called `lab_scale`" in listed
    (made / "__init__.py").unlink()
    listed = program.run("plugin", "list", "--all", "--plugin-dir", str(made)).stdout
    assert "not a package, expected __init__.py beside the manifest" in listed


def test_checks_without_a_required_argument_are_counted_by_the_reason_that_names_it(tmp_path: Path, program: Program) -> None:
    scale = SCALE.replace("    readings = 0\n", "    readings = 0\n    def __init__(self, file: str) -> None: ...\n")
    argument = '\n[[provides.args]]\nkey = "file"\ntype = "text"\n'
    made = package(tmp_path, code=scale, manifest=MANIFEST + argument)
    done = program.run("plugin", "check", KEY, "--plugin-dir", str(made), "--only", "force/reads,force/interrupt")
    last = done.stdout.rstrip().splitlines()[-1]
    remedy = f"give it with `--with {KEY}/scale:file=…`"
    assert re.fullmatch(r"\d+ skipped: `file`: missing, expected .*: " + re.escape(remedy), last), done.stdout + done.stderr
    assert "same reason" not in done.stdout


@pytest.mark.skipif(os.geteuid() != 0, reason="a plugin runs as another user for root alone")
def test_what_the_user_of_the_sandbox_may_not_read_is_refused_with_the_folder_that_closes_it(
    tmp_path: Path, program: Program
) -> None:
    made = package(tmp_path / "closed")
    (tmp_path / "closed").chmod(0o700)
    done = program.run("plugin", "check", KEY, "--plugin-dir", str(made))
    assert done.returncode != 0
    assert f"{tmp_path / 'closed'} denies it" in done.stderr, done.stderr
    assert "runs as user 65534" in done.stderr
    listed = program.run("plugin", "list", "--plugin-dir", str(made)).stdout
    assert f"    cannot run: let every user read {tmp_path / 'closed'} (`chmod o+rx`)" in listed, listed
    doctor = program.run("doctor", "--plugin-dir", str(made)).stdout
    assert f"`--trust {KEY}` runs it unconfined, in a process of its own" in doctor, doctor
    trusted = program.run("plugin", "check", KEY, "--plugin-dir", str(made), "--trust", KEY, "--only", "library/loads,force/reads")
    assert trusted.returncode == 0, trusted.stdout + trusted.stderr


def test_home_sockets_processes_and_programs_are_closed_to_a_plugin(tmp_path: Path, program: Program) -> None:
    (program.home / "secret").write_text("secret")
    code = f"""
import os, socket, subprocess
def tried(name, work):
    try:
        work()
    except PermissionError:
        return name + " refused"
    except BaseException as error:
        return name + " gave " + repr(error)
    return name + " ALLOWED"
class Scale(tp.Force, title="scale", source="simulated", axes=["Fz"]):
    def __init__(self):
        raise tp.Failure("device fault", ", ".join([
            tried("home", lambda: open({str(program.home / "secret")!r}).read()),
            tried("listing", lambda: os.listdir({str(program.home)!r})),
            tried("writing", lambda: open("/tmp/of-a-plugin", "w")),
            tried("socket", lambda: socket.socket()),
            tried("fork", os.fork),
            tried("program", lambda: os.execv("/bin/true", ["true"])),
        ]))
plugin = tp.Plugin("org.example.scale", "1.0.0", {{"scale": Scale}})
"""
    why = failure(program, package(tmp_path, code), "driver/opens")
    for closed in ["home", "listing", "writing", "socket", "fork", "program"]:
        assert f"{closed} refused" in why, why


FAULTS = {
    "raises": ("raise ValueError('the cell is wet')", "ValueError: the cell is wet ("),
    "says_not_finite": ("return tp.Reading(float('nan'), 0.01)", "is NaN, expected a number"),
    "has_another_shape": ("return tp.Reading([1.0, 2.0], 0.01)", "expected Fz, [Fx, Fy, Fz] or [Fx, Fy, Fz, Tx, Ty, Tz]"),
    "gives_nothing": ("return None", "expected taceva.plugin.Reading(force, time)"),
    "gives_no_time": ("return tp.Reading(1.0, 'now')", "a time of type str, expected seconds as taceva.plugin.now() counts them"),
    "counts_by_a_word": ("return tp.Reading(1.0, 0.01, None, 'two')", "'str' object cannot be interpreted as an integer"),
    "leaves_the_process": ("import os; os._exit(3)", "the process ended"),
    "ends_the_interpreter": ("raise SystemExit('bye')", "SystemExit: bye"),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_a_plugin_that_does_wrong_fails_with_what_it_did_and_what_is_expected(
    fault: str, tmp_path: Path, program: Program
) -> None:
    does, said = FAULTS[fault]
    code = SCALE.replace("self.readings += 1", does)
    assert said in failure(program, package(tmp_path, code), "force/reads")


def test_a_long_message_keeps_its_beginning_its_end_and_where_it_was_raised(tmp_path: Path, program: Program) -> None:
    code = SCALE.replace("self.readings += 1", "raise ValueError('begins ' + 'x' * 5000 + ' ends')")
    why = failure(program, package(tmp_path, code), "force/reads")
    assert "ValueError: begins xxx" in why and "characters left out" in why and "xxx ends (" in why and "__init__.py, line 6)" in why, why
    code = SCALE.replace("self.readings += 1", "raise ValueError('of 300 ' + 'y' * 300 + ' whole')")
    why = failure(program, package(tmp_path / "whole", code), "force/reads")
    assert "y" * 300 + " whole (" in why and "left out" not in why, why


def test_a_plugin_that_hangs_while_it_is_imported_is_told_of_in_these_words(tmp_path: Path, program: Program) -> None:
    made = package(tmp_path, "import time; time.sleep(1000)\n" + SCALE)
    why = failure(program, made, "library/loads", "--limit", "5")
    assert "it did not import its module within 5s" in why, why


ARM = """
import math
class Arm(tp.Robot, title="arm", source="simulated", limits={"speed_max_mm_s": 50.0}, guarded_motion=False):
    stands = tp.Pose(z=-20.0)
    def pose(self, deadline):
        return self.stands, tp.now()
    def move_to(self, target, speed, deadline):
        deadline.rest(math.dist(self.stands[:3], target[:3]) / speed)
        self.stands = target
        return tp.now()
    def halt(self):
        pass
plugin = tp.Plugin("org.example.scale", "1.0.0", {"scale": Arm})
"""
ARM_MANIFEST = MANIFEST.split("[[provides]]")[0] + """[[provides]]
kind = "robot"
key = "scale"
title = "arm"
source = "simulated"
limits = { speed_max_mm_s = 50.0 }
guarded_motion = false
"""


ARM_FAULTS = {
    "has_no_halt": ("    def halt(self):\n        pass\n", "", "Arm has no halt(), expected a method that stops the motion from any thread", "robot/says"),
    "says_no_pose": ("return self.stands, tp.now()", "return 1.0", "pose returned a float, expected (taceva.plugin.Pose(x, y, z), time)", "robot/says"),
    "has_another_pose": ("return self.stands, tp.now()", "return (1.0, 2.0), tp.now()", "not 3 or 6 numbers", "robot/says"),
    "stands_nowhere": ("return self.stands, tp.now()", "return (1.0, 2.0, math.nan), tp.now()", "NaN", "robot/says"),
    "ignores_halts": ("deadline.rest(", "import time; time.sleep(", "moving without time succeeded, expected `timeout`", "robot/timeout"),
    "cannot_be_stopped": ("pass", "raise ConnectionError('the cable')", "ConnectionError: the cable", "robot/halts-twice"),
    "moves_after_its_deadline": (
        "deadline.rest(",
        "raise ValueError('jammed'); (",
        "ValueError: jammed",
        "robot/moves-and",
    ),
    "guards_without_a_method": (
        "guarded_motion=False",
        "guarded_motion=True",
        "no method move_guarded(target, speed, force, deadline)",
        "driver/opens",
    ),
}


@pytest.mark.parametrize("fault", ARM_FAULTS)
def test_a_robot_that_does_wrong_fails_with_what_it_did_and_what_is_expected(fault: str, tmp_path: Path, program: Program) -> None:
    found, does, said, only = ARM_FAULTS[fault]
    manifest = ARM_MANIFEST.replace("guarded_motion = false", "guarded_motion = true" if "True" in does else "guarded_motion = false")
    made = package(tmp_path, ARM.replace(found, does), manifest)
    assert said in failure(program, made, only), fault


def test_a_robot_that_stops_at_a_force_and_one_that_stops_by_itself_keep_every_promise(tmp_path: Path, program: Program) -> None:
    code = ARM.replace("guarded_motion=False", "guarded_motion=True").replace("    def halt(self):", """    def move_guarded(self, target, speed, force, deadline):
        self.move_to(target, speed, deadline)
        return self.pose(deadline) if target.z > 0 else tp.now()
    move_expiring = move_to
    def halt(self):""")
    made = package(tmp_path, code, ARM_MANIFEST.replace("guarded_motion = false", "guarded_motion = true"))
    done = program.check(KEY, made, "--only", "robot/,library/loads,driver/opens")
    assert done["failed"] == [], done
    assert any(line.startswith("robot/guards-that-are-none") for line in done["passed"]), done


def test_a_plugin_that_hangs_is_ended_and_one_that_prints_is_told_of(tmp_path: Path, program: Program) -> None:
    code = SCALE.replace("self.readings += 1", "import time; time.sleep(1000)")
    why = failure(program, package(tmp_path / "hangs", code), "force/reads", "--limit", "5")
    assert "it did not read the force within 5s" in why
    prints = package(tmp_path / "prints", "print('loaded')\n" + SCALE)
    assert "it printed" in failure(program, prints, "library/quiet")


def test_a_module_that_cannot_be_imported_is_refused_with_its_reason(tmp_path: Path, program: Program) -> None:
    missing = package(tmp_path / "missing", "import no_such_library\n" + SCALE)
    why = failure(program, missing, "library/loads")
    assert "No module named 'no_such_library'" in why and "install it in the environment of the plugin" in why
    empty = package(tmp_path / "empty", "plugin = None\n")
    assert "has no plugin, expected plugin = taceva.plugin.Plugin(" in failure(program, empty, "library/loads")
    other = package(tmp_path / "other", SCALE.replace('title="scale"', 'title="scale", tare=True'))
    assert "tare" in failure(program, other, "library/loads")


def test_code_that_comes_too_late_is_refused_and_the_remedy_is_named(tmp_path: Path, program: Program) -> None:
    late = SCALE.replace("self.readings += 1", "import sqlite3, lzma; self.readings += 1")
    why = failure(program, package(tmp_path / "late", late), "force/reads")
    assert "_sqlite3: failed to map segment; name its module in `preload` of plugin.toml" in why and "interpreter-open" in why
    for name, more in [("early", 'preload = ["sqlite3", "lzma"]'), ("open", 'profile = "interpreter-open"')]:
        made = package(tmp_path / name, late, MANIFEST.replace("wire = 2", f"wire = 2\n{more}"))
        done = program.check(KEY, made, "--only", "force/reads")
        assert done["failed"] == [], done
    listed = program.run("plugin", "list", "--plugin-dir", str(tmp_path / "open/src/lab_scale")).stdout
    assert ", may load code at any time" in listed, listed


def new(folder: Path, kind: str, name: str) -> Path:
    """Create a project like its author would; return its package."""
    command = [sys.executable, "-m", "taceva", "plugin", "new", kind, name, "--language", "python"]
    subprocess.run(command, cwd=folder, check=True, capture_output=True)
    return folder / name / "src" / name.replace("-", "_")


def test_an_estimator_in_python_is_evaluated_by_the_command(tmp_path: Path, program: Program) -> None:
    made = new(tmp_path, "estimator", "my-plane")
    random = np.random.default_rng(5)
    force = random.uniform(0, 5, 120)
    frames = np.zeros((120, 32, 32, 1), np.uint8) + (20 + 40 * force).astype(np.uint8)[:, None, None, None]
    frames += random.integers(0, 3, frames.shape, np.uint8)
    points = np.arange(120) // 4
    taceva.from_arrays(
        tmp_path / "recording",
        force,
        frames,
        channels=["Fz"],
        points=points,
        sensor="plate",
        source="synthetic",
    )
    key = "org.example.my-plane/my-plane"
    done = program.run(
        "evaluate", str(tmp_path / "recording"), "--model", key, "--metrics", "mae", "--no-cache",
        "--plugin-dir", str(made),
    )
    assert done.returncode == 0, done.stderr
    assert f"model {key}" in done.stdout and "Fz" in done.stdout, done.stdout


def silent_fit(folder: Path, seconds: float) -> tuple[str, list[str]]:
    """A recording and an estimator that prints, says that it begins, and then is silent for so long; the words that evaluate it."""
    made = new(folder, "estimator", "my-plane")
    code = made / "__init__.py"
    begins = f"""        import time
        print("a printed line")
        tp.log("the fit begins", "warn")
        time.sleep({seconds})
        progress.begin("solve", 1)
"""
    text = code.read_text()
    assert text.count('        progress.begin("solve", 1)\n') == 1
    code.write_text(text.replace('        progress.begin("solve", 1)\n', begins))
    force = np.linspace(0, 5, 40)
    frames = np.zeros((40, 32, 32), np.uint8) + (20 + 40 * force).astype(np.uint8)[:, None, None]
    taceva.from_arrays(folder / "recording", force, frames, channels=["Fz"], points=np.arange(40) // 2, sensor="plate", source="synthetic")
    key = "org.example.my-plane/my-plane"
    words = ["evaluate", str(folder / "recording"), "--model", key, "--split", "by-point", "--metrics", "mae", "--no-cache", "--plugin-dir", str(made)]
    return key, words


def test_torch_is_told_to_write_no_code_and_its_error_names_the_remedy(tmp_path: Path, program: Program) -> None:
    head = """
import sys, types
flags = []
library = types.SimpleNamespace(set_flags=flags.append)
sys.modules["torch"] = types.ModuleType("torch")
sys.modules["torch"].backends = types.SimpleNamespace(mkldnn=library, nnpack=library)
"""
    told = SCALE.replace("self.readings += 1", "self.readings += 1; assert flags == [False, False], flags")
    done = program.check(KEY, package(tmp_path / "told", head + told), "--only", "force/reads")
    assert done["failed"] == [] and done["passed"], done
    fails = SCALE.replace("self.readings += 1", "raise RuntimeError('could not create a primitive')")
    why = failure(program, package(tmp_path / "fails", fails), "force/reads")
    assert "oneDNN writes code: import torch" in why and "torch.backends.mkldnn.set_flags(False)" in why, why


def test_a_new_network_of_torch_is_that_of_the_examples(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "taceva", "plugin", "new"]
    words = ["estimator", "my-network", "--language", "python", "--with", "torch"]
    subprocess.run([*command, *words], cwd=tmp_path, check=True, capture_output=True)
    example = Path(__file__).parents[2] / "examples/python-plugins/torch-estimator/src/torch_estimator"
    made = tmp_path / "my-network/src/my_network"
    network = [(folder / "__init__.py").read_text().split("FILTERS = ")[1].split("plugin = ")[0] for folder in (made, example)]
    assert network[0] == network[1] and "torch.nn.Conv2d" in network[0]
    assert 'dependencies = ["taceva", "torch"]' in (tmp_path / "my-network/pyproject.toml").read_text()
    refused = subprocess.run([*command, "force", "my-scale", *words[2:]], cwd=tmp_path, check=False, capture_output=True, text=True)
    assert refused.returncode != 0 and "expected `taceva plugin new estimator NAME --language python --with torch`" in refused.stderr


def test_what_a_plugin_prints_is_told_where_details_are_asked_for(tmp_path: Path, program: Program) -> None:
    _, words = silent_fit(tmp_path, 0)
    quiet, loud = program.run(*words), program.run(*words, "-v")
    assert quiet.returncode == loud.returncode == 0, quiet.stderr + loud.stderr
    assert "org.example.my-plane: printed: a printed line" in loud.stderr, loud.stderr
    assert "a printed line" not in quiet.stderr and "the fit begins" in quiet.stderr, quiet.stderr


@pytest.mark.parametrize("sent", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_against_a_silent_fit_is_answered_at_once_and_ends_it_in_seconds(tmp_path: Path, program: Program, sent: signal.Signals) -> None:
    key, words = silent_fit(tmp_path, 1000)
    command = [sys.executable, "-m", "taceva", *words, "--python", str(program.python)]
    with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, env=program.variables) as running:
        assert running.stderr is not None
        try:
            before = next((line for line in running.stderr if "the fit begins" in line), None)
            assert before is not None
            running.send_signal(sent)
            begun = time.monotonic()
            answered = next((line for line in running.stderr if f"stopping the fit of {key}" in line), None)
            assert answered is not None and time.monotonic() - begun < 5, answered
            assert running.wait(timeout=30) != 0
            # The limit is five seconds. The bound is wide for a busy machine, but far from the thirty seconds of other calls.
            assert time.monotonic() - begun < 20
        finally:
            running.kill()


def test_harmless_checks_share_a_process_and_run_alone_where_that_fails(tmp_path: Path, program: Program) -> None:
    made = new(tmp_path, "estimator", "my-plane")
    code, key = made / "__init__.py", "org.example.my-plane"
    text = code.read_text().replace('        progress.begin("solve", 1)', '        Model.fits += 1\n        progress.begin("solve", 1)')
    text = text.replace("    def save(self) -> bytes:", "    fits = 0\n\n    def save(self) -> bytes:")
    # A model that only the third fit of a process can save: it keeps its promise in company alone.
    code.write_text(text.replace("        return self.weights.astype", "        assert Model.fits >= 3\n        return self.weights.astype"))
    assert program.check(key, made, "--only", "estimator/keeps")["failed"]
    done = program.check(key, made, "--only", "estimator/fits,estimator/keeps")
    assert done["failed"] == [] and len(done["passed"]) == 3, done
    # Three fits in one process are too many for this one, and alone each check needs two at most.
    code.write_text(text.replace("        Model.fits += 1\n", "        Model.fits += 1\n        assert Model.fits <= 2\n"))
    done = program.check(key, made, "--only", "estimator/fits,estimator/keeps,estimator/predicts")
    assert done["failed"] == [] and len(done["passed"]) == 5, done


def test_complex_predictions_of_a_plugin_are_refused_as_those_of_any_model(tmp_path: Path, program: Program) -> None:
    made = new(tmp_path, "estimator", "my-plane")
    code = made / "__init__.py"
    code.write_text(code.read_text().replace("return np.einsum(", "return 1j + np.einsum("))
    done = program.check("org.example.my-plane", made, "--only", "estimator/fits")
    assert "prediction of the model: expected numbers, found an array of complex128" in "\n".join(done["failed"]), done


@pytest.mark.parametrize(
    ("instead", "said"),
    [
        ("np.einsum(", "ValueError: `predict` returned None, expected an array ["),
        ("return self.columns(features)\n        np.einsum(", "ValueError: the model predicted an array of the shape ["),
    ],
)
def test_predictions_that_do_not_fit_name_the_line_of_predict(
    instead: str, said: str, tmp_path: Path, program: Program
) -> None:
    made = new(tmp_path, "estimator", "my-plane")
    code = made / "__init__.py"
    text = code.read_text().replace("return np.einsum(", instead)
    code.write_text(text)
    line = 1 + next(number for number, line in enumerate(text.splitlines()) if "def predict" in line)
    why = "\n".join(program.check("org.example.my-plane", made, "--only", "estimator/fits-and")["failed"])
    assert said in why and f"__init__.py, line {line})" in why, why
    assert "_predictions.py" not in why and "_arrays.py" not in why, why


def test_a_syntax_error_names_its_file_and_line_once(tmp_path: Path, program: Program) -> None:
    made = package(tmp_path, SCALE + "x = (\n")
    why = failure(program, made, "library/loads")
    line = 1 + (HEAD + SCALE).count("\n")
    assert f"SyntaxError: '(' was never closed ({made / '__init__.py'}, line {line})" in why, why
    assert why.count(", line ") == 1 and "frozen" not in why, why


@pytest.mark.parametrize("before", ["", "import sys; sys.setrecursionlimit(10**9); "])
def test_an_estimator_that_calls_itself_without_end_fails_with_its_line_whatever_limit_it_sets(
    before: str, tmp_path: Path, program: Program
) -> None:
    made = new(tmp_path, "estimator", "my-plane")
    code = made / "__init__.py"
    code.write_text(code.read_text().replace("return np.einsum(", f"{before}return self.predict(features) or np.einsum("))
    why = "\n".join(program.check("org.example.my-plane", made, "--only", "estimator/fits")["failed"])
    assert "RecursionError: " in why and "the plugin recurses too deeply" in why and "__init__.py, line" in why, why


def test_an_estimator_that_asks_for_plugins_fails_in_words_and_starts_none(tmp_path: Path, program: Program) -> None:
    made = new(tmp_path, "estimator", "my-plane")
    code = made / "__init__.py"
    code.write_text(code.read_text().replace("return np.einsum(", "import taceva; taceva.plugins()\n        return np.einsum("))
    why = "\n".join(program.check("org.example.my-plane", made, "--only", "estimator/fits")["failed"])
    assert "a plugin cannot use plugins or the command" in why, why


# Scene of the guide.
SCENE = re.findall(r"^```toml eye.toml\n(.*?)^```$", (Path(__file__).parents[2] / "docs/python-plugins.md").read_text(), re.MULTILINE | re.DOTALL)[0]


def test_a_sensor_in_python_is_measured_by_a_whole_run_of_the_command(tmp_path: Path, program: Program) -> None:
    made = new(tmp_path, "sensor", "my-eye")
    (tmp_path / "eye.toml").write_text(SCENE)
    studies = []
    for out in ["first", "again"]:
        done = program.run(
            "run", str(tmp_path / "eye.toml"), "--plugin-dir", str(made), "--out", str(tmp_path / out), "--no-cache",
            "--format", "json", "--quiet",
        )
        assert done.returncode == 0, done.stderr
        studies.append(json.loads(done.stdout)["studies"][0])
    assert studies[0]["subject"]["source"] == "simulated"
    # Frames come a hundred times a second by the clock of the plugin.
    assert abs(studies[0]["metrics"]["intrinsic"]["frame_rate"]["value"] - 100) < 0.1
    assert studies[0]["metrics"]["mae"]["Fz"]["value"] > 0
    assert studies[0]["provenance"]["dataset"] == studies[1]["provenance"]["dataset"]


def test_a_device_has_all_of_numpy_and_the_stack_that_a_thousand_equations_take(tmp_path: Path, program: Program) -> None:
    code = SCALE.replace("    readings = 0", """    readings = 0
    def __init__(self):
        import numpy as np
        matrix = np.random.default_rng(3).random((1600, 1600))
        assert np.linalg.solve(matrix, np.fft.fft(matrix[0]).real).shape == (1600,)""")
    done = program.check(KEY, package(tmp_path, code), "--only", "driver/opens")
    assert done["failed"] == [] and done["passed"], done


def test_a_plugin_in_a_library_runs_in_the_processes_of_this_interpreter(tmp_path: Path, program: Program) -> None:
    source = Path(__file__).parents[2] / "plugins"
    if shutil.which("cc") is None:
        pytest.skip("no C compiler")
    made = tmp_path / "c-example"
    shutil.copytree(source / "c-example", made, ignore=shutil.ignore_patterns("*.so"))
    text = (made / "plugin.toml").read_text()
    library = re.search(r'linux-x86_64 = \{ path = "([^"]+)"', text)
    assert library is not None
    files = sorted(map(str, (made / "src").glob("*.c")))
    command = ["cc", "-std=c11", "-D_GNU_SOURCE", "-O2", "-fPIC", "-fvisibility=hidden", "-pthread", "-shared"]
    command += ["-I", str(source / "abi/include"), "-o", str(made / library[1]), *files, "-lm"]
    subprocess.run(command, check=True, capture_output=True)
    id = re.search(r'^id = "([^"]+)"', text, re.MULTILINE)
    assert id is not None
    done = program.check(id[1], made, "--only", "library/loads,driver/opens,sensor/gives,force/reads")
    assert done["failed"] == [], done
    assert len(done["passed"]) >= 4, done
