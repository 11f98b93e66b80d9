//! Which values of a metric or of a variant are good, by its name.

use super::find;
use crate::score::better::Better;

/// Variants whose direction is not that of their metric.
const OF_VARIANTS: [(&str, Better); 8] = [
    ("skill.constant", Better::Described),
    ("sr.of_constant", Better::Described),
    ("r_spatial.noise_floor", Better::Described),
    ("linearity.slope", Better::Described),
    ("linearity.offset", Better::NearZero),
    ("uniformity.mean", Better::Described),
    ("uniformity.deviation", Better::Lower),
    ("hysteresis.signed_area", Better::NearZero),
];

impl Better {
    /// The direction of the metric or variant called `name`: `mae`, `hysteresis.ratio`; `None` for a name that is not in the catalogue.
    ///
    /// ```
    /// use taceva_metrics::Better;
    /// assert_eq!(Better::of("r2"), Some(Better::Higher));
    /// assert_eq!(Better::of("linearity.offset"), Some(Better::NearZero));
    /// assert_eq!(Better::of("beauty"), None);
    /// ```
    pub fn of(name: &str) -> Option<Better> {
        let metric = name.split('.').next().and_then(find)?;
        let own = OF_VARIANTS.iter().find(|(variant, _)| *variant == name);
        Some(own.map_or(metric.better, |(_, better)| *better))
    }

    /// The name of a metric or variant with its sign; a name that is not in the catalogue as it is.
    #[must_use]
    pub fn named(name: &str) -> String {
        Better::of(name).map_or_else(|| name.to_owned(), |better| better.beside(name))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue::ALL;

    #[test]
    fn every_metric_of_the_catalogue_is_named_with_its_own_sign() {
        for metric in ALL {
            assert_eq!(Better::of(metric.id), Some(metric.better), "{}", metric.id);
            let other = format!("{}.any", metric.id);
            assert_eq!(Better::named(&other), metric.better.beside(&other));
        }
        for (name, better) in OF_VARIANTS {
            let (metric, _) = name.split_once('.').expect("a variant");
            assert_ne!(
                find(metric).map(|metric| metric.better),
                Some(better),
                "{name}"
            );
        }
        assert_eq!(Better::named("beauty"), "beauty");
    }
}
