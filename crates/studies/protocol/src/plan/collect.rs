//! Collects all metrics, presses, fields and models of a study. Later passes remove or merge some of them.

use taceva_core::{Field, FieldSet};
use taceva_metrics::{Fact, Metric, catalogue};

use super::study_facts::StudyFacts;
use crate::content_id::ContentId;
use crate::phase_kind::PhaseKind;
use crate::press::Press;
use crate::reason::{PlanReason, PlanSkip, Subject};

/// Requirements of a metric in the catalogue, and the phase that fulfils them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct MetricNeeds {
    pub(crate) id: String,
    pub(crate) fields: FieldSet,
    pub(crate) channels: Vec<String>,
    pub(crate) facts: &'static [Fact],
    pub(crate) phase: PhaseKind,
}

impl MetricNeeds {
    /// Needs of every metric in the catalogue.
    pub(crate) fn catalogue() -> Vec<MetricNeeds> {
        catalogue::ALL
            .iter()
            .map(|metric| MetricNeeds::of(metric))
            .collect()
    }

    fn of(metric: &Metric) -> MetricNeeds {
        let needs = &metric.needs;
        MetricNeeds {
            facts: metric.facts,
            ..MetricNeeds::new(metric.id, needs.fields, needs.channels)
        }
    }

    pub(crate) fn new(id: &str, fields: FieldSet, channels: &[&str]) -> MetricNeeds {
        MetricNeeds {
            id: id.to_owned(),
            fields,
            channels: channels.iter().map(|&name| name.to_owned()).collect(),
            facts: &[],
            phase: phase_of(id, fields),
        }
    }
}

/// Phase for a metric: the phase that varies the fields that the metric reads.
fn phase_of(id: &str, fields: FieldSet) -> PhaseKind {
    let reads = |field| fields.contains(field);
    match id {
        // Reads the same fields as every accuracy metric; only its name marks it as a metric of held-out points.
        "r_spatial" => PhaseKind::Spatial,
        // Both read predictions without contact.
        "noise_equivalent_force" | "zero_error" => PhaseKind::Idle,
        _ if reads(Field::Spacing) || reads(Field::Kind) => PhaseKind::Gratings,
        _ if reads(Field::Scene) || reads(Field::Intensity) => PhaseKind::LightSweep,
        _ if reads(Field::UnitId) => PhaseKind::SurfaceMap,
        _ if reads(Field::Phase) => PhaseKind::LoadUnload,
        _ if reads(Field::Repeat) || reads(Field::DepthStep) => PhaseKind::Repeatability,
        _ if reads(Field::Stamp) && reads(Field::Truth) => PhaseKind::Repeatability,
        _ if reads(Field::Stamp) || !(reads(Field::Truth) || reads(Field::Prediction)) => {
            PhaseKind::Idle
        }
        _ => PhaseKind::Calibration,
    }
}

/// A metric to compute, with its channels and its phase.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlannedMetric {
    /// Id in the catalogue of metrics.
    pub id: String,
    /// Channels of the truth for which, or from which, the metric is computed.
    pub channels: Vec<String>,
    /// Phase whose presses the metric uses. For a recording, the metric uses all samples with the fields that it reads.
    pub phase: PhaseKind,
    pub(crate) fields: FieldSet,
    pub(crate) required: Vec<String>,
    pub(crate) facts: &'static [Fact],
}

/// A press of the plan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlannedPress {
    /// Digest of the press.
    pub id: ContentId,
    /// Place, specimen and motion of the press.
    pub press: Press,
    /// Phases that need the press, in order.
    pub phases: Vec<PhaseKind>,
    /// True if frames are captured.
    pub frames: bool,
}

/// A model to fit before metrics are computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fit {
    /// Predicted field: labels, or the spacing of a grating.
    pub field: Field,
    /// Phase whose presses the model is fitted on.
    pub phase: PhaseKind,
    /// Number of folds into which contact points are divided. A separate model predicts each fold. `None` for one model.
    pub folds: Option<u32>,
}

/// A plan in progress. The plan is complete at first, and becomes smaller with each pass.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Collected {
    pub(crate) metrics: Vec<PlannedMetric>,
    pub(crate) phases: Vec<PhaseKind>,
    pub(crate) presses: Vec<PlannedPress>,
    pub(crate) fits: Vec<Fit>,
    pub(crate) fields: FieldSet,
    pub(crate) channels: Vec<String>,
    pub(crate) skipped: Vec<PlanSkip>,
}

/// Channels that a rig could measure, in order.
pub(crate) const CHANNELS: [&str; 7] = ["Px", "Py", "Pz", "Fx", "Fy", "Fz", SURFACE];

/// Channel of the height of first contact, along z of the sensor frame, in mm.
pub(crate) const SURFACE: &str = "surface_z";

impl Collected {
    /// Collects all metrics, presses, fields and models of a study.
    pub(crate) fn everything(metrics: &[MetricNeeds], facts: &StudyFacts<'_>) -> Collected {
        let channels = facts.all_channels();
        let metrics = metrics.iter().map(|needs| PlannedMetric {
            id: needs.id.clone(),
            channels: facts.channels_on(needs.phase),
            phase: needs.phase,
            fields: needs.fields,
            required: needs.channels.clone(),
            facts: needs.facts,
        });
        let presses = facts.phase_inputs.iter().flat_map(|phase_inputs| {
            PhaseKind::ALL.into_iter().flat_map(|kind| {
                let presses = phase_inputs.presses(kind).into_iter();
                presses.map(move |press| PlannedPress {
                    id: press.id(),
                    press,
                    phases: vec![kind],
                    frames: true,
                })
            })
        });
        Collected {
            metrics: metrics.collect(),
            phases: match &facts.phase_inputs {
                Some(inputs) => PhaseKind::ALL
                    .into_iter()
                    .filter(|kind| !kind.is_of_task() || inputs.count(*kind) > 0)
                    .collect(),
                None => Vec::new(),
            },
            presses: presses.collect(),
            fits: vec![
                Fit {
                    field: Field::Prediction,
                    phase: PhaseKind::Calibration,
                    folds: facts.folds,
                },
                Fit {
                    field: Field::PredictedSpacing,
                    phase: PhaseKind::Gratings,
                    folds: None,
                },
            ],
            // The protocol cannot press a taxel sensor yet.
            fields: Field::ALL
                .into_iter()
                .filter(|field| *field != Field::Signals)
                .collect(),
            channels,
            skipped: Vec::new(),
        }
    }

    /// Records that `subject` is skipped for `reason`.
    pub(crate) fn skip(&mut self, subject: Subject, reason: PlanReason) {
        self.skipped.push(PlanSkip { subject, reason });
    }

    /// Reason why `subject` was skipped; `None` if it is in the plan.
    pub(crate) fn reason_of(&self, subject: &Subject) -> Option<&PlanReason> {
        self.skipped
            .iter()
            .find(|skip| skip.subject == *subject)
            .map(|skip| &skip.reason)
    }

    /// True if phase `kind` needs frames: for its metrics, its model, its task or the timing of frames.
    pub(crate) fn looks_at_pictures(&self, kind: PhaseKind) -> bool {
        // The idle phase measures the timing of frames, and tasks are predicted from frames.
        if kind == PhaseKind::Idle || kind.is_of_task() {
            return self.phases.contains(&kind);
        }
        let seen = |fields: FieldSet| PICTURES.into_iter().any(|field| fields.contains(field));
        let metric = |metric: &PlannedMetric| metric.phase == kind && seen(metric.fields);
        let fit = |fit: &Fit| fit.phase == kind;
        self.metrics.iter().any(metric) || self.fits.iter().any(fit)
    }
}

/// Fields derived from frames.
const PICTURES: [Field; 5] = [
    Field::Frame,
    Field::Prediction,
    Field::PredictedSpacing,
    Field::Intensity,
    Field::FrameDigest,
];
