//! Findings in the scores of faults: the severity that ends skill, the error that a new untouched picture removes, and errors that no check finds.

use taceva_metrics::elementary::logarithm;

use crate::estimate::{Estimate, Undefined};
use crate::report::{CellScore, FaultReport, SeverityReport, Unnoticed};
use crate::severity::NEVER;

/// Stimulus below which a fault hardly changes the pictures. Stimulus is the change of pictures by a fault, divided by their change by contact.
pub(crate) const LOW: f64 = 0.05;
/// Code of the check that compares untouched pictures (pictures without contact).
pub(crate) const CHANGED_REST: &str = "TAC034";
/// Minimum degradation of a doubled error. Degradation is the error divided by the error without the fault.
const DOUBLE: f64 = 2.0;

/// Least severity whose interval of skill is not above 0; [`NEVER`] if there is none. `None` if an interval is missing, or no severity was tested.
pub(crate) fn breaks_at(severities: &[SeverityReport], channel: &str) -> Option<u8> {
    for of in severities {
        let skill = of.stale.get(channel)?.skill;
        if !skill.is_above_zero()? {
            return Some(of.severity);
        }
    }
    (!severities.is_empty()).then_some(NEVER)
}

/// Share of the excess error that a new untouched picture removes. Excess is the sum of the logarithms of degradation over all severities. `mean` is
/// the mean degradation without a new picture.
pub(crate) fn recovers(severities: &[SeverityReport], channel: &str, mean: &Estimate) -> Estimate {
    let Some(value) = mean.value else {
        return *mean;
    };
    if mean.low().unwrap_or(value) <= 1.0 {
        return Estimate::undefined(Undefined::NoExcess);
    }
    let mut sums = [0.0; 2];
    for of in severities {
        let fresh = of.fresh.as_ref();
        let sides = [of.stale.get(channel), fresh.and_then(|of| of.get(channel))];
        for (sum, score) in sums.iter_mut().zip(sides) {
            let degradation = score.and_then(|score| score.degradation.value);
            match degradation.filter(|ratio| *ratio > 0.0) {
                Some(ratio) => *sum += logarithm(ratio),
                None => return Estimate::undefined(Undefined::NoFreshReference),
            }
        }
    }
    let [stale, fresh] = sums;
    match stale > 0.0 {
        true => Estimate::new(1.0 - fresh / stale, Err(Undefined::NoInterval)),
        false => Estimate::undefined(Undefined::NoExcess),
    }
}

/// Errors that are at least doubled by a fault of pictures or signals that no check finds.
pub(crate) fn unnoticed(faults: &[FaultReport]) -> Vec<Unnoticed> {
    let of_inputs = faults.iter().filter(|fault| !fault.keeps_inputs());
    let hidden = of_inputs.flat_map(|fault| {
        let severities = fault.severities.iter().filter(|of| of.check.is_empty());
        severities.flat_map(move |of| {
            let is_doubled = |score: &CellScore| {
                let ratio = score.degradation.value;
                ratio.is_some_and(|ratio| ratio >= DOUBLE)
            };
            let doubled = of.stale.iter().filter(move |(_, score)| is_doubled(score));
            doubled.map(move |(channel, _)| Unnoticed {
                fault: fault.id.clone(),
                severity: of.severity,
                channel: channel.clone(),
            })
        })
    });
    hidden.collect()
}
