//! Comparison of the recorded presses on the disk with the plan, the acknowledged presses and the truth.

use std::collections::BTreeSet;

use taceva_core::{Phase, PressOutcome};

use super::gel::Gel;
use super::journal::{Entry, EntrySample, entries};
use super::oracle::Violation;
use taceva_protocol::ContentId;
use taceva_protocol::Motion;
use taceva_protocol::{Plan, PlannedPress};

/// Rounding error of sums of lengths in binary64, mm.
const ROUNDING_MM: f64 = 1e-6;

/// Result of comparing the recorded presses.
pub(super) struct Found {
    pub(super) violations: Vec<Violation>,
    /// Number of compared samples.
    pub(super) samples: u64,
}

/// Compares the recorded presses `kept` with `plan` and the acknowledged presses, and their samples with the truth of `gel`.
pub(super) fn judge_log(
    plan: &Plan,
    kept: &[Entry],
    acknowledged: &[ContentId],
    gel: &Gel,
) -> Found {
    let mut found = Found {
        violations: Vec::new(),
        samples: 0,
    };
    let mut seen = BTreeSet::new();
    for entry in kept {
        if !seen.insert(entry.press) {
            found
                .violations
                .push(Violation::Doubled(entry.press.to_string()));
        }
        found.compare(plan, entry, gel);
    }
    found.violations.extend(lost(&seen, acknowledged));
    for planned in &plan.presses {
        if !seen.contains(&planned.id) {
            found
                .violations
                .push(Violation::Lost(format!("{} was planned", planned.id)));
        }
    }
    found
}

/// Violation if the retreat of a press has too few samples for its approach, although the plan has waypoints in both directions. One sample may be
/// missing: a limit just below a waypoint gives the approach two samples of almost equal depth.
fn one_sided(planned: &PlannedPress, entry: &Entry) -> Option<Violation> {
    let waypoints = planned.press.waypoints();
    let on_way_out = |sample: &&EntrySample| {
        let waypoint = usize::try_from(sample.number).ok();
        let waypoint = waypoint.and_then(|number| waypoints.get(number));
        waypoint.is_some_and(|waypoint| waypoint.phase == Phase::Unload)
    };
    let comes_out = waypoints
        .iter()
        .any(|waypoint| waypoint.phase == Phase::Unload);
    let samples = entry.samples.len();
    let out = entry.samples.iter().filter(on_way_out).count();
    (comes_out && !(2 * out..=2 * out + 1).contains(&samples)).then(|| {
        let what = format!(
            "{} has {out} samples of {samples} on its retreat",
            entry.press
        );
        Violation::Untrue(what)
    })
}

/// Violations for acknowledged presses that are missing from `file`. A later repetition of a press does not excuse its loss.
pub(super) fn missing(file: &[u8], acknowledged: &[ContentId]) -> Vec<Violation> {
    let (kept, _) = entries(file);
    let seen = kept.iter().map(|entry| entry.press).collect();
    lost(&seen, acknowledged).collect()
}

fn lost<'a>(
    seen: &'a BTreeSet<ContentId>,
    acknowledged: &'a [ContentId],
) -> impl Iterator<Item = Violation> + 'a {
    let gone = acknowledged.iter().filter(|press| !seen.contains(press));
    gone.map(|press| Violation::Lost(press.to_string()))
}

impl Found {
    fn compare(&mut self, plan: &Plan, entry: &Entry, gel: &Gel) {
        let name = entry.press;
        let Some(planned) = plan.presses.iter().find(|planned| planned.id == name) else {
            self.violations.push(Violation::Invented(name.to_string()));
            return;
        };
        let samples = entry.samples.len();
        let whole = samples == planned.press.samples();
        let limited = entry.samples.iter().filter(|sample| sample.is_limited);
        let fits = match entry.outcome {
            PressOutcome::Complete => whole && limited.count() == 0,
            // Without a sample, the limit was reached during the search.
            PressOutcome::Limited(_) => samples == 0 || limited.count() > 0,
            _ => false,
        };
        let numbers = entry.samples.iter().map(|sample| sample.number);
        let in_order = match entry.outcome {
            PressOutcome::Complete => numbers.eq(0..u32::try_from(samples).unwrap_or(u32::MAX)),
            _ => numbers.is_sorted_by(|one, next| one < next),
        };
        if !fits || !in_order {
            let what = format!("{name} ended as {:?} with {samples} samples", entry.outcome);
            self.violations.push(Violation::Invented(what));
        }
        self.violations.extend(one_sided(planned, entry));
        let waypoints = planned.press.waypoints();
        // The depth of a sample is the difference of two reported poses.
        let reported_mm = ROUNDING_MM + 2.0 * gel.pose_noise_mm;
        // The tip may stop short of its waypoint if the robot stuck in the last segment, or earlier because of noise. The label has the
        // true place.
        let limits = plan.limits.as_ref();
        let stuck_mm = limits.map_or(0.0, |limits| {
            limits.overshoot.segment_mm + 3.0 * limits.signals.pose_noise_mm + gel.pose_noise_mm
        });
        let lag_mm = stuck_mm + reported_mm;
        let mut height = None;
        for sample in &entry.samples {
            let place = sample.number;
            self.samples += 1;
            let mut untrue = |what: String| self.violations.push(Violation::Untrue(what));
            let waypoint = usize::try_from(place)
                .ok()
                .and_then(|place| waypoints.get(place));
            if let Some(waypoint) = waypoint {
                let depth_mm = waypoint.depth.to_millimetres();
                let off_mm = sample.depth_mm - depth_mm;
                if off_mm > lag_mm || (off_mm < -lag_mm && !sample.is_limited) {
                    untrue(format!(
                        "{name}/{place} is {} mm deep, not {depth_mm}",
                        sample.depth_mm
                    ));
                }
            }
            if sample.is_limited && sample.force_n > gel.normal_max_n + gel.force_error_n() {
                untrue(format!(
                    "{name}/{place} rests at {} N, beyond the limit",
                    sample.force_n
                ));
            }
            if sample.frame.is_some() != planned.frames {
                untrue(format!("{name}/{place} has a frame or lacks one"));
            }
            let Some([exposed_s, height_mm, force_n]) = sample.frame else {
                continue;
            };
            if (sample.stamp_s - exposed_s).abs() > 1e-9 {
                untrue(format!("{name}/{place} shows a frame of another time"));
            }
            if (sample.force_n - force_n).abs() > gel.force_error_n() + 1e-9 {
                untrue(format!(
                    "{name}/{place} has {} N, its frame {force_n} N",
                    sample.force_n
                ));
            }
            if let Motion::Indent(_) = planned.press.motion {
                // All samples of a press have the same contact height.
                let contact_mm = height_mm - sample.depth_mm;
                let first: f64 = *height.get_or_insert(contact_mm);
                if (contact_mm - first).abs() > 2.0 * reported_mm {
                    untrue(format!("{name}/{place} shows a frame of another height"));
                }
            }
        }
    }
}
