"""Scores of tasks from Python: arrays, tables, the numbers of the command, merges, comparisons, and refusals."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import taceva
from conftest import taceva as command

#: Classes of the tasks.
CLASSES = ["no_slip", "slip"]

STROKES, FRAMES = np.indices((24, 10)).reshape(2, -1)

#: Slip from the fifth frame of each stroke on.
TRUTH = np.where(FRAMES >= 4, "slip", "no_slip")


def late(frames: Any) -> Any:
    """Return predictions that begin ``frames`` frames after the labels."""
    return np.where(FRAMES >= 4 + frames, "slip", "no_slip")


def scored(prediction: Any, rows: Any = slice(None), **given: Any) -> taceva.tasks.TaskScores:
    options = {"clusters": STROKES[rows], "names": CLASSES, "positive": "slip", "name": "slip"} | given
    return taceva.tasks.score(TRUTH[rows], prediction[rows], **options)


def value(found: taceva.tasks.TaskScores, metric: str) -> Any:
    return found[metric]["estimate"]["value"]


def test_arrays_have_the_scores_of_the_command(tmp_path: Path) -> None:
    found = scored(late(STROKES % 2))
    # Of 144 frames that slip, 12 are missed.
    assert value(found, "f1") == 264 / 276
    assert found["f1"]["estimate"]["n"] == 240 and found["f1"]["estimate"]["clusters"] == 24
    rows = range(len(TRUTH))
    truth = "".join(f"{row},{STROKES[row]},{TRUTH[row]}\n" for row in rows)
    prediction = "".join(f"{row},{late(STROKES % 2)[row]}\n" for row in rows)
    (tmp_path / "truth.csv").write_text(f"id,stroke,slip\n{truth}")
    (tmp_path / "pred.csv").write_text(f"id,slip\n{prediction}")
    spec = "slip=outcome:positive=slip:names=no_slip|slip"
    words = ["score", "--truth", "truth.csv", "--pred", "pred.csv", "--task", spec, "--cluster", "stroke", "--format", "json", "-q"]
    done = command(*words, cwd=tmp_path)
    by_command = json.loads(done.stdout)["tasks"][0]["scores"]
    assert found.to_dict()["tasks"][0]["scores"] == by_command
    tables = taceva.tasks.score_tables(tmp_path / "truth.csv", tmp_path / "pred.csv", spec, cluster="stroke")
    assert tables.to_dict()["tasks"] == json.loads(done.stdout)["tasks"]


def test_positions_booleans_and_missing_labels_are_labels() -> None:
    by_position = taceva.tasks.score([0, 1, None, 1], [0, 1, 1, 0], clusters=["a", "b", "c", "d"], names=CLASSES)
    assert value(by_position, "class_accuracy") == 2 / 3
    assert any("1 row without a label" in note for note in by_position.to_dict()["tasks"][0]["notes"])
    of_booleans = taceva.tasks.score([True, False], [True, True], clusters=[1, 2], positive=True)
    assert value(of_booleans, "recall") == 1.0 and value(of_booleans, "precision") == 0.5


def test_probabilities_rank_and_a_threshold_and_a_debounce_decide() -> None:
    probable = np.where(FRAMES >= 5, 0.75, 0.25)
    both = np.column_stack([1 - probable, probable])
    found = taceva.tasks.score(TRUTH, probabilities=both, clusters=STROKES, names=CLASSES, positive="slip")
    # Frame 4 of each stroke ties with four frames that do not slip.
    assert value(found, "roc_auc") == pytest.approx(1 - 24 * 96 / 2 / (144 * 96))
    assert value(found, "f1") == 240 / 264
    ruled = taceva.tasks.score(TRUTH, probabilities=probable, clusters=STROKES, names=CLASSES, positive="slip", threshold=0.4, debounce=2)
    assert value(ruled, "f1") == 192 / 240
    assert "threshold 0.4 strict, debounce 2" in ruled["f1"]["definition"]


def test_times_give_onsets_and_seven_columns_a_pose() -> None:
    found = scored(late(1), times=FRAMES * 0.04)
    assert value(found, "onset_delay") == pytest.approx(0.04)
    truth = np.zeros((6, 7))
    truth[:, 6] = 1
    moved = truth + [0, 0, 0.5, 0, 0, 0, 0]
    poses = taceva.tasks.score(truth, moved, clusters=range(6), thresholds={"t": ["0.1", "1"], "r": ["1"]})
    assert value(poses, "pose_translation") == 0.5 and value(poses, "pose_class") == 1.0


def test_parts_merge_to_the_scores_of_the_whole_in_any_order(tmp_path: Path) -> None:
    prediction = late(STROKES % 3)
    whole = scored(prediction)
    parts = [scored(prediction, slice(at * 80, (at + 1) * 80)) for at in range(3)]
    parts[1].save_states(tmp_path / "1.state")
    for order in ([0, 1, 2], [2, 0, 1]):
        states: list[Any] = [parts[at] if at == 0 else tmp_path / "1.state" if at == 1 else parts[at].states for at in order]
        merged = taceva.tasks.merge(*states)
        assert merged.to_dict()["tasks"] == whole.to_dict()["tasks"]
    with pytest.raises(ValueError, match="result 2.*would count twice"):
        taceva.tasks.merge(parts[0], parts[0])
    ruled = scored(prediction, slice(80, 160), debounce=2)
    with pytest.raises(ValueError, match="states of different rule do not merge: none and debounce 2"):
        taceva.tasks.merge(parts[0], ruled)
    with pytest.raises(ValueError, match="result 1"):
        taceva.tasks.merge(parts[0].states.replace(b'"unlabelled":0', b'"unlabelled":1'))


def test_two_models_are_compared_stroke_by_stroke() -> None:
    first, second = scored(late(STROKES % 2)), scored(late(1 + STROKES // 2 % 2))
    found = taceva.tasks.compare(first, second, names=["early", "late"])
    (f1,) = [answer for answer in found.to_dict()["answers"] if answer["score"] == "f1"]
    assert f1["paired"] and f1["winner"] == "early"
    assert f1["values"] == [264 / 276, 216 / 252]
    assert "early better than late" in str(found) and "f1" in found.to_latex()
    with pytest.raises(ValueError, match="at least two"):
        taceva.tasks.compare(first)
    with pytest.raises(ValueError, match="no result has the score"):
        taceva.tasks.compare(first, second, metrics=["mae"])


def test_results_have_the_forms_of_other_results(tmp_path: Path) -> None:
    found = scored(late(1))
    assert repr(found) == "<taceva.tasks.TaskScores of slip: 240 samples>"
    assert "slip" in str(found) and "<table" in found._repr_html_()
    frame = found.to_frame()
    assert frame.loc[frame["metric"] == "f1", "value"].tolist() == [value(found, "f1")]
    found.save(tmp_path / "slip.json")
    assert json.loads((tmp_path / "slip.json").read_text()) == found.to_dict()
    assert found["slip", "f1_macro.class slip"]["estimate"]["value"] == value(found, "f1")
    with pytest.raises(KeyError, match="no such score"):
        found["mae"]


def test_wrong_arrays_are_refused_by_name() -> None:
    with pytest.raises(ValueError, match="prediction slip has 3 rows, truth has 240"):
        taceva.tasks.score(TRUTH, TRUTH[:3], clusters=STROKES, name="slip")
    with pytest.raises(ValueError, match="^truth.*did you mean `slip`"):
        taceva.tasks.score(["slpi", "no_slip"], ["slip", "no_slip"], clusters=[1, 2], names=CLASSES)
    with pytest.raises(ValueError, match="expected predicted classes or poses, or probabilities"):
        taceva.tasks.score(TRUTH, clusters=STROKES)
    with pytest.raises(ValueError, match="names="):
        taceva.tasks.score(TRUTH, probabilities=np.zeros((240, 2)), clusters=STROKES)
    with pytest.raises(TypeError, match="truth row 0: 0.5"):
        taceva.tasks.score([0.5], [0], clusters=[1], names=CLASSES)
    with pytest.raises(ValueError, match="kind"):
        taceva.tasks.score(TRUTH, TRUTH, clusters=STROKES, kind="evnt")
    with pytest.raises(ValueError, match="a rule is given for 'slpi'"):
        taceva.tasks.score_tables("t.csv", "p.csv", "slip=class", threshold={"slpi": 0.5})
