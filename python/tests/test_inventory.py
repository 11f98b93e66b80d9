"""Models, metrics and plugins by name: Python finds the same as the command, and returns the same bytes."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path

import numpy as np
import pytest
import taceva
from plugin_environment import Program, make_environment
from test_plugins import new, opened

KEY = "org.example.my-plane/my-plane"


def test_every_listed_name_is_taken_and_explained() -> None:
    models, metrics = taceva.models(), taceva.metrics()
    assert {"baseline", "ridge", "cnn", "auto", "fast", "linfa/elastic-net"} <= set(models)
    assert {"mae", "rmse", "bias", "r2", "accuracy", "all"} <= set(metrics)
    assert all(about.strip() for about in (*models.values(), *metrics.values()))
    truth = np.arange(12.0).reshape(6, 2)
    for name in metrics:
        taceva.score(truth, truth + 0.5, channels=["Px", "Fz"], metrics=name, independent=True)


def test_a_plugin_is_found_listed_and_evaluated_as_by_the_command(tmp_path: Path) -> None:
    folder = opened(tmp_path)
    program = Program(folder / "home", make_environment(folder / "venv"))
    made = new(tmp_path, "estimator", "my-plane")
    force = np.linspace(0, 5, 60)
    frames = np.zeros((60, 32, 32), np.uint8) + (20 + 40 * force).astype(np.uint8)[:, None, None]
    recording = tmp_path / "recording"
    taceva.from_arrays(recording, force, frames, channels=["Fz"], points=np.arange(60) // 4, sensor="plate", source="synthetic")
    program.variables["TACEVA_PLUGIN_PATH"] = str(made)
    evaluated = program.run("evaluate", str(recording), "--model", KEY, "--split", "by-point", "--no-cache", "--format", "json")
    assert evaluated.returncode == 0, evaluated.stderr
    asked = (
        "import json, taceva\n"
        f"text = taceva.evaluate({str(recording)!r}, {KEY!r}, split='by-point').text\n"
        "found = [[plugin.id, plugin.place, plugin.estimators] for plugin in taceva.plugins()]\n"
        f"print(json.dumps([text, found, taceva.models()[{KEY!r}]]))\n"
    )
    done = subprocess.run([program.python, "-c", asked], capture_output=True, text=True, check=False, env=program.variables, timeout=500)
    assert done.returncode == 0, done.stderr
    text, found, about = json.loads(done.stdout)
    assert text == evaluated.stdout
    assert ["org.example.my-plane", "environment", [KEY]] in found
    assert "of the plugin org.example.my-plane" in about


def test_a_plugin_that_is_not_there_is_refused_by_its_name(recording: Path) -> None:
    with pytest.raises(ValueError, match="org.example.nothing/model"):
        taceva.evaluate(recording, "org.example.nothing/model", split="random 60/0/40")


def test_folds_are_those_of_the_command_and_test_each_row_once(recording: Path) -> None:
    dataset = taceva.open(recording)
    folds = dataset.folds("cv:3 random", seed=4)
    assert len(folds) == 3 and folds[0].split.startswith("cv:3 random")
    assert sorted(np.concatenate([fold.test for fold in folds]).tolist()) == list(range(len(dataset)))
    for fold in folds:
        assert not set(fold.test) & (set(fold.train) | set(fold.validation))
    assert [fold.test.tolist() for fold in folds] == [fold.test.tolist() for fold in dataset.folds("cv:3 random", seed=4)]
    with pytest.raises(ValueError, match="makes one division, expected folds"):
        dataset.folds("random 60/0/40")
    with pytest.raises(ValueError):
        dataset.folds(f"cv:{len(dataset) + 1} random")

