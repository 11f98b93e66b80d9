//! Plans a study in pure passes. Passes remove and merge metrics, presses, fields and models, and record each reason. They add none.
//!
//! `collect → resolve → applicability → phases → merge → fields → check → cost`, one file for each pass. Then `wear` adds load cycles.

mod applicability;
mod check;
mod collect;
mod cost;
mod explain;
mod fields;
mod merge;
mod phases;
mod resolve;
mod study_facts;
#[cfg(test)]
pub(crate) mod tests;
mod wanted_widths;
mod wear;

pub use collect::{Fit, PlannedMetric, PlannedPress};
pub use cost::Cost;
pub use wear::PlannedWear;

use taceva_core::{
    Channel, Channels, FieldSet, Footprint, FrameInfo, Nanometre, Outline, SkipReason, Unit,
};
use taceva_metrics::{SensorFacts, catalogue};

use crate::content_id::{ContentId, Hasher};
use crate::frame_size::FrameSize;
use crate::limits::RigLimits;
use crate::phase_kind::PhaseKind;
use crate::reason::{PlanReason, PlanSkip, Subject};
use crate::scene::{Contact, DepthOrigin, Scene, Study, phase_of_task};
use crate::source::SourceInfo;
use crate::text::{SceneError, SceneProblem};
use collect::Collected;
pub(crate) use collect::{MetricNeeds, SURFACE};
use study_facts::{Gather, StudyFacts};

/// Plan of one sensor: its metrics, presses and models, and skipped parts with reasons. [`Display`](std::fmt::Display) explains it.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// The name of the study.
    pub name: String,
    /// Metrics to compute.
    pub metrics: Vec<PlannedMetric>,
    /// Phases of the protocol, in order; empty for a recording.
    pub phases: Vec<PhaseKind>,
    /// Presses, in the order of their execution.
    pub presses: Vec<PlannedPress>,
    /// Models to fit.
    pub fits: Vec<Fit>,
    /// Fields of samples that a metric reads.
    pub fields: FieldSet,
    /// Channels of the measured truth.
    pub channels: Vec<String>,
    /// Units to measure, in the order of measurement.
    pub units: Vec<String>,
    /// Light scenes, the calibration scene first.
    pub lights: Vec<String>,
    /// Skipped metrics, phases, models, fields and channels, with reasons.
    pub skipped: Vec<PlanSkip>,
    /// Limits of every motion; `None` if nothing moves.
    pub limits: Option<RigLimits>,
    /// Settings for finding and keeping contact.
    pub contact: Contact,
    /// Outline of the sensing surface; `None` if unknown.
    pub footprint: Option<Footprint>,
    /// True if ambient light cannot reach the camera; `None` if unknown.
    pub opaque: Option<bool>,
    /// Size and format of the frames, if known.
    pub frame: Option<FrameInfo>,
    /// Size to which frames are reduced before storage; `None` stores full frames.
    pub kept_frames: Option<FrameSize>,
    /// Load cycles before the measured presses; `None` without `[protocol.wear]`.
    pub wear: Option<PlannedWear>,
    /// Estimated cost.
    pub cost: Cost,
}

impl Plan {
    /// Digest of the acquisition. A recording with another digest cannot be resumed.
    ///
    /// The digest excludes metrics. A finished acquisition can therefore also be used by a scene with fewer metrics from the same presses.
    pub fn digest(&self) -> ContentId {
        let contact = &self.contact;
        let hasher = Hasher::new("taceva.plan/1")
            .number(contact.step_mm.value)
            .number(contact.threshold_n.value)
            .number(contact.settle_s.value)
            .number(contact.speed_mm_s.value)
            .count(self.presses.len());
        let hasher = match contact.depth_from.value {
            DepthOrigin::Surface => hasher.text("depth from the surface"),
            DepthOrigin::Contact => hasher,
        };
        let hasher = match self.kept_frames {
            Some(kept) => hasher.text("frames").text(&kept.to_string()),
            None => hasher,
        };
        let presses = self.presses.iter();
        presses
            .fold(hasher, |hasher, press| {
                let hasher = hasher.text(&press.id.to_string());
                hasher.whole(i64::from(press.frames))
            })
            .finish()
    }

    /// Channels of the truth of every sample, in order.
    pub fn truth_channels(&self) -> Channels {
        let channels = self.channels.iter().filter_map(|name| {
            let of_six = Channel::SIX
                .into_iter()
                .find(|channel| channel.name() == name);
            of_six.or_else(|| Channel::named(name, Unit::Millimetre).ok())
        });
        Channels::new(channels).unwrap_or_default()
    }

    /// Facts about the sensor that metrics read. The reference light scene is the calibration scene.
    pub fn sensor_facts(&self) -> SensorFacts {
        let depth_max_mm = self.limits.as_ref().map(|limits| limits.depth_max.0);
        let footprint = self
            .footprint
            .map(|footprint| match (footprint.outline(), depth_max_mm) {
                (Outline::Disc { radius }, Some(_)) => {
                    Footprint::disc(radius.to_millimetres(), depth_max_mm).unwrap_or(footprint)
                }
                (Outline::Rectangle { half_x, half_y }, Some(_)) => {
                    let [half_x, half_y] = [half_x, half_y].map(Nanometre::to_millimetres);
                    Footprint::rectangle(half_x, half_y, depth_max_mm).unwrap_or(footprint)
                }
                _ => footprint,
            });
        let default = SensorFacts::default();
        SensorFacts::default()
            .with_footprint(footprint)
            .with_opaque(self.opaque)
            .with_reference_scene(
                self.lights
                    .first()
                    .cloned()
                    .unwrap_or(default.reference_scene),
            )
            .with_frame_size(self.frame.map(|frame| [frame.width, frame.height]))
    }

    /// True if a metric or the score of contact shapes reads depths.
    pub(crate) fn reads_depth(&self) -> bool {
        let reads = |metric: &PlannedMetric| metric.channels.iter().any(|name| name == "Pz");
        self.metrics.iter().any(reads) || self.phases.contains(&PhaseKind::Shape)
    }

    /// Presses of one phase, in order.
    pub fn presses_of(&self, kind: PhaseKind) -> impl Iterator<Item = &PlannedPress> {
        let presses = self.presses.iter();
        presses.filter(move |press| press.phases.contains(&kind))
    }
}

/// Plans the studies of `scene` with the facts that `source` returns for each. Opens no device.
///
/// # Errors
/// [`SceneError`] with the line:
///
/// - a limit is loosened or missing, or a depth exceeds its limit;
/// - two statements contradict each other, or there are too many presses;
/// - a metric requested by name, or a score with a wanted width, applies to no study of the scene.
pub fn plan(
    scene: &Scene,
    mut source: impl FnMut(&Study) -> SourceInfo,
) -> Result<Vec<Plan>, SceneError> {
    let needs = MetricNeeds::catalogue();
    let plans: Vec<Plan> = scene
        .studies
        .iter()
        .map(|study| plan_study(scene, study, &source(study), &needs))
        .collect::<Result<_, _>>()?;
    refuse_the_impossible(scene, &plans)?;
    wanted_widths::check(scene, &plans)?;
    Ok(plans)
}

/// Plans one study for the metrics whose `needs` are given.
pub(crate) fn plan_study(
    scene: &Scene,
    study: &Study,
    source: &SourceInfo,
    needs: &[MetricNeeds],
) -> Result<Plan, SceneError> {
    let lights = study_facts::lights(scene, study, source)?;
    let units = study.units();
    let gather = Gather {
        scene,
        study,
        source,
        units: &units,
        lights: &lights,
    };
    let facts = gather.facts()?;
    let refused = |problem| scene.text.error(None, problem);
    let mut collected = check::is_drawable(&facts)
        .and_then(|()| refine(Collected::everything(needs, &facts), &facts))
        .map_err(refused)?;
    let wear = wear::put_before(&mut collected.presses, study, &facts).map_err(refused)?;
    let cost = cost::cost(&collected.presses, &facts);
    Ok(Plan {
        name: study.name.clone(),
        metrics: collected.metrics,
        phases: collected.phases,
        presses: collected.presses,
        fits: collected.fits,
        fields: collected.fields,
        channels: collected.channels,
        units: units.clone(),
        lights: lights.clone(),
        skipped: collected.skipped,
        limits: facts.limits,
        contact: scene.protocol.contact.clone(),
        footprint: facts.footprint,
        opaque: facts.opaque,
        frame: facts.frame,
        kept_frames: facts.kept_frames,
        wear,
        cost,
    })
}

/// Runs all passes in order.
fn refine(collected: Collected, facts: &StudyFacts<'_>) -> Result<Collected, SceneProblem> {
    let collected = resolve::pass(collected, facts);
    let collected = applicability::pass(collected, facts);
    let collected = phases::pass(collected, facts);
    let collected = merge::pass(collected, facts);
    let collected = fields::pass(collected, facts);
    check::pass(collected, facts)
}

/// Rejects a metric that the scene requests by name but no study can compute.
fn refuse_the_impossible(scene: &Scene, plans: &[Plan]) -> Result<(), SceneError> {
    for name in scene.metrics.want.iter().flatten() {
        let phase = phase_of_task(&name.value);
        if phase.is_none() && catalogue::find(&name.value).is_none() {
            continue;
        }
        let kept = |plan: &Plan| match &phase {
            Some(phase) => plan.phases.contains(phase),
            None => plan.metrics.iter().any(|metric| metric.id == name.value),
        };
        if plans.iter().any(kept) {
            continue;
        }
        if phase.is_some() && plans.iter().all(|plan| plan.limits.is_none()) {
            let problem = format!(
                "`{}` is a score of presses, and no study of the scene has a robot: `taceva evaluate DATASET --task NAME` scores a task of a recording",
                name.value
            );
            let problem = SceneProblem::Contradiction(problem);
            return Err(scene.text.error(name.at(), problem));
        }
        let subject = match phase {
            Some(phase) => Subject::Phase(phase),
            None => Subject::Metric(name.value.clone()),
        };
        let unread = match phase {
            // A robot presses only on a known surface.
            Some(_) => SkipReason::FactAbsent("footprint"),
            None => SkipReason::NothingReadsIt,
        };
        let skips = plans.iter().flat_map(|plan| &plan.skipped);
        let reason = skips
            .filter(|skip| skip.subject == subject)
            .map(|skip| skip.reason.clone())
            .next();
        let problem = SceneProblem::NeverApplies {
            metric: name.value.clone(),
            reason: reason.unwrap_or(PlanReason::Skip(unread)),
        };
        return Err(scene.text.error(name.at(), problem));
    }
    Ok(())
}
