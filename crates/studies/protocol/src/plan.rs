//! From what is wanted to what is done: pure passes that remove and merge, never add, and leave a reason each time.
//!
//! `collect → resolve → applicability → phases → merge → fields → check → cost`, one pass a file.

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

pub use collect::{Fit, PlannedMetric, PlannedPress};
pub use cost::Cost;

use taceva_core::{
    Channel, Channels, FieldSet, Footprint, FrameInfo, Nanometre, Outline, SkipReason, Unit,
};
use taceva_metrics::{SensorFacts, catalogue};

use crate::content_id::{ContentId, Hasher};
use crate::frame_size::FrameSize;
use crate::limits::RigLimits;
use crate::phase_kind::PhaseKind;
use crate::reason::{PlanReason, PlanSkip, Subject};
use crate::scene::{Contact, Scene, Study};
use crate::source::SourceInfo;
use crate::text::{SceneError, SceneProblem};
use collect::Collected;
pub(crate) use collect::{MetricNeeds, SURFACE};
use study_facts::{Gather, StudyFacts};

/// What is done for one sensor, what is not, and why. [`Display`](std::fmt::Display) explains it.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// The name of the study.
    pub name: String,
    /// The metrics that are computed.
    pub metrics: Vec<PlannedMetric>,
    /// The parts of the protocol that are visited, in order; none of a recording.
    pub phases: Vec<PhaseKind>,
    /// The presses, in the order in which they are made.
    pub presses: Vec<PlannedPress>,
    /// The models that are fitted.
    pub fits: Vec<Fit>,
    /// The fields of samples that something reads.
    pub fields: FieldSet,
    /// The channels of the truth.
    pub channels: Vec<String>,
    /// The units that are measured, in order.
    pub units: Vec<String>,
    /// The scenes of light that are visited, that of calibration first.
    pub lights: Vec<String>,
    /// What is left out, and why.
    pub skipped: Vec<PlanSkip>,
    /// The limits of every motion; absent where nothing moves.
    pub limits: Option<RigLimits>,
    /// How contact is searched for and held.
    pub contact: Contact,
    /// The outline of the surface that senses.
    pub footprint: Option<Footprint>,
    /// Whether ambient light cannot reach the camera, if it is known.
    pub opaque: Option<bool>,
    /// Size and format of the frames, if they are known.
    pub frame: Option<FrameInfo>,
    /// The size to which frames are reduced before they are kept, if they are.
    pub kept_frames: Option<FrameSize>,
    /// What it will cost.
    pub cost: Cost,
}

impl Plan {
    /// The name of what is acquired: a recording begun under another digest is not continued.
    ///
    /// Metrics are not in it, so that a finished acquisition serves a scene that wants fewer of them from the same presses.
    pub fn digest(&self) -> ContentId {
        let contact = &self.contact;
        let hasher = Hasher::new("taceva.plan/1")
            .number(contact.step_mm.value)
            .number(contact.threshold_n.value)
            .number(contact.settle_s.value)
            .number(contact.speed_mm_s.value)
            .count(self.presses.len());
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

    /// The channels of the truth of every sample, in order.
    pub fn truth_channels(&self) -> Channels {
        let channels = self.channels.iter().filter_map(|name| {
            let of_six = Channel::SIX
                .into_iter()
                .find(|channel| channel.name() == name);
            of_six.or_else(|| Channel::named(name, Unit::Millimetre).ok())
        });
        Channels::new(channels).unwrap_or_default()
    }

    /// The facts of the sensor that metrics read; the scene of light that others are compared with is that of calibration.
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

    /// The presses of one part of the protocol, in order.
    pub fn presses_of(&self, kind: PhaseKind) -> impl Iterator<Item = &PlannedPress> {
        let presses = self.presses.iter();
        presses.filter(move |press| press.phases.contains(&kind))
    }
}

/// The plans of the studies of `scene`, each fed from what `source` says of it. No device is opened.
///
/// # Errors
/// [`SceneError`] with the line: a limit that is loosened or absent, a depth beyond the limit, two statements that exclude each other,
/// more presses than any gel survives, or a metric asked for by its own name that applies to no study of the scene.
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
    Ok(plans)
}

/// The plan of one study, of metrics that need `needs`.
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
    let collected = check::is_drawable(&facts)
        .and_then(|()| refine(Collected::everything(needs, &facts), &facts))
        .map_err(|problem| scene.text.error(None, problem))?;
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
        cost,
    })
}

/// All passes, in order.
fn refine(collected: Collected, facts: &StudyFacts<'_>) -> Result<Collected, SceneProblem> {
    let collected = resolve::pass(collected, facts);
    let collected = applicability::pass(collected, facts);
    let collected = phases::pass(collected, facts);
    let collected = merge::pass(collected, facts);
    let collected = fields::pass(collected, facts);
    check::pass(collected, facts)
}

/// Refuses a metric that somebody named by itself and that no study can give.
fn refuse_the_impossible(scene: &Scene, plans: &[Plan]) -> Result<(), SceneError> {
    let named = scene.metrics.want.iter().flatten();
    for name in named.filter(|name| catalogue::find(&name.value).is_some()) {
        let kept = |plan: &Plan| plan.metrics.iter().any(|metric| metric.id == name.value);
        if plans.iter().any(kept) {
            continue;
        }
        let subject = Subject::Metric(name.value.clone());
        let skips = plans.iter().flat_map(|plan| &plan.skipped);
        let reason = skips
            .filter(|skip| skip.subject == subject)
            .map(|skip| skip.reason.clone())
            .next();
        let problem = SceneProblem::NeverApplies {
            metric: name.value.clone(),
            reason: reason.unwrap_or(PlanReason::Skip(SkipReason::NothingReadsIt)),
        };
        return Err(scene.text.error(name.at(), problem));
    }
    Ok(())
}
