"""Counts with their nouns, as the command prints them."""

from __future__ import annotations


def counted(count: int, noun: str) -> str:
    """Return the number with its noun: ``1 row``, ``3 rows``."""
    return f"{count} {noun}" if count == 1 else f"{count} {noun}s"
