"""Settings and names of metrics in the format of the command."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any


def setting_words(settings: Mapping[str, Any] | None) -> list[str]:
    """Return settings by name in the format of ``--set``; booleans are ``true`` and ``false``.

    >>> setting_words({"size": "16x16", "difference": True})
    ['size=16x16', 'difference=true']
    """
    written = {name: str(value).lower() if isinstance(value, bool) else value for name, value in (settings or {}).items()}
    return [f"{name}={value}" for name, value in written.items()]


def metric_names(metrics: str | Sequence[str]) -> list[str]:
    """Return names of metrics and groups as a list; accepts a single name.

    >>> metric_names("mae"), metric_names(("mae", "r2"))
    (['mae'], ['mae', 'r2'])

    Raises
    ------
    TypeError
        For functions and any other type than names.
    """
    if isinstance(metrics, str):
        return [metrics]
    given: Any = metrics
    if callable(given) or any(callable(name) for name in given):
        raise TypeError("metrics: a function, expected names; taceva.score_function scores by a function of your own")
    for name in metrics:
        if not isinstance(name, str):
            raise TypeError(f"metrics: {name!r}, expected names of metrics and groups")
    return list(metrics)
