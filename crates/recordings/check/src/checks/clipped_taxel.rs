//! TAC017: taxels whose values accumulate at the end of their range.

use taceva_core::{Field, counted};

use crate::evidence::Evidence;
use crate::finding::{Check, Found, Severity};
use crate::signal_facts::{SignalFacts, TaxelFacts, ValueCount};

pub(super) static CHECK: Check = Check {
    code: "TAC017",
    name: "clipped-taxel",
    looks_for: "taxels clipped at their greatest or least value: it occurs in at least 1 % of the samples, and over three times as often as the nearest other value",
    hint: "press with less force, or lower the gain of the converter. The signal beyond the limit is lost, and models learn a constant there. If the value marks a missing reading, list it as `placeholders` in [signals] of the map",
    reads: Some(Field::Signals),
    find,
};

/// Minimum number of samples with the value at the end of the range.
const LEAST: u64 = 5;
/// Minimum frequency of the value at the end of the range: one in this many samples.
const SHARE: u64 = 100;
/// Minimum ratio of the frequency of the value at the end of the range to the frequency of the nearest other value.
const TIMES: u64 = 3;
/// Maximum number of taxels named in a message; the others are counted.
const NAMED: usize = 5;

/// Minimum distance of a code for "nothing measured" from the nearest other value, as a fraction of the range of all other values.
const FAR: f32 = 0.25;

/// End of the range of a taxel at which values accumulate.
#[derive(Clone, Copy)]
struct End {
    own: ValueCount,
    /// Value of this taxel that is nearest to the end.
    next: f32,
    /// True if the value is far from all other values, such as a code for "nothing measured".
    is_code: bool,
}

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let Some(facts) = evidence.signals else {
        return Vec::new();
    };
    let ends =
        (0..facts.taxels.len()).filter_map(|position| Some((position, end_of(facts, position)?)));
    let (codes, clipped): (Vec<_>, Vec<_>) = ends.partition(|(_, end)| end.is_code);
    let unit = facts.info.unit;
    let named = |position: usize, own: ValueCount| {
        let samples = counted(own.count, "sample");
        format!(
            "{} is {} {unit} in {samples}",
            facts.names[position], own.value
        )
    };
    let clipped: Vec<String> = clipped
        .into_iter()
        .map(|(position, end)| named(position, end.own))
        .collect();
    let codes: Vec<String> = codes
        .into_iter()
        .map(|(position, end)| {
            let named = named(position, end.own);
            format!("{named}, and the nearest other value is {}", end.next)
        })
        .collect();
    let said = [
        (clipped, "are clipped at a limit"),
        (codes, "have a number that may mean \"nothing measured\""),
    ];
    let said = said.into_iter().filter(|(taxels, _)| !taxels.is_empty());
    said.map(|(taxels, what)| {
        let first = taxels[..taxels.len().min(NAMED)].join("; ");
        let message = format!(
            "{} of {} signals {what}: {first}",
            taxels.len(),
            facts.taxels.len()
        );
        Found::overall(Severity::Warning, message)
    })
    .collect()
}

/// End of the range at which a taxel is clipped or has a code for "nothing measured"; `None` without such an end.
fn end_of(facts: &SignalFacts, position: usize) -> Option<End> {
    let TaxelFacts {
        least,
        above_least,
        greatest,
        below_greatest,
        ..
    } = facts.taxels[position];
    let is_frequent = |ValueCount { count, .. }: ValueCount, next: ValueCount| {
        count >= LEAST && count * SHARE >= facts.samples && count > TIMES * next.count
    };
    let end = |own: ValueCount, next: Option<ValueCount>, other: f32| {
        let next = next.filter(|next| is_frequent(own, *next))?.value;
        let is_code =
            (next - own.value).abs() > FAR * (other - next).abs() && next.total_cmp(&other).is_ne();
        Some(End {
            own,
            next,
            is_code: is_code || (own.value < 0.0 && next >= 0.0),
        })
    };
    // A sensor that shows nothing until it is touched has its least value at rest.
    let is_rest = |end: &End| match &facts.rest {
        Some(rest) => rest.values()[position] <= end.own.value,
        None => end.own.value.abs() <= 0.0,
    };
    let above = end(greatest, below_greatest, least.value);
    let below = end(least, above_least, greatest.value);
    above.or(below.filter(|end| !is_rest(end)))
}
