//! Ratio of the spread between presses to the spread between repeats.

use taceva_core::{Field, Needs};

use crate::evaluate::family::Numbers;
use crate::evaluate::metric::{Formula, Metric, ScoreUnit};
use crate::families::repeats::spread::SpreadSums;
use crate::families::repeats::{REPEAT_NEEDS, REPEATS, RepeatFormula};
use crate::score::direction::Better;
use crate::score::range::Range;
use crate::score::theme::Theme;
use crate::score::value::{Finished, UndefinedReason};

pub(crate) static SIGNAL_TO_REPEATABILITY: Metric = Metric {
    id: "signal_to_repeatability",
    title: "signal to repeatability",
    symbol: Some("signal to repeatability"),
    theme: Theme::Detail,
    better: Better::Higher,
    unit: ScoreUnit::One,
    range: Range::Positive,
    definition: "signal_to_repeatability/2",
    reference: "standard deviation of the cells' means, without the part that s_r explains, over s_r, the pooled repeatability standard \
        deviation of ISO 5725",
    documentation: "Ratio of the differences between presses to those between repeats of one press. The part that repeats explain is \
                    subtracted first, so sensors pressed twice and ten times score alike. It is 0 if the \
                    part of repeats explains all differences, and for predictions that never change. Undefined if repeats are equal although presses differ. If \
                    labels differ less between presses than predictions of one press do, the score is flagged `low stimulus` and takes \
                    part in no verdict.",
    // Labels are needed to know that the presses differ, and so that a signal existed.
    needs: Needs::new(REPEAT_NEEDS.fields.with(Field::Truth)).with_least_samples(2),
    formula: Formula(&RepeatFormula {
        finish: |spreads, _| signal_to_repeatability(spreads),
        has_curve: false,
        needs_stimulus: true,
    }),
    ..Metric::of(&REPEATS)
};

/// Spread of group means beyond the scatter of repeats, divided by the pooled spread of repeats. A group is the repeats of one press. The ratio is
/// 0 if the scatter of repeats explains the spread of the means.
fn signal_to_repeatability(spreads: &SpreadSums) -> Numbers {
    let ratio = || -> Finished {
        let (signal, noise) = (spreads.signal()?, spreads.pooled()?);
        match (signal > 0.0, noise > 0.0) {
            (false, _) => Ok(0.0),
            (true, false) => Err(UndefinedReason::EqualRepeats),
            (true, true) => Ok(signal / noise),
        }
    };
    Numbers::of(ratio())
}
