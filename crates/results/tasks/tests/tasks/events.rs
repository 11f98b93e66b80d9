//! Scores of onsets.

mod refusals;

use taceva_metrics::{Interval, UndefinedReason};
use taceva_tasks::events::{EventRule, EventState, Frame, OnsetPair, match_onsets};
use taceva_tasks::{ScoreFlag, Undefined};

use super::cases::{case, close, number, numbers, score, value};

/// Frames at 10 Hz from `start_s`, one per letter: `t` is a true event, `p` a predicted event, `b` both, `.` neither.
fn frames(start_s: f64, letters: &str) -> Vec<Frame> {
    let frame = |(at, letter): (u32, char)| {
        let time_s = start_s + f64::from(at) * 0.1;
        let predicted = if "pb".contains(letter) { 1.0 } else { 0.0 };
        Frame::new(
            u64::from(at) + 1,
            Some(time_s),
            "tb".contains(letter),
            predicted,
        )
    };
    (0..).zip(letters.chars()).map(frame).collect()
}

/// State of the default rule with one sequence a cluster.
fn state_of(sequences: &[&str]) -> EventState {
    let mut state = EventState::new(EventRule::default());
    for (at, letters) in sequences.iter().enumerate() {
        let pushed = state.push(&format!("stroke {at}"), &frames(0.0, letters));
        pushed.expect("frames with times");
    }
    state
}

#[test]
fn onsets_match_one_to_one_as_in_the_golden_case() {
    let case = case("events", "onsets matched one to one");
    let [truth, predicted] = ["truth_s", "pred_s"].map(|key| numbers(&case[key]));
    let pairs = match_onsets(&truth, &predicted, 0.2);
    let expected = OnsetPair {
        truth: 0,
        prediction: 1,
    };
    assert_eq!(pairs, [expected]);
    let delay = predicted[1] - truth[0];
    close(delay, numbers(&case["delays_s"])[0], 1e-14, "delay");
    let count = |list: &[f64]| list.len() as f64;
    let f1 = 2.0 * pairs.len() as f64 / (count(&truth) + count(&predicted));
    close(f1, number(&case, "f1"), 1e-15, "F1");
}

#[test]
fn the_golden_onsets_as_frames_have_the_golden_f1_and_delay() {
    let case = case("events", "onsets matched one to one");
    let [truth, predicted] = ["truth_s", "pred_s"].map(|key| numbers(&case[key]));
    // Frames of 20 Hz over 8 s. An onset holds for one frame.
    let is_in = |list: &[f64], time_s: f64| list.iter().any(|at| (at - time_s).abs() < 1e-6);
    let frames: Vec<Frame> = (0..160_u32)
        .map(|at| {
            let time_s = f64::from(at) * 0.05;
            let score = if is_in(&predicted, time_s) { 1.0 } else { 0.0 };
            Frame::new(u64::from(at), Some(time_s), is_in(&truth, time_s), score)
        })
        .collect();
    // 0.9 s and 1.05 s are three frames apart, so both are onsets.
    let mut state = EventState::new(EventRule::default());
    state.push("a", &frames).expect("frames with times");
    let scores = state.scores();
    assert_eq!(
        score(&scores, "onset_f1", None).estimate.value,
        Ok(2.0 / 7.0)
    );
    close(value(&scores, "onset_delay", None), 0.05, 1e-12, "delay");
    // Three predicted onsets without a true one in 7.95 s.
    close(
        value(&scores, "false_alarms", None),
        180.0 / 7.95,
        1e-12,
        "false alarms",
    );
}

#[test]
fn the_published_rule_of_slip_labels_from_the_third_frame_in_a_row() {
    let case = case("events", "Sparsh rule");
    let scores = numbers(&case["score"]);
    let labels = |debounce| {
        let rule = EventRule::default()
            .with_threshold(0.4)
            .expect("a threshold");
        rule.with_debounce(debounce)
            .expect("a debounce")
            .labels(&scores)
    };
    let expected = |key: &str| -> Vec<bool> {
        numbers(&case[key])
            .into_iter()
            .map(|label| label > 0.5)
            .collect()
    };
    assert_eq!(labels(1), expected("raw"));
    assert_eq!(labels(3), expected("debounced"));
}

#[test]
fn a_debounce_does_not_reach_from_one_sequence_into_the_next() {
    let rule = EventRule::default().with_debounce(3).expect("a debounce");
    let mut state = EventState::new(rule);
    // Two frames in a row at the end of one sequence, and two at the start of the next.
    for letters in ["..pp", "pp.."] {
        state.push("a", &frames(0.0, letters)).expect("frames");
    }
    let found = score(&state.scores(), "onset_f1", None).estimate.value;
    assert_eq!(found, Err(Undefined::NoOnset));
}

#[test]
fn the_nearest_pair_matches_first_and_ties_go_by_time() {
    let pair = |truth, prediction| OnsetPair { truth, prediction };
    // 1.1 is nearer to 1.15 than to 1.0, which leaves 1.0 to 0.9.
    assert_eq!(
        match_onsets(&[1.0, 1.15], &[0.9, 1.1], 0.2),
        [pair(0, 0), pair(1, 1)]
    );
    // 1.1 is as near to both: the earlier true onset has it.
    assert_eq!(match_onsets(&[1.0, 1.2], &[1.1], 0.2), [pair(0, 0)]);
    // Both predictions are as near: the earlier one has the true onset.
    assert_eq!(match_onsets(&[1.0], &[1.1, 0.9], 0.2), [pair(0, 1)]);
    assert!(match_onsets(&[], &[1.0], 0.2).is_empty());
}

#[test]
fn an_onset_at_the_tolerance_matches_as_a_decimal() {
    // 2.2 − 2.0 is above 0.2 as a binary number.
    assert_eq!(match_onsets(&[2.0], &[2.2], 0.2).len(), 1);
    assert!(match_onsets(&[2.0], &[2.200_002], 0.2).is_empty());
}

#[test]
fn a_sequence_that_begins_within_an_event_has_no_onset_there() {
    let scores = state_of(&["bb.."]).scores();
    let found = score(&scores, "onset_f1", None).estimate.value;
    assert_eq!(found, Err(Undefined::NoOnset));
}

#[test]
fn onsets_of_two_sequences_do_not_match_each_other() {
    let scores = state_of(&["..t.", "..p."]).scores();
    assert_eq!(score(&scores, "onset_f1", None).estimate.value, Ok(0.0));
    let delay = score(&scores, "onset_delay", None).estimate.value;
    assert_eq!(delay, Err(Undefined::NoMatch));
}

#[test]
fn delays_have_a_mean_and_a_point_that_95_percent_do_not_exceed() {
    // 19 delays of 0.1 s and one of 0.2 s: 95 % are 19.
    let late = [".tp."; 19];
    let scores = state_of(&[&late[..], &[".t.p"]].concat()).scores();
    let found = value(&scores, "onset_delay", None);
    close(found, 2.1 / 20.0, 1e-12, "mean");
    close(
        value(&scores, "onset_delay", Some("p95")),
        0.1,
        1e-12,
        "p95",
    );
    let scores = state_of(&[&late[..18], &[".t.p", ".t.p"]].concat()).scores();
    close(
        value(&scores, "onset_delay", Some("p95")),
        0.2,
        1e-12,
        "p95",
    );
    let point = score(&scores, "onset_delay", Some("p95"));
    let none = Interval::Undefined(UndefinedReason::NoInterval);
    assert_eq!((point.estimate.interval, point.unit), (none, Some("s")));
}

#[test]
fn false_alarms_are_unmatched_predicted_onsets_a_minute() {
    // Two sequences of 0.3 s with one false alarm.
    let scores = state_of(&[".p..", ".b.."]).scores();
    let alarms = score(&scores, "false_alarms", None);
    close(
        value(&scores, "false_alarms", None),
        60.0 / 0.6,
        1e-12,
        "false alarms",
    );
    assert_eq!(alarms.unit, Some("1/min"));
    let still = state_of(&["."]).scores();
    let found = score(&still, "false_alarms", None).estimate.value;
    assert_eq!(found, Err(Undefined::NoDuration));
}

#[test]
fn frames_without_times_leave_all_scores_of_onsets_out_by_name() {
    let mut state = state_of(&[".b.."]);
    let untimed: Vec<Frame> = frames(0.0, ".b..")
        .into_iter()
        .map(|frame| Frame::new(frame.row, None, frame.truth, frame.score))
        .collect();
    state.push("untimed", &untimed).expect("frames");
    for score in state.scores() {
        assert_eq!(
            score.estimate.value,
            Err(Undefined::NoTimes),
            "{}",
            score.metric
        );
    }
}

#[test]
fn no_frame_has_no_score() {
    for score in EventState::new(EventRule::default()).scores() {
        assert_eq!(
            score.estimate.value,
            Err(Undefined::Empty),
            "{}",
            score.metric
        );
    }
}

#[test]
fn scores_that_all_lie_outside_0_to_1_are_flagged_and_scored() {
    let state_with = |scores: [f64; 3]| {
        let frames: Vec<Frame> = (0..3_u32)
            .zip(scores)
            .map(|(at, score)| Frame::new(u64::from(at), Some(f64::from(at)), at == 2, score))
            .collect();
        let rule = EventRule::default()
            .with_threshold(0.4)
            .expect("a threshold");
        let mut state = EventState::new(rule);
        state.push("a", &frames).expect("frames");
        state.scores()
    };
    let flagged = state_with([-3.0, -1.5, 2.5]);
    assert_eq!(score(&flagged, "onset_f1", None).estimate.value, Ok(1.0));
    assert_eq!(
        score(&flagged, "onset_f1", None).flags,
        [ScoreFlag::OutsideUnit]
    );
    let plain = state_with([-3.0, 0.5, 2.5]);
    assert!(score(&plain, "onset_f1", None).flags.is_empty());
}

#[test]
fn five_strokes_have_an_interval_by_stroke_and_a_definition_with_the_rule() {
    let scores = state_of(&[".b..", ".t..", ".bb.", ".b..", ".b.p", ".b.."]).scores();
    let f1 = score(&scores, "onset_f1", None);
    let found = f1.estimate.value.expect("onsets");
    let [low, high] = f1.estimate.interval.ends().expect("six strokes");
    assert!(
        0.0 < low && low < found && found < high && high < 1.0,
        "{low} {high}"
    );
    assert_eq!((f1.estimate.n, f1.estimate.clusters), (12, 6));
    assert!(
        f1.definition
            .ends_with("threshold 0.5 strict, debounce 1, tolerance 0.2 s"),
        "{}",
        f1.definition
    );
}

#[test]
fn order_and_merges_do_not_change_a_bit_of_the_state() {
    let strokes = [
        ".tp.", ".b..", ".t.p", "..b.", ".pt.", "...p", ".bb.", ".b.b",
    ];
    let state_from = |order: &[usize]| {
        let mut state = EventState::new(EventRule::default());
        for &at in order {
            let cluster = ["a", "b", "c"][at % 3];
            state
                .push(cluster, &frames(0.3, strokes[at]))
                .expect("frames");
        }
        state
    };
    let whole = state_from(&[0, 1, 2, 3, 4, 5, 6, 7]);
    let merged = state_from(&[7, 2, 5]).merge(state_from(&[1, 0, 6, 4, 3]));
    let merged = merged.expect("one rule");
    let bytes = |state: &EventState| serde_json::to_string(state).expect("a state");
    assert_eq!(bytes(&merged), bytes(&whole));
    assert_eq!(merged.scores(), whole.scores());
}

#[test]
fn many_onsets_far_from_each_other_match_in_any_order_of_times() {
    // Compared one by one, these would be ten thousand million pairs.
    let count = 100_000_u32;
    let truth: Vec<f64> = (0..count).map(f64::from).collect();
    let predicted: Vec<f64> = truth.iter().rev().map(|time_s| time_s + 0.125).collect();
    let pairs = match_onsets(&truth, &predicted, 0.2);
    assert_eq!(pairs.len(), truth.len());
    let last = predicted.len() - 1;
    assert!(
        pairs
            .iter()
            .all(|pair| pair.prediction == last - pair.truth)
    );
}
