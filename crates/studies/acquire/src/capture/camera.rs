//! Thread that captures frames.

use std::sync::mpsc::{SyncSender, TrySendError};
use std::time::{Duration, Instant};

use taceva_core::{
    Deadline, DriverError, DriverKey, DriverSource, ErrorKind, Frame, FrameInfo, FrameMut, Sensor,
    Stamp,
};

use super::device_error;
use super::predictor::LivePredictor;
use super::streams::Counts;

/// Capacity of the frame queue, in frames.
pub(super) const ROOM: usize = 8;
/// Deadline for each call that requests a frame.
const CALL: Deadline = Deadline::after(Duration::from_millis(100));
/// Time without a complete frame after which the camera counts as failed.
const PATIENCE: Duration = Duration::from_secs(3);
/// Delay before a failed call is retried.
const REST: Duration = Duration::from_millis(5);

/// A captured frame.
#[derive(Debug)]
pub(super) struct Taken {
    pub(super) frame: Frame,
    pub(super) stamp: Stamp,
    /// Image file as the camera sent it; `None` if the camera sent pixels.
    pub(super) sent: Option<Vec<u8>>,
}

/// Capture loop of a started sensor.
pub(super) struct Camera<'a> {
    pub(super) sensor: &'a mut dyn Sensor,
    pub(super) driver: &'a DriverKey,
    pub(super) source: DriverSource,
    pub(super) counts: &'a Counts,
    /// Predictor that receives the frames, if any.
    pub(super) predictor: Option<&'a LivePredictor<'a>>,
}

impl Camera<'_> {
    /// Adds frames to `queue` until the capture ends.
    ///
    /// # Errors
    /// The error that ended the stream of frames.
    pub(super) fn take(mut self, queue: &SyncSender<Taken>) -> Result<(), DriverError> {
        let info = self.sensor.frame_info();
        let mut last = None;
        let mut was_whole = Instant::now();
        while !self.counts.is_over() {
            let taken = self.next(info, &mut was_whole)?;
            let number = self.sensor.sequence();
            // A damaged frame also has a sequence number and is already counted.
            if let (Some(last), Some(number)) = (last, number) {
                self.counts.missed(last, number);
            }
            let Some(taken) = taken else {
                last = last.and(number);
                continue;
            };
            last = number;
            if let Some(predictor) = self.predictor {
                predictor.offer(&taken.frame, taken.stamp.valid_s, self.source);
            }
            if !self.put(queue, taken) {
                return Ok(());
            }
        }
        Ok(())
    }

    /// Requests the next frame; `None` if this call returned no frame.
    fn next(
        &mut self,
        info: FrameInfo,
        was_whole: &mut Instant,
    ) -> Result<Option<Taken>, DriverError> {
        let mut bytes = vec![0; info.byte_len().unwrap_or_default()];
        let into = FrameMut::new(info, &mut bytes)
            .map_err(|error| self.failed(ErrorKind::Internal, error.to_string()))?;
        match self.sensor.capture(into, CALL) {
            Ok(stamp) => {
                *was_whole = Instant::now();
                let frame = Frame::new(info, bytes)
                    .map_err(|error| self.failed(ErrorKind::Internal, error.to_string()))?;
                let sent = self.sensor.sent().map(<[u8]>::to_vec);
                Ok(Some(Taken { frame, stamp, sent }))
            }
            Err(error) => {
                let is_passing = match error.kind() {
                    ErrorKind::Protocol => {
                        self.counts.count_damaged();
                        std::thread::sleep(REST);
                        true
                    }
                    ErrorKind::Timeout => true,
                    ErrorKind::Interrupted => return Ok(None),
                    _ => false,
                };
                match is_passing {
                    true if was_whole.elapsed() < PATIENCE => Ok(None),
                    true => {
                        let why =
                            format!("no complete frame for {PATIENCE:?}; last error: {error}");
                        Err(self.failed(error.kind(), why))
                    }
                    false => Err(error),
                }
            }
        }
    }

    fn failed(&self, kind: ErrorKind, why: String) -> DriverError {
        device_error(kind, self.driver, "capture a frame", why)
    }

    /// Adds a frame to `queue`. Returns false if the receiver no longer exists. If the queue is full, a frame of a real device is dropped, and a
    /// simulated or replayed device waits.
    fn put(&self, queue: &SyncSender<Taken>, taken: Taken) -> bool {
        if self.source != DriverSource::Real {
            return queue.send(taken).is_ok();
        }
        match queue.try_send(taken) {
            Ok(()) => true,
            Err(TrySendError::Full(_)) => {
                self.counts.count_dropped();
                true
            }
            Err(TrySendError::Disconnected(_)) => false,
        }
    }
}
