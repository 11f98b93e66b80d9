//! The reading of a sensor without a camera at one instant: a grid of taxels, or a row of channels.

mod error;

pub use error::SignalError;

use std::fmt;

use crate::unit::Unit;

/// Grid of taxels of a tactile sensor without a camera, with the numbers per taxel and their unit.
///
/// A sensor without a grid has one row of taxels.
///
/// ```
/// use taceva_core::{SignalInfo, Unit};
/// // Five magnetometers in a row, of three axes each.
/// let info = SignalInfo::new(5, 1, 3, Unit::Microtesla)?;
/// assert_eq!((info.len(), info.to_string().as_str()), (15, "5×1 places of 3 in uT"));
/// # Ok::<(), taceva_core::SignalError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[non_exhaustive]
pub struct SignalInfo {
    /// Rows of taxels.
    pub rows: u32,
    /// Taxels per row.
    pub columns: u32,
    /// Numbers that each taxel measures, such as 3 for three axes.
    pub channels: u32,
    /// Unit of every number.
    pub unit: Unit,
}

impl SignalInfo {
    /// Greatest allowed count of numbers in one sample.
    pub const LEN_MAX: u32 = 16_384;

    /// A grid of `rows` × `columns` taxels, each with `channels` numbers in `unit`.
    ///
    /// # Errors
    /// [`SignalError`] if a dimension is 0, or a sample would have more than [`LEN_MAX`](SignalInfo::LEN_MAX) numbers.
    pub const fn new(
        rows: u32,
        columns: u32,
        channels: u32,
        unit: Unit,
    ) -> Result<SignalInfo, SignalError> {
        let info = SignalInfo {
            rows,
            columns,
            channels,
            unit,
        };
        match info.is_valid() {
            true => Ok(info),
            false => Err(SignalError::Grid { info }),
        }
    }

    /// True if the grid has 1 to [`LEN_MAX`](SignalInfo::LEN_MAX) numbers. A grid read from a file may be invalid.
    pub const fn is_valid(&self) -> bool {
        let (rows, columns) = (self.rows as u64, self.columns as u64);
        // Two 32-bit numbers have a 64-bit product.
        match (rows * columns).checked_mul(self.channels as u64) {
            Some(length) => length > 0 && length <= SignalInfo::LEN_MAX as u64,
            None => false,
        }
    }

    /// Count of numbers in one sample; 0 for an invalid grid, see [`is_valid`](SignalInfo::is_valid).
    pub const fn len(&self) -> usize {
        match self.is_valid() {
            true => self.rows as usize * self.columns as usize * self.channels as usize,
            false => 0,
        }
    }

    /// True if a sample has no numbers.
    pub const fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

impl fmt::Display for SignalInfo {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let SignalInfo {
            rows,
            columns,
            channels,
            unit,
        } = self;
        write!(f, "{rows}×{columns} places of {channels} in {unit}")
    }
}

/// Numbers of all taxels at one instant, all finite.
///
/// # Shapes
/// `[rows, columns, channels]`, contiguous and row-major. The numbers of one taxel are adjacent.
/// # Units
/// The unit of the [`SignalInfo`].
///
/// ```
/// use taceva_core::{SignalInfo, Signals, Unit};
/// let info = SignalInfo::new(1, 2, 3, Unit::Microtesla)?;
/// let signals = Signals::new(info, vec![0.1, 0.2, 0.3, 1.1, 1.2, 1.3])?;
/// // The second place.
/// assert_eq!(signals.values()[3..], [1.1, 1.2, 1.3]);
/// assert!(Signals::new(info, vec![0.0; 5]).is_err());
/// # Ok::<(), taceva_core::SignalError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Signals {
    info: SignalInfo,
    values: Vec<f32>,
}

impl Signals {
    /// Signals with the numbers `values`. The numbers of one taxel are adjacent.
    ///
    /// # Shapes
    /// `values`: rows × columns × channels.
    /// # Errors
    /// [`SignalError`] if the count of numbers is wrong, or a number is not finite.
    pub fn new(info: SignalInfo, values: Vec<f32>) -> Result<Signals, SignalError> {
        if !info.is_valid() {
            return Err(SignalError::Grid { info });
        }
        if values.len() != info.len() {
            return Err(SignalError::Count {
                info,
                found: values.len(),
            });
        }
        match values.iter().position(|value| !value.is_finite()) {
            None => Ok(Signals { info, values }),
            Some(position) => Err(SignalError::NotFinite {
                position,
                found: values[position].to_string(),
            }),
        }
    }

    /// Grid of the taxels, with the unit of their numbers.
    pub fn info(&self) -> SignalInfo {
        self.info
    }

    /// Numbers of all taxels. The numbers of one taxel are adjacent.
    pub fn values(&self) -> &[f32] {
        &self.values
    }

    /// Numbers of all taxels, moved out without a copy.
    pub fn into_values(self) -> Vec<f32> {
        self.values
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_grid_without_places_or_beyond_every_sensor_is_refused() {
        for (rows, columns, channels) in [(0, 1, 1), (1, 0, 1), (1, 1, 0), (u32::MAX, 2, 2)] {
            let error = SignalInfo::new(rows, columns, channels, Unit::Count).expect_err("refused");
            assert!(error.to_string().contains("16384"), "{error}");
        }
        assert!(SignalInfo::new(u32::MAX, u32::MAX, u32::MAX, Unit::Volt).is_err());
        let most = SignalInfo::new(128, 128, 1, Unit::Count).expect("as many as there may be");
        assert_eq!(most.len(), 16_384);
    }

    #[test]
    fn numbers_that_are_none_are_named_with_their_place() {
        let info = SignalInfo::new(1, 3, 1, Unit::Volt).expect("three places");
        let error = Signals::new(info, vec![0.0, f32::NAN, 1.0]).expect_err("no number");
        assert_eq!(
            error.to_string(),
            "signal 1 is NaN, expected a finite number"
        );
        let error = Signals::new(info, vec![0.0; 4]).expect_err("one too many");
        assert_eq!(
            error.to_string(),
            "4 signals for 1×3 places of 1 in V, expected 3"
        );
    }
}
