//! Which values are good, and the sign that says so beside a name.

use crate::catalogue;

/// Which values of a metric are good.
///
/// ```
/// use taceva_metrics::{Better, catalogue};
/// let mae = catalogue::find("mae").ok_or("a metric")?;
/// assert_eq!((mae.better, mae.better.beside("mae")), (Better::Lower, "mae ↓".to_owned()));
/// # Ok::<(), &str>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Better {
    /// Small ones.
    Lower,
    /// Large ones.
    Higher,
    /// Those near zero.
    NearZero,
    /// None: they describe.
    Described,
}

/// Variants that are read otherwise than their metric.
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
    /// That of the metric or variant called `name`: `mae`, `hysteresis.ratio`; none of names that are not in the catalogue.
    ///
    /// ```
    /// use taceva_metrics::Better;
    /// assert_eq!(Better::of("r2"), Some(Better::Higher));
    /// assert_eq!(Better::of("linearity.offset"), Some(Better::NearZero));
    /// assert_eq!(Better::of("beauty"), None);
    /// ```
    pub fn of(name: &str) -> Option<Better> {
        let metric = name.split('.').next().and_then(catalogue::find)?;
        let own = OF_VARIANTS.iter().find(|(variant, _)| *variant == name);
        Some(own.map_or(metric.better, |(_, better)| *better))
    }

    /// `name` as it stands in every table, with the sign of the direction behind it: `mae ↓`, `r2 ↑`, `bias →0`; nothing behind what only
    /// describes.
    ///
    /// ```
    /// use taceva_metrics::Better;
    /// assert_eq!(Better::Lower.beside("mae Fz"), "mae Fz ↓");
    /// ```
    #[must_use]
    pub fn beside(self, name: &str) -> String {
        let sign = match self {
            Better::Lower => " ↓",
            Better::Higher => " ↑",
            Better::NearZero => " →0",
            Better::Described => "",
        };
        format!("{name}{sign}")
    }

    /// The name of a metric or variant with its sign; a name that is not in the catalogue as it is.
    #[must_use]
    pub fn named(name: &str) -> String {
        Better::of(name).map_or_else(|| name.to_owned(), |better| better.beside(name))
    }

    /// The word for it in files: `lower`, `higher`, `near zero` or `none`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Better::Lower => "lower",
            Better::Higher => "higher",
            Better::NearZero => "near zero",
            Better::Described => "none",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_direction_has_a_sign_and_a_word_of_its_own() {
        let all = [
            Better::Lower,
            Better::Higher,
            Better::NearZero,
            Better::Described,
        ];
        assert_eq!(all.map(|better| better.beside("")), [" ↓", " ↑", " →0", ""]);
        let words = ["lower", "higher", "near zero", "none"];
        assert_eq!(all.map(Better::name), words);
    }

    #[test]
    fn every_metric_of_the_catalogue_is_named_with_its_own_sign() {
        for metric in catalogue::ALL {
            assert_eq!(Better::of(metric.id), Some(metric.better), "{}", metric.id);
            let other = format!("{}.any", metric.id);
            assert_eq!(Better::named(&other), metric.better.beside(&other));
        }
        for (name, better) in OF_VARIANTS {
            let (metric, _) = name.split_once('.').expect("a variant");
            assert_ne!(
                catalogue::find(metric).map(|metric| metric.better),
                Some(better),
                "{name}"
            );
        }
        assert_eq!(Better::named("beauty"), "beauty");
    }
}
