//! Adjustable constants in the definitions of metrics.

use taceva_core::{Nanometre, Newton};

use crate::error::MetricError;

/// Adjustable constants in the definitions of metrics. Defaults are the values of the TacEva paper or of its project page.
///
/// Each score reports its constants. States with different constants do not merge.
///
/// ```
/// use taceva_metrics::Settings;
/// let settings = Settings::default().with_bins(10).with_n_min(5);
/// assert_eq!((settings.bins, settings.n_min, settings.ddof), (10, 5, 0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Settings {
    /// Number of cells along each side of a map of the gel's surface; default 20, at most 1,000.
    pub bins: u32,
    /// Least number of samples of a bin; bins with fewer samples are ignored. Default 1.
    pub n_min: u64,
    /// Number subtracted from the bin count in the divisor of the variance: 0 (default: the bins are the whole population) or 1.
    pub ddof: u32,
    /// Least magnitude of the normal force of a press that sensitivity and uniformity use; default 0.02 N.
    pub gate: Newton,
    /// Number of neighbouring bins in the rolling mean of the variant `r_spatial.smooth`, odd; default 5.
    pub smoothing_window: u32,
    /// Greatest error of a predicted grating spacing that counts as correct; default 0.05 mm.
    pub resolution_tolerance: Nanometre,
}

impl Default for Settings {
    fn default() -> Settings {
        Settings {
            bins: 20,
            n_min: 1,
            ddof: 0,
            gate: Newton(0.02),
            smoothing_window: 5,
            resolution_tolerance: Nanometre(50_000),
        }
    }
}

impl Settings {
    /// Greatest number of cells along each side of a map. A larger map would take more space than its data.
    pub const BINS_MAX: u32 = 1000;

    /// The same settings with another [`bins`](Settings::bins).
    #[must_use]
    pub fn with_bins(self, bins: u32) -> Settings {
        Settings { bins, ..self }
    }

    /// The same settings with another [`n_min`](Settings::n_min).
    #[must_use]
    pub fn with_n_min(self, n_min: u64) -> Settings {
        Settings { n_min, ..self }
    }

    /// The same settings with another [`ddof`](Settings::ddof).
    #[must_use]
    pub fn with_ddof(self, ddof: u32) -> Settings {
        Settings { ddof, ..self }
    }

    /// The same settings with another [`gate`](Settings::gate).
    #[must_use]
    pub fn with_gate(self, gate: Newton) -> Settings {
        Settings { gate, ..self }
    }

    /// The same settings with another [`smoothing_window`](Settings::smoothing_window).
    #[must_use]
    pub fn with_smoothing_window(self, smoothing_window: u32) -> Settings {
        Settings {
            smoothing_window,
            ..self
        }
    }

    /// The same settings with another [`resolution_tolerance`](Settings::resolution_tolerance).
    #[must_use]
    pub fn with_resolution_tolerance(self, resolution_tolerance: Nanometre) -> Settings {
        Settings {
            resolution_tolerance,
            ..self
        }
    }

    /// Rejects values outside the allowed ranges.
    pub(crate) fn check(&self) -> Result<(), MetricError> {
        let refuse = |name, found: String, expected: &str| MetricError::Setting {
            name,
            expected: expected.to_owned(),
            found,
        };
        if !(1..=Settings::BINS_MAX).contains(&self.bins) {
            return Err(refuse("bins", self.bins.to_string(), "1 to 1000"));
        }
        if self.n_min == 0 {
            return Err(refuse("n_min", self.n_min.to_string(), "1 or more"));
        }
        if self.ddof > 1 {
            return Err(refuse("ddof", self.ddof.to_string(), "0 or 1"));
        }
        if !(self.gate.0 > 0.0 && self.gate.0.is_finite()) {
            return Err(refuse("gate", self.gate.0.to_string(), "a force above 0 N"));
        }
        if self.smoothing_window.is_multiple_of(2) {
            return Err(refuse(
                "smoothing_window",
                self.smoothing_window.to_string(),
                "an odd number",
            ));
        }
        if self.resolution_tolerance.0 < 0 {
            return Err(refuse(
                "resolution_tolerance",
                self.resolution_tolerance.to_string(),
                "0 mm or more",
            ));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constants_that_mean_nothing_are_refused_by_name() {
        let fine = Settings::default();
        assert_eq!(fine.check(), Ok(()));
        let refused = [
            (Settings { bins: 0, ..fine }, "bins"),
            (Settings { bins: 1001, ..fine }, "bins"),
            (Settings { n_min: 0, ..fine }, "n_min"),
            (Settings { ddof: 2, ..fine }, "ddof"),
            (
                Settings {
                    gate: Newton(0.0),
                    ..fine
                },
                "gate",
            ),
            (
                Settings {
                    gate: Newton(f64::NAN),
                    ..fine
                },
                "gate",
            ),
            (
                Settings {
                    smoothing_window: 4,
                    ..fine
                },
                "smoothing_window",
            ),
            (
                Settings {
                    resolution_tolerance: Nanometre(-1),
                    ..fine
                },
                "resolution_tolerance",
            ),
        ];
        for (settings, name) in refused {
            let error = settings.check().expect_err(name).to_string();
            assert!(error.starts_with(&format!("setting `{name}`")), "{error}");
        }
    }
}
