//! Confidence intervals.

use taceva_metrics::Scale;

/// Confidence interval of a score, at 95 %, or the reason for its absence.
#[derive(Clone, Debug, PartialEq)]
pub enum Interval {
    /// Both ends of an interval, and the method that computed them.
    Ends {
        /// Lower and upper end, in the unit of the score.
        ends: [f64; 2],
        /// Method, with the number `G` of clusters: `jackknife by point_id, G=32`.
        method: String,
        /// Standard error from which the ends were computed, in the unit of the score; `None` if the result does not state it.
        standard_error: Option<f64>,
        /// Number of clusters; `None` if the result does not state it.
        clusters: Option<u64>,
        /// Degrees of freedom of the Student's t quantile of the ends; `None` if the result does not state them.
        degrees_of_freedom: Option<f64>,
    },
    /// No interval, with the reason.
    Absent(String),
}

impl Interval {
    /// Converts an interval of `taceva-metrics`.
    pub fn of(interval: &taceva_metrics::Interval) -> Interval {
        if let taceva_metrics::Interval::Undefined(reason) = interval {
            return Interval::Absent(reason.to_string());
        }
        Interval::Ends {
            ends: interval.ends().unwrap_or([f64::NAN; 2]),
            method: interval.method().unwrap_or_default(),
            standard_error: interval.standard_error(),
            clusters: interval.clusters().map(|clusters| clusters as u64),
            degrees_of_freedom: interval.freedom(),
        }
    }

    /// Lower and upper end, in the unit of the score; `None` without an interval.
    pub fn ends(&self) -> Option<[f64; 2]> {
        match self {
            Interval::Ends { ends, .. } => Some(*ends),
            Interval::Absent(_) => None,
        }
    }

    /// Method that computed the interval, in words; `None` without an interval.
    pub fn method(&self) -> Option<&str> {
        match self {
            Interval::Ends { method, .. } => Some(method),
            Interval::Absent(_) => None,
        }
    }

    /// Degrees of freedom of the Student's t quantile of the ends; `None` if the result does not state them.
    pub fn degrees_of_freedom(&self) -> Option<f64> {
        match self {
            Interval::Ends {
                degrees_of_freedom, ..
            } => *degrees_of_freedom,
            Interval::Absent(_) => None,
        }
    }

    /// Scale on which the interval was computed, such as logarithmic, parsed from the words of its method.
    pub fn scale(&self) -> Scale {
        const SCALES: [Scale; 4] = [Scale::Logarithm, Scale::Logit, Scale::Cut, Scale::Wilson];
        let method = self.method().unwrap_or_default();
        let is_named = |scale: &Scale| method.contains(&scale.to_string());
        SCALES.into_iter().find(is_named).unwrap_or(Scale::Own)
    }

    /// Number of clusters; `None` if neither the result nor its method states the number.
    pub fn clusters(&self) -> Option<usize> {
        if let Interval::Ends {
            clusters: Some(clusters),
            ..
        } = self
        {
            return usize::try_from(*clusters).ok();
        }
        let (_, rest) = self.method()?.split_once("G=")?;
        let digits = rest.find(|letter: char| !letter.is_ascii_digit());
        rest[..digits.unwrap_or(rest.len())].parse().ok()
    }
}

/// Text for readers about the `method` of an interval. If `n` independent samples were put into fewer groups, the text states both numbers.
///
/// ```
/// use taceva_results::described_method;
/// let method = "jackknife, samples taken as independent, G=32, logarithmic";
/// let words = "jackknife, 460 samples taken as independent in 32 groups, logarithmic";
/// assert_eq!(described_method(method, 460), words);
/// assert_eq!(described_method(method, 32), method);
/// ```
pub fn described_method(method: &str, n: u64) -> String {
    let parts = method.split_once("samples taken as independent, G=");
    let described = parts.and_then(|(before, after)| {
        let digits = after.find(|letter: char| !letter.is_ascii_digit());
        let (groups, after) = after.split_at(digits.unwrap_or(after.len()));
        let is_hashed = groups.parse::<u64>().is_ok_and(|groups| groups < n);
        is_hashed
            .then(|| format!("{before}{n} samples taken as independent in {groups} groups{after}"))
    });
    described.unwrap_or_else(|| method.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scale_of_an_interval_is_read_off_its_method() {
        let scale = |method: &str| {
            let interval = Interval::Ends {
                ends: [0.4, 0.6],
                method: method.to_owned(),
                standard_error: None,
                clusters: None,
                degrees_of_freedom: None,
            };
            interval.scale()
        };
        assert_eq!(scale("jackknife by point_id, G=10"), Scale::Own);
        let logarithmic = "jackknife by point_id, G=10, logarithmic";
        assert_eq!(scale(logarithmic), Scale::Logarithm);
        let share = "jackknife by point_id, G=10, Wilson with effective samples";
        assert_eq!(scale(share), Scale::Wilson);
    }
}
