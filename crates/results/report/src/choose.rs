//! Chooses a sensor for a task: hard needs exclude sensors, soft needs rank them, and each step shows its values.

mod evidence;
mod faults;
mod inexact;
mod need;
mod need_error;
mod other;
mod place;
mod property;
mod reasons;
mod render;
mod samples;
mod values;
mod words;

pub use evidence::{Evidence, choose_results};
pub use need::{Bound, Need};
pub use need_error::NeedError;
pub use property::Property;
pub use render::CHOICE_SCHEMA;

use std::collections::BTreeMap;

use serde::Serialize;
use taceva_metrics::Standing;

use crate::catalogue::{Kind, Sensor};

/// Result of a choice: shortlist, other sensors, and the values used.
#[derive(Clone, Debug, Default)]
pub struct Choice {
    /// Sensors that meet the needs, best first.
    pub ranked: Vec<Candidate>,
    /// Sensors with an unknown value for a hard need, ordered by name.
    pub open: Vec<Dropped>,
    /// Sensors that do not meet a hard need.
    pub dropped: Vec<Dropped>,
    /// Sensors without a rank, because a value that a need uses is excluded from verdicts.
    pub barred: Vec<Dropped>,
    /// Sensors that meet the hard needs but have no rank, because a value for a ranking need is unknown.
    pub unplaced: Vec<Dropped>,
    /// Sensors that meet the hard needs but have no rank, because samples, test parts, definitions or faults differ between sensors.
    pub apart: Vec<Dropped>,
    /// Values of the sensors without a rank, in the order of the sensors.
    pub others: Vec<Candidate>,
    /// Sensors without any value that the needs use, but with a value by another definition, named in the reason.
    pub other_definitions: Vec<Dropped>,
    /// Sensors without any value that the needs use, by any definition.
    pub unknown: Vec<String>,
    /// Number of sensors without an exact price in a currency of the needs, by the currency of their exact prices.
    pub other_currencies: BTreeMap<String, usize>,
    /// Significant differences between ranked sensors; `None` for a choice by [`choose`], which tests nothing.
    pub evidence: Option<Vec<Evidence>>,
    /// Remark that ranking errors are not comparable, if the label spreads of the sensors differ.
    pub spread: Option<String>,
    /// True if samples behind the values are simulated.
    pub simulated: bool,
    /// Sensors whose greatest depth or force a need uses. These limits come from the catalogue, not from results.
    pub limits_of_catalogue: Vec<String>,
}

/// A sensor that meets every hard need, as far as known.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// Name of the sensor.
    pub name: String,
    /// Score for the rank, 0 to 1: mean over soft needs of the ratio to the best sensor; 1 without soft needs.
    pub share: f64,
    /// Values of the sensor that the needs use.
    pub steps: Vec<Step>,
}

/// One value of a sensor for one need.
#[derive(Clone, Debug)]
pub struct Step {
    /// Text of the need.
    pub need: String,
    /// Property that the need uses: `MAE Fxy`.
    pub property: Property,
    /// Value that the need uses; `None` if unknown.
    pub value: Option<f64>,
    /// Inexact value that decides a hard need, such as `> 1000 USD`; `None` if an exact value is known or if the need stays open.
    pub inexact: Option<String>,
    /// 95 % confidence interval; `None` if unknown.
    pub interval: Option<[f64; 2]>,
    /// Standing of the value in verdicts.
    pub standing: Standing,
    /// Ratio of the value to the best value of the remaining sensors; `None` for hard needs and unknown values.
    pub share: Option<f64>,
    /// Context of the value: the measured part of a size, the goods of a price, the greatest tested depth and force of a published error. `None`
    /// for other properties.
    pub part: Option<String>,
    /// True for a hard need, which does not affect the rank.
    pub is_bound: bool,
    /// True if the value does not meet a hard need.
    pub is_unmet: bool,
    /// True if an end of the interval does not meet the bound of a hard need.
    pub is_unsure: bool,
}

/// A sensor without a rank.
#[derive(Clone, Debug, Serialize)]
pub struct Dropped {
    /// Name of the sensor.
    pub name: String,
    /// Reason as text: every unmet hard need, then every need with an unknown value; or the reason why verdicts exclude a value.
    pub reason: String,
}

impl Dropped {
    fn new(sensor: &Sensor, reason: String) -> Dropped {
        Dropped {
            name: sensor.name.clone(),
            reason,
        }
    }
}

/// Chooses among `sensors` for `needs`.
///
/// A hard need excludes every sensor whose value does not meet it, and sets apart sensors whose value is unknown. A sensor with a score that is
/// excluded from verdicts has no rank. Studies of sensors are skipped. A soft need scores each remaining sensor by its mean ratio to the best
/// sensor, over the values of the need. The rank follows the mean over soft needs. A sensor that lacks a value has no rank. Sensors with equal
/// scores share a rank and are ordered by name.
///
/// ```
/// use taceva_report::{Need, catalogue, choose};
/// let choice = choose(&catalogue::all(), &Need::parse("accurate shear")?);
/// assert_eq!(choice.ranked[0].name, "ViTacTip");
/// # Ok::<(), taceva_report::NeedError>(())
/// ```
pub fn choose(sensors: &[Sensor], needs: &[Need]) -> Choice {
    choose_together(sensors, needs, |_| Vec::new())
}

/// Same as [`choose`]. From the sensors that meet all hard needs, `take_apart` removes those that cannot be ranked together.
fn choose_together(
    sensors: &[Sensor],
    needs: &[Need],
    take_apart: impl FnOnce(&mut Vec<&Sensor>) -> Vec<Dropped>,
) -> Choice {
    let mut choice = Choice::default();
    let mut remaining: Vec<&Sensor> = Vec::new();
    for sensor in sensors.iter().filter(|entry| entry.kind == Kind::Sensor) {
        let mut properties = needs.iter().flat_map(Need::properties);
        let is_known = properties.any(|property| property.of(sensor).is_some());
        if !is_known && !reasons::is_decided(sensor, needs) {
            match by_other_definition(sensor, needs) {
                Some(reason) => choice.other_definitions.push(Dropped::new(sensor, reason)),
                None => choice.unknown.push(sensor.name.clone()),
            }
            continue;
        }
        let unmet = reasons::unmet(sensor, needs);
        let unproven = reasons::unproven(sensor, needs);
        if let Some(reason) = reasons::barred(sensor, needs) {
            choice.barred.push(Dropped::new(sensor, reason));
        } else if !unmet.is_empty() {
            let all = [unmet, unproven].concat();
            choice.dropped.push(Dropped::new(sensor, all.join("; ")));
        } else if !unproven.is_empty() {
            choice.open.push(Dropped::new(sensor, unproven.join("; ")));
        } else if let Some(reason) = reasons::unplaced(sensor, needs) {
            choice.unplaced.push(Dropped::new(sensor, reason));
        } else {
            remaining.push(sensor);
        }
    }
    choice.other_currencies = other_currencies(sensors, needs);
    choice.apart = samples::take_apart(&mut remaining, needs);
    choice
        .apart
        .extend(faults::take_apart(&mut remaining, needs));
    choice.apart.extend(take_apart(&mut remaining));
    choice.ranked = remaining
        .iter()
        .map(|sensor| candidate(sensor, &remaining, needs))
        .collect();
    let by_share = |left: &Candidate, right: &Candidate| right.share.total_cmp(&left.share);
    choice.ranked.sort_by(by_share);
    let others = sensors.iter().filter(|sensor| choice.sets_aside(sensor));
    choice.others = others
        .map(|sensor| candidate(sensor, &remaining, needs))
        .collect();
    choice
}

/// Number of sensors without an exact price in a currency of `needs`, by the currency of their exact prices. Empty if no need bounds a price.
fn other_currencies(sensors: &[Sensor], needs: &[Need]) -> BTreeMap<String, usize> {
    let asked = needs.iter().flat_map(Need::properties);
    let asked: Vec<&str> = asked.filter_map(Property::currency).collect();
    let mut counts: BTreeMap<String, usize> = BTreeMap::new();
    let is_unpriced = |sensor: &&Sensor| {
        let mut asked = asked.iter();
        asked.all(|currency| sensor.price_in(currency).is_none())
    };
    let sensors = sensors.iter().filter(|entry| entry.kind == Kind::Sensor);
    let sensors = sensors.filter(|_| !asked.is_empty());
    for sensor in sensors.filter(is_unpriced) {
        let prices = sensor.prices.iter().filter(|price| price.is_comparable());
        for currency in taceva_core::distinct(prices.map(|price| price.currency.clone())) {
            *counts.entry(currency).or_default() += 1;
        }
    }
    counts
}

/// Values of `sensor` for the properties in `needs`, but by other definitions; each property once.
fn by_other_definition(sensor: &Sensor, needs: &[Need]) -> Option<String> {
    let properties = needs.iter().flat_map(Need::properties);
    let found = taceva_core::distinct(properties.filter_map(|property| {
        let other = property.other(sensor)?;
        Some(format!("no {property}; known: {other}"))
    }));
    (!found.is_empty()).then(|| found.join("; "))
}

fn candidate(sensor: &Sensor, remaining: &[&Sensor], needs: &[Need]) -> Candidate {
    let (mut steps, mut shares) = (Vec::new(), Vec::new());
    for need in needs {
        for bound in &need.bounds {
            steps.push(Step {
                need: need.words.clone(),
                property: bound.property,
                value: bound.property.of(sensor),
                inexact: inexact::decided(sensor, bound).map(|decided| decided.shown),
                interval: bound.property.interval(sensor),
                standing: bound.property.standing(sensor),
                share: None,
                part: bound.property.part(sensor),
                is_bound: true,
                is_unmet: reasons::is_unmet(sensor, bound),
                is_unsure: bound
                    .property
                    .interval(sensor)
                    .is_some_and(|ends| !ends.into_iter().all(|end| bound.holds(end))),
            });
        }
        let mut of_need = Vec::new();
        for property in &need.ranks {
            let value = property.of(sensor);
            let share = value.and_then(|value| property.share(value, remaining));
            of_need.extend(share);
            steps.push(Step {
                need: need.words.clone(),
                property: *property,
                value,
                inexact: None,
                interval: property.interval(sensor),
                standing: property.standing(sensor),
                share,
                part: property.part(sensor),
                is_bound: false,
                is_unmet: false,
                is_unsure: false,
            });
        }
        shares.extend(mean(&of_need));
    }
    Candidate {
        name: sensor.name.clone(),
        share: mean(&shares).unwrap_or(1.0),
        steps,
    }
}

fn mean(values: &[f64]) -> Option<f64> {
    let count = values.iter().fold(0.0, |count, _| count + 1.0);
    (count > 0.0).then(|| values.iter().sum::<f64>() / count)
}

#[cfg(test)]
mod tests;
