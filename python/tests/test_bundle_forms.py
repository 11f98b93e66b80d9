"""Forms of a bundle, read by the programs that they are for: mlcroissant, rocrate-validator and huggingface_hub."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from conftest import taceva as command

#: Interpreter that `.ci/install` gives the readers.
INSTALLED = Path(__file__).resolve().parents[2] / "target" / "libraries" / "bin" / "python"
READER = os.environ.get("TACEVA_LIBRARIES") or str(INSTALLED if INSTALLED.exists() else sys.executable)

#: Words that JSON and YAML must escape.
NAME, AUTHOR = 'Prüfstück "7": \\ #1', "Zoë \"Z\" O'Néill"
LAB = "https://lab.example"

CROISSANT = """
import json, sys
import mlcroissant

dataset = mlcroissant.Dataset(sys.argv[1] + "/croissant.json")
issues = dataset.metadata.ctx.issues
sets = {own.id: [str(record) for record in dataset.records(own.id)] for own in dataset.metadata.record_sets}
name, creator = dataset.metadata.name, dataset.metadata.creators[0].name
print("= " + json.dumps({"issues": sorted(issues.errors | issues.warnings), "sets": sets, "name": name, "creator": creator}))
"""

CRATE = """
import json, sys
from rocrate_validator import models, services
from rocrate_validator.utils.http import HttpRequester

settings = services.ValidationSettings(
    rocrate_uri=sys.argv[1],
    profile_identifier="process-run-crate-0.5",
    requirement_severity=models.Severity.RECOMMENDED,
    offline=True,
)
contexts = ["https://w3id.org/ro/crate/1.1/context", "https://w3id.org/ro/terms/workflow-run/context"]
missing = [url for url in contexts if HttpRequester().get(url, headers={"Accept": "application/ld+json"}).status_code != 200]
issues = [] if missing else [str(issue.message) for issue in services.validate(settings).get_issues()]
print("= " + json.dumps({"missing": missing, "issues": issues}))
"""

CARD = """
import json, pathlib, sys
import huggingface_hub, yaml

folder = pathlib.Path(sys.argv[1])
data = huggingface_hub.ModelCard.load(folder / "README.md").data
scores = [[own.metric_name, own.metric_value, own.metric_args] for own in data.eval_results]
entries = yaml.safe_load((folder / ".eval_results" / "taceva.yaml").read_text(encoding="utf-8"))
entries = huggingface_hub.parse_eval_result_entries(entries)
entries = [[own.dataset_id, own.task_id, own.value, own.date, own.notes] for own in entries]
print("= " + json.dumps({"name": data.model_name, "license": data.license, "scores": scores, "entries": entries}))
"""


ENTRIES = """
import json, pathlib, sys
import huggingface_hub, yaml

entries = yaml.safe_load(pathlib.Path(sys.argv[1]).read_text(encoding="utf-8"))
entries = huggingface_hub.parse_eval_result_entries(entries)
print("= " + json.dumps({"entries": [[own.dataset_id, own.value, own.source_url] for own in entries]}))
"""


@pytest.fixture(scope="module")
def bundle(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A finished bundle of two scored tables."""
    folder = tmp_path_factory.mktemp("forms")
    truth, predicted = ["id,point_id,Fx,Fz"], ["id,Fx,Fz"]
    for row in range(60):
        force = 0.2 + 0.1 * (row % 4)
        truth.append(f"{row},p{row % 15},{row % 3},{force}")
        predicted.append(f"{row},{row % 3 + 0.01 * (row % 7)},{force + 0.001 * (row * 7919 % 13 - 6)}")
    (folder / "truth.csv").write_text("\n".join(truth) + "\n")
    (folder / "pred.csv").write_text("\n".join(predicted) + "\n")
    (folder / "sensor.toml").write_text('model = "Foo"\n')
    tables = ["--truth", "truth.csv", "--pred", "pred.csv"]
    scored = ["--sensor", "sensor.toml", "--format", "json", "--out", "result.json", "--state-out", "result.state"]
    owner = ["--author", f"{AUTHOR} <0000-0002-1825-0097>", "--organization", f"Lab <{LAB}>", "--licence", "CC-BY-4.0"]
    for words in [
        ["score", *tables, *scored],
        ["bundle", "result.json", "--state", "result.state", *tables, *owner, "--name", NAME, "--out", "b"],
        ["bundle", "verify", "b", "--level", "predictions"],
    ]:
        done = command(*words, cwd=folder)
        assert done.returncode == 0, done.stderr
    return folder / "b"


def read(bundle: Path, module: str, script: str, home: Path) -> dict[str, Any]:
    """Run `script`, which needs `module`, on `bundle`; skip without it."""
    if subprocess.run([READER, "-c", f"import {module}"], capture_output=True, check=False).returncode != 0:
        pytest.skip(f"{READER} has no module `{module}`")
    quiet = {"HF_HUB_OFFLINE": "1", "HF_HUB_DISABLE_TELEMETRY": "1", "HF_HOME": str(home), "PYTHONIOENCODING": "utf-8"}
    done = subprocess.run(
        [READER, "-c", script, str(bundle)],
        env={**os.environ, **quiet},
        capture_output=True,
        encoding="utf-8",
        check=False,
    )
    assert done.returncode == 0, done.stderr
    line = next(line for line in done.stdout.splitlines() if line.startswith("= "))
    found: dict[str, Any] = json.loads(line[2:])
    return found


def claims(bundle: Path) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = json.loads((bundle / "bundle.json").read_text(encoding="utf-8"))["claims"]
    assert len(found) > 5
    return found


def test_mlcroissant_finds_nothing_to_warn_of_and_loads_every_row_of_both_tables(bundle: Path, tmp_path: Path) -> None:
    found = read(bundle, "mlcroissant", CROISSANT, tmp_path)
    assert found["issues"] == []
    assert {name: len(rows) for name, rows in found["sets"].items()} == {"truth": 60, "prediction": 60}
    assert "'truth/point_id': b'p0', 'truth/Fx': 0, 'truth/Fz': 0.2" in found["sets"]["truth"][0]
    assert (found["name"], found["creator"]) == (NAME, AUTHOR)


def test_rocrate_validator_recommends_nothing_more_of_a_run_of_a_program(bundle: Path, tmp_path: Path) -> None:
    found = read(bundle, "rocrate_validator", CRATE, tmp_path)
    if found["missing"]:
        contexts = ", ".join(found["missing"])
        pytest.skip(f"rocrate-validator has not cached {contexts}; `rocrate-validator cache warm` does so")
    assert found["issues"] == []


def test_huggingface_hub_reads_every_claim_with_interval_unit_and_number(bundle: Path, tmp_path: Path) -> None:
    found = read(bundle, "huggingface_hub", CARD, tmp_path)
    assert (found["name"], found["license"]) == (NAME, "cc-by-4.0")
    expected = claims(bundle)
    keys = ("ci95", "unit", "n", "definition")
    assert [args for _, _, args in found["scores"]] == [{key: claim[key] for key in keys} for claim in expected]
    assert [value for _, value, _ in found["scores"]] == [claim["value"] for claim in expected]
    manifest = json.loads((bundle / "bundle.json").read_text(encoding="utf-8"))
    for (samples, task, value, date, notes), claim in zip(found["entries"], expected, strict=True):
        assert (samples, value, date) == (manifest["samples_digest"], claim["value"], manifest["created"])
        assert task.startswith(claim["metric"]) and task.endswith("_" + claim["channel"])
        assert f"unit {claim['unit']}, n = {claim['n']}, definition {claim['definition']}" in notes


def test_the_forms_of_a_catalogue_are_read_without_a_warning(bundle: Path, tmp_path: Path) -> None:
    folder = tmp_path / "catalogue"
    for words in [
        ["add", str(bundle), "--to", str(folder), "--url", "https://example.org/b.tar.gz"],
        ["export", str(folder), "--hf", str(folder / "hub"), "--croissant", "--organization", f"Lab <{LAB}>"],
    ]:
        done = command("catalogue", *words, cwd=tmp_path)
        assert done.returncode == 0, done.stderr
    found = read(folder, "mlcroissant", CROISSANT, tmp_path)
    assert (found["issues"], found["sets"], found["creator"]) == ([], {}, AUTHOR)
    found = read(folder / "hub" / ".eval_results" / "foo.yaml", "huggingface_hub", ENTRIES, tmp_path)
    manifest = json.loads((bundle / "bundle.json").read_text(encoding="utf-8"))
    expected = sorted(claim["value"] for claim in manifest["claims"])
    assert sorted(value for _, value, _ in found["entries"]) == expected
    for samples, _, address in found["entries"]:
        assert (samples, address) == (manifest["samples_digest"], "https://example.org/b.tar.gz")
