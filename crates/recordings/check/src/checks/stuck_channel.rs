//! TAC009: a constant channel, or a force that freezes or is clipped at a limit.

use taceva_core::{Channel, Unit};

use crate::evidence::Evidence;
use crate::finding::{Check, Found, Severity};

pub(super) static CHECK: Check = Check {
    code: "TAC009",
    name: "stuck-channel",
    looks_for: "channels that never change; forces and torques that are constant over a tenth of the samples while pictures change, or clipped in 5 % of the samples",
    hint: "remove a constant channel from the map, because its R² is undefined; drop samples in which a transducer was frozen or at its limit",
    reads: None,
    find,
};

/// Minimum length of a stretch in which a force is frozen, samples. `STILL_SHARE` is its minimum fraction of all samples, as one in this many.
const STILL: usize = 20;
const STILL_SHARE: usize = 10;
/// Minimum number of samples outside the frozen stretch. If more than one in `HELD` of these samples repeats the previous value, the channel is often
/// held and not stuck.
const BESIDE: usize = 10;
const HELD: usize = 10;
/// Maximum frequency of repeated pictures in the frozen stretch: one in this many. If the pictures also freeze, the whole recording is frozen.
const SAME_PICTURES: usize = 10;
/// Minimum number of samples at the limit of a clipped force. `CUT_SHARE` is their minimum frequency.
const CUT: usize = 10;
const CUT_SHARE: usize = 20;
/// Minimum ratio of the samples at the limit to the samples at any other value. The force must have at least `VALUES` values. Commanded levels have a
/// lower ratio.
const TIMES: usize = 3;
const VALUES: usize = 20;

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let channels = evidence.table.channels().iter().enumerate();
    channels
        .filter_map(|(position, channel)| {
            let labels = evidence.labelled(position);
            if let Some(value) = only_value(&labels) {
                let message = format!("{channel} is {value} {} in every sample", channel.unit());
                return Some(Found::overall(Severity::Warning, message));
            }
            // Positions and angles are commanded, and may be held.
            if !matches!(channel.unit(), Unit::Newton | Unit::NewtonMillimetre) {
                return None;
            }
            still(evidence, channel, &labels).or_else(|| cut(evidence, channel, &labels))
        })
        .collect()
}

/// Common value of all samples; `None` if values differ or there are fewer than two.
fn only_value(labels: &[(usize, f64)]) -> Option<f64> {
    let (first, others) = labels.split_first()?;
    let is_only = !others.is_empty() && others.iter().all(|label| is_same(label.1, first.1));
    is_only.then_some(first.1)
}

fn is_same(one: f64, other: f64) -> bool {
    one.to_bits() == other.to_bits()
}

/// Finds a force that freezes while the pictures change.
fn still(evidence: &Evidence<'_>, channel: &Channel, labels: &[(usize, f64)]) -> Option<Found> {
    let runs = labels.chunk_by(|one, other| is_same(one.1, other.1));
    // A force that is not measured is zero throughout.
    let runs = runs.filter(|run| run[0].1.abs() > 0.0);
    let longest = runs.max_by_key(|run| run.len())?;
    let held = labels
        .windows(2)
        .filter(|pair| is_same(pair[0].1, pair[1].1));
    let held = held.count() - (longest.len() - 1);
    let beside = labels.len() - longest.len();
    let is_long = longest.len() >= STILL && longest.len() * STILL_SHARE >= labels.len();
    if !is_long || beside < BESIDE || held * HELD > beside {
        return None;
    }
    let frames = evidence.table.frames();
    let digest = |row: usize| frames[row].as_ref().map(|frame| frame.digest);
    let unchanged = longest.windows(2).filter(|pair| {
        let [(before, _), (row, _)] = pair else {
            return true;
        };
        digest(*row).is_none() || digest(*row) == digest(*before)
    });
    if unchanged.count() * SAME_PICTURES > longest.len() {
        return None;
    }
    let rows: Vec<usize> = longest.iter().map(|(row, _)| *row).collect();
    let message = format!(
        "{channel} is {} {} in {} of {} samples in succession, although their pictures differ; {channel} changes elsewhere",
        longest[0].1,
        channel.unit(),
        rows.len(),
        labels.len()
    );
    Some(evidence.found(Severity::Warning, message, &rows))
}

/// Finds a force clipped at its greatest or least value. Zero is excluded, because it is normal at rest.
fn cut(evidence: &Evidence<'_>, channel: &Channel, labels: &[(usize, f64)]) -> Option<Found> {
    let mut sorted = labels.to_vec();
    sorted.retain(|(_, value)| value.abs() > 0.0);
    sorted.sort_by(|one, other| one.1.total_cmp(&other.1).then(one.0.cmp(&other.0)));
    let values = sorted.chunk_by(|one, other| is_same(one.1, other.1));
    let values: Vec<&[(usize, f64)]> = values.collect();
    let (least, greatest) = (*values.first()?, *values.last()?);
    let is_cut = |end: &&[(usize, f64)]| {
        let others = values.iter().filter(|value| !is_same(value[0].1, end[0].1));
        let next = others.map(|value| value.len()).max().unwrap_or(0);
        end.len() >= CUT && end.len() * CUT_SHARE >= labels.len() && end.len() > TIMES * next
    };
    let ends = [(greatest, 1.0), (least, -1.0)].into_iter();
    let end = ends
        .filter(|(end, sign)| end[0].1 * sign > 0.0)
        .map(|(end, _)| end)
        .find(is_cut)
        .filter(|_| values.len() >= VALUES)?;
    let rows: Vec<usize> = end.iter().map(|(row, _)| *row).collect();
    let message = format!(
        "{channel} ends at {} {} in {} of {} samples, over {TIMES} times as many as at any other value: {channel} is clipped there",
        end[0].1,
        channel.unit(),
        rows.len(),
        labels.len()
    );
    Some(evidence.found(Severity::Warning, message, &rows))
}
