//! How much larger the differences between presses are than those between repeats.

use super::NEEDS;
use super::spread::SpreadSums;
use crate::evaluate::family::Numbers;
use crate::evaluate::metric::{Formula, Metric, ScoreUnit};
use crate::score::Parameter;
use crate::score::better::Better;
use crate::score::range::Range;
use crate::score::value::{Finished, UndefinedReason};
use taceva_core::{Field, Needs, Unit};

pub(crate) static SIGNAL_TO_REPEATABILITY: Metric = Metric {
    id: "signal_to_repeatability",
    title: "signal to repeatability",
    better: Better::Higher,
    unit: ScoreUnit::One,
    range: Range::Positive,
    definition: "signal_to_repeatability/1",
    reference: "standard deviation of the cells' means over the pooled repeatability standard deviation s_r of ISO 5725",
    documentation: "How many times larger the differences between presses are than those between repeats of one press. A \
                    sensor whose predictions never change repeats perfectly and has no signal: its value is 0. Undefined where \
                    repeats do not differ at all although presses do. Where labels differ less from press to press than predictions of one press \
                    do, the score is flagged `low stimulus` and takes part in no verdict: what predictions differ by is no signal.",
    // Without labels it is not known whether there was a signal.
    needs: Needs::new(NEEDS.fields.with(Field::Truth)).with_least_samples(2),
    facts: &[],
    constants: no_constants,
    formula: Formula::SignalToRepeatability,
};

fn no_constants(_: Unit) -> Vec<Parameter> {
    Vec::new()
}

/// RN(s_m / s_r), s_m the standard deviation of the cells' means; 0 where the means do not differ.
pub(super) fn signal_to_repeatability(spreads: &SpreadSums) -> Numbers {
    let ratio = || -> Finished {
        let (signal, noise) = (spreads.deviation_of_means()?, spreads.pooled()?);
        match (signal > 0.0, noise > 0.0) {
            (false, _) => Ok(0.0),
            (true, false) => Err(UndefinedReason::EqualRepeats),
            (true, true) => Ok(signal / noise),
        }
    };
    Numbers::of(ratio())
}
