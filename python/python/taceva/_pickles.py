"""Objects that travel between processes, and what is said where two of them have another taceva."""

from __future__ import annotations

#: What a pickle of this package holds; another number is refused in words instead of misread.
PICKLE_VERSION = 2


def require_version(found: object) -> None:
    """Refuse a pickle that another version of this package wrote.

    >>> require_version(99)
    Traceback (most recent call last):
        ...
    ValueError: a pickle of version 99, this taceva reads version 2: use the same taceva on both sides, or send states(), a path or a saved file
    """
    if found != PICKLE_VERSION:
        raise ValueError(
            f"a pickle of version {found}, this taceva reads version {PICKLE_VERSION}: "
            "use the same taceva on both sides, or send states(), a path or a saved file"
        )
