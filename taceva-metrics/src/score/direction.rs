//! Direction of good values of a metric, and its sign, such as an arrow, in tables.

/// Direction of good values of a metric.
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
    /// Small values are good.
    Lower,
    /// Large values are good.
    Higher,
    /// Values near zero are good.
    NearZero,
    /// No direction: values describe the sensor without a preference.
    Described,
}

impl Better {
    /// Appends the sign of the direction to `name`, as in tables: `mae ↓`, `r2 ↑`, `bias →0`. A descriptive value has no sign.
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

    /// Name of the direction in files: `lower`, `higher`, `near zero` or `none`.
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
}
