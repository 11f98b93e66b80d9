//! Speed and acceleration limits of a controller, read from one report.

use std::io::Read;
use std::time::Duration;

use taceva_core::Speed;

use crate::link::connect;

/// Speed and acceleration limits of the tip. The controller replaces commanded values outside the limits without an error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ArmLimits {
    /// Least and greatest speed, mm/s.
    pub(super) speed_mm_s: [f64; 2],
    /// Least and greatest acceleration, mm/s².
    pub(super) acceleration_mm_s2: [f64; 2],
}

/// Longest wait for a report with limits; the controller sends five per second.
const PATIENCE: Duration = Duration::from_secs(1);
/// Offset of the least acceleration in a report, bytes. The greatest acceleration, the least speed and the greatest speed follow.
const LIMITS: usize = 185;
const REPORT: usize = LIMITS + 16;

impl ArmLimits {
    /// Reads the limits from a report on `port` of `host`. `None` if the port is closed, sends no complete report in time, or states no limits.
    pub(super) fn ask(host: &str, port: u16) -> Option<ArmLimits> {
        let (mut stream, _) = connect(host, port).ok()?;
        stream.set_read_timeout(Some(PATIENCE)).ok()?;
        let mut report = [0; REPORT];
        stream.read_exact(&mut report).ok()?;
        ArmLimits::read(&report)
    }

    fn read(report: &[u8; REPORT]) -> Option<ArmLimits> {
        let [l3, l2, l1, l0, ..] = *report;
        let length = u32::from_be_bytes([l3, l2, l1, l0]);
        let is_complete = usize::try_from(length).is_ok_and(|length| length >= REPORT);
        let number = |at: usize| {
            let bytes = std::array::from_fn(|byte| report[LIMITS + 4 * at + byte]);
            decimal(f32::from_le_bytes(bytes))
        };
        let range = |at: usize| {
            let [least, most] = [number(at)?, number(at + 1)?];
            (0.0 < least && least < most).then_some([least, most])
        };
        Some(ArmLimits {
            acceleration_mm_s2: range(0)?,
            speed_mm_s: range(2)?,
        })
        .filter(|_| is_complete)
    }

    /// Rejects a speed outside the limits, because the controller would replace it.
    ///
    /// # Errors
    /// A sentence with the speed and the limits.
    pub(super) fn admit(&self, speed: Speed) -> Result<(), String> {
        let [least, most] = self.speed_mm_s;
        match speed.mm_per_s() {
            found if found < least => Err(format!(
                "a speed of {found} mm/s, expected at least {least} mm/s: the controller would move at {least} mm/s without an error"
            )),
            found if found > most => Err(format!(
                "a speed of {found} mm/s, expected at most {most} mm/s: the controller would move at {most} mm/s without an error"
            )),
            _ => Ok(()),
        }
    }

    /// Rejects an acceleration outside the limits, because the controller would replace it.
    ///
    /// # Errors
    /// A sentence with the acceleration and the limits.
    pub(super) fn admit_acceleration(&self, acceleration_mm_s2: f64) -> Result<(), String> {
        let [least, most] = self.acceleration_mm_s2;
        match (least..=most).contains(&acceleration_mm_s2) {
            true => Ok(()),
            false => Err(format!(
                "`acceleration_mm_s2` is {acceleration_mm_s2}, expected {least} to {most}: the controller would take the nearest of these without an error"
            )),
        }
    }
}

/// Shortest decimal number whose nearest single-precision value is `number`, such as 0.1; `None` if `number` is not finite.
fn decimal(number: f32) -> Option<f64> {
    let number: Option<f64> = number.to_string().parse().ok();
    number.filter(|number| number.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Report that states a length of `length` bytes. `limits` are the least and greatest acceleration, then the least and greatest speed.
    fn report(length: u32, limits: [f32; 4]) -> [u8; REPORT] {
        let mut report = [0; REPORT];
        report[..4].copy_from_slice(&length.to_be_bytes());
        for (at, number) in limits.into_iter().enumerate() {
            let at = LIMITS + 4 * at;
            report[at..at + 4].copy_from_slice(&number.to_le_bytes());
        }
        report
    }

    fn admits(limits: &ArmLimits, mm_s: f64) -> Result<(), String> {
        limits.admit(Speed::try_new(mm_s).expect("above 0"))
    }

    #[test]
    fn a_speed_outside_the_limits_of_the_report_is_refused_and_its_ends_are_not() {
        let limits = ArmLimits::read(&report(587, [1.0, 50_000.0, 0.1, 1_000.0]));
        let limits = limits.expect("limits");
        for mm_s in [0.1, 5.0, 1_000.0] {
            assert_eq!(admits(&limits, mm_s), Ok(()), "{mm_s}");
        }
        let slow = admits(&limits, 0.05).expect_err("too slow");
        assert!(slow.contains("at least 0.1 mm/s"), "{slow}");
        let fast = admits(&limits, 1_500.0).expect_err("too fast");
        assert!(fast.contains("at most 1000 mm/s"), "{fast}");
        assert_eq!(limits.admit_acceleration(500.0), Ok(()));
        let hard = limits.admit_acceleration(60_000.0).expect_err("too hard");
        assert!(hard.contains("1 to 50000"), "{hard}");
    }

    #[test]
    fn a_report_without_limits_gives_none() {
        for (length, limits) in [
            (145, [1.0, 50_000.0, 0.1, 1_000.0]),
            (587, [0.0; 4]),
            (587, [1.0, 50_000.0, f32::NAN, 1_000.0]),
            (587, [1.0, 50_000.0, 1_000.0, 0.1]),
            (587, [1.0, f32::INFINITY, 0.1, 1_000.0]),
        ] {
            assert_eq!(ArmLimits::read(&report(length, limits)), None, "{limits:?}");
        }
    }
}
