"""Page of a result, by the command of the program."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path

from taceva import _taceva
from taceva._result import Result


def report(result: Result | str | os.PathLike[str], out: str | os.PathLike[str], *, replace: bool = False) -> Path:
    """Write the page of a result with its figures and tables into a folder, as ``taceva report`` does, and return the path of the page.

    Parameters
    ----------
    result
        A result, whose page also draws its samples if it keeps them. Or the path of a result, or of the folder of a run.
    out
        The folder for ``report.html``, ``figures/`` and the tables ``scores.csv``, ``scores.md``, ``scores.tex`` and ``scores-main.tex``.
    replace
        True to replace a report that is there.

    Raises
    ------
    ValueError
        For a path without results, and for a folder that has a report, unless ``replace`` is true.

    >>> import tempfile
    >>> import taceva
    >>> result = taceva.score([[0.0], [1.0]], [[0.5], [1.0]], channels=["Fz"], name="my model")
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     taceva.report(result, folder).name
    'report.html'
    """
    with tempfile.TemporaryDirectory() as created:
        if isinstance(result, Result):
            path = Path(created) / "result.json"
            result.save(path)
            if result._table_of_samples() is not None:
                result.save_samples(path.with_suffix(".samples.csv"))
        else:
            path = Path(result)
        words = ["taceva", "report", os.path.abspath(path), f"--out={os.path.abspath(out)}"]
        return Path(_taceva.write_report([*words, "--force"] if replace else words))
