//! Best configuration for each channel: chosen on validation parts, scored on test parts.

mod table;

use taceva_report::{Cell, FormattedValue};

use crate::analysis::Group;

pub(crate) use table::table;

/// The configuration chosen for a channel of a recording.
#[derive(Clone, Debug)]
pub(crate) struct Choice {
    pub(crate) channel: String,
    /// Index of the chosen configuration among the groups.
    pub(crate) chosen: usize,
    /// Number of candidates for the choice.
    pub(crate) among: usize,
    /// Indices of all other configurations with results, including configurations that lack some seeds.
    pub(crate) others: Vec<usize>,
    rmse: f64,
    unit: String,
}

/// A configuration with a validation error, and its index among the groups.
struct Known<'a> {
    at: usize,
    rmse: f64,
    unit: &'a str,
    seeds: Vec<u64>,
}

/// Chooses a configuration for each recording, split and channel. Candidates have the same seeds as the configuration with the most results.
pub(crate) fn choices(groups: &[Group<'_>], channels: &[String]) -> Vec<Choice> {
    let mut choices = Vec::new();
    for place in taceva_core::distinct(groups.iter().map(|group| group.place())) {
        for channel in channels {
            let of_place = groups.iter().enumerate();
            let known: Vec<Known<'_>> = of_place
                .filter(|(_, group)| group.place() == place)
                .filter_map(|(at, group)| {
                    let (rmse, unit) = group.validation(channel)?;
                    Some(Known {
                        at,
                        rmse,
                        unit,
                        seeds: group.results.iter().map(|(seed, _)| *seed).collect(),
                    })
                })
                .collect();
            // If several have the most seeds, the first one in the file is used.
            let most = known.iter().rev().max_by_key(|of| of.seeds.len());
            let candidates = known
                .iter()
                .filter(|of| most.is_some_and(|most| of.seeds == most.seeds));
            let best = candidates
                .clone()
                .min_by(|left, right| left.rmse.total_cmp(&right.rmse));
            if let Some(best) = best {
                let others = known.iter().map(|of| of.at);
                choices.push(Choice {
                    channel: channel.clone(),
                    chosen: best.at,
                    among: candidates.count(),
                    others: others.filter(|at| *at != best.at).collect(),
                    rmse: best.rmse,
                    unit: best.unit.to_owned(),
                });
            }
        }
    }
    choices
}

/// Formats a number with about three significant digits.
pub(crate) fn number(value: f64) -> Cell {
    Cell::Number(FormattedValue::number(value, None).value)
}

/// Formats both ends of `interval`, the confidence interval of `value`.
pub(crate) fn ends(value: f64, interval: [f64; 2]) -> String {
    match FormattedValue::number(value, Some(interval)).interval {
        Some([low, high]) => format!("{low} … {high}"),
        None => String::new(),
    }
}
