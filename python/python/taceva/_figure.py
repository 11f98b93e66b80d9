"""Figures of results, as in the reports of the command."""

from __future__ import annotations

import base64
import html
import os
from collections.abc import Sequence
from pathlib import Path

from taceva import _taceva


class Figure:
    """A figure of one or more results, for notebooks, or saved as SVG or PDF for a paper."""

    def __init__(self, texts: Sequence[str], drawn: dict[str, str], metrics: list[str] | None = None) -> None:
        self._texts = list(texts)
        self._drawn = drawn
        #: Compared metrics; ``None`` for figures of results that are not compared.
        self._metrics = metrics

    @property
    def name(self) -> str:
        """A name for files: ``histograms``."""
        return self._drawn["name"]

    @property
    def title(self) -> str:
        """Title."""
        return self._drawn["title"]

    @property
    def caption(self) -> str:
        """Caption: content, number of samples, and omissions."""
        return self._drawn["caption"]

    @property
    def description(self) -> str:
        """Description of the content, for screen readers."""
        return self._drawn["description"]

    @property
    def svg(self) -> str:
        """Complete SVG drawing, on white."""
        return self._drawn["svg"]

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the figure to ``path``, which must not exist and ends in ``.svg`` or ``.pdf``; fonts of a PDF are embedded."""
        target = Path(path)
        forms = {".svg": lambda: self.svg.encode(), ".pdf": lambda: bytes(_taceva.figure_pdf(self._texts, self.name, self._metrics))}
        if target.suffix not in forms:
            raise ValueError(f"{target}: expected a name that ends in .svg or .pdf")
        content = forms[target.suffix]()
        with target.open("xb") as file:
            file.write(content)

    def __repr__(self) -> str:
        return f"<taceva.Figure {self.name!r}: {self.title}>"

    def _repr_svg_(self) -> str:
        return self.svg

    def _repr_html_(self) -> str:
        # Embedded as an image, to separate its style and names from those of the page.
        address = base64.b64encode(self.svg.encode()).decode()
        return (
            f'<figure style="margin: 1em 0"><img src="data:image/svg+xml;base64,{address}" alt="{html.escape(self.description)}"'
            f' style="max-width: 100%"><figcaption>{html.escape(self.title)}: {html.escape(self.caption)}</figcaption></figure>'
        )


def figures_of(texts: Sequence[str], metrics: list[str] | None = None) -> list[Figure]:
    """Return all figures for which the results have data, in the order of reports; figures of compared ``metrics`` come first."""
    return [Figure(texts, drawn, metrics) for drawn in _taceva.figures(list(texts), metrics)]
