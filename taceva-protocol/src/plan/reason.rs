//! Why a plan leaves something out or joins it with something else.

use std::fmt;

use taceva_core::{Field, SkipReason};

use crate::phase::PhaseKind;

/// Something that a plan does not do, and why.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlanSkip {
    /// What.
    pub subject: Subject,
    /// Why.
    pub reason: PlanReason,
}

/// What a plan can leave out.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Subject {
    /// A metric by its id, or some of its channels: `repeatability (Fx, Fy)`.
    Metric(String),
    /// A part of the protocol, or some of its presses.
    Phase(PhaseKind),
    /// A model that predicts this field.
    Fit(Field),
    /// A field of samples.
    Field(Field),
    /// A channel of the truth.
    Channel(String),
}

impl Subject {
    /// How it is written in data: `metric:r_light`.
    pub fn key(&self) -> String {
        match self {
            Subject::Metric(id) => format!("metric:{id}"),
            Subject::Phase(kind) => format!("phase:{kind}"),
            Subject::Fit(field) => format!("fit:{field}"),
            Subject::Field(field) => format!("field:{field}"),
            Subject::Channel(name) => format!("channel:{name}"),
        }
    }
}

impl fmt::Display for Subject {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Subject::Metric(id) => write!(f, "metric  {id}"),
            Subject::Phase(kind) => write!(f, "phase   {kind}"),
            Subject::Fit(field) => write!(f, "model   {field}"),
            Subject::Field(field) => write!(f, "field   {field}"),
            Subject::Channel(name) => write!(f, "channel {name}"),
        }
    }
}

/// Why a plan leaves something out.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum PlanReason {
    /// A reason that any stream of samples may have.
    Skip(SkipReason),
    /// A field that nobody supplies, and what is missing in the chain that would.
    Unsupplied {
        /// The field.
        field: Field,
        /// What is missing.
        cause: Cause,
    },
    /// A channel that no device of the rig measures.
    Unmeasured {
        /// The channel.
        channel: String,
        /// What is missing.
        cause: Cause,
    },
    /// The gel has no markers: shear leaves no trace that repeats.
    NoMarkers,
    /// No metric that is computed needs it.
    NoMetricNeeds,
    /// Presses that another phase makes too: they are visited once.
    VisitedBy {
        /// The other phase.
        phase: PhaseKind,
        /// How many presses are shared.
        presses: usize,
    },
}

/// What is missing for somebody to supply a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Cause {
    /// No sensor.
    NoSensor,
    /// No robot.
    NoRobot,
    /// No force transducer.
    NoForce,
    /// The force transducer does not measure this axis.
    NoAxis,
    /// No model.
    NoModel,
    /// No model that can be fitted: a finished one predicts its own labels only.
    NoEstimator,
    /// The light cannot be set.
    NoLighting,
    /// One scene of light, where two are compared.
    OneLight,
    /// One unit, where two are compared.
    OneUnit,
}

impl Cause {
    /// Every cause.
    pub const ALL: [Cause; 9] = [
        Cause::NoSensor,
        Cause::NoRobot,
        Cause::NoForce,
        Cause::NoAxis,
        Cause::NoModel,
        Cause::NoEstimator,
        Cause::NoLighting,
        Cause::OneLight,
        Cause::OneUnit,
    ];
}

impl fmt::Display for Cause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Cause::NoSensor => "a sensor: the scene has none",
            Cause::NoRobot => "a robot: the scene has none",
            Cause::NoForce => "a force transducer: the scene has none",
            Cause::NoAxis => "a force transducer that measures it: this one does not",
            Cause::NoModel => "a model: none chosen",
            Cause::NoEstimator => {
                "a model that is fitted: a finished one predicts its own labels only"
            }
            Cause::NoLighting => "light that can be set: the scene has none",
            Cause::OneLight => "two scenes of light: there is one",
            Cause::OneUnit => "two units of the sensor: the scene has one",
        })
    }
}

impl PlanReason {
    /// One of each kind, so that tests can visit every line.
    pub fn all() -> Vec<PlanReason> {
        let skips = SkipReason::all().into_iter().map(PlanReason::Skip);
        let causes = Cause::ALL.into_iter().map(|cause| PlanReason::Unsupplied {
            field: Field::Prediction,
            cause,
        });
        skips
            .chain(causes)
            .chain([
                PlanReason::Unmeasured {
                    channel: "Fx".to_owned(),
                    cause: Cause::NoAxis,
                },
                PlanReason::NoMarkers,
                PlanReason::NoMetricNeeds,
                PlanReason::VisitedBy {
                    phase: PhaseKind::Spatial,
                    presses: 100,
                },
            ])
            .collect()
    }
}

impl fmt::Display for PlanReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            PlanReason::Skip(reason) => write!(f, "{reason}"),
            PlanReason::Unsupplied { field, cause } => write!(f, "needs `{field}` ← needs {cause}"),
            PlanReason::Unmeasured { channel, cause } => {
                write!(f, "needs `{channel}` ← needs {cause}")
            }
            PlanReason::NoMarkers => {
                f.write_str("the gel has no markers: shear leaves no trace that could repeat")
            }
            PlanReason::NoMetricNeeds => f.write_str("no kept metric needs it"),
            PlanReason::VisitedBy { phase, presses } => {
                write!(f, "{presses} presses are those of {phase}: visited once")
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_reason_has_its_golden_line() {
        let lines: Vec<String> = PlanReason::all().iter().map(ToString::to_string).collect();
        let golden = include_str!("../../tests/golden/reasons.txt");
        assert_eq!(lines.join("\n"), golden.trim_end());
    }
}
