"""Follows the guide to Python plugins step by step."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

GUIDE = Path(__file__).parents[2] / "docs/python-plugins.md"
BLOCK = re.compile(r"^```(\w+)(?: (\S+))?\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def test_a_scale_in_python_is_made_as_the_guide_says(tmp_path: Path) -> None:
    section = GUIDE.read_text().split("## A scale in ten minutes")[1].split("\n## ")[0]
    programs = tmp_path / "bin"
    programs.mkdir()
    for name, command in {"taceva": "-m taceva", "python": ""}.items():
        program = programs / name
        program.write_text(f'#!/bin/sh\nexec "{sys.executable}" {command} "$@"\n')
        program.chmod(0o755)
    here, run = tmp_path, 0
    variables = os.environ | {"HOME": str(tmp_path), "PATH": f"{programs}:{os.environ['PATH']}"}
    for language, file, text in BLOCK.findall(section):
        if file:
            (here / file).write_text(text)
        elif language == "sh":
            script = f"set -eu\n{text}pwd > {tmp_path / 'pwd'}"
            done = subprocess.run(["bash", "-c", script], cwd=here, env=variables, capture_output=True, text=True, check=False)
            assert done.returncode == 0, done.stdout + done.stderr
            here, run = Path((tmp_path / "pwd").read_text().strip()), run + 1
    assert run == 2
    assert "my scale" in done.stdout and "org.example.my-scale/my-scale" in done.stdout
