//! Decoder of scale reports, HID usage page 0x8D ("weighing devices"). No I/O.

use taceva_core::ErrorKind;
use thiserror::Error;

/// Number of a weight report, whose bytes are `03 status unit exponent low high`.
const WEIGHT_REPORT: u8 = 3;
/// Maximum absolute value of the decimal exponent in a report.
const EXPONENT_MAX: i8 = 9;
/// Standard gravity, N/kg. Local gravity, to which scales may be adjusted, differs by up to 0.3 %.
const N_KG: f64 = 9.806_65;
const KG_G: f64 = 1e-3;
/// Mass of an international pound, g.
const G_POUND: f64 = 453.592_37;
const G_OUNCE: f64 = G_POUND / 16.0;

/// A valid weight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Weight {
    /// Mass, g; negative under tension.
    pub(super) grams: f64,
    /// Step between reported masses, g, for the unit and exponent of the report. The display of the scale may have larger steps.
    pub(super) step_grams: f64,
}

impl Weight {
    /// Force on the scale, N.
    pub(super) fn newtons(self) -> f64 {
        self.grams * KG_G * N_KG
    }

    /// Step between reported forces, N.
    pub(super) fn step_newtons(self) -> f64 {
        self.step_grams * KG_G * N_KG
    }
}

/// Reason why a report has no valid weight.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub(super) enum WeightError {
    #[error("the scale reports a fault: switch it off and on")]
    Fault,
    #[error("the scale is overloaded and clips forces: reduce the load")]
    Overloaded,
    #[error("the scale needs calibration: calibrate it as its manual describes")]
    Uncalibrated,
    #[error("the scale has lost its zero: unload it, then press its zero key")]
    ZeroLost,
    #[error("the scale reports status {0}, expected 1 to 8")]
    Status(u8),
    #[error(
        "the scale weighs in unit {0}, expected mg, g, kg, oz or lb: select one with its unit key"
    )]
    Unit(u8),
    #[error("the scale sends weights times 10^{0}, expected an exponent of -9 to 9")]
    Exponent(i8),
    #[error("a report of {0} bytes, expected 6")]
    Short(usize),
}

impl WeightError {
    /// Kind of the failure.
    pub(super) fn kind(self) -> ErrorKind {
        match self {
            WeightError::Overloaded => ErrorKind::OutOfRange,
            WeightError::Status(_)
            | WeightError::Unit(_)
            | WeightError::Exponent(_)
            | WeightError::Short(_) => ErrorKind::Protocol,
            WeightError::Fault | WeightError::Uncalibrated | WeightError::ZeroLost => {
                ErrorKind::DeviceFault
            }
        }
    }
}

/// Parses a weight report; `None` for a report with another number.
pub(super) fn read(report: &[u8]) -> Option<Result<Weight, WeightError>> {
    match *report {
        [WEIGHT_REPORT, status, unit, exponent, low, high, ..] => {
            let count = u16::from_le_bytes([low, high]);
            Some(weight(status, unit, exponent.cast_signed(), count))
        }
        [WEIGHT_REPORT, ..] => Some(Err(WeightError::Short(report.len()))),
        _ => None,
    }
}

fn weight(status: u8, unit: u8, exponent: i8, count: u16) -> Result<Weight, WeightError> {
    // Only the status contains the sign.
    let sign = match status {
        1 => return Err(WeightError::Fault),
        // At zero, in motion, at rest.
        2..=4 => 1.0,
        5 => -1.0,
        6 => return Err(WeightError::Overloaded),
        7 => return Err(WeightError::Uncalibrated),
        8 => return Err(WeightError::ZeroLost),
        other => return Err(WeightError::Status(other)),
    };
    let grams = match unit {
        1 => 1e-3,
        2 => 1.0,
        3 => 1e3,
        11 => G_OUNCE,
        12 => G_POUND,
        other => return Err(WeightError::Unit(other)),
    };
    if exponent.unsigned_abs() > EXPONENT_MAX.unsigned_abs() {
        return Err(WeightError::Exponent(exponent));
    }
    // Division gives the nearest number to a decimal such as 12.4.
    let scaled = |count: f64| match exponent {
        0.. => count * 10_f64.powi(i32::from(exponent)),
        _ => count / 10_f64.powi(-i32::from(exponent)),
    };
    Ok(Weight {
        grams: sign * scaled(f64::from(count)) * grams,
        step_grams: scaled(1.0) * grams,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grams(report: [u8; 6]) -> f64 {
        read(&report).expect("of a weight").expect("a weight").grams
    }

    #[test]
    fn golden_reports_are_weights() {
        // 124 g at rest; 12.4 g in motion; -2 g; 0.875 kg; 3.5 oz; 1.2 lb.
        assert!((grams([3, 4, 2, 0, 124, 0]) - 124.0).abs() < 1e-12);
        assert!((grams([3, 3, 2, 0xff, 124, 0]) - 12.4).abs() < 1e-12);
        assert!((grams([3, 5, 2, 0, 2, 0]) + 2.0).abs() < 1e-12);
        assert!((grams([3, 4, 3, 0xfd, 0x6b, 0x03]) - 875.0).abs() < 1e-9);
        assert!((grams([3, 4, 11, 0xff, 35, 0]) - 99.223_330_9).abs() < 1e-6);
        assert!((grams([3, 4, 12, 0xff, 12, 0]) - 544.310_844).abs() < 1e-6);
        assert!(grams([3, 2, 2, 0, 0, 0]).abs() < 1e-12);
        let weight = Weight {
            grams: 1000.0,
            step_grams: 2.0,
        };
        assert!((weight.newtons() - 9.806_65).abs() < 1e-12);
        assert!((weight.step_newtons() - 0.019_613_3).abs() < 1e-12);
    }

    #[test]
    fn the_step_of_a_scale_follows_from_its_unit_and_exponent() {
        let step = |report: [u8; 6]| {
            let weight = read(&report).expect("of a weight").expect("a weight");
            weight.step_grams
        };
        // Whole grams, tenths of a gram, thousandths of a kilogram, tenths of an ounce; zero and loads below it have a step too.
        for (report, expected_g) in [
            ([3, 4, 2, 0, 124, 0], 1.0),
            ([3, 2, 2, 0xff, 0, 0], 0.1),
            ([3, 5, 3, 0xfd, 2, 0], 1.0),
            ([3, 4, 11, 0xff, 35, 0], 2.834_952_312_5),
        ] {
            assert!((step(report) - expected_g).abs() < 1e-9, "{report:?}");
        }
    }

    #[test]
    fn what_a_scale_does_not_vouch_for_is_no_weight() {
        let found = |report: [u8; 6]| read(&report).expect("of a weight").expect_err("none");
        assert_eq!(found([3, 1, 2, 0, 9, 0]), WeightError::Fault);
        assert_eq!(found([3, 6, 2, 0, 9, 0]), WeightError::Overloaded);
        assert_eq!(found([3, 7, 2, 0, 9, 0]), WeightError::Uncalibrated);
        assert_eq!(found([3, 8, 2, 0, 9, 0]), WeightError::ZeroLost);
        assert_eq!(found([3, 0, 2, 0, 9, 0]), WeightError::Status(0));
        assert_eq!(found([3, 4, 7, 0, 9, 0]), WeightError::Unit(7));
        assert_eq!(found([3, 4, 2, 10, 9, 0]), WeightError::Exponent(10));
        assert_eq!(found([3, 4, 2, 0x80, 9, 0]), WeightError::Exponent(-128));
        assert_eq!(read(&[3, 4, 2]), Some(Err(WeightError::Short(3))));
    }

    #[test]
    fn reports_of_something_else_and_noise_are_passed_over() {
        assert_eq!(read(&[]), None);
        assert_eq!(read(&[1, 4, 2, 0, 124, 0]), None);
        // All reports of up to seven bytes with each first four: never a panic, never NaN.
        for seed in 0_u64..200_000 {
            let mixed = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15).rotate_left(29) ^ seed;
            let bytes = mixed.to_le_bytes();
            let length = usize::try_from(seed % 9).expect("small").min(bytes.len());
            let mut report = bytes[..length].to_vec();
            if let Some(first) = report.first_mut().filter(|_| seed % 2 == 0) {
                *first = WEIGHT_REPORT;
            }
            if let Some(Ok(weight)) = read(&report) {
                assert!(weight.grams.is_finite(), "{report:?}");
            }
        }
    }
}
