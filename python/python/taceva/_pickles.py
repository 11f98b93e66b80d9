"""Version check of objects that are pickled between processes."""

from __future__ import annotations

#: Version of the pickles of this package; another version is rejected.
PICKLE_VERSION = 4


def require_version(found: object) -> None:
    """Reject a pickle of any version but ``PICKLE_VERSION``.

    >>> require_version(99)
    Traceback (most recent call last):
        ...
    ValueError: a pickle of version 99, this taceva reads version 4: use the same taceva on both sides, or send states(), a path or a saved file
    """
    if found != PICKLE_VERSION:
        raise ValueError(
            f"a pickle of version {found}, this taceva reads version {PICKLE_VERSION}: "
            "use the same taceva on both sides, or send states(), a path or a saved file"
        )
