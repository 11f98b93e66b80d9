//! A tactile sensor with a camera behind its gel.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::{Deadline, DriverError, Interrupt, Lighting};
use crate::frame::{FrameInfo, FrameMut};
use crate::stamp::Stamp;

/// A sensor that captures pictures of its gel.
///
/// ```
/// use std::time::Duration;
/// use taceva_core::{Deadline, DriverError, FrameInfo, FrameMut, PixelFormat, Sensor, Stamp};
///
/// /// Returns gray frames.
/// struct Gray;
///
/// impl Sensor for Gray {
///     fn frame_info(&self) -> FrameInfo {
///         FrameInfo { width: 4, height: 2, format: PixelFormat::Gray8 }
///     }
///     fn capture(&mut self, mut into: FrameMut<'_>, _: Deadline) -> Result<Stamp, DriverError> {
///         into.bytes_mut().fill(128);
///         Ok(Stamp::at(Duration::ZERO))
///     }
/// }
///
/// let mut sensor = Gray;
/// let info = sensor.frame_info();
/// let mut bytes = vec![0; info.byte_len().expect("8 bytes")];
/// sensor.capture(FrameMut::new(info, &mut bytes)?, Deadline::PASSED)?;
/// assert_eq!(bytes, [128; 8]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait Sensor: Send {
    /// Size and format of every frame. Both are constant while the sensor is open.
    fn frame_info(&self) -> FrameInfo;

    /// Starts the capture of frames. Does nothing if the sensor needs no start.
    ///
    /// # Errors
    /// [`DriverError`] if the device does not answer within `deadline`, is in use by another program, or is disconnected.
    fn start(&mut self, deadline: Deadline) -> Result<(), DriverError> {
        let _ = deadline;
        Ok(())
    }

    /// Waits for the next frame, writes its pixels into the caller's buffer and returns its time stamp.
    ///
    /// Frames arrive in the order of their stamps, each at most once. A frame may be missing if the caller was too slow.
    /// After an error the buffer has no valid frame.
    ///
    /// # Errors
    /// [`DriverError`] of kind
    /// - `InvalidArgument` if the size or format of `into` is not [`frame_info`](Sensor::frame_info), or the sensor must be started first,
    /// - `Timeout` if no frame arrived within `deadline`,
    /// - `Protocol` for an incomplete frame; the next call may succeed,
    /// - `Disconnected` or `EndOfStream` if no further frame can arrive.
    fn capture(&mut self, into: FrameMut<'_>, deadline: Deadline) -> Result<Stamp, DriverError>;

    /// Sequence number of the last frame; `None` if neither the device nor its link numbers frames. The first number is arbitrary. A gap
    /// between two numbers means that frames were lost, or not read in time.
    fn sequence(&self) -> Option<u64> {
        None
    }

    /// PNG or JPEG file from which the last frame was decoded; `None` if the device sends no files. A recording may store the file unchanged.
    fn sent(&self) -> Option<&[u8]> {
        None
    }

    /// Stops the capture of frames; may be called in every state.
    ///
    /// # Errors
    /// [`DriverError`] if the device does not confirm the stop.
    fn stop(&mut self) -> Result<(), DriverError> {
        Ok(())
    }

    /// Handle that interrupts a pending call from another thread. If `None`, a call lasts until its deadline.
    fn interrupt_handle(&self) -> Option<Arc<dyn Interrupt>> {
        None
    }

    /// Settings read from the camera, by name, such as `exposure_ms` with `15.7`. A recording stores them. Empty if no setting is known.
    fn settings(&self) -> BTreeMap<String, String> {
        BTreeMap::new()
    }

    /// True if the frames have time stamps of the host's clock. If false, the drift of the device's clock is subtracted from the stamps. A sensor
    /// of a plugin always returns false.
    fn is_stamped_by_host(&self) -> bool {
        false
    }

    /// Control of the light around this sensor; `None` if the sensor cannot set this light.
    fn lighting(&mut self) -> Option<&mut dyn Lighting> {
        None
    }
}
