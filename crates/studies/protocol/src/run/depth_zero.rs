//! Height relative to which the depths of a press are measured, and its standard uncertainty.

use std::fmt;

use taceva_core::Millimetre;

use super::surface_fit::{DepthForce, surface};

/// Height relative to which the depths of a press are measured.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct DepthZero {
    /// Height of the gel in the sensor frame, positive into the gel. If no surface is fitted, this is the height of the first contact.
    pub height: Millimetre,
    /// Standard uncertainty of the height, or the reason why it is unknown.
    pub uncertainty: Result<Millimetre, ZeroUnknown>,
}

/// Reason why the standard uncertainty of a depth zero is unknown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ZeroUnknown {
    /// Depths are measured from the first contact, which is the default.
    CountedFromContact,
    /// There are too few readings near the first contact.
    FewReadings {
        /// Number of readings.
        readings: usize,
    },
    /// Every reading near the gel is in contact.
    NoneWithoutContact,
    /// The force does not increase with depth by more than its noise.
    NoRise,
}

impl DepthZero {
    /// Depth zero of a press with its first contact at `contact_mm`, fitted to the `readings` from `window_mm` above the contact on.
    pub(super) fn of(readings: &[DepthForce], contact_mm: f64, window_mm: f64) -> DepthZero {
        match surface(readings, contact_mm, window_mm) {
            Ok(surface) => DepthZero {
                height: Millimetre(surface.height_mm),
                uncertainty: Ok(Millimetre(surface.deviation_mm)),
            },
            Err(unknown) => DepthZero::at_contact(contact_mm, unknown),
        }
    }

    /// Zero of the depths at the first contact, at `contact_mm`, because no surface is fitted for the reason `unknown`.
    pub(super) fn at_contact(contact_mm: f64, unknown: ZeroUnknown) -> DepthZero {
        DepthZero {
            height: Millimetre(contact_mm),
            uncertainty: Err(unknown),
        }
    }
}

impl fmt::Display for ZeroUnknown {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ZeroUnknown::CountedFromContact => {
                f.write_str("depths count from the first contact (`depth_from = \"contact\"`)")
            }
            ZeroUnknown::FewReadings { readings } => write!(
                f,
                "{readings} readings near the gel, expected at least {}",
                super::surface_fit::LEAST_READINGS
            ),
            ZeroUnknown::NoneWithoutContact => {
                f.write_str("every reading near the gel is in contact")
            }
            ZeroUnknown::NoRise => f.write_str("the force does not rise with depth"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn without_a_fit_depths_count_from_the_first_contact_and_the_reason_is_kept() {
        let reading = DepthForce {
            z_mm: 0.5,
            force_n: 0.03,
        };
        let zero = DepthZero::of(&[reading; 2], 0.5, 0.4);
        assert_eq!(zero.height, Millimetre(0.5));
        let reason = zero.uncertainty.expect_err("two readings");
        assert_eq!(reason, ZeroUnknown::FewReadings { readings: 2 });
        assert_eq!(
            reason.to_string(),
            "2 readings near the gel, expected at least 6"
        );
    }
}
