//! Faulty force transducer.

use taceva_core::{
    Axes, Deadline, DriverError, DriverKey, ForceTransducer, Newton, Stamp, Tare, Wrench,
};

use super::link::Link;
use super::{FaultKind, FaultPlan};
use taceva_drivers::Pace;

/// Force transducer whose readings fail according to a plan.
pub struct FaultyForce {
    inner: Box<dyn ForceTransducer>,
    link: Link,
    full_scale: Newton,
    last: Option<Wrench>,
}

impl FaultyForce {
    /// Wraps the transducer `inner`, whose driver key is `driver`. The link has the faults of `plan` and the clock `pace`. A saturated transducer
    /// shows the normal force `full_scale`.
    pub fn new(
        inner: Box<dyn ForceTransducer>,
        driver: DriverKey,
        full_scale: Newton,
        plan: FaultPlan,
        pace: Box<dyn Pace>,
    ) -> FaultyForce {
        FaultyForce {
            inner,
            link: Link::new(driver, plan, pace),
            full_scale,
            last: None,
        }
    }
}

impl ForceTransducer for FaultyForce {
    fn axes(&self) -> Axes {
        self.inner.axes()
    }

    fn start(&mut self, deadline: Deadline) -> Result<(), DriverError> {
        self.inner.start(deadline)
    }

    fn read(&mut self, deadline: Deadline) -> Result<(Wrench, Stamp), DriverError> {
        let read = |deadline| self.inner.read(deadline);
        let ((mut wrench, stamp), fault) = self.link.read("read the force", deadline, read)?;
        match (fault, self.last) {
            (Some(FaultKind::Freeze), Some(last)) => {
                wrench = last;
                self.link.note(FaultKind::Freeze);
            }
            (Some(kind @ (FaultKind::NotANumber | FaultKind::Saturation)), _) => {
                wrench.force[2] = match kind {
                    FaultKind::NotANumber => Newton(f64::NAN),
                    _ => self.full_scale,
                };
                self.link.note(kind);
            }
            _ => self.last = Some(wrench),
        }
        Ok((wrench, self.link.stamped(stamp, fault)))
    }

    fn stop(&mut self) -> Result<(), DriverError> {
        self.inner.stop()
    }

    fn tare(&mut self) -> Option<&mut dyn Tare> {
        self.inner.tare()
    }
}
