"""The example notebook, executed by a real kernel, and its output."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

NOTEBOOKS = Path(__file__).resolve().parents[2] / "examples" / "notebooks"


def executed(name: str, monkeypatch: pytest.MonkeyPatch) -> list[tuple[str, list[dict[str, str]]]]:
    """Return each code cell, and its output by type."""
    nbclient = pytest.importorskip("nbclient")
    nbformat = pytest.importorskip("nbformat")
    pytest.importorskip("ipykernel")
    pytest.importorskip("pandas")
    pytest.importorskip("sklearn")
    monkeypatch.delenv("TACEVA_RECORDING", raising=False)
    notebook = nbformat.read(NOTEBOOKS / name, as_version=4)
    nbformat.validate(notebook)
    nbclient.NotebookClient(notebook, timeout=600, startup_timeout=300, kernel_name="python3").execute()
    return [(cell.source, [shown(output) for output in cell.outputs]) for cell in notebook.cells if cell.cell_type == "code"]


def shown(output: Any) -> dict[str, str]:
    return {"text/plain": output.text} if output.output_type == "stream" else dict(output.data)


@pytest.mark.filterwarnings("ignore::DeprecationWarning", "ignore::ResourceWarning")
def test_the_notebook_opens_a_recording_compares_three_models_and_ends_with_a_table(monkeypatch: pytest.MonkeyPatch) -> None:
    cells = executed("three_models.ipynb", monkeypatch)
    outputs = {source: outputs for source, outputs in cells}

    def of(part: str) -> dict[str, str]:
        (found,) = [outputs for source, outputs in outputs.items() if part in source]
        # Progress bars and messages of libraries are not results.
        return [output for output in found if set(output) != {"text/plain"} or "Error" not in output["text/plain"]][-1]

    assert "240 rows of drawn gel, synthetic" in of("drawn(folder)")["text/plain"]
    assert "Fz" in of("describe()")["text/html"]
    page = of('"ridge": taceva.evaluate')["text/html"]
    assert page.count("<table") >= 1 and "Nothing here was measured: the samples are synthetic." in page
    assert "data:image/svg+xml;base64," in page
    together = of("pandas.concat")["text/html"]
    assert all(name in together for name in ("ridge", "neighbours", "mean"))
    assert "<table" in of("taceva.compare(")["text/html"]
    figure = of("comparison.figures()")
    assert "<svg" in figure["image/svg+xml"] and "data:image/svg+xml;base64," in figure["text/html"]
    table = of("comparison.to_latex()")["text/plain"]
    assert r"\begin{tabular}" in table and r"\toprule" in table
    assert all(name in table for name in ("mae", "Fz")) or "MAE" in table
