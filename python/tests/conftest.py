"""Shared parts of the tests: the command within Python, and a recording that it imported."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

# A shell ignores Ctrl-C for background processes, and Python then raises nothing.
signal.signal(signal.SIGINT, signal.default_int_handler)

RECORDINGS = Path(__file__).resolve().parents[2] / "tests" / "recordings"


def taceva(*arguments: str | os.PathLike[str], cwd: Path | None = None) -> subprocess.CompletedProcess[str]:
    """Run the command in its own process; tests of failures check the exit code."""
    words = [sys.executable, "-m", "taceva", *map(os.fspath, arguments)]
    return subprocess.run(words, cwd=cwd, capture_output=True, text=True, check=False)


@pytest.fixture(scope="session")
def recording(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Frames and labels of the recording `names`, imported."""
    out = tmp_path_factory.mktemp("recordings") / "names"
    source = RECORDINGS / "names"
    done = taceva("import", source, "--map", source / "map.toml", "--out", out)
    assert done.returncode == 0, done.stderr
    return out
