//! Finds published numbers that are comparable with results of this program: same sensor, quantity, unit and definition.

use taceva_core::Unit;

use super::definition::of as definition_of;
use super::{Published, Sensor};

/// Definitions of this program that equal the definition of the same metric in the catalogue. Other definitions are not comparable.
///
/// Success rates are excluded, because they depend on the number of spacings in a scene, and fewer spacings are easier to predict. Robustness over
/// the surface is excluded, because its published definition is unclear: the table of the TacEva study differs from half the sum of the numbers in
/// its figure.
const SAME: [&str; 6] = [
    "mae/1",
    "r2/1",
    "smape/1",
    "sensitivity/1",
    "uniformity/2",
    "hysteresis/1",
];

impl Sensor {
    /// Published number of a metric and channel that is comparable with a value of `definition` and `unit`. `None` without a published number, or if
    /// its definition differs.
    pub fn published_alike(
        &self,
        metric: &str,
        channel: &str,
        definition: &str,
        unit: Unit,
    ) -> Option<&Published> {
        let ours = SAME.into_iter().find(|ours| *ours == definition)?;
        let words = definition_of(ours.split('/').next()?, "")?;
        self.results.iter().find(|result| {
            result.metric == metric
                && result.channel == channel
                && result.definition == words
                && result.unit == unit.symbol()
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue::find;

    #[test]
    fn a_published_value_of_another_definition_unit_or_channel_stands_beside_none_of_ours() {
        let gelsight = find("GelSight").expect("there");
        let of = |metric, channel, definition, unit| {
            let found = gelsight.published_alike(metric, channel, definition, unit);
            found.map(|published| published.value)
        };
        let mm = Unit::Millimetre;
        assert_eq!(of("mae", "Pz", "mae/1", mm), Some(0.0325));
        assert_eq!(of("mae", "Pz", "mae/2", mm), None, "a later definition");
        assert_eq!(of("mae", "Pz", "rmse/1", mm), None);
        assert_eq!(of("mae", "Pz", "mae/1", Unit::Newton), None);
        assert_eq!(
            of("mae", "Px", "mae/1", mm),
            None,
            "only the plane is published"
        );
        // The publication has 31 spacings; ours has as many as the scene.
        assert!(gelsight.result("sr", "line").is_some());
        assert_eq!(of("sr", "line", "sr/1", Unit::One), None);
        // The same name with another definition text is another definition.
        let mut other = gelsight.clone();
        for result in &mut other.results {
            result.definition.push_str(", over gel and glass");
        }
        let found = other.published_alike("mae", "Pz", "mae/1", mm);
        assert_eq!(found, None);
    }

    #[test]
    fn every_definition_of_the_list_is_published_of_a_sensor() {
        for ours in SAME {
            let metric = ours.split('/').next().unwrap_or_default();
            let words = definition_of(metric, "").expect("a definition");
            let all = crate::catalogue::all();
            let mut results = all.iter().flat_map(|sensor| &sensor.results);
            assert!(results.any(|result| result.definition == words), "{ours}");
        }
    }
}
