//! Reasons why a plan skips or merges metrics, presses, models, fields and channels.

use std::fmt;

use taceva_core::{Field, SkipReason, by_count, counted};

use crate::phase_kind::PhaseKind;

/// Lines of a scene that state the sensing surface. One of them is sufficient.
const FOOTPRINT_LINE: &str = "`footprint = { shape = \"disc\", radius_mm = … }` or \
     `footprint = { shape = \"rect\", half_x_mm = …, half_y_mm = … }`";

/// Skipped item of a plan, with its reason.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlanSkip {
    /// Skipped item.
    pub subject: Subject,
    /// Reason why the item is skipped.
    pub reason: PlanReason,
}

/// Items of a plan that can be skipped.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Subject {
    /// A metric by its id, or some of its channels: `repeatability (Fx, Fy)`.
    Metric(String),
    /// A phase of the protocol, or some of its presses.
    Phase(PhaseKind),
    /// A model that predicts this field.
    Fit(Field),
    /// A field of samples.
    Field(Field),
    /// A channel of the truth.
    Channel(String),
}

impl Subject {
    /// Key of the subject in data, such as `metric:r_light`.
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

/// Reasons why a plan skips an item.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum PlanReason {
    /// A reason that also occurs in evaluations without a plan.
    Skip(SkipReason),
    /// A field has no source.
    Unresolved {
        /// Field without a source.
        field: Field,
        /// Missing source.
        cause: Cause,
    },
    /// No device of the rig measures a channel.
    Unmeasured {
        /// Channel that is not measured.
        channel: String,
        /// Missing device.
        cause: Cause,
    },
    /// The gel has no markers, so shear leaves no repeatable trace.
    NoMarkers,
    /// No planned metric needs the item.
    NoMetricNeeds,
    /// Presses are shared with another phase, and are made only once.
    VisitedBy {
        /// The other phase.
        phase: PhaseKind,
        /// Number of shared presses.
        presses: usize,
    },
}

/// Missing device or model that would supply a field or a channel.
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
    /// No model can be fitted. A model that was fitted earlier predicts only its own labels.
    NoEstimator,
    /// The light cannot be set.
    NoLighting,
    /// There is only one light scene, but the metric compares two.
    OneLight,
    /// There is only one unit, but the metric compares two.
    OneUnit,
}

impl Cause {
    /// All causes.
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
            Cause::NoAxis => {
                "a force transducer that measures it: the transducer of the scene does not"
            }
            Cause::NoModel => "a model: none chosen",
            Cause::NoEstimator => {
                "a model that can be fitted: a model file predicts its own labels only"
            }
            Cause::NoLighting => "light that can be set: the scene has none",
            Cause::OneLight => "two scenes of light: there is one",
            Cause::OneUnit => "two units of the sensor: the scene has one",
        })
    }
}

impl PlanReason {
    /// One reason of each kind, for tests of every message.
    pub fn all() -> Vec<PlanReason> {
        let skips = SkipReason::all().into_iter().map(PlanReason::Skip);
        let causes = Cause::ALL.into_iter().map(|cause| PlanReason::Unresolved {
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
            PlanReason::Skip(reason @ SkipReason::FactAbsent("footprint")) => {
                write!(
                    f,
                    "{reason}: write {FOOTPRINT_LINE} under [sensor] of the scene or of the rig file"
                )
            }
            PlanReason::Skip(reason) => write!(f, "{reason}"),
            PlanReason::Unresolved { field, cause } => write!(f, "needs `{field}` ← needs {cause}"),
            PlanReason::Unmeasured { channel, cause } => {
                write!(f, "needs `{channel}` ← needs {cause}")
            }
            PlanReason::NoMarkers => f.write_str(
                "shear repeatability applies only to gels with markers, and this gel has none",
            ),
            PlanReason::NoMetricNeeds => f.write_str("no kept metric needs it"),
            PlanReason::VisitedBy { phase, presses } => {
                write!(
                    f,
                    "{} {} shared with {phase}: made once",
                    counted(*presses, "press"),
                    by_count(*presses, "is", "are")
                )
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    /// Index of the kind of `reason`. A new kind without an index does not compile.
    fn place(reason: &PlanReason) -> usize {
        match reason {
            PlanReason::Skip(_) => 0,
            PlanReason::Unresolved { .. } => 1,
            PlanReason::Unmeasured { .. } => 2,
            PlanReason::NoMarkers => 3,
            PlanReason::NoMetricNeeds => 4,
            PlanReason::VisitedBy { .. } => 5,
        }
    }

    /// Index of a cause. A new cause without an index does not compile.
    fn place_of_cause(cause: Cause) -> usize {
        match cause {
            Cause::NoSensor => 0,
            Cause::NoRobot => 1,
            Cause::NoForce => 2,
            Cause::NoAxis => 3,
            Cause::NoModel => 4,
            Cause::NoEstimator => 5,
            Cause::NoLighting => 6,
            Cause::OneLight => 7,
            Cause::OneUnit => 8,
        }
    }

    #[test]
    fn every_kind_of_reason_and_every_cause_is_among_all() {
        let places: BTreeSet<usize> = PlanReason::all().iter().map(place).collect();
        assert_eq!(places, (0..6).collect());
        let causes: Vec<usize> = Cause::ALL.into_iter().map(place_of_cause).collect();
        assert_eq!(causes, (0..9).collect::<Vec<_>>());
        for cause in Cause::ALL {
            let field = Field::Prediction;
            assert!(PlanReason::all().contains(&PlanReason::Unresolved { field, cause }));
        }
    }

    /// Skip reasons are a non-exhaustive enum of another crate, so no match can cover them. The test parses the source of that crate.
    #[test]
    fn every_reason_that_a_stream_may_have_is_among_all() {
        let source = concat!(
            env!("CARGO_MANIFEST_DIR"),
            "/../../../taceva-core/src/skip_reason.rs"
        );
        let source = std::fs::read_to_string(source).expect("the crate beside this one");
        let (_, list) = source
            .split_once("pub enum SkipReason {")
            .expect("declared");
        let (list, _) = list.split_once("\n}").expect("ends");
        let declared: BTreeSet<&str> = list
            .lines()
            .map(str::trim)
            .filter(|line| line.starts_with(|first: char| first.is_ascii_uppercase()))
            .map(word)
            .collect();
        let debug: Vec<String> = SkipReason::all()
            .iter()
            .map(|reason| format!("{reason:?}"))
            .collect();
        let listed: BTreeSet<&str> = debug.iter().map(|reason| word(reason)).collect();
        assert_eq!(declared, listed);
        assert!(listed.len() >= 7, "{listed:?}");
    }

    /// Leading ASCII letters and digits of `text`.
    fn word(text: &str) -> &str {
        let end = text.find(|letter: char| !letter.is_ascii_alphanumeric());
        &text[..end.unwrap_or(text.len())]
    }
}
