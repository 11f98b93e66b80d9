//! Pass 1: finds the source of each channel and field. Removes channels and fields without a source, and records the missing device, model or field.

use taceva_core::{Field, SkipReason};

use super::collect::Collected;
use super::study_facts::{FieldSource, ModelChoice, OF_THE_PROTOCOL, StudyFacts, axis_of};
use crate::reason::{Cause, PlanReason, Subject};

/// Removes the channels and fields without a source.
pub(super) fn pass(mut collected: Collected, facts: &StudyFacts<'_>) -> Collected {
    for channel in collected.channels.clone() {
        if let Some(cause) = channel_cause(&channel, facts) {
            collected.channels.retain(|kept| *kept != channel);
            let reason = PlanReason::Unmeasured {
                channel: channel.clone(),
                cause,
            };
            collected.skip(Subject::Channel(channel), reason);
        }
    }
    for field in collected.fields.iter().collect::<Vec<Field>>() {
        if let Some(reason) = field_reason(field, &collected, facts) {
            collected.fields = collected.fields.without(field);
            collected.skip(Subject::Field(field), reason);
        }
    }
    collected
}

/// Missing device without which `channel` is not measured; `None` if the channel is measured.
fn channel_cause(channel: &str, facts: &StudyFacts<'_>) -> Option<Cause> {
    let FieldSource::Rig { robot, force, .. } = facts.field_source else {
        return None;
    };
    match (axis_of(channel), force) {
        (None, _) => (!robot).then_some(Cause::NoRobot),
        (Some(_), None) => Some(Cause::NoForce),
        (Some(axis), Some(axes)) => (!axes.contains(axis)).then_some(Cause::NoAxis),
    }
}

/// Reason why `field` has no source; `None` if the field has a source.
fn field_reason(field: Field, collected: &Collected, facts: &StudyFacts<'_>) -> Option<PlanReason> {
    let cause = match &facts.field_source {
        FieldSource::Rig { sensor, robot, .. } => match field {
            Field::Frame | Field::FrameDigest | Field::Intensity => {
                (!sensor).then_some(Cause::NoSensor)
            }
            Field::Truth => collected.channels.is_empty().then_some(Cause::NoRobot),
            Field::Prediction | Field::PredictedSpacing if !sensor => Some(Cause::NoSensor),
            Field::Scene => match facts.lights.len() {
                0 => Some(Cause::NoLighting),
                1 => Some(Cause::OneLight),
                _ => None,
            },
            Field::UnitId => (facts.units.len() < 2).then_some(Cause::OneUnit),
            field if OF_THE_PROTOCOL.contains(&field) => (!robot).then_some(Cause::NoRobot),
            _ => None,
        },
        FieldSource::Recording { fields, .. } => {
            let of_model = [Field::Prediction, Field::PredictedSpacing].contains(&field);
            let seen = if of_model { Field::Frame } else { field };
            // The reader computes digest and brightness from the frames.
            let read_off = [Field::FrameDigest, Field::Intensity].contains(&field);
            let there = fields.contains(seen) || (read_off && fields.contains(Field::Frame));
            if !there {
                return Some(PlanReason::Skip(SkipReason::FieldAbsent(seen)));
            }
            None
        }
    };
    let of_model = match (field, facts.model) {
        (Field::Prediction | Field::PredictedSpacing, ModelChoice::None) => Some(Cause::NoModel),
        (Field::PredictedSpacing, ModelChoice::Finished) => Some(Cause::NoEstimator),
        _ => None,
    };
    let cause = cause.or(of_model)?;
    Some(PlanReason::Unresolved { field, cause })
}
