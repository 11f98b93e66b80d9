"""Gauge studies, calibration curves and budgets from Python: published examples, the numbers of the command, and refusals."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import taceva
from conftest import taceva as command

#: Worked example of AIAG's manual: three trials of ten parts, by appraiser.
AIAG = {
    "A": [
        [0.29, -0.56, 1.34, 0.47, -0.8, 0.02, 0.59, -0.31, 2.26, -1.36],
        [0.41, -0.68, 1.17, 0.5, -0.92, -0.11, 0.75, -0.2, 1.99, -1.25],
        [0.64, -0.58, 1.27, 0.64, -0.84, -0.21, 0.66, -0.17, 2.01, -1.31],
    ],
    "B": [
        [0.08, -0.47, 1.19, 0.01, -0.56, -0.2, 0.47, -0.63, 1.8, -1.68],
        [0.25, -1.22, 0.94, 1.03, -1.2, 0.22, 0.55, 0.08, 2.12, -1.62],
        [0.07, -0.68, 1.34, 0.2, -1.28, 0.06, 0.83, -0.34, 2.19, -1.5],
    ],
    "C": [
        [0.04, -1.38, 0.88, 0.14, -1.46, -0.29, 0.02, -0.46, 1.77, -1.49],
        [-0.11, -1.13, 1.09, 0.2, -1.07, -0.67, 0.01, -0.56, 1.45, -1.77],
        [-0.15, -0.96, 0.67, 0.11, -1.45, -0.49, 0.21, -0.49, 1.87, -2.16],
    ],
}

#: Deviations of the pooled analysis of variance.
POOLED = {"repeatability": 0.19993317972081662, "operator": 0.22683752149632233, "gauge": 0.30237152232290465, "part": 1.0423274938380347}

#: Sources of the end gauge, GUM H.1.
END_GAUGE: dict[str, Any] = {
    "measurand": "l",
    "unit": "nm",
    "coverage": 0.99,
    "expression": "l_s + d0 + d1 + d2 - l_s * (delta_alpha * (theta_bar + Delta) + alpha_s * delta_theta)",
    "source": [
        {"name": "l_s", "value": 50000623.0, "u": 25, "dof": 18},
        {"name": "d0", "value": 215, "u": 5.8, "dof": 24},
        {"name": "d1", "u": 3.9, "dof": 5},
        {"name": "d2", "u": 6.7, "dof": 8},
        {"name": "alpha_s", "value": 11.5e-6, "half_width": 2e-6},
        {"name": "delta_alpha", "half_width": 1e-6, "reliability": "10 %"},
        {"name": "delta_theta", "half_width": 0.05, "dof": 2},
        {"name": "theta_bar", "value": -0.1, "u": np.float32(0.25)},
        {"name": "Delta", "half_width": 0.5, "shape": "arcsine"},
    ],
}


def columns() -> dict[str, Any]:
    rows = [(length, part, by, trial) for by, trials in AIAG.items() for trial, parts in enumerate(trials) for part, length in enumerate(parts)]
    length, part, by, trial = zip(*rows, strict=True)
    return {"length": np.array(length), "part": np.array(part), "appraiser": np.array(by), "trial": np.array(trial)}


def study(**given: Any) -> taceva.GaugeStudy:
    table = columns()
    return taceva.gauge(table["length"], **{"part": table["part"], "by": table["appraiser"], "trial": table["trial"], "channel": "length"} | given)


def sds(found: taceva.GaugeStudy) -> dict[str, float]:
    return {one["name"]: one["sd"] for one in found.to_dict()["components"]}


def test_the_worked_example_of_aiag_has_its_components() -> None:
    found = study()
    for name, sd in POOLED.items():
        assert sds(found)[name] == pytest.approx(sd, rel=1e-10), name
    assert found.to_dict()["ndc"]["value"] == pytest.approx(4.875041362678109, rel=1e-12)
    assert repr(found) == "<taceva.GaugeStudy of length: 10 parts, 3 operators, 3 trials>"
    by_range = sds(study(method="range"))
    assert by_range["repeatability"] == pytest.approx(0.20188, abs=5e-5) and by_range["gauge"] == pytest.approx(0.30575, abs=5e-5)


def test_arrays_frames_and_files_give_the_numbers_of_the_command(tmp_path: Path) -> None:
    table = columns()
    path = tmp_path / "study.csv"
    rows = zip(*table.values(), strict=True)
    path.write_text("length,part,appraiser,trial\n" + "".join(f"{float(length)!r},{part},{by},{trial}\n" for length, part, by, trial in rows))
    words = ["gauge", path, "--part", "part", "--by", "appraiser", "--trial", "trial", "--channels", "length", "--format", "json"]
    done = command(*words)
    assert done.returncode == 0, done.stderr
    named: dict[str, Any] = {"part": "part", "by": "appraiser", "trial": "trial", "channel": "length"}
    assert taceva.gauge(path, **named).text == done.stdout
    assert taceva.gauge(str(path), **named).text == done.stdout
    assert taceva.gauge(table, **named).to_dict()["components"] == json.loads(done.stdout)["components"]
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame(table)
    assert sds(taceva.gauge(frame, **named)) == sds(study())
    shuffled = frame.sample(frac=1.0, random_state=1)
    turned = frame.iloc[::-1]
    assert sds(taceva.gauge(shuffled["length"], part=turned["part"], by=turned["appraiser"], trial=turned["trial"])) == sds(study())


def test_errors_of_a_truth_and_their_share_of_a_tolerance_are_studied() -> None:
    table = columns()
    truth = np.array([0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0])[table["part"]]
    found = study(truth=truth, channel="Fz", tolerance="4 N").to_dict()
    assert (found["response"], found["unit"], found["channel"]) == ("error", "N", "Fz")
    errors = sds(taceva.gauge(table["length"] - truth, part=table["part"], by=table["appraiser"], trial=table["trial"]))
    assert {one["name"]: one["sd"] for one in found["components"]} == pytest.approx(errors, rel=1e-9)
    assert all(one["percent_tolerance"] > 0 for one in found["components"] if one["name"] == "gauge")


def test_a_result_is_a_text_a_frame_a_page_and_latex(tmp_path: Path) -> None:
    found = study()
    assert "repeatability" in str(found) and "<table" in found._repr_html_() and r"\toprule" in found.to_latex()
    found.save(tmp_path / "gauge.json")
    assert (tmp_path / "gauge.json").read_text() == found.text
    with pytest.raises(FileExistsError):
        found.save(tmp_path / "gauge.json")
    pytest.importorskip("pandas")
    frame = found.to_frame()
    sd = frame[(frame["component"] == "gauge (R&R)") & (frame["quantity"] == "sd")]["value"]
    assert sd.tolist() == [sds(found)["gauge"]]


def test_a_study_refuses_by_row_column_and_parameter(tmp_path: Path) -> None:
    table = columns()
    with pytest.raises(ValueError, match="part has 3 rows, length has 90"):
        study(part=[1, 2, 3])
    infinite = table["length"].copy()
    infinite[4] = math.inf
    with pytest.raises(ValueError, match="length row 4: inf, expected a finite number"):
        taceva.gauge(infinite, part=table["part"], by=table["appraiser"], trial=table["trial"], channel="length")
    with pytest.raises(ValueError, match="by: no column 'unit_id', expected an array"):
        taceva.gauge(table["length"], part=table["part"], trial=table["trial"])
    with pytest.raises(ValueError, match="part: no column 'point_id'"):
        taceva.gauge(table, by="appraiser", trial="trial")
    with pytest.raises(ValueError, match="pool 2.*: expected a p value from 0 to 1") as refused:
        study(pool=2)
    assert "--" not in str(refused.value) and "/tmp" not in str(refused.value)
    with pytest.raises(ValueError, match="readings"):
        study(part=np.zeros(90, int))
    two = table | {"Fz": table["length"], "Fx": table["length"]}
    with pytest.raises(ValueError, match="channel has several values: F., F.; expected one, such as channel='F.'"):
        taceva.gauge(two, part="part", by="appraiser", trial="trial")
    path = tmp_path / "study.csv"
    path.write_text("Fz,part,by,trial\n0.1,a,u,1\nmany,a,u,2\n")
    with pytest.raises(taceva.DatasetError, match="study.csv") as broken:
        taceva.gauge(path, part="part", by="by", trial="trial")
    assert broken.value.path == path and broken.value.line == 3


def test_the_end_gauge_has_the_uncertainty_of_the_gum() -> None:
    sources = END_GAUGE | {"source": [dict(source) for source in END_GAUGE["source"]]}
    sources["source"][7]["u"] = 0.2
    found = taceva.budget(sources, draws=0)
    budget = found.to_dict()
    assert budget["value"] == pytest.approx(50000838.0, abs=0.5)
    assert budget["u"] == pytest.approx(31.663879111008633, rel=1e-12)
    assert repr(found) == "<taceva.Budget of l: U = 92 nm>"
    assert "U = 92 nm (k = 2.921, p = 99 %" in str(found)


def test_numbers_of_numpy_are_sources() -> None:
    budget = taceva.budget(END_GAUGE, draws=0).to_dict()
    assert next(source for source in budget["sources"] if source["name"] == "theta_bar")["u"] == 0.25
    rows = {"measurand": "Z", "unit": "ohm", "expression": "V", "source": [{"name": "V", "rows": np.array([4.9, 5.0, 5.1])}]}
    assert taceva.budget(rows, draws=0).to_dict()["value"] == pytest.approx(5.0)


def scored() -> taceva.Result:
    generator = np.random.default_rng(3)
    point = np.arange(60) // 3
    truth = generator.uniform(0.2, 2.0, 60)
    prediction = truth + 0.02 * generator.normal(size=20)[point] + 0.01 * generator.normal(size=60)
    return taceva.score(truth, prediction, channels=["Fz"], points=point)


def test_a_budget_names_figures_of_a_result_and_of_a_study(tmp_path: Path) -> None:
    sources = {
        "measurand": "Fz",
        "at": ["0.5 N"],
        "source": [
            {"name": "places", "from": "error.between"},
            {"name": "one reading", "from": "error.within", "readings": 1},
            {"name": "units", "from": "gauge.json#operator"},
        ],
    }
    measured = scored()
    of_units = study(channel="Fz")
    found = taceva.budget(sources, results=measured, gauge=of_units, draws=0)
    u = {source["name"]: source["u"] for source in found.to_dict()["sources"]}
    assert 0.01 < u["places"] < 0.03 and 0.007 < u["one reading"] < 0.013
    assert u["units"] == pytest.approx(POOLED["operator"], rel=1e-12)
    measured.save(tmp_path / "r.json")
    measured.save_samples(tmp_path / "r.samples.csv")
    of_units.save(tmp_path / "units.json")
    sources["source"][2] = {"name": "units", "from": f"{tmp_path / 'units.json'}#operator"}
    assert taceva.budget(sources, results=tmp_path / "r.json", draws=0).to_dict()["u"] == found.to_dict()["u"]
    limited = taceva.budget(sources, results=measured, draws=0, most="1 mN").to_dict()
    assert limited["passed"] is False


def test_a_budget_refuses_by_line_key_and_parameter() -> None:
    lamp = {"name": "lamp", "half_width": "10 mN"}
    with pytest.raises(ValueError, match=r"sources: line \d.*half_wide"):
        taceva.budget({"measurand": "Fz", "at": ["1 N"], "source": [{"name": "lamp", "half_wide": "10 mN"}]})
    with pytest.raises(ValueError, match=r"sources: line \d.*error\.between.*no result is given; add results"):
        taceva.budget({"measurand": "Fz", "at": ["1 N"], "source": [{"name": "places", "from": "error.between"}]})
    with pytest.raises(ValueError, match="^at `1`|^at 1"):
        taceva.budget({"measurand": "Fz", "at": ["1 N"], "source": [lamp]}, at="1")
    with pytest.raises(ValueError, match="at has several values: 1.0 N, 2.0 N; expected one, such as at='1.0 N'"):
        taceva.budget({"measurand": "Fz", "at": ["1 N", "2 N"], "source": [lamp]}, draws=0)
    with pytest.raises(TypeError, match="expected a string, a number, a list or a mapping"):
        taceva.budget({"measurand": "Fz", "at": ["1 N"], "source": [{"name": "lamp", "u": object()}]})


def test_a_curve_of_arrays_and_of_a_result_inverts_a_reading() -> None:
    force, reading = np.repeat(np.arange(6) * 0.25, 2), np.repeat([0.02, 0.26, 0.49, 0.77, 1.01, 1.24], 2) + np.tile([-0.005, 0.005], 6)
    found = taceva.curve(x=force, y=reading, invert=["0.35 N"], detect=True)
    figures = {figure["quantity"]: figure for figure in found.to_dict()["figures"]}
    slope, offset = np.polyfit(force, reading, 1)
    assert figures["inverse"]["value"] == pytest.approx((0.35 - offset) / slope, rel=1e-9)
    assert figures["detectable"]["value"] > figures["critical"]["value"]
    assert repr(found) == "<taceva.CalibrationCurve of y over x, order 1, 12 rows>"
    of_result = taceva.curve(scored(), x="Fz", y="prediction.Fz", at=[0.5]).to_dict()
    assert (of_result["points"], of_result["n"], of_result["x"]["unit"]) == (20, 60, "N")
    table = {"truth": force, "seen": np.where(np.arange(12) == 3, np.nan, reading)}
    assert taceva.curve(table, x="truth", y="seen", points=np.arange(12) // 2).to_dict()["rows_left_out"] == 1


def test_a_curve_refuses_by_parameter() -> None:
    with pytest.raises(ValueError, match="order <N>': 7 is not in 1..=3|order.*7"):
        taceva.curve(x=[0.0, 1.0, 2.0], y=[0.0, 1.0, 2.1], order=7)
    with pytest.raises(ValueError, match="y has 2 rows, x has 3"):
        taceva.curve(x=[0.0, 1.0, 2.0], y=[0.0, 1.0])
    with pytest.raises(ValueError, match="y: no column 'grey', expected an array or one of force"):
        taceva.curve({"force": [0.0, 1.0, 2.0]}, x="force", y="grey")
    with pytest.raises(ValueError, match="no samples are kept"):
        metrics = taceva.TactileMetrics(["Fz"])
        metrics.update([0.5, 1.0], [0.5, 1.0])
        taceva.curve(metrics.compute(), x="Fz", y="Fz_predicted")
