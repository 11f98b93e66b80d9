//! Detection of angles that are probably in radians, although their period is taken in degrees.

use taceva_core::Channel;

use super::whole_columns::WholeColumns;
use super::{ScorePlan, ScoreRequest};
use crate::error::EvaluateError;
use crate::note::Note;

/// Rounding error of values in radians with three decimals.
const ROUNDED_RAD: f64 = 1e-3;

/// Notes on angles without a stated unit whose values are all within one period in radians.
///
/// # Errors
/// [`EvaluateError`] if a table cannot be read.
pub(super) fn notes(
    request: &ScoreRequest,
    plan: &ScorePlan,
    tables: [&dyn WholeColumns; 2],
) -> Result<Vec<Note>, EvaluateError> {
    let mut notes = Vec::new();
    for (name, period) in &request.periods {
        let mut units = request.units.iter();
        if units.any(|(known, _)| known == name) || period.stated_unit(name).is_some() {
            continue;
        }
        let channel = plan.metrics.channels().by_name(name);
        let Some(degrees) = channel.and_then(Channel::period) else {
            continue;
        };
        let most = f64::from(degrees).to_radians() + ROUNDED_RAD;
        let mut are_within = true;
        for table in tables {
            if are_within {
                table.visit(name, &mut |cell| {
                    let value = cell.trim().parse::<f64>().ok();
                    let value = value.filter(|value| value.is_finite());
                    are_within = value.is_none_or(|value| value.abs() <= most);
                    are_within
                })?;
            }
        }
        if are_within {
            notes.push(Note::LikelyRadians {
                channel: name.clone(),
                period: degrees,
            });
        }
    }
    Ok(notes)
}
