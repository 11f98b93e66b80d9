"""Arrays as people have them, brought to native float32 or float64 in the order of C."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

Numbers = npt.NDArray[np.float32] | npt.NDArray[np.float64]


def numbers(array: Any, name: str, *, allow_invalid: bool = False) -> Numbers:
    """Return ``array`` as native float32 or float64, C-contiguous, copied only where it must be.

    Arrays of numpy and torch (any device), lists, and whatever has ``__array__`` or ``__dlpack__`` are taken; whole numbers are converted.

    Raises
    ------
    TypeError
        For complex numbers, texts and objects.
    ValueError
        For NaN or an infinite number, unless ``allow_invalid``; for rows of unequal length.
    """
    if hasattr(array, "detach") and hasattr(array, "cpu"):
        # A tensor of torch: its gradient and its device are left behind. bfloat16 is not known to numpy.
        tensor = array.detach().cpu()
        array = tensor.float() if str(tensor.dtype) == "torch.bfloat16" else tensor
    found = np.asarray(array)
    if found.dtype.kind in "iub" or found.dtype == np.float16:
        found = found.astype(np.float64)
    if found.dtype.kind != "f" or found.dtype.itemsize not in (4, 8):
        raise TypeError(f"{name}: expected numbers, found an array of {found.dtype}")
    found = np.ascontiguousarray(found, dtype=found.dtype.newbyteorder("="))
    if not allow_invalid and not np.isfinite(found).all():
        place = tuple(int(at[0]) for at in np.nonzero(~np.isfinite(found)))
        raise ValueError(
            f"{name}: {found[place]} at {list(place)}: expected finite numbers; "
            "allow_invalid=True counts such samples and leaves them out"
        )
    return found


def points(names: Any) -> Any:
    """Return contact points as an array of int64, or as a list of texts.

    Raises
    ------
    TypeError
        For points that are neither whole numbers nor texts.
    """
    if hasattr(names, "detach") and hasattr(names, "cpu"):
        names = names.detach().cpu()
    found = np.asarray(names)
    if found.ndim != 1:
        raise ValueError(f"points have the shape {list(found.shape)}, expected one a row")
    if found.dtype.kind in "iub":
        if found.dtype == np.uint64 and found.size and int(found.max()) >= 2**63:
            return [str(name) for name in found.tolist()]
        return np.ascontiguousarray(found, dtype=np.int64)
    if found.dtype.kind in "UO" and all(isinstance(name, str) for name in found.tolist()):
        return [str(name) for name in found.tolist()]
    raise TypeError(f"points: expected whole numbers or texts, found an array of {found.dtype}")
