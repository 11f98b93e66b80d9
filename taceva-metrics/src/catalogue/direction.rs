//! Direction of good values of a metric or variant, by name.

use super::find;
use crate::score::direction::Better;

impl Better {
    /// Direction of the metric or variant called `name`: `mae`, `hysteresis.ratio`; `None` for a name outside the catalogue.
    ///
    /// ```
    /// use taceva_metrics::Better;
    /// assert_eq!(Better::of("r2"), Some(Better::Higher));
    /// assert_eq!(Better::of("linearity.offset"), Some(Better::NearZero));
    /// assert_eq!(Better::of("beauty"), None);
    /// ```
    pub fn of(name: &str) -> Option<Better> {
        let (id, variant) = name.split_once('.').unwrap_or((name, ""));
        find(id).map(|metric| metric.better_of(variant))
    }

    /// Name of a metric or variant with the arrow of its direction, such as `mae ↓`. A name outside the catalogue is returned unchanged.
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
        for metric in ALL {
            for (variant, better) in metric.variants {
                assert_ne!(metric.better, *better, "{}.{variant}", metric.id);
            }
        }
        assert_eq!(Better::named("beauty"), "beauty");
    }
}
