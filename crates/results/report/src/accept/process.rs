//! Decision risks for units of one process.

use taceva_core::counted;
use taceva_metrology::conformity::{GlobalRisk, Limits, Measurement, Population};

use super::check::LimitCheck;
use super::interval::LimitInterval;
use super::limits_file::Limit;
use super::subject::{Subject, other_unit};
use crate::results::Study;

/// Decision risks of one limit, for units of one process.
#[derive(Clone, Debug, PartialEq)]
pub struct ProcessRisk {
    /// Number of units.
    pub units: usize,
    /// Shares of units with a wrong decision by the rule of the limit.
    pub risk: GlobalRisk,
    /// Acceptance limits that reach the target consumer's risk; `None` without a target, or if no guard band reaches it.
    pub acceptance: Option<Limits>,
}

/// Sets the risk of each check of `study` among `units` of the same process. `target` is the largest allowed share of units that are accepted
/// although they do not conform.
pub fn add_process_risks(
    checks: &mut [LimitCheck],
    study: &Study,
    units: &[Study],
    target: Option<f64>,
) {
    for check in checks {
        check.process = Some(risk(check, study, units, target));
    }
}

fn risk(
    check: &LimitCheck,
    study: &Study,
    units: &[Study],
    target: Option<f64>,
) -> Result<ProcessRisk, String> {
    let limit = &check.limit;
    let decision = check.decision.as_ref();
    let decision = decision.ok_or_else(|| "no value to decide on".to_owned())?;
    let accepted = decision.acceptance.as_ref();
    let accepted = accepted.ok_or_else(|| "the rule accepts no value".to_owned())?;
    let own = measured(study, limit)?;
    let each = units.iter().zip(1_usize..);
    let each = each.map(|(unit, number)| {
        measured(unit, limit).map_err(|reason| format!("unit {number}: {reason}"))
    });
    let known: Vec<Measurement> = each.collect::<Result<_, String>>()?;
    let population = Population::of(&known, &own).map_err(|error| error.to_string())?;
    let risk = population.risk(&decision.limits, accepted);
    let acceptance = match target {
        Some(target) => population
            .acceptance(&decision.limits, target)
            .map_err(|error| error.to_string())?,
        None => None,
    };
    Ok(ProcessRisk {
        units: units.len(),
        risk: risk.ok_or_else(|| "the limit is outside the range of the score".to_owned())?,
        acceptance,
    })
}

/// Score checked by `limit`, with its uncertainty.
fn measured(study: &Study, limit: &Limit) -> Result<Measurement, String> {
    let subject = Subject::find(study, limit)?;
    let score = subject.score()?;
    match other_unit(&score, limit) {
        Some(reason) => Err(reason),
        None => LimitInterval::of(study, &score, subject.variant).measured,
    }
}

/// Remarks on the risks of `checks`: meaning of the risks, and a reason for each missing risk.
pub(super) fn notes(checks: &[LimitCheck]) -> Vec<String> {
    let mut known = checks.iter().filter_map(|check| check.process.as_ref());
    let units = known.find_map(|process| process.as_ref().ok());
    let mut notes: Vec<String> = units
        .map(|process| {
            format!(
                "Risks among units like the {} given. Consumer's risk: share of units that are accepted and do not meet the limit. Producer's risk: share of units that meet it and are not accepted.",
                counted(process.units, "unit")
            )
        })
        .into_iter()
        .collect();
    for check in checks {
        if let Some(Err(reason)) = &check.process {
            let Limit {
                metric, channel, ..
            } = &check.limit;
            notes.push(format!("No risk of {metric} {channel}: {reason}."));
        }
    }
    notes
}
