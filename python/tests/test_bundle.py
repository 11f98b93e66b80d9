"""Verification of bundles from Python: the numbers of the command, damage, and refusals."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
import taceva
from conftest import taceva as command


@pytest.fixture(scope="module")
def bundle(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A draft of two scored tables."""
    folder = tmp_path_factory.mktemp("bundle")
    truth, predicted = ["id,point_id,Fz"], ["id,Fz"]
    for row in range(30):
        force = 0.2 + 0.1 * (row % 4)
        truth.append(f"{row},p{row % 6},{force}")
        predicted.append(f"{row},{force + 0.001 * (row * 7919 % 13 - 6)}")
    (folder / "truth.csv").write_text("\n".join(truth) + "\n")
    (folder / "pred.csv").write_text("\n".join(predicted) + "\n")
    tables = ["--truth", "truth.csv", "--pred", "pred.csv"]
    for words in [
        ["score", *tables, "--format", "json", "--out", "result.json", "--state-out", "result.state"],
        ["bundle", "result.json", "--state", "result.state", *tables, "--draft", "--out", "b"],
    ]:
        done = command(*words, cwd=folder)
        assert done.returncode == 0, done.stderr
    return folder / "b"


def test_a_bundle_is_verified_as_by_the_command(bundle: Path, tmp_path: Path) -> None:
    found = taceva.bundle.verify(bundle, level="predictions")
    done = command("bundle", "verify", bundle, "--level", "predictions", "--format", "json")
    assert done.returncode == 0, done.stderr
    assert found.is_verified and found.to_dict() == json.loads(done.stdout)
    claims = found.to_dict()["claims"]
    assert {claim["level"] for claim in claims} == {"predictions"}
    assert len(found.to_frame()) == len(claims)
    assert f"{len(claims)} equal" in repr(found) and "predictions: reached" in str(found)
    found.save(tmp_path / "v.json")
    assert json.loads((tmp_path / "v.json").read_text()) == found.to_dict()


def test_damage_is_named_and_no_error(bundle: Path) -> None:
    table = bundle / "tables" / "prediction.csv"
    whole = table.read_bytes()
    table.write_bytes(whole.replace(b"0.2", b"0.3", 1))
    try:
        found = taceva.bundle.verify(bundle)
    finally:
        table.write_bytes(whole)
    assert not found.is_verified
    assert found.to_dict()["damage"][0]["path"] == "tables/prediction.csv"
    assert "1 damaged file" in repr(found)


def test_an_unknown_level_and_a_missing_bundle_are_refused(bundle: Path, tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="deep"):
        taceva.bundle.verify(bundle, level="deep")
    with pytest.raises(ValueError, match=r"nowhere\.tar\.gz"):
        taceva.bundle.verify(tmp_path / "nowhere.tar.gz")
