"""Bundles of results: their numbers computed again, as ``taceva bundle verify`` does."""

from __future__ import annotations

import json
import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from taceva import _taceva
from taceva._counted import counted

__all__ = ["Verification", "verify"]


class Verification:
    """Result of `verify`: every claim with the number that was computed again, and the level that it reached."""

    def __init__(self, found: dict[str, Any]) -> None:
        self._found = found

    @property
    def text(self) -> str:
        """JSON ``taceva.verification/1``, as the command writes it by ``--format json``."""
        return str(self._found["document"])

    @property
    def is_verified(self) -> bool:
        """True if the bundle is whole, and every claim is equal or within the tolerance."""
        return bool(self._found["is_verified"])

    def to_dict(self) -> dict[str, Any]:
        """Return the JSON as a dictionary."""
        return dict(json.loads(self.text))

    def to_frame(self) -> Any:
        """Return a ``pandas.DataFrame`` with one row for each claim."""
        import pandas

        return pandas.DataFrame(self.to_dict()["claims"])

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the JSON to ``path``, which must not exist."""
        with Path(path).open("x", encoding="utf-8", newline="\n") as file:
            file.write(self.text)

    def __str__(self) -> str:
        return str(self._found["text"])

    def __repr__(self) -> str:
        found = self.to_dict()
        if found["damage"]:
            return f"<taceva.bundle.Verification: {counted(len(found['damage']), 'damaged file')}>"
        claims = counted(len(found["claims"]), "claim")
        return f"<taceva.bundle.Verification of {claims}: {found['summary']['equal']} equal>"


def verify(
    bundle: str | os.PathLike[str],
    *,
    level: str | None = None,
    datasets: Sequence[str | os.PathLike[str]] = (),
    tolerance: float = 0.0,
) -> Verification:
    """Compute the numbers of a bundle again, as ``taceva bundle verify`` does. Nothing of a bundle is executed.

    Parameters
    ----------
    bundle
        The path of a folder or of a ``.tar.gz``.
    level
        The level to reach: ``"files"``, ``"form"``, ``"scores"``, ``"predictions"``, ``"model"`` or ``"fit"``.
        By default the deepest level that the files allow.
    datasets
        The recordings of the results, on which their models predict again.
    tolerance
        The greatest difference between a claim and its recomputed number for the verdict ``within``, in the unit of each score.

    Returns
    -------
    Verification
        ``is_verified`` is False for a damaged bundle too. ``to_dict()["damage"]`` then names the files.

    Raises
    ------
    ValueError
        For a path that cannot be read, and for an unknown level.

    Examples
    --------
    >>> import taceva
    >>> taceva.bundle.verify("nowhere.tar.gz")
    Traceback (most recent call last):
        ...
    ValueError: nowhere.tar.gz: No such file or directory (os error 2)
    """
    words = ["taceva", "bundle", "verify", os.fspath(bundle), f"--tolerance={float(tolerance)!r}"]
    if level is not None:
        words.append(f"--level={level}")
    for dataset in datasets:
        words += ["--dataset", os.fspath(dataset)]
    return Verification(_taceva.verify_bundle(words))
