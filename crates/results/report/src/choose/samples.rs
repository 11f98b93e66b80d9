//! Candidates that were measured on other samples than the rest: they meet needs, and no need ranks them.

use std::collections::BTreeSet;

use super::{Dropped, Need, Property};
use crate::catalogue::{Sensor, short};

/// Takes the measured candidates out of `remaining` if a need ranks and not all of them rest on the same samples and definitions.
pub(super) fn take_apart(remaining: &mut Vec<&Sensor>, needs: &[Need]) -> Vec<Dropped> {
    let ranks: Vec<Property> = needs.iter().flat_map(|need| need.ranks.clone()).collect();
    let bases = remaining.iter().map(|sensor| basis(sensor, &ranks));
    let bases: BTreeSet<Option<String>> = bases.collect();
    if ranks.is_empty() || bases.len() < 2 {
        return Vec::new();
    }
    let mut apart = Vec::new();
    remaining.retain(|sensor| match &sensor.samples {
        None => true,
        Some(samples) => {
            apart.push(Dropped {
                name: sensor.name.clone(),
                reason: format!(
                    "its numbers are of the samples {}, and others rest on other samples or definitions",
                    short(samples)
                ),
            });
            false
        }
    });
    apart
}

/// Samples and definitions behind the numbers that rank `sensor`; `None` for numbers that no bundle holds.
fn basis(sensor: &Sensor, ranks: &[Property]) -> Option<String> {
    let samples = sensor.samples.clone()?;
    let results = ranks.iter().filter_map(|property| {
        let (metric, channel) = property.score()?;
        sensor.result(metric, channel)
    });
    Some(results.fold(samples, |basis, result| basis + "," + &result.definition))
}
