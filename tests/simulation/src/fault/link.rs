//! Link between the caller and a device, which causes most of the faults. All wrappers use this link.

use std::time::Duration;

use taceva_core::{Deadline, DriverError, DriverKey, ErrorKind, Stamp};

use super::{FaultKind, FaultPlan};
use taceva_drivers::Pace;

/// Link to a device, with the faults of a plan.
pub(super) struct Link {
    plan: FaultPlan,
    pace: Box<dyn Pace>,
    driver: DriverKey,
    calls: u64,
    last_stamp: Option<Stamp>,
}

impl Link {
    pub(super) fn new(driver: DriverKey, plan: FaultPlan, pace: Box<dyn Pace>) -> Link {
        Link {
            plan,
            pace,
            driver,
            calls: 0,
            last_stamp: None,
        }
    }

    /// Counts a call to the device. Returns the fault that the plan has for this call; `None` without a fault.
    pub(super) fn next_fault(&mut self) -> Option<FaultKind> {
        let fault = self.plan.at(self.calls);
        self.calls += 1;
        fault
    }

    /// Reads a value over the link, with the fault of the call. If a reading is dropped, returns the next one.
    pub(super) fn read<T>(
        &mut self,
        doing: &'static str,
        mut deadline: Deadline,
        mut read: impl FnMut(Deadline) -> Result<T, DriverError>,
    ) -> Result<(T, Option<FaultKind>), DriverError> {
        let fault = self.next_fault();
        match fault {
            Some(FaultKind::Silence) => return self.silence(doing, deadline),
            Some(FaultKind::SlowLink) => deadline = self.slow(doing, deadline)?,
            Some(FaultKind::Drop) => {
                read(deadline)?;
                self.note(FaultKind::Drop);
            }
            _ => {}
        }
        Ok((read(deadline)?, fault))
    }

    /// Counts a fault that occurred.
    pub(super) fn note(&self, kind: FaultKind) {
        self.plan.note(kind);
    }

    /// Waits until the deadline and times out.
    pub(super) fn silence<T>(
        &mut self,
        doing: &'static str,
        deadline: Deadline,
    ) -> Result<T, DriverError> {
        self.note(FaultKind::Silence);
        self.wait(deadline.remaining());
        Err(self.timeout(doing, deadline))
    }

    /// Waits for the delay of the slow link and returns the rest of the deadline.
    pub(super) fn slow(
        &mut self,
        doing: &'static str,
        deadline: Deadline,
    ) -> Result<Deadline, DriverError> {
        self.note(FaultKind::SlowLink);
        let delay = self.plan.slow_link();
        self.wait(delay.min(deadline.remaining()));
        if delay > deadline.remaining() {
            return Err(self.timeout(doing, deadline));
        }
        Ok(deadline.less(delay))
    }

    /// Stamp of a received value, as changed by `fault`.
    pub(super) fn stamped(&mut self, stamp: Stamp, fault: Option<FaultKind>) -> Stamp {
        match (fault, self.last_stamp) {
            (Some(FaultKind::StaleStamp), Some(last)) => {
                self.note(FaultKind::StaleStamp);
                return last;
            }
            (Some(FaultKind::SlowLink), _) => {
                let late_s = self.plan.slow_link().as_secs_f64();
                self.last_stamp = Some(stamp);
                return Stamp {
                    received_s: stamp.received_s.map(|received_s| received_s + late_s),
                    ..stamp
                };
            }
            _ => {}
        }
        self.last_stamp = Some(stamp);
        stamp
    }

    fn wait(&mut self, time: Duration) {
        let until_s = self.pace.now_s() + time.as_secs_f64();
        self.pace.wait_until(until_s);
    }

    pub(super) fn timeout(&self, doing: &'static str, deadline: Deadline) -> DriverError {
        DriverError::new(ErrorKind::Timeout, &self.driver, doing)
            .because(format!("no answer within {deadline}"))
    }
}
