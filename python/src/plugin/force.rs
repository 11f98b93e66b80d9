//! A Python force transducer.

use std::sync::Arc;

use pyo3::prelude::*;
use taceva_core::{
    Axes, Deadline, Descriptor, DriverError, ErrorKind, ForceTransducer, Interrupt, Newton,
    NewtonMillimetre, Stamp, Tare, Wrench,
};

use super::objects::Object;
use super::sensor::stamp;
use crate::errors::value_error;

const READ: &str = "read the force";

/// Force transducer that is a Python object with `start`, `read(deadline)`, `stop` and, if declared, `zero(deadline)`.
pub(super) struct PythonForce {
    object: Object,
    axes: Axes,
    can_tare: bool,
    sequence: Option<u64>,
    lost: Option<u64>,
}

/// Result of `read` of the Python object.
struct Reading {
    wrench: Wrench,
    stamp: Stamp,
    /// Sequence number of the last reading; `None` before the first reading, or if the device does not number its readings.
    sequence: Option<u64>,
    /// Number of lost readings; `None` if the device does not count them.
    lost: Option<u64>,
}

impl PythonForce {
    pub(super) fn new(object: Object, descriptor: &Descriptor) -> Result<PythonForce, DriverError> {
        let facts = descriptor.force();
        let can_tare = facts.is_some_and(|facts| facts.tare);
        if can_tare && !object.has("zero") {
            let why = "its class declares `tare=True` but has no method zero(deadline)";
            let key = object.key();
            return Err(
                DriverError::new(ErrorKind::Unsupported, key, "open the device").because(why),
            );
        }
        Ok(PythonForce {
            object,
            axes: facts.map(|facts| facts.axes).unwrap_or_default(),
            can_tare,
            sequence: None,
            lost: None,
        })
    }
}

/// Parses the result of `read`: force in N, time, sequence number of the device and number of lost readings.
fn reading(said: &Bound<'_, PyAny>) -> PyResult<Reading> {
    let parts: Vec<Bound<'_, PyAny>> = said.extract().unwrap_or_default();
    let (force, time, number, lost) = match parts.as_slice() {
        [force, time] => (force, time, None, None),
        [force, time, number] => (force, time, number.extract()?, None),
        [force, time, number, lost] => (force, time, number.extract()?, lost.extract()?),
        _ => {
            let class = said.get_type().name()?;
            return Err(value_error(format_args!(
                "read returned a {class}, expected taceva.plugin.Reading(force, time)"
            )));
        }
    };
    Ok(Reading {
        wrench: wrench(force)?,
        stamp: stamp(time, "read")?,
        sequence: number,
        lost,
    })
}

/// Parses the force on the transducer, in N: one number is along z, three are x, y and z. Six numbers include the torque.
fn wrench(said: &Bound<'_, PyAny>) -> PyResult<Wrench> {
    let mut wrench = Wrench::default();
    let numbers: Vec<f64> = match said.extract::<f64>() {
        Ok(normal) => vec![0.0, 0.0, normal],
        Err(_) => said.extract().unwrap_or_default(),
    };
    match numbers.as_slice() {
        [force @ .., _, _, _] if force.len() == 3 => {
            let [x, y, z, tx, ty, tz] = [0, 1, 2, 3, 4, 5].map(|at| numbers[at]);
            wrench.force = [x, y, z].map(Newton);
            wrench.torque = [tx, ty, tz].map(NewtonMillimetre);
        }
        [x, y, z] => wrench.force = [*x, *y, *z].map(Newton),
        _ => {
            return Err(value_error(
                "read returned a force that is not 1, 3 or 6 numbers: expected Fz, [Fx, Fy, Fz] or [Fx, Fy, Fz, Tx, Ty, Tz], in N and N·mm",
            ));
        }
    }
    Ok(wrench)
}

impl ForceTransducer for PythonForce {
    fn axes(&self) -> Axes {
        self.axes
    }

    fn start(&mut self, deadline: Deadline) -> Result<(), DriverError> {
        self.object.method("start", "start", deadline)
    }

    fn read(&mut self, deadline: Deadline) -> Result<(Wrench, Stamp), DriverError> {
        let read = self.object.call(READ, deadline, |object, deadline| {
            reading(&object.call_method1("read", (deadline,))?)
        })?;
        (self.sequence, self.lost) = (read.sequence, read.lost);
        Ok((read.wrench, read.stamp))
    }

    fn sequence(&self) -> Option<u64> {
        self.sequence
    }

    fn lost(&self) -> Option<u64> {
        self.lost
    }

    fn stop(&mut self) -> Result<(), DriverError> {
        self.object.plain_method("stop", "stop")
    }

    fn interrupt_handle(&self) -> Option<Arc<dyn Interrupt>> {
        self.object.interrupt_handle()
    }

    fn tare(&mut self) -> Option<&mut dyn Tare> {
        if self.can_tare { Some(self) } else { None }
    }
}

impl Tare for PythonForce {
    fn zero(&mut self, deadline: Deadline) -> Result<(), DriverError> {
        self.object.method("zero", "zero the force", deadline)
    }
}
