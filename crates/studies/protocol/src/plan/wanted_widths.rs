//! Check of wanted widths: each must belong to a score that a study of the scene computes.

use taceva_core::SkipReason;
use taceva_metrics::plane_axes;

use super::{Plan, PlannedMetric};
use crate::reason::{PlanReason, Subject};
use crate::scene::{Scene, WantedWidth};
use crate::text::{SceneError, SceneProblem};

/// Rejects a wanted width whose score no plan keeps, with the line and the reason.
pub(super) fn check(scene: &Scene, plans: &[Plan]) -> Result<(), SceneError> {
    for (score, written) in &scene.metrics.want_width {
        let Some(wanted) = WantedWidth::parse(score, &written.value) else {
            continue;
        };
        if plans.iter().any(|plan| plan.scores(&wanted)) {
            continue;
        }
        let axes = plane_axes(&wanted.channel);
        let is_cause = |subject: &Subject| match subject {
            Subject::Metric(id) => *id == wanted.metric,
            Subject::Channel(name) => match axes {
                Some(axes) => axes.contains(&name.as_str()),
                None => *name == wanted.channel,
            },
            _ => false,
        };
        let mut skips = plans.iter().flat_map(|plan| &plan.skipped);
        let reason = skips.find(|skip| is_cause(&skip.subject));
        let absent = PlanReason::Skip(SkipReason::ChannelAbsent(wanted.channel));
        let problem = SceneProblem::NeverApplies {
            metric: score.clone(),
            reason: reason.map_or(absent, |skip| skip.reason.clone()),
        };
        return Err(scene.text.error(written.at(), problem));
    }
    Ok(())
}

impl Plan {
    /// True if the plan keeps the score of `wanted`; for a plane such as `Pxy`, the scores of both channels.
    pub fn scores(&self, wanted: &WantedWidth) -> bool {
        let axes = plane_axes(&wanted.channel);
        let has = |metric: &PlannedMetric, name: &str| {
            metric.channels.iter().any(|channel| channel == name)
        };
        self.metrics.iter().any(|metric| {
            metric.id == wanted.metric
                && match axes {
                    Some(axes) => axes.iter().all(|axis| has(metric, axis)),
                    None => has(metric, &wanted.channel),
                }
        })
    }
}
