//! Best configuration for each channel: chosen on validation parts, scored on test parts.

mod table;

use taceva_report::{Cell, FormattedValue};

use crate::analysis::Group;

pub(crate) use table::table;

/// The configuration chosen for a channel of a recording.
#[derive(Clone, Debug)]
pub(crate) struct Choice {
    pub(crate) channel: String,
    /// Positions among the groups: the chosen one, and all candidates.
    pub(crate) chosen: usize,
    pub(crate) others: Vec<usize>,
    rmse: f64,
    unit: String,
}

/// Choice for each recording, split and channel. Configurations without a result for every seed are skipped.
pub(crate) fn choices(groups: &[Group<'_>], channels: &[String]) -> Vec<Choice> {
    let mut places: Vec<(&str, Option<&str>)> = Vec::new();
    for group in groups {
        if !places.contains(&group.place()) {
            places.push(group.place());
        }
    }
    let mut choices = Vec::new();
    for place in places {
        for channel in channels {
            let of_place = groups.iter().enumerate();
            let known: Vec<(usize, f64, &str)> = of_place
                .filter(|(_, group)| group.place() == place && group.is_whole)
                .filter_map(|(at, group)| {
                    let (rmse, unit) = group.validation(channel)?;
                    Some((at, rmse, unit))
                })
                .collect();
            // Of equals, the first in the file.
            let best = known
                .iter()
                .min_by(|left, right| left.1.total_cmp(&right.1));
            if let Some(&(chosen, rmse, unit)) = best {
                let others = known.iter().map(|(at, ..)| *at);
                choices.push(Choice {
                    channel: channel.clone(),
                    chosen,
                    others: others.filter(|at| *at != chosen).collect(),
                    rmse,
                    unit: unit.to_owned(),
                });
            }
        }
    }
    choices
}

/// A number with about three significant digits.
pub(crate) fn number(value: f64) -> Cell {
    Cell::Number(FormattedValue::number(value, None).value)
}

/// Both ends of an interval of `value`.
pub(crate) fn ends(value: f64, interval: [f64; 2]) -> String {
    match FormattedValue::number(value, Some(interval)).interval {
        Some([low, high]) => format!("{low} … {high}"),
        None => String::new(),
    }
}
