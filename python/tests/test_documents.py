"""Runs the Python code of the documents."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

WORKSPACE = Path(__file__).resolve().parents[2]


def blocks(path: Path) -> list[str]:
    """Return Python blocks that are not interactive sessions."""
    found = re.findall(r"^```python\n(.*?)^```", path.read_text(), re.MULTILINE | re.DOTALL)
    return [block for block in found if ">>>" not in block]


def test_every_block_of_the_documents_runs_as_it_is_pasted(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    skipped = []
    names: dict[str, object] = {}
    page = blocks(WORKSPACE / "docs" / "python.md")
    assert len(page) >= 4
    for block in [*page, *blocks(WORKSPACE / "python" / "README.md")]:
        if "torch" in block:
            try:
                import torch  # noqa: F401
            except ImportError:
                skipped.append(block.splitlines()[0])
                exec("import taceva; dataset = taceva.open('demo')", names)
                continue
        exec(compile(block, "block", "exec"), names)
    assert (tmp_path / "ridge.json").exists() and (tmp_path / "intervals-mae.pdf").read_bytes().startswith(b"%PDF")
    if skipped:
        pytest.skip(f"without torch {len(skipped)} blocks were not pasted")
