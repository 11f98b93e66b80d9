//! Faulty sensor.

use std::collections::BTreeMap;

use taceva_core::{Deadline, DriverError, DriverKey, FrameInfo, FrameMut, Lighting, Sensor, Stamp};

use super::link::Link;
use super::{FaultKind, FaultPlan};
use taceva_drivers::Pace;

/// Sensor whose captures fail according to a plan.
pub struct FaultySensor {
    inner: Box<dyn Sensor>,
    link: Link,
    last_frame: Option<Vec<u8>>,
}

impl FaultySensor {
    /// Wraps the sensor `inner`, whose driver key is `driver`. The link has the faults of `plan` and the clock `pace`.
    pub fn new(
        inner: Box<dyn Sensor>,
        driver: DriverKey,
        plan: FaultPlan,
        pace: Box<dyn Pace>,
    ) -> FaultySensor {
        FaultySensor {
            inner,
            link: Link::new(driver, plan, pace),
            last_frame: None,
        }
    }
}

impl Sensor for FaultySensor {
    fn frame_info(&self) -> FrameInfo {
        self.inner.frame_info()
    }

    fn start(&mut self, deadline: Deadline) -> Result<(), DriverError> {
        self.inner.start(deadline)
    }

    fn capture(
        &mut self,
        mut into: FrameMut<'_>,
        deadline: Deadline,
    ) -> Result<Stamp, DriverError> {
        let capture = |deadline| self.inner.capture(again(&mut into), deadline);
        let (stamp, fault) = self.link.read("capture a frame", deadline, capture)?;
        let pixels = into.bytes_mut();
        match (fault, &mut self.last_frame) {
            (Some(FaultKind::Freeze), Some(last)) => {
                pixels.copy_from_slice(last);
                self.link.note(FaultKind::Freeze);
            }
            (_, Some(last)) => last.copy_from_slice(pixels),
            (_, none) => *none = Some(pixels.to_vec()),
        }
        match fault {
            Some(FaultKind::Saturation) => {
                pixels.fill(u8::MAX);
                self.link.note(FaultKind::Saturation);
            }
            Some(FaultKind::NotANumber) => {
                self.link.note(FaultKind::NotANumber);
                return Ok(Stamp {
                    valid_s: f64::NAN,
                    ..stamp
                });
            }
            _ => {}
        }
        Ok(self.link.stamped(stamp, fault))
    }

    fn stop(&mut self) -> Result<(), DriverError> {
        self.inner.stop()
    }

    fn settings(&self) -> BTreeMap<String, String> {
        self.inner.settings()
    }

    fn lighting(&mut self) -> Option<&mut dyn Lighting> {
        self.inner.lighting()
    }
}

/// Borrows the buffer of a frame again, so that two calls can write to it.
fn again<'a>(frame: &'a mut FrameMut<'_>) -> FrameMut<'a> {
    let info = frame.info();
    FrameMut::new(info, frame.bytes_mut()).expect("it had this size before")
}
