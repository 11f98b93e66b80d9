"""Progress bars of tqdm for long work, if tqdm is installed and a terminal or a notebook shows them."""

from __future__ import annotations

import sys
from typing import Any, Protocol


class Bar(Protocol):
    """Receiver of the progress of long work."""

    def begin(self, stage: str, steps: int | None) -> None:
        """Begin a stage of ``steps`` steps, or of unknown length."""

    def advance(self, steps: int) -> None:
        """Count ``steps`` more steps."""

    def end(self) -> None:
        """End the stage."""


class _Tqdm:
    """One bar for each stage."""

    def __init__(self, tqdm: Any) -> None:
        self._tqdm = tqdm
        self._bar: Any = None

    def begin(self, stage: str, steps: int | None) -> None:
        self._bar = self._tqdm(total=steps, desc=stage, leave=False)

    def advance(self, steps: int) -> None:
        if self._bar is not None:
            self._bar.update(steps)

    def end(self) -> None:
        if self._bar is not None:
            self._bar.close()
            self._bar = None


_shown: bool | None = None


def progress(shown: bool | None) -> None:
    """Show bars of tqdm always (``True``), never (``False``), or on terminals and in notebooks (``None``, the default)."""
    global _shown
    _shown = shown


def _is_notebook() -> bool:
    """Return whether a Jupyter kernel runs this process; importing IPython alone is not enough."""
    interactive = sys.modules.get("IPython")
    shell = interactive.get_ipython() if interactive is not None else None
    return type(shell).__module__.startswith("ipykernel.")


def bar() -> Bar | None:
    """Return a bar for the work that begins now, if bars are shown and tqdm is installed."""
    if _shown is False or (_shown is None and not _is_notebook() and not sys.stderr.isatty()):
        return None
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return None
    return _Tqdm(tqdm)
