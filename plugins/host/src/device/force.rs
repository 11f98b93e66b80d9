//! Force transducer of a plugin.

#![expect(unsafe_code, reason = "readings come through the plugin's functions")]

use std::ffi::c_void;
use std::sync::Arc;
use std::time::Instant;

use taceva_abi as abi;
use taceva_abi::ext::{NUMBERED, NumberedCalls, TARE, TareCalls};
use taceva_core::{
    Axes, Axis, Deadline, DriverError, DriverKind, ErrorKind, Facts, ForceFacts, ForceTransducer,
    Interrupt, Newton, NewtonMillimetre, SampleTiming, Stamp, Tare, Wrench, check_wrench,
};

use super::handle::{Handle, Opened, Owned, PluginDevice};
use super::sensor::stamp;
use crate::call::timeout;
use crate::library::NEW_FORCE_MINOR;

/// Force transducer of a plugin in this process.
pub(crate) struct PluginForce {
    timing: SampleTiming,
    handle: Owned,
    calls: abi::ForceCalls,
    read: Read,
    axes: Axes,
    /// Torque unit of the library, expressed in N·mm.
    torque_unit: f64,
    tare: Option<TareAbility>,
    numbers: Option<Sequence>,
    /// Sequence number of the last reading; `None` before the first, or if the device does not number readings.
    sequence: Option<u64>,
    /// Number of lost readings, as stated after the last reading; `None` if the device does not count them.
    lost: Option<u64>,
}

type Sequence = unsafe extern "C" fn(*mut c_void, *mut u64, *mut abi::Error) -> abi::Status;

type Read = unsafe extern "C" fn(
    *mut c_void,
    *mut abi::Wrench,
    *mut abi::Stamp,
    u64,
    *mut abi::Error,
) -> abi::Status;

const OPENING: &str = "open the force transducer";

impl PluginDevice for PluginForce {
    const KIND: DriverKind = DriverKind::Force;
    type Calls = abi::ForceCalls;
    type Facts = ForceFacts;

    fn facts(facts: &Facts) -> Option<&ForceFacts> {
        match facts {
            Facts::Force(facts) => Some(facts),
            _ => None,
        }
    }

    fn new(
        opened: Opened<abi::ForceCalls>,
        facts: &ForceFacts,
    ) -> Result<PluginForce, DriverError> {
        let Opened { handle, calls } = opened;
        let read = handle.needs(calls.read, "read")?;
        let tare = if facts.tare {
            let zero = |table: TareCalls| table.zero;
            let zero = handle.ability(TARE, OPENING, "it declares that it can tare", zero)?;
            let handle = handle.share();
            Some(TareAbility { handle, zero })
        } else {
            None
        };
        let numbers = if facts.numbered {
            let sequence = |table: NumberedCalls| table.sequence;
            let what = "it declares that it numbers its readings";
            Some(handle.ability(NUMBERED, OPENING, what, sequence)?)
        } else {
            None
        };
        let timing = handle.timing(facts.rate);
        let torque_unit = match handle.minor() < NEW_FORCE_MINOR {
            true => 1000.0,
            false => 1.0,
        };
        Ok(PluginForce {
            numbers,
            sequence: None,
            lost: None,
            handle,
            calls,
            read,
            timing,
            axes: facts.axes,
            torque_unit,
            tare,
        })
    }
}

impl ForceTransducer for PluginForce {
    fn axes(&self) -> Axes {
        self.axes
    }

    fn start(&mut self, deadline: Deadline) -> Result<(), DriverError> {
        let Some(start) = self.calls.start else {
            return Ok(());
        };
        self.handle
            .call("start the force transducer", |raw, error| {
                // SAFETY: [owner & open] by `&mut self`, with an error that outlives the call.
                unsafe { start(raw, timeout(deadline), error) }
            })
    }

    fn read(&mut self, deadline: Deadline) -> Result<(Wrench, Stamp), DriverError> {
        const DOING: &str = "read the force";
        let mut wrench = abi::Wrench::default();
        let mut when = abi::Stamp::default();
        let asked = Instant::now();
        let read = self.handle.call(DOING, |raw, error| {
            let (wrench, when) = (&raw mut wrench, &raw mut when);
            // SAFETY: [owner & started] by `&mut self`, with places for the reading and an error that outlive the call.
            unsafe { (self.read)(raw, wrench, when, timeout(deadline), error) }
        });
        self.timing.wait(asked.elapsed());
        read?;
        let kept = self.timing.sample(Instant::now(), stamp(when));
        kept.map_err(|error| {
            let why = error.to_string();
            self.handle.failed(ErrorKind::DeviceFault, DOING, why)
        })?;
        let wrench = Wrench {
            force: wrench.force_n.map(Newton),
            torque: wrench
                .torque_n_mm
                .map(|torque| NewtonMillimetre(torque * self.torque_unit)),
        };
        let wrench = wrench.on_grid();
        check_wrench(&wrench).map_err(|error| {
            let why = error.to_string();
            self.handle.failed(ErrorKind::DeviceFault, DOING, why)
        })?;
        if let Some(numbers) = self.numbers {
            let mut sequence = 0;
            self.handle.call("number the reading", |raw, error| {
                // SAFETY: [owner & open] by `&mut self`, with a place for the number and an error that outlive the call.
                unsafe { numbers(raw, &raw mut sequence, error) }
            })?;
            self.sequence = Some(sequence);
        }
        if let Some(lost) = self.calls.lost {
            let mut count = 0;
            let counted = self.handle.call("count lost readings", |raw, error| {
                // SAFETY: [owner & open] by `&mut self`, with a place for the number and an error that outlive the call.
                unsafe { lost(raw, &raw mut count, error) }
            });
            self.lost = match counted {
                Ok(()) => Some(count),
                Err(error) if error.kind() == ErrorKind::NotFound => {
                    self.calls.lost = None;
                    None
                }
                Err(error) => return Err(error),
            };
        }
        Ok((measured(wrench, self.axes), stamp(when)))
    }

    fn sequence(&self) -> Option<u64> {
        self.sequence
    }

    fn lost(&self) -> Option<u64> {
        self.lost
    }

    fn stop(&mut self) -> Result<(), DriverError> {
        let Some(stop) = self.calls.stop else {
            return Ok(());
        };
        self.handle.call("stop the force transducer", |raw, error| {
            // SAFETY: [owner & open] by `&mut self`, with an error that outlives the call.
            unsafe { stop(raw, error) }
        })
    }

    fn interrupt_handle(&self) -> Option<Arc<dyn Interrupt>> {
        self.handle.interrupt()
    }

    fn tare(&mut self) -> Option<&mut dyn Tare> {
        let tare = self.tare.as_mut()?;
        Some(tare)
    }
}

/// Sets the components of unmeasured axes to 0.
fn measured(mut wrench: Wrench, axes: Axes) -> Wrench {
    for (place, axis) in [Axis::Fx, Axis::Fy, Axis::Fz].into_iter().enumerate() {
        if !axes.contains(axis) {
            wrench.force[place].0 = 0.0;
        }
    }
    for (place, axis) in [Axis::Tx, Axis::Ty, Axis::Tz].into_iter().enumerate() {
        if !axes.contains(axis) {
            wrench.torque[place].0 = 0.0;
        }
    }
    wrench
}

struct TareAbility {
    handle: Arc<Handle>,
    zero: unsafe extern "C" fn(*mut c_void, u64, *mut abi::Error) -> abi::Status,
}

impl Tare for TareAbility {
    fn zero(&mut self, deadline: Deadline) -> Result<(), DriverError> {
        self.handle.call("tare", |raw, error| {
            // SAFETY: [owner & started] by `&mut self`, which is borrowed from the transducer, with an error that outlives the call.
            unsafe { (self.zero)(raw, timeout(deadline), error) }
        })
    }
}
