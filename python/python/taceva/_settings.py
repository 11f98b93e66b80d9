"""Settings as the command writes them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any


def setting_words(settings: Mapping[str, Any] | None) -> list[str]:
    """Return settings by name in the form of ``--set``: truth values are ``true`` and ``false``.

    >>> setting_words({"size": "16x16", "difference": True})
    ['size=16x16', 'difference=true']
    """
    written = {name: str(value).lower() if isinstance(value, bool) else value for name, value in (settings or {}).items()}
    return [f"{name}={value}" for name, value in written.items()]
