//! Scales on which a measured value has a symmetric distribution.

use taceva_metrics::Scale;
use taceva_metrics::elementary::{exponential, logarithm};

/// Scale on which a measured value has Student's distribution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum OpenScale {
    /// Identity: the value itself.
    Own,
    /// Logarithm of the value, for errors.
    Logarithm,
    /// Negative logarithm of the distance to 1, for R².
    Remainder,
    /// Logarithm of the odds value / (width − value), for shares.
    Odds { width: f64 },
}

impl OpenScale {
    /// Scales other than [`OpenScale::Own`] on which interval ends may be symmetric.
    pub(super) fn candidates(scale: Scale) -> &'static [OpenScale] {
        match scale {
            Scale::Logarithm => &[OpenScale::Logarithm, OpenScale::Remainder],
            Scale::Logit => &[
                OpenScale::Odds { width: 1.0 },
                OpenScale::Odds { width: 2.0 },
            ],
            // The product of the odds of both ends is the square of the odds of the share.
            Scale::Wilson => &[OpenScale::Odds { width: 1.0 }],
            _ => &[],
        }
    }

    /// Name of the quantity whose logarithm is the scale, for texts about a limit; `None` for the value itself.
    pub(super) fn quantity(self) -> Option<&'static str> {
        match self {
            OpenScale::Own => None,
            OpenScale::Logarithm => Some("the limit"),
            OpenScale::Remainder => Some("1 − limit"),
            OpenScale::Odds { width } if width > 1.0 => Some("limit / (2 − limit)"),
            OpenScale::Odds { .. } => Some("limit / (1 − limit)"),
        }
    }

    /// Quantity of the scale at `value`: `value` itself for `Own`.
    pub(super) fn quantity_of(self, value: f64) -> f64 {
        match self {
            OpenScale::Own | OpenScale::Logarithm => value,
            OpenScale::Remainder => 1.0 - value,
            OpenScale::Odds { width } => value / (width - value),
        }
    }

    /// Ends of the domain of the scale.
    fn domain(self) -> [f64; 2] {
        match self {
            OpenScale::Own => [f64::NEG_INFINITY, f64::INFINITY],
            OpenScale::Logarithm => [0.0, f64::INFINITY],
            OpenScale::Remainder => [f64::NEG_INFINITY, 1.0],
            OpenScale::Odds { width } => [0.0, width],
        }
    }

    /// True for a value inside the domain of the scale.
    pub(super) fn holds(self, value: f64) -> bool {
        let [low, high] = self.domain();
        low < value && value < high
    }

    /// Distance from one value to another on the scale; infinite outside the domain.
    pub(super) fn distance(self, from: f64, to: f64) -> f64 {
        let [low, high] = self.domain();
        match self {
            _ if to <= low => f64::NEG_INFINITY,
            _ if to >= high => f64::INFINITY,
            OpenScale::Own => to - from,
            OpenScale::Logarithm => logarithm(to / from),
            OpenScale::Remainder => logarithm((1.0 - from) / (1.0 - to)),
            OpenScale::Odds { width } => logarithm(to / from * ((width - from) / (width - to))),
        }
    }

    /// Moves `value` by `by` on the scale. A value outside the domain is unchanged. Moving by 0 returns the identical value.
    pub(super) fn moved(self, value: f64, by: f64) -> f64 {
        match self {
            _ if by.abs() <= 0.0 || !self.holds(value) => value,
            OpenScale::Own => value + by,
            OpenScale::Logarithm => value * exponential(by),
            OpenScale::Remainder => 1.0 - (1.0 - value) * exponential(-by),
            OpenScale::Odds { width } => {
                width * value / (value + (width - value) * exponential(-by))
            }
        }
    }

    /// Converts an uncertainty of `value` from the scale to the unit of the value, to first order.
    pub(super) fn in_unit(self, value: f64, scaled: f64) -> f64 {
        match self {
            OpenScale::Own => scaled,
            OpenScale::Logarithm => scaled * value,
            OpenScale::Remainder => scaled * (1.0 - value),
            OpenScale::Odds { width } => scaled * value * (width - value) / width,
        }
    }
}
