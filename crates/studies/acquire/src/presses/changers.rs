//! Changers of a rig, opened from the rig file. Each call has a deadline. After a change, the name that the changer reports for the new item is
//! checked.

use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

use taceva_core::{Changer, Deadline, DriverError, DriverKey, ErrorKind, Rig, Specimen};
use taceva_drivers::{Drivers, OpenError};
use taceva_protocol::{Cancel, RigFile, Setting, SpecimenChanger};

use super::device::Opened;
use super::devices::Sitting;
use super::workshop::Workshop;
use crate::scene::RigSpec;

/// Interval between checks for cancellation.
const LISTENING: Duration = Duration::from_millis(10);

/// An open changer.
pub(super) struct OpenChanger {
    changer: Box<dyn Changer>,
    driver: DriverKey,
    patience: Duration,
}

impl OpenChanger {
    /// Opens the changer `device` of `rig`; `None` without a `device`. Nothing moves.
    pub(super) fn open(
        spec: &RigSpec,
        rig: &RigFile,
        device: Option<&Setting<String>>,
        drivers: &Drivers,
    ) -> Result<Option<OpenChanger>, OpenError> {
        let Some(device) = device else {
            return Ok(None);
        };
        let selector = spec
            .selector(&drivers.changers, device, "1")
            .expect("the selector was read when the scene was planned");
        let opened = Opened::open(&drivers.changers, selector, &mut Rig::new())?;
        Ok(Some(OpenChanger {
            driver: opened.descriptor.key().clone(),
            changer: opened.device,
            patience: rig.changers.patience,
        }))
    }

    /// True if the changer contains the item `name`.
    pub(super) fn holds(&self, name: &str) -> bool {
        self.changer.holds().iter().any(|held| held == name)
    }

    /// Brings the item `name` into place. A cancellation interrupts the changer.
    ///
    /// # Errors
    /// [`DriverError`] of the changer. An error of kind `DeviceFault` if the changer reports another item in place.
    pub(super) fn bring(
        &mut self,
        name: &str,
        is_stopped: &(dyn Fn() -> bool + Sync),
    ) -> Result<(), DriverError> {
        let deadline = Deadline::after(self.patience);
        let interrupt = self.changer.interrupt_handle();
        let is_done = AtomicBool::new(false);
        let there = thread::scope(|scope| {
            if let Some(interrupt) = interrupt {
                scope.spawn(|| {
                    let interrupt = interrupt;
                    while !is_done.load(Ordering::Acquire) {
                        if is_stopped() {
                            interrupt.interrupt();
                        }
                        thread::sleep(LISTENING);
                    }
                });
            }
            let there = self.changer.bring(name, deadline);
            is_done.store(true, Ordering::Release);
            there
        })?;
        if there == name {
            return Ok(());
        }
        let why = format!(
            "the changer reports `{}` in place, expected `{}`",
            taceva_core::shown(&there),
            taceva_core::shown(name)
        );
        let error = DriverError::new(ErrorKind::DeviceFault, &self.driver, "bring it into place");
        Err(error.because(why))
    }
}

/// Changer that exchanges specimens during a run.
pub(super) struct OfSpecimens {
    pub(super) changer: OpenChanger,
    pub(super) cancel: Cancel,
}

impl SpecimenChanger for OfSpecimens {
    fn mount(&mut self, specimen: Specimen, _: Deadline) -> Result<(), DriverError> {
        let cancel = self.cancel.clone();
        self.changer
            .bring(&specimen.to_string(), &move || cancel.is_cancelled())
    }

    fn holds(&self, specimen: Specimen) -> bool {
        self.changer.holds(&specimen.to_string())
    }

    fn patience(&self) -> Option<Duration> {
        Some(self.changer.patience)
    }
}

/// Brings `unit` under the robot by a changer of units; `None` if no changer contains the unit.
///
/// # Errors
/// Errors of [`OpenChanger::open`] and [`OpenChanger::bring`].
pub(super) fn bring_unit(
    spec: &RigSpec,
    rig: &RigFile,
    unit: &str,
    sitting: Sitting<'_>,
) -> Option<Result<(), OpenError>> {
    let Workshop {
        drivers, progress, ..
    } = sitting.workshop;
    let opened = OpenChanger::open(spec, rig, rig.changers.unit.as_ref(), drivers);
    let mut changer = match opened {
        Ok(changer) => changer?,
        Err(error) => return Some(Err(error)),
    };
    if !changer.holds(unit) {
        return None;
    }
    let is_stopped = || progress.is_cancelled() || sitting.cancel.is_cancelled();
    let brought = changer.bring(unit, &is_stopped);
    Some(brought.map_err(OpenError::Device))
}
