//! Formats a plan as text, and as data for other programs.

use std::fmt;

use serde::ser::{Serialize, SerializeStruct, Serializer};
use taceva_core::{Field, SkipReason, counted};

use super::{Plan, PlannedMetric, PlannedPress};
use crate::phase_kind::PhaseKind;
use crate::reason::{PlanReason, PlanSkip, Subject};

impl fmt::Display for Plan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "plan  study   {}", self.name)?;
        if let Some(limits) = &self.limits {
            let overshoot = limits.overshoot.healthy_mm;
            writeln!(
                f,
                "limit motion  {}, {}, a stop within {overshoot:.3} mm",
                limits.depth_max, limits.normal_max
            )?;
        }
        if let Some(wear) = &self.wear {
            writeln!(f, "load  gel     {wear}")?;
        }
        if !self.phases.is_empty() {
            writeln!(
                f,
                "run   phase   {:<46} {}",
                joined(&self.phases),
                Costs(self)
            )?;
        }
        if !self.metrics.is_empty() {
            let metrics: Vec<&str> = self
                .metrics
                .iter()
                .map(|metric| metric.id.as_str())
                .collect();
            writeln!(f, "run   metric  {}", metrics.join(", "))?;
        }
        if self.adds_skill() {
            writeln!(
                f,
                "add   metric  {SKILL}: decides whether predictions take part in verdicts"
            )?;
        }
        for fit in &self.fits {
            write!(f, "fit   model   {} on {}", fit.field, fit.phase)?;
            match fit.folds {
                Some(folds) => writeln!(f, ", a model for each of {folds} folds of its points")?,
                None => writeln!(f)?,
            }
        }
        let fields: Vec<String> = self.fields.iter().map(|field| field.to_string()).collect();
        if !fields.is_empty() {
            let note = match self.cost.frames {
                0 if !self.phases.is_empty() => "    frames are not captured",
                _ => "",
            };
            writeln!(f, "read  fields  {}{note}", fields.join(", "))?;
        }
        if let Some(kept) = self.kept_frames.filter(|_| self.cost.frames > 0) {
            write!(f, "keep  frames  {kept} in 8 bits, area averages")?;
            match self.frame {
                Some(frame) => writeln!(f, " of {frame}")?,
                None => writeln!(f)?,
            }
        }
        for (subjects, reason) in grouped(&self.skipped) {
            let verb = match reason {
                PlanReason::VisitedBy { .. } => "join",
                _ => "skip",
            };
            writeln!(f, "{verb}  {subjects:<40} {reason}")?;
        }
        Ok(())
    }
}

/// Id of the skill metric, which is added to every study with predictions.
const SKILL: &str = "skill";

impl Plan {
    /// True if the skill metric is added because a planned metric or the score of contact shapes reads predictions.
    fn adds_skill(&self) -> bool {
        let reads = |metric: &PlannedMetric| metric.fields.contains(Field::Prediction);
        let is_predicted =
            self.metrics.iter().any(reads) || self.phases.contains(&PhaseKind::Shape);
        is_predicted && !self.metrics.iter().any(|metric| metric.id == SKILL)
    }
}

/// Formats the cost.
struct Costs<'a>(&'a Plan);

impl fmt::Display for Costs<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let cost = &self.0.cost;
        write!(
            f,
            "{}, ~{:.0} min",
            counted(cost.presses, "press"),
            cost.minutes.ceil()
        )?;
        if cost.frames > 0 {
            write!(f, ", {}", counted(cost.frames, "frame"))?;
        }
        if let Some(bytes) = cost.bytes.filter(|bytes| *bytes > 0) {
            // Lossless compression reduces the size by an amount that depends on the noise.
            write!(f, ", at most {} MB", bytes.div_ceil(1_000_000))?;
        }
        Ok(())
    }
}

fn joined<T: fmt::Display>(items: &[T]) -> String {
    let words: Vec<String> = items.iter().map(ToString::to_string).collect();
    words.join(", ")
}

/// Skipped items of one kind with the same reason, combined in one line. Metrics that were not requested are omitted.
fn grouped(skipped: &[PlanSkip]) -> Vec<(String, &PlanReason)> {
    let mut lines: Vec<(&Subject, String, &PlanReason)> = Vec::new();
    let news = skipped
        .iter()
        .filter(|skip| skip.reason != PlanReason::Skip(SkipReason::NotWanted));
    for PlanSkip { subject, reason } in news {
        let same_kind =
            |other: &Subject| std::mem::discriminant(other) == std::mem::discriminant(subject);
        let line = lines
            .iter_mut()
            .find(|(first, _, other)| *other == reason && same_kind(first));
        match line {
            Some((_, subjects, _)) => {
                let whole = subject.to_string();
                let name = whole
                    .split_once(' ')
                    .map_or(whole.as_str(), |(_, name)| name.trim_start());
                subjects.push_str(", ");
                subjects.push_str(name);
            }
            None => lines.push((subject, subject.to_string(), reason)),
        }
    }
    lines
        .into_iter()
        .map(|(_, subjects, reason)| (subjects, reason))
        .collect()
}

/// Serialises the plan with the schema `taceva.plan/1`.
impl Serialize for Plan {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let named =
            |fields: taceva_core::FieldSet| fields.iter().map(Field::name).collect::<Vec<_>>();
        let metrics: Vec<_> = self
            .metrics
            .iter()
            .map(|metric| WrittenMetric {
                id: &metric.id,
                channels: &metric.channels,
                phase: metric.phase.name(),
            })
            .collect();
        let fits: Vec<_> = self
            .fits
            .iter()
            .map(|fit| WrittenFit {
                predicts: fit.field.name(),
                phase: fit.phase.name(),
                folds: fit.folds,
            })
            .collect();
        let skipped: Vec<_> = self
            .skipped
            .iter()
            .map(|skip| WrittenSkip {
                what: skip.subject.key(),
                reason: skip.reason.to_string(),
            })
            .collect();
        let optional = [
            self.kept_frames.is_some(),
            self.adds_skill(),
            self.wear.is_some(),
        ];
        let fields = 15 + optional.into_iter().map(usize::from).sum::<usize>();
        let mut plan = serializer.serialize_struct("Plan", fields)?;
        plan.serialize_field("schema", "taceva.plan/1")?;
        plan.serialize_field("name", &self.name)?;
        plan.serialize_field("digest", &self.digest())?;
        plan.serialize_field("metrics", &metrics)?;
        if self.adds_skill() {
            plan.serialize_field("added_metrics", &[SKILL])?;
        }
        plan.serialize_field("phases", &self.phases)?;
        plan.serialize_field("fits", &fits)?;
        plan.serialize_field("fields", &named(self.fields))?;
        plan.serialize_field("channels", &self.channels)?;
        plan.serialize_field("units", &self.units)?;
        plan.serialize_field("lights", &self.lights)?;
        plan.serialize_field("limits", &self.limits)?;
        plan.serialize_field("cost", &self.cost)?;
        plan.serialize_field("skipped", &skipped)?;
        plan.serialize_field("frame", &self.frame)?;
        // The recording depends on the frame size, so another size makes another plan.
        if let Some(kept) = &self.kept_frames {
            plan.serialize_field("kept_frames", kept)?;
        }
        if let Some(wear) = &self.wear {
            plan.serialize_field("wear", wear)?;
        }
        let presses: Vec<_> = self.presses.iter().map(WrittenPress::of).collect();
        plan.serialize_field("presses", &presses)?;
        plan.end()
    }
}

#[derive(serde::Serialize)]
struct WrittenMetric<'a> {
    id: &'a str,
    channels: &'a [String],
    phase: &'static str,
}

#[derive(serde::Serialize)]
struct WrittenFit {
    predicts: &'static str,
    phase: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    folds: Option<u32>,
}

#[derive(serde::Serialize)]
struct WrittenSkip {
    what: String,
    reason: String,
}

#[derive(serde::Serialize)]
struct WrittenPress<'a> {
    id: String,
    unit: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    light: Option<&'a str>,
    specimen: String,
    place_mm: [f64; 2],
    samples: usize,
    frames: bool,
    phases: &'a [PhaseKind],
}

impl WrittenPress<'_> {
    fn of(planned: &PlannedPress) -> WrittenPress<'_> {
        WrittenPress {
            id: planned.id.to_string(),
            unit: &planned.press.unit,
            light: planned.press.light.as_deref(),
            specimen: planned.press.specimen.to_string(),
            place_mm: planned
                .press
                .place
                .map(taceva_core::Nanometre::to_millimetres),
            samples: planned.press.samples(),
            frames: planned.frames,
            phases: &planned.phases,
        }
    }
}
