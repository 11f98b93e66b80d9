"""An environment whose plugins can run in the sandbox, and a program that finds them."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import sysconfig
from pathlib import Path

import pytest

# Number of tries of a check that fails with this text because of a measured time.
TRIES, LATE = 6, " took "

# Interpreters that may have the same compiled modules as this one.
_CANDIDATES = ["/usr/bin/python3", "/usr/local/bin/python3"]


def _is_open(path: str) -> bool:
    """Return whether an unprivileged user can enter `path`; under root, plugins run as such a user."""
    real = Path(path).resolve()
    return all(part.stat().st_mode & 0o001 for part in [*real.parents, real] if part.is_dir())


def base_interpreter() -> str:
    """Return an interpreter of this version that the sandbox user can read; skip the test if there is none."""
    if os.geteuid() != 0:
        return sys.executable
    packages = sysconfig.get_paths()["purelib"]
    if not _is_open(packages):
        pytest.skip(f"a plugin of root runs as another user, who may not read {packages}")
    if _is_open(sys.base_prefix):
        return sys.executable
    for candidate in _CANDIDATES:
        if not os.path.exists(candidate):
            continue
        ask = "import sys; print(sys.version_info[:2] == %r)" % (sys.version_info[:2],)
        said = subprocess.run([candidate, "-I", "-c", ask], capture_output=True, text=True, check=False)
        if said.stdout.strip() == "True":
            return candidate
    pytest.skip(f"a plugin of root runs as another user, who may not read {sys.base_prefix}, and no other Python of this version is there")


def make_environment(folder: Path) -> Path:
    """Create an environment with the packages of this one; return its interpreter."""
    subprocess.run([base_interpreter(), "-m", "venv", "--without-pip", str(folder)], check=True)
    packages = folder / "lib" / f"python{sys.version_info[0]}.{sys.version_info[1]}" / "site-packages"
    # A plain path would not be searched for further path files, such as that of an editable installation.
    beside = sysconfig.get_paths()["purelib"]
    (packages / "of_the_tests.pth").write_text(f"import site; site.addsitedir({beside!r})\n")
    return folder / "bin" / "python"


def add_package(python: Path, source: Path, module: str, entry: str, value: str | None = None) -> None:
    """Install a package like an editable installation: by a path file, and with its entry point."""
    packages = next((python.parent.parent / "lib").glob("python3*")) / "site-packages"
    (packages / f"{module}.pth").write_text(f"{source}\n")
    about = packages / f"{module}-1.0.0.dist-info"
    about.mkdir()
    (about / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {module}\nVersion: 1.0.0\n")
    (about / "entry_points.txt").write_text(f"[taceva.plugins]\n{entry} = {value or module}\n")


class Program:
    """The program `taceva` with its own settings and plugins."""

    def __init__(self, home: Path, python: Path) -> None:
        self.home = home
        self.python = python
        self.allowed: dict[str, tuple[str, ...]] = {}
        home.mkdir(exist_ok=True)
        home.chmod(0o755)
        self.variables = {
            name: value for name, value in os.environ.items() if not name.startswith(("XDG_", "TACEVA_PLUGIN"))
        }
        self.variables |= {"HOME": str(home)}

    def run(self, *arguments: str) -> subprocess.CompletedProcess[str]:
        command = [sys.executable, "-m", "taceva", *arguments, "--python", str(self.python)]
        return subprocess.run(command, capture_output=True, text=True, check=False, env=self.variables, timeout=500)

    def allow(self, id: str, *needs: str) -> None:
        """Allow a plugin these needs only."""
        self.allowed[id] = needs
        file = self.home / ".config/taceva/config.toml"
        file.parent.mkdir(parents=True, exist_ok=True)
        lines = [f"{json.dumps(id)} = {json.dumps(needs)}\n" for id, needs in self.allowed.items()]
        file.write_text("[plugins.allow]\n" + "".join(lines))

    def check(self, id: str, folder: Path, *arguments: str) -> dict[str, list[str]]:
        """Check a plugin; return the lines by outcome. Repeats a check that was only late, because the machine may be busy."""
        given = ["plugin", "check", id, "--plugin-dir", str(folder), "--format", "json", *arguments]
        outcomes = self._outcomes(given)
        for _ in range(TRIES):
            late = [line for line in outcomes["failed"] if LATE in line]
            if not late:
                break
            names = ",".join(line.split(":")[0] for line in late)
            again = self._outcomes([*_without(given, "--only"), "--only", names])
            outcomes["failed"] = [line for line in outcomes["failed"] if line not in late] + again["failed"]
            outcomes["passed"] += again["passed"]
        return outcomes

    def _outcomes(self, given: list[str]) -> dict[str, list[str]]:
        done = self.run(*given)
        assert done.stdout, done.stderr
        outcomes: dict[str, list[str]] = {"passed": [], "failed": [], "skipped": []}
        for result in json.loads(done.stdout)["results"]:
            outcomes[result["outcome"]].append(f"{result['check']}: {result.get('why', '')}")
        return outcomes


def _without(arguments: list[str], option: str) -> list[str]:
    """Return the arguments without an option and its value."""
    if option not in arguments:
        return arguments
    at = arguments.index(option)
    return arguments[:at] + arguments[at + 2 :]
