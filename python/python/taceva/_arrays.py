"""Conversion of arrays to native float32 or float64 in C order."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from taceva import _taceva
from taceva._counted import counted

Numbers = npt.NDArray[np.float32] | npt.NDArray[np.float64]

#: Greatest number of rows in one call. Larger arrays come from broadcasting or a mistake; they are rejected before anything is copied.
MOST_ROWS = 2**31 - 1

#: Number of rows converted at a time, so that no array is copied as a whole.
BLOCK_ROWS = 65_536


def real(array: Any, name: str) -> npt.NDArray[Any]:
    """Return ``array`` as an array of real numbers, in any memory layout. Does not copy numpy arrays or tensors on the CPU.

    Raises
    ------
    TypeError
        For complex numbers, texts and objects.
    ValueError
        For rows of unequal length, more rows than `MOST_ROWS`, a mask, and a tensor without memory.
    """
    if np.ma.isMaskedArray(array) and np.ma.getmaskarray(array).any():
        raise ValueError(f"{name}: a masked array; expected an array without a mask, with only the rows to score")
    found = np.asarray(_in_memory(array, name))
    is_number = found.dtype.kind in "iub" or (found.dtype.kind == "f" and found.dtype.itemsize <= 8)
    if not is_number:
        raise TypeError(f"{name}: expected numbers, found an array of {found.dtype}")
    require_rows(found, name)
    return found


def require_rows(array: npt.NDArray[Any], name: str) -> None:
    """Reject more rows than one call accepts."""
    if array.ndim and len(array) > MOST_ROWS:
        raise ValueError(f"{name} has {len(array)} rows, expected at most {MOST_ROWS} in one call: update with one part after another")


def native(array: npt.NDArray[Any], name: str, *, allow_invalid: bool = False) -> Numbers:
    """Return an array of real numbers as native float32 or float64 in C order; copies only if necessary."""
    is_single = array.dtype.kind == "f" and array.dtype.itemsize == 4
    found: Numbers = np.ascontiguousarray(array, dtype=np.float32) if is_single else np.ascontiguousarray(array, dtype=np.float64)
    if not allow_invalid:
        require_finite(found, name)
    return found


def with_units(channels: Sequence[str], units: Mapping[str, str]) -> list[tuple[str, str]]:
    """Return each channel with its unit: the given unit, else mm or N for one of the six channels, else ``1``."""
    unknown = sorted(set(units) - set(channels))
    if unknown:
        raise ValueError(f"units: no channel {', '.join(unknown)}, expected channels among {', '.join(channels)}")
    for name in channels:
        if name not in units and _taceva.unit_of(name) is None and _is_mistyped(name):
            raise ValueError(f"channel {name!r} has no known unit: expected Px, Py, Pz, Fx, Fy or Fz, or its unit, such as units={{{name!r}: 'N'}}")
    return [(name, units.get(name) or _taceva.unit_of(name) or "1") for name in channels]


def _is_mistyped(name: str) -> bool:
    """Return whether ``name`` is probably one of the six channels, mistyped.

    Normal, tangential, shear and radial parts, such as ``Fn`` and ``Ft``, have names of their own.

    >>> _is_mistyped("fx"), _is_mistyped("Fq"), _is_mistyped("Fn"), _is_mistyped("Mz"), _is_mistyped("force")
    (True, True, False, False, False)
    """
    return len(name) == 2 and name[0] in "PpFf" and name[1].isalpha() and name[1].lower() not in "ntsr"


def column_order(channels: list[tuple[str, str]]) -> list[int] | None:
    """Return the positions of ``channels`` in the order of sums and recordings; ``None`` if they are already in that order.

    >>> column_order([("Fz", "N"), ("Px", "mm")]), column_order([("Px", "mm"), ("Fz", "N")])
    ([1, 0], None)
    """
    order = _taceva.channel_order(channels)
    return None if order == list(range(len(channels))) else order


def in_order(table: npt.NDArray[Any], order: list[int] | None) -> npt.NDArray[Any]:
    """Return the columns of ``table`` in ``order``. A table of another width is returned unchanged, and rejected later."""
    return table if order is None or table.shape[1:] != (len(order),) else table[:, order]


def require_finite(array: Numbers, name: str, first: int = 0) -> None:
    """Reject NaN and infinite numbers; ``first`` is the number of the first row, for messages."""
    if not np.isfinite(array).all():
        row, *column = (int(at[0]) for at in np.nonzero(~np.isfinite(array)))
        raise ValueError(
            f"{name}: {array[(row, *column)]} at {[first + row, *column]}: expected finite numbers; "
            "allow_invalid=True counts such samples and leaves them out"
        )


def refuse_invalid(
    tables: Mapping[str, npt.NDArray[Any]],
    channels: Sequence[str],
    order: npt.NDArray[np.intp] | None,
    remedy: str = "allow_invalid=True counts such rows and leaves them out",
) -> None:
    """Reject NaN and infinite numbers in the first of ``tables`` with any. ``order`` has the given row of the prediction for each row of the truth."""
    for name, table in tables.items():
        found, count = None, 0
        for first in range(0, len(table), BLOCK_ROWS):
            block = table[first : first + BLOCK_ROWS].reshape(-1, len(channels))
            is_invalid = ~np.isfinite(block)
            rows = np.flatnonzero(is_invalid.any(axis=1))
            count += len(rows)
            if found is None and len(rows):
                column = int(is_invalid[rows[0]].argmax())
                found = (first + int(rows[0]), channels[column], block[rows[0], column])
        if found is None:
            continue
        row, channel, value = found
        own = row if order is None or name == "truth" else int(order[row])
        of_truth = "" if own == row else f" (row {row} of truth)"
        raise ValueError(
            f"{name} row {own}{of_truth}, column {channel}: {value}; {counted(count, 'such row')}: expected finite numbers; {remedy}"
        )


def numbers(array: Any, name: str, *, allow_invalid: bool = False) -> Numbers:
    """Return ``array`` as native float32 or float64, C-contiguous; copies only if necessary.

    Accepts arrays of numpy and torch (any device), lists, and objects with ``__array__``; converts whole numbers.

    Raises
    ------
    TypeError, ValueError
        As `real`, and for NaN or an infinite number, unless ``allow_invalid``.
    """
    return native(real(array, name), name, allow_invalid=allow_invalid)


def points(names: Any, name: str = "points") -> npt.NDArray[np.int64] | list[str]:
    """Return contact points, or other names, as an array of whole numbers or as a list of strings.

    Raises
    ------
    TypeError
        For names that are neither whole numbers nor texts.
    """
    found = np.asarray(_in_memory(names, name))
    if found.ndim != 1:
        raise ValueError(f"{name} have the shape {list(found.shape)}, expected one value per row")
    require_rows(found, name)
    if found.dtype.kind in "iub":
        if found.dtype.kind == "u" and found.dtype.itemsize == 8 and found.size and int(found.max()) >= 2**63:
            return [str(number) for number in found.tolist()]
        return np.ascontiguousarray(found, dtype=np.int64)
    if found.dtype.kind in "UOT" and all(isinstance(text, str) for text in found.tolist()):
        return [str(text) for text in found.tolist()]
    raise TypeError(f"{name}: expected whole numbers or texts, found an array of {found.dtype}")


def _in_memory(array: Any, name: str) -> Any:
    """Return a torch tensor on the CPU without its gradient; any other object unchanged."""
    if not (hasattr(array, "detach") and hasattr(array, "cpu")):
        return array
    if getattr(array, "is_meta", False):
        raise ValueError(f"{name}: a tensor on the device meta, which holds no numbers; expected a tensor with memory")
    tensor = array.detach().cpu()
    # numpy does not know bfloat16.
    return tensor.float() if str(tensor.dtype) == "torch.bfloat16" else tensor
