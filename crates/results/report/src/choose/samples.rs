//! Sensors that meet the needs but have no rank, because their samples differ from the samples of other sensors.

use std::collections::BTreeSet;

use super::{Dropped, Need, Property};
use crate::catalogue::{Sensor, short};

/// Removes measured sensors from `remaining` and returns them, if a need ranks and the samples or definitions of `remaining` differ.
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
            let reason = format!(
                "its numbers are from the samples {}; numbers of other sensors are from other samples or definitions",
                short(samples)
            );
            apart.push(Dropped::new(sensor, reason));
            false
        }
    });
    apart
}

/// Samples and definitions of the values that rank `sensor`, as one text; `None` for values without a bundle.
fn basis(sensor: &Sensor, ranks: &[Property]) -> Option<String> {
    let samples = sensor.samples.clone()?;
    let results = ranks.iter().filter_map(|property| {
        let (metric, channel) = property.score()?;
        sensor.result(metric, channel)
    });
    Some(results.fold(samples, |basis, result| basis + "," + &result.definition))
}
