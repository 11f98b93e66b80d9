//! Zero offset that this program subtracts from forces and torques, and measuring range of a transducer.

use std::time::Duration;

use taceva_core::{Deadline, DriverError, DriverKey, ErrorKind, Newton, NewtonMillimetre, Wrench};

use crate::link::monotonic;

/// Zero offset and measuring range of one transducer.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct HostZero {
    /// Key of the driver, for error messages.
    driver: DriverKey,
    zero: Wrench,
    /// Measuring range of each force, N; `None` if unknown.
    ranges_n: Option<[f64; 3]>,
    /// Greatest accepted zero offset of a force, N; `None` accepts any offset within the range.
    zero_max_n: Option<f64>,
}

/// Name of the operation that reads forces, in error messages.
pub(crate) const READ: &str = "read the force";
/// Name of the operation that zeroes forces, in error messages.
pub(crate) const ZERO: &str = "zero the force";
/// Time over which readings are averaged to determine a zero offset.
const MEAN_OVER: Duration = Duration::from_millis(250);
/// Maximum zero offset as a share of the measuring range. The rest of the range is for measurements.
const ZERO_MAX: f64 = 0.5;

impl HostZero {
    /// Creates a zero offset of 0. All three forces have the measuring range `force_max_n`.
    pub(crate) fn new(driver: DriverKey, force_max_n: Option<f64>) -> HostZero {
        HostZero {
            zero_max_n: force_max_n.map(|most| ZERO_MAX * most),
            ..HostZero::of_axes(driver, force_max_n.map(|most| [most; 3]))
        }
    }

    /// Creates a zero offset of 0. Each force has its own measuring range, and any zero offset within the ranges is accepted.
    pub(crate) fn of_axes(driver: DriverKey, ranges_n: Option<[f64; 3]>) -> HostZero {
        HostZero {
            driver,
            zero: Wrench::default(),
            ranges_n,
            zero_max_n: None,
        }
    }

    /// Fails if the magnitude of a force reaches or exceeds its measuring range.
    ///
    /// # Errors
    /// `OutOfRange`, with the force and the range.
    pub(crate) fn check(&self, wrench: &Wrench) -> Result<(), DriverError> {
        let Some(ranges_n) = self.ranges_n else {
            return Ok(());
        };
        let mut forces = wrench.force.iter().zip(ranges_n);
        match forces.find(|(force, most)| force.0.abs() >= *most) {
            Some((beyond, most)) => {
                let why = format!(
                    "a force of {beyond}, expected less than {most} N: the transducer clips forces beyond its range"
                );
                Err(DriverError::new(ErrorKind::OutOfRange, &self.driver, READ).because(why))
            }
            None => Ok(()),
        }
    }

    /// Subtracts the zero offset from `wrench`.
    ///
    /// # Errors
    /// As [`check`](HostZero::check), for the result.
    pub(crate) fn taken_off(&self, wrench: &Wrench) -> Result<Wrench, DriverError> {
        let left = sum(wrench, &times(&self.zero, -1.0));
        self.check(&left)?;
        Ok(left)
    }

    /// Resets the zero offset to 0, after the box itself set its zero.
    #[cfg(feature = "sri")]
    pub(crate) fn forget(&mut self) {
        self.zero = Wrench::default();
    }

    /// Sets the zero offset to the mean of the readings over 0.25 s. `next` returns one reading.
    ///
    /// # Errors
    /// Errors of `next`; `Timeout` if the deadline is too near; `OutOfRange` for a load above half of a stated range.
    pub(crate) fn take(
        &mut self,
        deadline: Deadline,
        mut next: impl FnMut(Duration) -> Result<Wrench, DriverError>,
    ) -> Result<(), DriverError> {
        let failed = |kind, why: String| DriverError::new(kind, &self.driver, ZERO).because(why);
        let began = monotonic();
        let (mut total, mut count) = (Wrench::default(), 0.0);
        loop {
            let spent = monotonic().saturating_sub(began);
            if spent >= MEAN_OVER && count > 0.0 {
                break;
            }
            let left = deadline.less(spent).remaining();
            if left.is_zero() {
                let why = format!(
                    "zeroing needs {MEAN_OVER:?} of readings, which did not arrive within {deadline}"
                );
                return Err(failed(ErrorKind::Timeout, why));
            }
            total = sum(&total, &next(left)?);
            count += 1.0;
        }
        let mean = times(&total, 1.0 / count);
        if let Some(most) = self.zero_max_n
            && let Some(beyond) = mean.force.iter().find(|force| force.0.abs() > most)
        {
            let why =
                format!("a load of {beyond}, expected at most {most} N: half the measuring range");
            return Err(failed(ErrorKind::OutOfRange, why));
        }
        self.zero = mean;
        Ok(())
    }
}

fn sum(one: &Wrench, other: &Wrench) -> Wrench {
    Wrench {
        force: std::array::from_fn(|axis| Newton(one.force[axis].0 + other.force[axis].0)),
        torque: std::array::from_fn(|axis| {
            NewtonMillimetre(one.torque[axis].0 + other.torque[axis].0)
        }),
    }
}

fn times(wrench: &Wrench, factor: f64) -> Wrench {
    Wrench {
        force: wrench.force.map(|force| Newton(force.0 * factor)),
        torque: wrench
            .torque
            .map(|torque| NewtonMillimetre(torque.0 * factor)),
    }
}

#[cfg(test)]
mod tests {
    use taceva_core::DriverKey;

    use super::*;

    const KEY: DriverKey = DriverKey::fixed("test/force");

    fn load(fz: f64) -> Wrench {
        let mut wrench = Wrench::default();
        wrench.force[2] = Newton(fz);
        wrench
    }

    fn taken(zero: &mut HostZero, fz: f64, deadline: Deadline) -> Result<(), DriverError> {
        let next = |_| {
            std::thread::sleep(Duration::from_millis(5));
            Ok(load(fz))
        };
        zero.take(deadline, next)
    }

    fn fz_left(zero: &HostZero, fz: f64) -> f64 {
        zero.taken_off(&load(fz)).expect("within its range").force[2].0
    }

    #[test]
    fn a_load_that_is_called_zero_is_taken_off_and_a_great_one_is_not() {
        let mut zero = HostZero::new(KEY, Some(10.0));
        let patience = Deadline::after(Duration::from_secs(20));
        taken(&mut zero, 2.0, patience).expect("a small load");
        assert!((fz_left(&zero, 5.0) - 3.0).abs() < 1e-9);
        let refused = taken(&mut zero, 5.1, patience).expect_err("more than half");
        assert_eq!(refused.kind(), ErrorKind::OutOfRange);
        let hasty = taken(&mut zero, 0.0, Deadline::PASSED).expect_err("no time");
        assert_eq!(hasty.kind(), ErrorKind::Timeout);
        assert!((fz_left(&zero, 5.0) - 3.0).abs() < 1e-9);
    }

    #[test]
    fn a_force_at_the_end_of_the_range_is_none() {
        let zero = HostZero::new(KEY, Some(10.0));
        assert!(zero.check(&load(9.99)).is_ok());
        for beyond in [10.0, -10.0, 11.0] {
            assert!(zero.check(&load(beyond)).is_err());
        }
        assert!(HostZero::new(KEY, None).check(&load(1e9)).is_ok());
    }

    #[test]
    fn each_force_has_its_own_range() {
        let mut zero = HostZero::of_axes(KEY, Some([12.0, 12.0, 17.0]));
        assert!(zero.check(&load(16.9)).is_ok());
        assert!(zero.check(&load(17.0)).is_err());
        let mut sideways = Wrench::default();
        sideways.force[0] = Newton(12.0);
        assert!(zero.check(&sideways).is_err());
        let patience = Deadline::after(Duration::from_secs(20));
        taken(&mut zero, 11.0, patience).expect("a great load within the range");
        assert!((fz_left(&zero, 16.0) - 5.0).abs() < 1e-9);
    }
}
