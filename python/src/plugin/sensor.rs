//! A Python sensor. The object writes frames into a numpy array, from which they are copied.

use std::sync::Arc;
use std::time::Duration;

use pyo3::buffer::PyBuffer;
use pyo3::prelude::*;
use taceva_core::{
    Deadline, Descriptor, DriverError, ErrorKind, FrameInfo, FrameMut, Interrupt, PixelFormat,
    Sensor, Stamp,
};

use super::objects::Object;
use crate::errors::value_error;

const CAPTURE: &str = "capture a frame";

/// Sensor that is a Python object with `start`, `capture(into, deadline)` and `stop`.
pub(super) struct PythonSensor {
    object: Object,
    frame: FrameInfo,
    /// Numpy array that receives each frame, and access to its bytes; created for the first frame.
    into: Option<(Py<PyAny>, PyBuffer<u8>)>,
}

impl PythonSensor {
    pub(super) fn new(
        object: Object,
        descriptor: &Descriptor,
    ) -> Result<PythonSensor, DriverError> {
        let frame = descriptor.sensor().and_then(|facts| facts.frame);
        let frame = frame.ok_or_else(|| {
            let why =
                "its class declares no `frame`, expected (width, height, \"gray8\" or \"rgb8\")";
            DriverError::new(ErrorKind::Unsupported, object.key(), "open the sensor").because(why)
        })?;
        Ok(PythonSensor {
            object,
            frame,
            into: None,
        })
    }
}

/// Array for frames of `frame`, `[height, width]` or `[height, width, 3]`, and its bytes.
fn array(py: Python<'_>, frame: FrameInfo) -> PyResult<(Py<PyAny>, PyBuffer<u8>)> {
    let number = match frame.format {
        PixelFormat::Gray8 | PixelFormat::Rgb8 => "uint8",
        _ => "uint16",
    };
    let (height, width) = (frame.height, frame.width);
    let numpy = py.import("numpy")?;
    let array = match frame.format.samples() {
        1 => numpy.call_method1("zeros", ((height, width), number))?,
        samples => numpy.call_method1("zeros", ((height, width, samples), number))?,
    };
    let bytes = array
        .call_method1("reshape", (-1,))?
        .call_method1("view", ("uint8",))?;
    Ok((array.unbind(), PyBuffer::get(&bytes)?))
}

/// Time of a frame or reading: seconds on the host clock, or a pair of this time and the time of receipt.
pub(super) fn stamp(said: &Bound<'_, PyAny>, method: &str) -> PyResult<Stamp> {
    let seconds = |number: f64| {
        Duration::try_from_secs_f64(number).map_err(|_| {
            value_error(format_args!(
                "{method} returned the time {number}, expected seconds as taceva.plugin.now() counts them"
            ))
        })
    };
    if let Ok(valid) = said.extract::<f64>() {
        return Ok(Stamp::new(seconds(valid)?, None));
    }
    if let Ok((valid, received)) = said.extract::<(f64, f64)>() {
        return Ok(Stamp::new(seconds(valid)?, Some(seconds(received)?)));
    }
    let class = said.get_type().name()?;
    Err(value_error(format_args!(
        "{method} returned a time of type {class}, expected seconds as taceva.plugin.now() counts them, or (taken, received)"
    )))
}

impl Sensor for PythonSensor {
    fn frame_info(&self) -> FrameInfo {
        self.frame
    }

    fn start(&mut self, deadline: Deadline) -> Result<(), DriverError> {
        self.object.method("start", "start", deadline)
    }

    fn capture(
        &mut self,
        mut into: FrameMut<'_>,
        deadline: Deadline,
    ) -> Result<Stamp, DriverError> {
        let PythonSensor {
            object,
            frame,
            into: kept,
        } = self;
        object.call(CAPTURE, deadline, |object, deadline| {
            let py = object.py();
            let (array, bytes) = match kept {
                Some(kept) => kept,
                None => kept.insert(array(py, *frame)?),
            };
            let said = object.call_method1("capture", (array.bind(py), deadline))?;
            let stamp = stamp(&said, "capture")?;
            let pixels = into.bytes_mut();
            bytes.copy_to_slice(py, pixels)?;
            Ok(stamp)
        })
    }

    fn stop(&mut self) -> Result<(), DriverError> {
        self.object.plain_method("stop", "stop")
    }

    fn interrupt_handle(&self) -> Option<Arc<dyn Interrupt>> {
        self.object.interrupt_handle()
    }
}
