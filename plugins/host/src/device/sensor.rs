//! Sensor of a plugin. Every frame is checked before use.

#![expect(
    unsafe_code,
    reason = "frames are captured and released through the plugin's functions"
)]

use std::sync::Arc;
use std::time::{Duration, Instant};

use taceva_abi as abi;
use taceva_abi::ext::{SENSOR_LIGHTING, SensorLightingCalls};
use taceva_core::{
    Deadline, DriverError, DriverKind, ErrorKind, Facts, FrameInfo, FrameMut, Interrupt, Lighting,
    PixelFormat, SampleTiming, Sensor, SensorFacts, Stamp,
};

use super::handle::{Opened, Owned, PluginDevice};
use super::lighting::LightingAbility;
use crate::call::timeout;

/// Sensor of a plugin in this process.
pub struct PluginSensor {
    handle: Owned,
    calls: abi::SensorCalls,
    capture: Capture,
    info: FrameInfo,
    length: usize,
    lighting: Option<LightingAbility>,
    timing: SampleTiming,
    /// Sequence number of the last frame; `None` before the first frame, and if the device does not number frames.
    sequence: Option<u64>,
    /// Number of losses that the device flagged without a gap in its numbers.
    flagged: u64,
}

type Capture = unsafe extern "C" fn(
    *mut std::ffi::c_void,
    *mut abi::Frame,
    u64,
    *mut abi::Error,
) -> abi::Status;

/// Frame in the plugin's memory, borrowed for one callback.
#[derive(Clone, Copy, Debug)]
pub struct LentFrame<'a> {
    /// Width, height and pixel format.
    pub info: FrameInfo,
    /// Pixels, row by row from the top, without padding.
    pub bytes: &'a [u8],
    /// Times of exposure and reception.
    pub stamp: Stamp,
    /// Frame number. If the device assigned the number, a gap means lost frames.
    pub sequence: u64,
    /// True if frames were lost since the last frame.
    pub dropped: bool,
}

const OPENING: &str = "open the sensor";
const CAPTURING: &str = "capture a frame";

impl PluginDevice for PluginSensor {
    const KIND: DriverKind = DriverKind::Sensor;
    type Calls = abi::SensorCalls;
    type Facts = SensorFacts;

    fn facts(facts: &Facts) -> Option<&SensorFacts> {
        match facts {
            Facts::Sensor(facts) => Some(facts),
            _ => None,
        }
    }

    fn new(
        opened: Opened<abi::SensorCalls>,
        facts: &SensorFacts,
    ) -> Result<PluginSensor, DriverError> {
        let Opened { handle, calls } = opened;
        let capture = handle.needs(calls.capture, "capture")?;
        let info = facts.frame.ok_or_else(|| {
            let why = "the plugin does not declare the size of its frames with these arguments";
            handle.failed(ErrorKind::Abi, OPENING, why)
        })?;
        let length = info.byte_len().ok_or_else(|| {
            let why = format!("frames of {info} exceed the address space");
            handle.failed(ErrorKind::Abi, OPENING, why)
        })?;
        let lighting = if facts.scenes.is_empty() {
            None
        } else {
            let set = |table: SensorLightingCalls| table.set;
            let set = handle.ability(SENSOR_LIGHTING, OPENING, "it declares scenes", set)?;
            Some(LightingAbility::new(
                handle.share(),
                set,
                facts.scenes.clone(),
            ))
        };
        let timing = handle.timing(facts.rate);
        Ok(PluginSensor {
            timing,
            handle,
            calls,
            capture,
            info,
            length,
            lighting,
            sequence: None,
            flagged: 0,
        })
    }
}

impl PluginSensor {
    /// Waits for the next frame and passes it to `look` without a copy.
    ///
    /// # Errors
    /// As [`Sensor::capture`]; `Unsupported` if the plugin never lends its frames.
    pub fn lend<R>(
        &mut self,
        deadline: Deadline,
        look: impl FnOnce(LentFrame<'_>) -> R,
    ) -> Result<R, DriverError> {
        if self.calls.max_lent == 0 {
            let why = "it does not lend its frames";
            return Err(self.handle.failed(ErrorKind::Unsupported, CAPTURING, why));
        }
        let taken = self.take(std::ptr::null_mut(), deadline)?;
        let bytes = self.checked(&taken, None)?;
        Ok(look(LentFrame {
            info: self.info,
            bytes,
            stamp: stamp(taken.frame.stamp),
            sequence: taken.frame.sequence,
            dropped: taken.frame.flags & abi::FRAME_DROPPED != 0,
        }))
    }

    /// Captures the next frame. `buffer` has the length of a frame, or is NULL to borrow the frame.
    fn take(&mut self, buffer: *mut u8, deadline: Deadline) -> Result<Taken, DriverError> {
        let mut taken = Taken {
            frame: abi::Frame {
                size: u32::try_from(size_of::<abi::Frame>()).expect("a small struct"),
                format: abi::PixelFormat(0),
                width: 0,
                height: 0,
                flags: 0,
                reserved: 0,
                sequence: 0,
                stamp: abi::Stamp::default(),
                buffer,
                buffer_length: if buffer.is_null() {
                    0
                } else {
                    self.length as u64
                },
                data: std::ptr::null(),
                length: 0,
                release: None,
                private_data: std::ptr::null_mut(),
            },
        };
        let asked = Instant::now();
        let captured = self.handle.call(CAPTURING, |raw, error| {
            // SAFETY: [owner & started] by `&mut self` of the caller, with a frame, its buffer and an error that outlive the call.
            unsafe { (self.capture)(raw, &raw mut taken.frame, timeout(deadline), error) }
        });
        self.timing.wait(asked.elapsed());
        captured?;
        self.number(taken.frame.flags, taken.frame.sequence);
        let kept = (self.timing).sample(Instant::now(), stamp(taken.frame.stamp));
        kept.map_err(|error| {
            let why = error.to_string();
            self.handle.failed(ErrorKind::DeviceFault, CAPTURING, why)
        })?;
        Ok(taken)
    }

    /// Sets the sequence number of the last frame, which has `flags`. A flagged loss without a gap in the numbers of the device adds a gap.
    fn number(&mut self, flags: u32, number: u64) {
        let is_numbered = flags & abi::FRAME_NUMBERED != 0;
        let follows = self
            .sequence
            .is_some_and(|last| last.checked_add(1) == Some(number.saturating_add(self.flagged)));
        self.flagged += u64::from(follows && flags & abi::FRAME_DROPPED != 0);
        self.sequence = is_numbered.then(|| number.saturating_add(self.flagged));
    }

    /// Checks format, size and address of a frame and returns its pixels. A frame outside `buffer` must be lent.
    fn checked<'t>(
        &self,
        taken: &'t Taken,
        buffer: Option<*const u8>,
    ) -> Result<&'t [u8], DriverError> {
        let frame = &taken.frame;
        let refused = |kind, why: String| Err(self.handle.failed(kind, CAPTURING, why));
        let Some(format) = pixel_format(frame.format) else {
            let why = format!("unknown pixel format {}", frame.format.0);
            return refused(ErrorKind::Unsupported, why);
        };
        let found = FrameInfo {
            width: frame.width,
            height: frame.height,
            format,
        };
        if found != self.info {
            let why = format!("a frame of {found}, expected {}", self.info);
            return refused(ErrorKind::Protocol, why);
        }
        if frame.length != self.length as u64 {
            let why = format!(
                "a frame of {found} in {} bytes, expected {}",
                frame.length, self.length
            );
            return refused(ErrorKind::Protocol, why);
        }
        if frame.data.is_null() {
            return refused(
                ErrorKind::Protocol,
                "the frame's data pointer is NULL".to_owned(),
            );
        }
        let is_in_buffer = buffer.is_some_and(|buffer| std::ptr::eq(buffer, frame.data));
        if !is_in_buffer && frame.release.is_none() {
            let why = "a frame is outside the buffer but has no `release`, expected `release` in every frame that the plugin lends";
            return refused(ErrorKind::Abi, why.to_owned());
        }
        // SAFETY: not NULL, of the declared length, and lent until `release`, which `taken` calls on drop.
        Ok(unsafe { std::slice::from_raw_parts(frame.data, self.length) })
    }
}

/// A captured frame. Dropping it releases lent memory.
struct Taken {
    frame: abi::Frame,
}

impl Drop for Taken {
    fn drop(&mut self) {
        if let Some(release) = self.frame.release {
            // SAFETY: [any], once: `release` is set by the lender, and the pixels are no longer borrowed.
            unsafe { release(&raw mut self.frame) };
        }
    }
}

impl Sensor for PluginSensor {
    fn frame_info(&self) -> FrameInfo {
        self.info
    }

    fn start(&mut self, deadline: Deadline) -> Result<(), DriverError> {
        let Some(start) = self.calls.start else {
            return Ok(());
        };
        self.handle.call("start the sensor", |raw, error| {
            // SAFETY: [owner & open] by `&mut self`, with an error that outlives the call.
            unsafe { start(raw, timeout(deadline), error) }
        })
    }

    fn capture(
        &mut self,
        mut into: FrameMut<'_>,
        deadline: Deadline,
    ) -> Result<Stamp, DriverError> {
        if into.info() != self.info {
            let why = format!("a buffer for {}, expected {}", into.info(), self.info);
            let kind = ErrorKind::InvalidArgument;
            return Err(self.handle.failed(kind, CAPTURING, why));
        }
        let buffer = into.bytes_mut().as_mut_ptr();
        let taken = self.take(buffer, deadline)?;
        let stamp = stamp(taken.frame.stamp);
        let pixels = self.checked(&taken, Some(buffer))?.as_ptr();
        if !std::ptr::eq(pixels, buffer) {
            // SAFETY: `length` bytes can be read there and written here. `copy` instead of `copy_nonoverlapping`: a plugin may lend a part of the
            // buffer that it was given.
            unsafe { std::ptr::copy(pixels, buffer, self.length) };
        }
        Ok(stamp)
    }

    fn sequence(&self) -> Option<u64> {
        self.sequence
    }

    fn stop(&mut self) -> Result<(), DriverError> {
        let Some(stop) = self.calls.stop else {
            return Ok(());
        };
        self.handle.call("stop the sensor", |raw, error| {
            // SAFETY: [owner & open] by `&mut self`, with an error that outlives the call.
            unsafe { stop(raw, error) }
        })
    }

    fn interrupt_handle(&self) -> Option<Arc<dyn Interrupt>> {
        self.handle.interrupt()
    }

    fn lighting(&mut self) -> Option<&mut dyn Lighting> {
        let lighting = self.lighting.as_mut()?;
        Some(lighting)
    }
}

fn pixel_format(format: abi::PixelFormat) -> Option<PixelFormat> {
    match format {
        abi::PixelFormat::GRAY8 => Some(PixelFormat::Gray8),
        abi::PixelFormat::GRAY16 => Some(PixelFormat::Gray16),
        abi::PixelFormat::RGB8 => Some(PixelFormat::Rgb8),
        abi::PixelFormat::RGB16 => Some(PixelFormat::Rgb16),
        _ => None,
    }
}

/// Converts a time stamp.
pub(super) fn stamp(stamp: abi::Stamp) -> Stamp {
    let received = (stamp.received_ns != 0).then(|| Duration::from_nanos(stamp.received_ns));
    Stamp::new(Duration::from_nanos(stamp.valid_ns), received)
}
