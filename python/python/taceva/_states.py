"""States of metrics as bytes with a digest, which detects edits, and their exchange between processes."""

from __future__ import annotations

import hashlib
import sys

_HEAD = b"taceva.states/2 sha256:"


def sealed(content: bytes) -> bytes:
    """Return ``content`` after a line with its digest.

    >>> opened(sealed(b"[1]"))
    b'[1]'
    """
    return _HEAD + hashlib.sha256(content).hexdigest().encode() + b"\n" + content


def opened(states: bytes) -> bytes:
    """Return the content of a result of `sealed`.

    >>> opened(sealed(b"[1]").replace(b"1]", b"2]"))
    Traceback (most recent call last):
        ...
    ValueError: the states were changed after states() returned them: the digest differs; send the bytes unchanged

    Raises
    ------
    ValueError
        For bytes that are not states, and for edited states.
    """
    head, _, content = bytes(states).partition(b"\n")
    if not head.startswith(_HEAD):
        raise ValueError("not states of metrics: expected the bytes that states() of this version of taceva returned")
    if sealed(content) != states:
        raise ValueError("the states were changed after states() returned them: the digest differs; send the bytes unchanged")
    return content


def gathered(own: bytes) -> list[bytes]:
    """Return the bytes of every process of ``torch.distributed``, or only ``own`` if it is not initialised."""
    torch = sys.modules.get("torch")
    if torch is None or not torch.distributed.is_available() or not torch.distributed.is_initialized():
        return [own]
    found: list[bytes] = [b""] * torch.distributed.get_world_size()
    torch.distributed.all_gather_object(found, own)
    return found
