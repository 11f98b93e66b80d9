"""Checks of a plugin for the tests of its author."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence


class Checked(NamedTuple):
    """A check: its name, its subject, and ``"passed"`` or ``"skipped"`` with the reason."""

    check: str
    subject: str | None
    outcome: str
    why: str | None


def check(
    module: str,
    *,
    arguments: Mapping[str, str] | None = None,
    only: Sequence[str] = (),
    limit: float = 120,
) -> list[Checked]:
    """Check the plugin ``module`` like ``taceva plugin check``, in confined processes.

    Parameters
    ----------
    module : str
        Import name of the package, which is not imported here.
    arguments : mapping of str to str, optional
        Arguments of drivers by their keys: ``{"org.example.eye/camera": "index=1"}``.
    only : sequence of str
        Prefixes of the names of the checks to run; all if empty.
    limit : float
        Time limit of each check, in whole seconds.

    Returns
    -------
    list of Checked
        The passed and the skipped checks.

    Raises
    ------
    AssertionError
        If a check fails; the message lists all failures.
    """
    import importlib.util
    import tomllib

    spec = importlib.util.find_spec(module)
    if spec is None or spec.origin is None:
        raise ModuleNotFoundError(f"package {module!r} not found in this environment")
    folder = os.path.dirname(spec.origin)
    manifest = os.path.join(folder, "plugin.toml")
    if not os.path.exists(manifest):
        raise FileNotFoundError(
            f"{manifest} is missing: `python -m taceva.plugin manifest {module} --write` writes it"
        )
    with open(manifest, "rb") as file:
        id = tomllib.load(file)["id"]
    command = [sys.executable, "-m", "taceva", "plugin", "check", id, "--plugin-dir", folder]
    command += ["--format", "json", "--limit", str(int(limit))]
    for driver, given in (arguments or {}).items():
        command += ["--with", f"{driver}:{given}"]
    if only:
        command += ["--only", ",".join(only)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    try:
        results = json.loads(done.stdout)["results"]
    except (ValueError, KeyError):
        raise RuntimeError(f"{id} could not be checked: {done.stderr.strip()}") from None
    failed = [result for result in results if result["outcome"] == "failed"]
    if failed:
        lines = [f"{one['check']} {one.get('subject') or ''}: {one['why']}" for one in failed]
        raise AssertionError(f"{id} fails {len(failed)} of {len(results)} checks:\n" + "\n".join(lines))
    return [Checked(one["check"], one.get("subject"), one["outcome"], one.get("why")) for one in results]
