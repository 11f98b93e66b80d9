"""The program `examples/recompute`, which imports nothing of TacEva, on the folder of a small run."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from conftest import taceva

PROGRAM = Path(__file__).resolve().parents[2] / "examples" / "recompute"
SCENE = """scene_version = 1
name = "small"
seed = 7
robot = { driver = "sim/robot" }
force = { driver = "sim/force-transducer" }
lighting = { driver = "sim/lighting" }
model = { name = "ridge", set = { size = "8x8" } }
sensor = { driver = "sim/vitactip:reduction=16", units = ["0", "1"] }

[protocol]
calibration = { points = 60, indentations = 1 }
spatial = { points = 12 }
gratings = { step_mm = 0.75, presses = 2 }
lighting = { points = 6 }
repeatability = { points = 6, trials = 3, depth_step_mm = 0.5 }
hysteresis = { points = 5, depth_step_mm = 0.5 }
surface = { points = 8 }
idle = { frames = 12 }

[metrics.settings]
bins = 10
gate_N = 0.03
smoothing = 3
tolerance_mm = 0.1
"""


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    pytest.importorskip("pyarrow")
    folder = tmp_path_factory.mktemp("recompute")
    (folder / "small.toml").write_text(SCENE)
    done = taceva("run", folder / "small.toml", "--out", folder / "run", "--no-cache", "--quiet")
    assert done.returncode == 0, done.stderr
    return folder / "run"


def recomputed(run: Path) -> tuple[int, str]:
    done = subprocess.run([sys.executable, "-B", PROGRAM, run], capture_output=True, text=True, check=False)
    return done.returncode, done.stdout + done.stderr


def copied(run: Path, out: Path) -> Path:
    return Path(shutil.copytree(run, out, ignore=shutil.ignore_patterns("frames", "figures", "states")))


def count(text: str, kind: str) -> int:
    (found,) = re.findall(rf"^{kind} +(\d+)", text, re.MULTILINE)
    return int(found)


def test_every_number_of_a_run_is_computed_again_from_its_files(run: Path) -> None:
    code, text = recomputed(run)
    assert code == 0, text
    assert count(text, "not recomputed") == count(text, "differing") == 0, text
    total = sum(count(text, kind) for kind in ("equal", "within", "cancelling"))
    assert total == count(text, "numbers") > 5000, text
    # Every metric of the protocol has a score, so that none is left out.
    (study,) = json.loads((run / "results.json").read_text())["studies"]
    assert len(study["metrics"]) == 28 and count(text, "absent") == 0, text


def test_a_changed_number_is_named_with_its_place_and_both_values(run: Path, tmp_path: Path) -> None:
    changed = copied(run, tmp_path / "run")
    results = json.loads((run / "results.json").read_text())
    score = results["studies"][0]["metrics"]["rmse"]["Fz"]
    was = score["value"]
    score["value"] = was * (1 + 1e-9)
    (changed / "results.json").write_text(json.dumps(results))
    code, text = recomputed(changed)
    assert code == 1 and count(text, "differing") == 1, text
    assert f"studies.0.metrics.rmse.Fz.value: {score['value']!r} in the file, recomputed {was!r}"[:60] in text, text


def test_a_changed_constant_and_a_removed_score_are_named(run: Path, tmp_path: Path) -> None:
    changed = copied(run, tmp_path / "run")
    results = json.loads((run / "results.json").read_text())
    metrics = results["studies"][0]["metrics"]
    metrics["tolerance"]["Fz"]["parameters"]["tolerance"] = 0.04
    del metrics["rmse"]["Fx"], metrics["hysteresis"]
    (changed / "results.json").write_text(json.dumps(results))
    code, text = recomputed(changed)
    assert code == 1 and (count(text, "differing"), count(text, "absent")) == (1, 2), text
    assert "differing: studies.0.metrics.tolerance.Fz.parameters.tolerance: 0.04 in the file, recomputed 0.05" in text
    assert "no rmse.Fx, although plans.json asks for it" in text and "no hysteresis, although" in text


def test_a_number_without_a_rule_or_a_removed_one_is_not_passed_over(run: Path, tmp_path: Path) -> None:
    changed = copied(run, tmp_path / "run")
    results = json.loads((run / "results.json").read_text())
    metrics = results["studies"][0]["metrics"]
    metrics["mae"]["Fz"]["of_my_own"] = {"value": 0.5}
    del metrics["mae"]["Fx"]["ci95"]
    (changed / "results.json").write_text(json.dumps(results))
    code, text = recomputed(changed)
    assert code == 1, text
    assert "not recomputed: studies.0.metrics.mae.Fz.of_my_own.value: 0.5" in text
    assert "differing: studies.0.metrics.mae.Fx.ci95.0: no number in the file" in text


def test_a_changed_prediction_changes_the_scores_that_read_it(run: Path, tmp_path: Path) -> None:
    changed = copied(run, tmp_path / "run")
    (table,) = (changed / "reports").glob("*.samples.csv")
    header, *rows = table.read_text().splitlines()
    place = header.split(",").index("Fz_predicted")
    at = next(at for at, row in enumerate(rows) if ",idle," in row)
    # The idle phase names its point with a comma, so its row has one cell more.
    cells = rows[at].split(",")
    shift = len(cells) - len(header.split(","))
    cells[place + shift] = repr(float(cells[place + shift]) + 0.01)
    rows[at] = ",".join(cells)
    table.write_text("\n".join([header, *rows]) + "\n")
    code, text = recomputed(changed)
    assert code == 1, text
    assert "differing: studies.0.metrics.noise_equivalent_force.Fz.value" in text
    assert "metrics.sensitivity" not in text


def test_labels_that_the_table_of_samples_states_otherwise_than_the_recording_are_refused(run: Path, tmp_path: Path) -> None:
    changed = copied(run, tmp_path / "run")
    (table,) = (changed / "reports").glob("*.samples.csv")
    text = table.read_text()
    press = next(line for line in text.splitlines() if ",calibration," in line)
    table.write_text(text.replace(press, press.replace(",calibration,", ",idle,"), 1))
    code, said = recomputed(changed)
    assert code == 1 and "plans.json has the phases ['calibration'], the table of samples ['idle']" in said, said
