//! Collects everything that a study could do: all metrics, presses, fields and models. Later passes remove from it and merge.

use taceva_core::{Field, FieldSet};
use taceva_metrics::{Fact, Metric, catalogue};

use super::study_facts::StudyFacts;
use crate::content_id::ContentId;
use crate::phase_kind::PhaseKind;
use crate::press::Press;
use crate::reason::{PlanReason, PlanSkip, Subject};

/// What a metric requires; the catalogue's words, and the part of the protocol that gives it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct MetricNeeds {
    pub(crate) id: String,
    pub(crate) fields: FieldSet,
    pub(crate) channels: Vec<String>,
    pub(crate) facts: &'static [Fact],
    pub(crate) phase: PhaseKind,
}

impl MetricNeeds {
    /// The needs of every metric of the catalogue.
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

/// The part of the protocol that a metric is computed on: that which varies what the metric reads.
fn phase_of(id: &str, fields: FieldSet) -> PhaseKind {
    let reads = |field| fields.contains(field);
    match id {
        // What it reads is what every accuracy reads; only its name says that it wants points no model has seen.
        "r_spatial" => PhaseKind::Spatial,
        // It looks at what is predicted where nothing is touched.
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

/// A metric that is computed, on which channels and on which presses.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlannedMetric {
    /// Its id in the catalogue.
    pub id: String,
    /// The channels of the truth that it is computed for, or from.
    pub channels: Vec<String>,
    /// The part of the protocol it is computed on; of a recording, all samples that carry what it reads.
    pub phase: PhaseKind,
    pub(crate) fields: FieldSet,
    pub(crate) required: Vec<String>,
    pub(crate) facts: &'static [Fact],
}

/// A press of the plan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlannedPress {
    /// Its name.
    pub id: ContentId,
    /// What is done.
    pub press: Press,
    /// The parts of the protocol that want it, in order.
    pub phases: Vec<PhaseKind>,
    /// Whether pictures are taken; without them no camera is asked.
    pub frames: bool,
}

/// A model that is fitted before metrics are computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fit {
    /// What it predicts: labels, or the spacing of a grating.
    pub field: Field,
    /// The part of the protocol it is fitted on.
    pub phase: PhaseKind,
}

/// What a plan holds so far: everything at first, less after each pass.
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

/// The channels that a rig could measure, in order.
pub(crate) const CHANNELS: [&str; 7] = ["Px", "Py", "Pz", "Fx", "Fy", "Fz", SURFACE];

/// The height at which a surface is first felt, along z of the sensor's frame, in mm.
pub(crate) const SURFACE: &str = "surface_z";

impl Collected {
    /// Everything: all metrics, all presses, all fields, all models.
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
            phases: match facts.phase_inputs {
                Some(_) => PhaseKind::ALL.to_vec(),
                None => Vec::new(),
            },
            presses: presses.collect(),
            fits: vec![
                Fit {
                    field: Field::Prediction,
                    phase: PhaseKind::Calibration,
                },
                Fit {
                    field: Field::PredictedSpacing,
                    phase: PhaseKind::Gratings,
                },
            ],
            // Nothing of the protocol presses a sensor of taxels yet.
            fields: Field::ALL
                .into_iter()
                .filter(|field| *field != Field::Signals)
                .collect(),
            channels,
            skipped: Vec::new(),
        }
    }

    /// Notes that `subject` was left out.
    pub(crate) fn skip(&mut self, subject: Subject, reason: PlanReason) {
        self.skipped.push(PlanSkip { subject, reason });
    }

    /// Why `subject` was left out.
    pub(crate) fn reason_of(&self, subject: &Subject) -> Option<&PlanReason> {
        self.skipped
            .iter()
            .find(|skip| skip.subject == *subject)
            .map(|skip| &skip.reason)
    }

    /// Whether a kept metric or model of the part `kind` looks at pictures.
    pub(crate) fn looks_at_pictures(&self, kind: PhaseKind) -> bool {
        // What is asked of a sensor at rest is how its pictures come.
        if kind == PhaseKind::Idle {
            return self.phases.contains(&kind);
        }
        let seen = |fields: FieldSet| PICTURES.into_iter().any(|field| fields.contains(field));
        let metric = |metric: &PlannedMetric| metric.phase == kind && seen(metric.fields);
        let fit = |fit: &Fit| fit.phase == kind;
        self.metrics.iter().any(metric) || self.fits.iter().any(fit)
    }
}

/// Fields that are read off pictures.
const PICTURES: [Field; 5] = [
    Field::Frame,
    Field::Prediction,
    Field::PredictedSpacing,
    Field::Intensity,
    Field::FrameDigest,
];
