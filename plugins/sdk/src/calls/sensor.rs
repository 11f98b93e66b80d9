//! Functions with which the host calls a sensor.

#![expect(unsafe_code, reason = "functions that a host calls")]

use std::ffi::c_void;

use taceva_abi::ext::{SENSOR_LIGHTING, SensorLightingCalls};
use taceva_abi::{
    Error, FRAME_NUMBERED, Frame, PixelFormat as AbiFormat, SensorCalls, Status, Text,
};
use taceva_core::{ErrorKind, Facts, FrameMut, PixelFormat, Sensor};

use super::{Kind, call, device_calls, extended};
use crate::convert::{self, deadline};
use crate::driver_lists::{Drivers, Loaded};
use crate::failure::Failure;
use crate::handles::Handle;
use crate::memory;

/// Open sensor, and the number of captured frames.
pub(crate) struct Opened {
    sensor: Box<dyn Sensor>,
    frames: u64,
}

impl Kind for dyn Sensor {
    type Opened = Opened;
    type Calls = SensorCalls;
    const CALLS: &'static SensorCalls = &CALLS;

    fn drivers(loaded: &Loaded) -> &Drivers<dyn Sensor> {
        &loaded.sensors
    }

    fn handle(sensor: Box<dyn Sensor>, _: &Facts) -> Handle<Opened> {
        let interrupt = sensor.interrupt_handle();
        Handle::new(Opened { sensor, frames: 0 }).interrupted_by(interrupt)
    }
}

static CALLS: SensorCalls = SensorCalls {
    device: device_calls::<SensorCalls, Opened>(extension),
    // Frames are written into the host's buffer, so none is lent.
    max_lent: 0,
    reserved: 0,
    start: Some(start),
    capture: Some(capture),
    stop: Some(stop),
};

static LIGHTING: SensorLightingCalls = SensorLightingCalls {
    #[expect(clippy::cast_possible_truncation, reason = "sixteen bytes")]
    size: size_of::<SensorLightingCalls>() as u32,
    reserved: 0,
    set: Some(set_light),
};

unsafe extern "C" fn extension(handle: *mut c_void, id: Text) -> *const c_void {
    let has = |opened: &mut Opened| opened.sensor.lighting().is_some();
    // SAFETY: the host lends the text for the call.
    unsafe { extended(handle, id, SENSOR_LIGHTING, &LIGHTING, has) }
}

unsafe extern "C" fn start(handle: *mut c_void, timeout_ns: u64, error: *mut Error) -> Status {
    let work = |opened: &mut Opened| Ok(opened.sensor.start(deadline(timeout_ns))?);
    // SAFETY: the host guarantees that `error` is valid.
    unsafe { call(handle, error, work) }
}

unsafe extern "C" fn stop(handle: *mut c_void, error: *mut Error) -> Status {
    // SAFETY: the host guarantees that `error` is valid.
    unsafe {
        call(handle, error, |opened: &mut Opened| {
            Ok(opened.sensor.stop()?)
        })
    }
}

unsafe extern "C" fn capture(
    handle: *mut c_void,
    frame: *mut Frame,
    timeout_ns: u64,
    error: *mut Error,
) -> Status {
    let work = |opened: &mut Opened| {
        // SAFETY: the host provides memory for the frame, which begins with its size.
        let frame = unsafe { memory::sized_place("frame", frame) }?;
        let info = opened.sensor.frame_info();
        let length = info.byte_len().ok_or_else(|| {
            Failure::new(
                ErrorKind::Internal,
                format!("frames of {info} exceed the address space"),
            )
        })?;
        let room = usize::try_from(frame.buffer_length).unwrap_or(usize::MAX);
        if room < length {
            let message =
                format!("a buffer of {room} bytes, expected {length} for a frame of {info}");
            return Err(Failure::argument(message));
        }
        // SAFETY: the host states the length of the buffer, and lends it for the call.
        let buffer = unsafe { memory::list_place("buffer", frame.buffer, length) }?;
        let into = FrameMut::new(info, buffer)
            .map_err(|error| Failure::new(ErrorKind::Internal, error.to_string()))?;
        frame.stamp = convert::stamp(&opened.sensor.capture(into, deadline(timeout_ns))?)?;
        (frame.width, frame.height) = (info.width, info.height);
        frame.format = format(info.format)?;
        (frame.data, frame.release) = (frame.buffer.cast_const(), None);
        frame.length = length as u64;
        opened.frames += 1;
        (frame.sequence, frame.flags) = match opened.sensor.sequence() {
            Some(number) => (number, FRAME_NUMBERED),
            None => (opened.frames, 0),
        };
        Ok(())
    };
    // SAFETY: the host guarantees that `error` is valid.
    unsafe { call(handle, error, work) }
}

fn format(format: PixelFormat) -> Result<AbiFormat, Failure> {
    match format {
        PixelFormat::Gray8 => Ok(AbiFormat::GRAY8),
        PixelFormat::Gray16 => Ok(AbiFormat::GRAY16),
        PixelFormat::Rgb8 => Ok(AbiFormat::RGB8),
        PixelFormat::Rgb16 => Ok(AbiFormat::RGB16),
        newer => {
            let message = format!(
                "the plugin interface has no pixel format for {}",
                newer.name()
            );
            Err(Failure::new(ErrorKind::Unsupported, message))
        }
    }
}

unsafe extern "C" fn set_light(
    handle: *mut c_void,
    scene: Text,
    timeout_ns: u64,
    error: *mut Error,
) -> Status {
    let work = |opened: &mut Opened| {
        // SAFETY: the host lends the text for the call.
        let scene = unsafe { memory::text("scene", scene) }?;
        let lighting = opened.sensor.lighting().ok_or_else(|| {
            Failure::new(
                ErrorKind::Unsupported,
                "the sensor does not control its lighting",
            )
        })?;
        Ok(lighting.set(scene, deadline(timeout_ns))?)
    };
    // SAFETY: the host guarantees that `error` is valid.
    unsafe { call(handle, error, work) }
}
