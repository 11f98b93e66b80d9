//! Which published numbers are comparable with ours: those of the same sensor, quantity, unit and definition.

use taceva_core::Unit;

use super::{Published, Sensor};

/// Definitions of ours, and in which words the catalogue writes the same one. What is not in this list is another definition.
///
/// Success rates are not: ours are of as many spacings as a scene has, and the fewer there are the easier each is to predict. Nor is robustness over the
/// surface: the table of its publication is not half the sum of what its figure shows, so that nobody knows which of them the definition gave.
const SAME: [(&str, &str); 6] = [
    (
        "mae/1",
        "mean of |truth - prediction|; of a plane the mean of both axes",
    ),
    ("r2/1", "1 - residual over total sum of squares"),
    (
        "smape/1",
        "mean of |truth - prediction| over the mean of both magnitudes",
    ),
    ("sensitivity/1", "indentation over normal force"),
    (
        "uniformity/2",
        "1 / (1 + deviation / |mean|) over bins of the surface",
    ),
    ("hysteresis/1", "area between loading and unloading"),
];

impl Sensor {
    /// The published number of a metric and channel that may stand beside one of ours with `definition` and `unit`; `None` where what was
    /// published is defined otherwise, or nothing was.
    pub fn published_alike(
        &self,
        metric: &str,
        channel: &str,
        definition: &str,
        unit: Unit,
    ) -> Option<&Published> {
        let (_, words) = SAME.iter().find(|(ours, _)| *ours == definition)?;
        self.results.iter().find(|result| {
            result.metric == metric
                && result.channel == channel
                && result.definition == *words
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
        // Told among 31 spacings there, among as many as the scene has here.
        assert!(gelsight.result("sr", "line").is_some());
        assert_eq!(of("sr", "line", "sr/1", Unit::One), None);
        // The same name with other words is another definition.
        let mut other = gelsight.clone();
        for result in &mut other.results {
            result.definition.push_str(", over gel and glass");
        }
        let found = other.published_alike("mae", "Pz", "mae/1", mm);
        assert_eq!(found, None);
    }

    #[test]
    fn every_definition_of_the_list_is_published_of_a_sensor() {
        for (ours, words) in SAME {
            let all = crate::catalogue::all();
            let mut results = all.iter().flat_map(|sensor| &sensor.results);
            assert!(results.any(|result| result.definition == words), "{ours}");
        }
    }
}
