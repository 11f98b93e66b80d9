//! Frames and rules that are refused.

use taceva_tasks::events::{EventError, EventRule, EventState, Frame};

/// Error for a sequence of two frames, under the default rule.
fn refusal(frames: [Frame; 2]) -> EventError {
    let refused = EventState::new(EventRule::default()).push("a", &frames);
    refused.expect_err("a bad frame")
}

#[test]
fn times_that_go_back_are_refused_with_both_rows() {
    let frames = [
        Frame::new(41, Some(2.5), false, 0.0),
        Frame::new(40, Some(2.25), false, 0.0),
    ];
    assert_eq!(
        refusal(frames).to_string(),
        "row 40: time 2.25 s is before 2.5 s of row 41, expected times that do not go back; sort the rows by time"
    );
    let equal = [
        Frame::new(1, Some(2.5), false, 0.0),
        Frame::new(2, Some(2.5), true, 1.0),
    ];
    assert!(
        EventState::new(EventRule::default())
            .push("a", &equal)
            .is_ok()
    );
}

#[test]
fn a_score_that_is_not_finite_is_refused_by_row() {
    for value in [f64::NAN, f64::INFINITY] {
        let frames = [
            Frame::new(1, Some(0.0), false, 0.0),
            Frame::new(2, Some(0.1), false, value),
        ];
        let text = refusal(frames).to_string();
        assert!(text.starts_with("row 2: the score is "), "{text}");
    }
}

#[test]
fn a_time_that_is_not_finite_or_lacks_is_refused_by_row() {
    let times = |time_s| {
        [
            Frame::new(1, Some(0.0), false, 0.0),
            Frame::new(2, time_s, false, 0.0),
        ]
    };
    assert_eq!(refusal(times(None)), EventError::NoTime { row: 2 });
    for value in [f64::NAN, f64::INFINITY, 1e13] {
        let text = refusal(times(Some(value))).to_string();
        assert!(text.starts_with("row 2: the time is "), "{text}");
    }
}

#[test]
fn a_refused_sequence_leaves_the_state_as_it_was() {
    let mut state = EventState::new(EventRule::default());
    let frames = [
        Frame::new(1, Some(1.0), false, 0.0),
        Frame::new(2, Some(0.0), false, 0.0),
    ];
    assert!(state.push("a", &frames).is_err());
    assert_eq!(state, EventState::new(EventRule::default()));
}

#[test]
fn a_rule_without_a_finite_threshold_a_frame_or_a_tolerance_is_refused() {
    let rule = EventRule::default();
    assert!(rule.with_threshold(f64::NAN).is_err());
    assert_eq!(rule.with_debounce(0), Err(EventError::Debounce));
    for tolerance in [-0.1, f64::NAN, f64::INFINITY] {
        assert!(rule.with_tolerance_s(tolerance).is_err());
    }
}

#[test]
fn states_of_other_rules_do_not_merge() {
    let rule = EventRule::default();
    let debounced = rule.with_debounce(3).expect("a debounce");
    let refused = EventState::new(rule).merge(EventState::new(debounced));
    let text = refused.expect_err("another rule").to_string();
    assert!(
        text.starts_with("states of different event rules do not merge: threshold 0.5"),
        "{text}"
    );
}
