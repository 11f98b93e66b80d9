//! Laws of merging, for any kind of samples.

use taceva_metrics::{Evaluator, State};

/// States of an evaluator.
pub(crate) fn states(mut evaluator: Evaluator) -> Vec<State> {
    evaluator.states().expect("the plan's channels")
}

/// Report of an evaluator, as JSON and as a table.
pub(crate) fn report(evaluator: Evaluator) -> String {
    let evaluation = evaluator.finish().expect("the plan's channels");
    let json = serde_json::to_string(&evaluation).expect("a report");
    format!("{json}\n{evaluation:#}")
}

/// Merges `right` into `left`.
pub(crate) fn merged(mut left: Evaluator, right: Evaluator) -> Evaluator {
    left.merge(right).expect("one plan");
    left
}

/// Asserts that `whole` equals its merged parts, in either order.
pub(crate) fn a_whole_equals_its_merged_parts<T>(
    samples: &[T],
    cut: usize,
    of: impl Fn(&[T]) -> Evaluator,
) {
    let (left, right) = samples.split_at(cut);
    let whole = states(of(samples));
    assert_eq!(states(merged(of(left), of(right))), whole);
    assert_eq!(states(merged(of(right), of(left))), whole);
    let expected = report(of(samples));
    assert_eq!(report(merged(of(left), of(right))), expected);
    assert_eq!(report(merged(of(right), of(left))), expected);
}

/// Asserts that order and grouping do not matter, and that an empty evaluator is the identity.
pub(crate) fn merging_is_commutative_and_associative_and_nothing_is_its_identity<T>(
    samples: [&[T]; 3],
    of: impl Fn(&[T]) -> Evaluator,
) {
    let of = &of;
    let [a, b, c] = samples.map(|samples| move || of(samples));
    let nothing = || of(&[]);
    assert_eq!(states(merged(a(), b())), states(merged(b(), a())));
    let left = merged(merged(a(), b()), c());
    let right = merged(a(), merged(b(), c()));
    assert_eq!(states(left), states(right));
    assert_eq!(states(merged(a(), nothing())), states(a()));
    assert_eq!(states(merged(nothing(), a())), states(a()));
}

/// Asserts that a state survives serialization, and that an evaluator that merges the read state gives the same report.
pub(crate) fn a_state_that_was_written_and_read_is_the_same<T>(
    samples: &[T],
    of: impl Fn(&[T]) -> Evaluator,
) {
    let written = states(of(samples));
    let text = serde_json::to_string(&written).expect("a state");
    let read: Vec<State> = serde_json::from_str(&text).expect("its own text");
    assert_eq!(read, written);
    let mut again = of(&[]);
    again.merge_states(&read).expect("one plan");
    assert_eq!(report(again), report(of(samples)));
}
