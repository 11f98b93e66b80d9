//! Definitions that a published number must have to share a metric name, and thus a table column, with results of this program.

/// Metrics, with their channel if the definition depends on it, and the definition of published numbers.
const DEFINITIONS: &[(&str, &str)] = &[
    (
        "mae",
        "mean of |truth - prediction|; for a plane, the mean over both axes",
    ),
    ("r2", "1 - residual over total sum of squares"),
    (
        "smape",
        "mean of |truth - prediction| over the mean of both magnitudes",
    ),
    (
        "sr",
        "share of presses whose spacing is predicted to within the tolerance",
    ),
    ("sensitivity", "indentation over normal force"),
    (
        "uniformity",
        "1 / (1 + deviation / |mean|) over bins of the surface",
    ),
    (
        "r_spatial.std_distance",
        "the standard deviation of bin means over distance",
    ),
    (
        "r_spatial.std_depth",
        "the standard deviation of bin means over depth",
    ),
    (
        "r_spatial",
        "half the sum of the standard deviations of bin means over distance and depth",
    ),
    (
        "r_light",
        "|change of light| / (|change of light| + |change of error|)",
    ),
    (
        "repeatability",
        "mean standard deviation of repeated predictions",
    ),
    ("hysteresis", "area between loading and unloading"),
    ("intrinsic frame_rate", "pictures a second"),
    ("intrinsic field_of_view", "area of the sensing surface"),
    ("intrinsic resolution", "pixels of a picture"),
    ("intrinsic thickness", "thickness of the sensor"),
];

/// Definition that a published number called `metric` must have; `None` for names that this program does not use.
pub(super) fn of(metric: &str, channel: &str) -> Option<&'static str> {
    let family = metric.split_once('.').map_or(metric, |(family, _)| family);
    // A variant with its own definition precedes its metric.
    let named = |name: &str| {
        name == metric || name == family || name.split_once(' ') == Some((family, channel))
    };
    let mut found = DEFINITIONS.iter().filter(|(name, _)| named(name));
    found.next().map(|(_, definition)| *definition)
}

/// True if a published number of `metric` may lack a definition. Only construction facts may, because no verdict uses them.
pub(super) fn may_be_unstated(metric: &str) -> bool {
    metric == "intrinsic"
}

/// True if results of this program have scores of `metric`.
pub(super) fn is_ours(metric: &str) -> bool {
    taceva_metrics::catalogue::find(metric).is_some()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_of_a_metric_have_its_definition_and_strangers_have_none() {
        assert_eq!(of("r_light.scene:S1", "Fz"), of("r_light", "Pz"));
        assert_eq!(of("intrinsic", "frame_rate"), Some("pictures a second"));
        assert_eq!(of("force_error", "F"), None);
        assert!(is_ours("mae") && !is_ours("force_error"));
    }
}
