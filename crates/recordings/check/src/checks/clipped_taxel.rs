//! TAC017: taxels whose values accumulate at the end of their range.

use taceva_core::{Field, counted};

use crate::evidence::Evidence;
use crate::finding::{Check, Found, Severity};
use crate::signal_facts::{SignalFacts, TaxelFacts, ValueCount};

pub(super) static CHECK: Check = Check {
    code: "TAC017",
    name: "clipped-taxel",
    looks_for: "taxels clipped at their greatest or least number, which occurs in 1 % of the samples and three times as often as the next number",
    hint: "press with less force, or lower the gain of the converter: the signal beyond the limit is lost, and models learn a constant \
        there; if the number means that nothing was measured, list it as `placeholders` in [signals] of the map",
    reads: Some(Field::Signals),
    find,
};

/// Minimum number of samples with the value at the end of the range.
const LEAST: u64 = 5;
/// Minimum frequency of the value at the end of the range: one in this many samples.
const SHARE: u64 = 100;
/// Minimum ratio of the frequency of the value at the end of the range to that of the next value.
const TIMES: u64 = 3;
/// Maximum number of taxels named in a message; the others are counted.
const NAMED: usize = 5;

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let Some(facts) = evidence.signals else {
        return Vec::new();
    };
    let clipped: Vec<String> = (0..facts.taxels.len())
        .filter_map(|position| Some((position, end_of(facts, position)?)))
        .map(|(position, ValueCount { value, count })| {
            let unit = facts.info.unit;
            format!(
                "{} is {value} {unit} in {}",
                facts.names[position],
                counted(count, "sample")
            )
        })
        .collect();
    if clipped.is_empty() {
        return Vec::new();
    }
    let named = clipped[..clipped.len().min(NAMED)].join(", ");
    let message = format!(
        "{} of {} signals are clipped at a limit: {named}",
        clipped.len(),
        facts.taxels.len()
    );
    vec![Found::overall(Severity::Warning, message)]
}

/// Value at which a taxel is clipped, and the number of samples with this value; `None` if the taxel is not clipped.
fn end_of(facts: &SignalFacts, position: usize) -> Option<ValueCount> {
    let TaxelFacts {
        least,
        above_least,
        greatest,
        below_greatest,
        ..
    } = facts.taxels[position];
    let is_clipped = |ValueCount { count, .. }: ValueCount, next: ValueCount| {
        count >= LEAST && count * SHARE >= facts.samples && count > TIMES * next.count
    };
    let above =
        Some(greatest).filter(|end| below_greatest.is_some_and(|next| is_clipped(*end, next)));
    // A sensor that shows nothing until it is touched has its least value at rest.
    let is_rest = |end: &ValueCount| match &facts.rest {
        Some(rest) => rest.values()[position] <= end.value,
        None => end.value.abs() <= 0.0,
    };
    let below = Some(least).filter(|end| above_least.is_some_and(|next| is_clipped(*end, next)));
    above.or(below.filter(|end| !is_rest(end)))
}
