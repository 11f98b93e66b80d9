"""Comparison of two or more results, with tests of the differences."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import Any

from taceva import _taceva
from taceva._counted import counted
from taceva._figure import Figure, figures_of
from taceva._result import Result


class Comparison:
    """Result of `compare`: differences between results with intervals, and p-values adjusted by Holm for the number of comparisons."""

    def __init__(self, results: Sequence[Result], metrics: Sequence[str], margins: Mapping[str, float], seed: int) -> None:
        texts, samples = [result.text for result in results], [result._table_of_samples() for result in results]
        self._asked = (texts, samples, list(metrics), dict(margins), seed)

    def _form(self, form: str) -> str:
        return _taceva.comparison(*self._asked, form)

    def to_dict(self) -> dict[str, Any]:
        """Return the JSON that ``taceva compare --format json`` writes, as a dictionary."""
        return dict(json.loads(self._form("json")))

    def to_latex(self, table: str = "all") -> str:
        """Return a LaTeX table: every answer, or with ``"main"`` the main scores side by side, one column of a paper wide; it needs ``booktabs``.

        Raises
        ------
        ValueError
            For another table.
        """
        forms = {"all": "tex", "main": "main"}
        if table not in forms:
            raise ValueError(f"table {table!r}: expected 'all' or 'main'")
        return self._form(forms[table])

    def figures(self) -> list[Figure]:
        """Return all figures that show the results together.

        First come the values of each of the ``metrics`` of `compare` with intervals. Other figures are of every metric that the results have.
        """
        return figures_of(self._asked[0], self._asked[2])

    def __str__(self) -> str:
        return self._form("text")

    def _repr_html_(self) -> str:
        return self._form("html")


def compare(
    *results: Result,
    metrics: Sequence[str] = (),
    margins: Mapping[str, float] | None = None,
    seed: int = 0,
) -> Comparison:
    """Compare two or more results, as ``taceva compare`` does.

    Parameters
    ----------
    results
        Of the same metrics, such as of two models on one recording. The MAE of results of the same samples, in the same order and with the same
        points, is compared in pairs, and other scores by their intervals. `score`, `score_tables` and `evaluate` keep up to 200,000 samples;
        `TactileMetrics` keeps none, and a note states so.
    metrics
        Metrics to compare, by name, such as ``["mae", "r2"]``; by default every metric of both results with a better direction.
    margins
        The largest difference that still counts as equal, in the unit of the metric: ``{"mae.Fz": 0.05}``, or ``{"mae": 0.05}`` for every channel.
    seed
        Seed of the random signs of the sign-flip test.

    Raises
    ------
    ValueError
        For fewer than two results.

    >>> import taceva
    >>> truth = [[0.0], [1.0], [2.0], [3.0], [4.0], [5.0]]
    >>> close, far = ([[row[0] + error] for row in truth] for error in (0.01, 0.5))
    >>> results = [taceva.score(truth, found, channels=["Fz"]) for found in (close, far)]
    >>> taceva.compare(*results).to_dict()["schema"]
    'taceva.comparison/2.1'
    """
    if len(results) < 2:
        raise ValueError(f"{counted(len(results), 'result')}, expected at least two")
    return Comparison(results, metrics, margins or {}, seed)
