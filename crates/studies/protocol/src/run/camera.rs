//! Captures frames while the tip rests.

mod cycle;
mod freeze;
mod moment;

use std::time::Duration;

use taceva_core::{Deadline, ErrorKind, Frame, FrameMut, Sensor, Stamp};

use super::error::StopCause;
use super::event::Event;
use super::tip::{Step, Tip};
use freeze::Freeze;
use moment::Moment;

/// Number of failed attempts at one frame after which the run stops. An attempt fails if the frame is lost, damaged or outdated.
const FRAME_TRIES: u32 = 10;
/// Deadline for one frame.
const FRAME_DEADLINE: Deadline = Deadline::after(Duration::from_secs(1));
/// Maximum time by which a frame may be ahead of the run clock, in s. A greater difference means that another clock stamps the frames.
const AHEAD_S: f64 = 0.001;

/// A sensor that captures frames.
pub(super) struct Camera<'a> {
    pub(super) sensor: &'a mut dyn Sensor,
    freeze: Freeze,
}

impl<'a> Camera<'a> {
    pub(super) fn new(sensor: &'a mut dyn Sensor) -> Camera<'a> {
        Camera {
            sensor,
            freeze: Freeze::default(),
        }
    }

    /// Records that the tip has left the gel since the last frame.
    pub(super) fn leave(&mut self) {
        self.freeze.leave();
    }

    /// First valid frame captured at or after `from_s`. Fails if the camera repeats an earlier frame although the force changed.
    pub(super) fn frame(
        &mut self,
        from_s: f64,
        tip: &Tip<'_>,
        events: &mut dyn FnMut(&Event),
    ) -> Step<(Frame, Stamp)> {
        let info = self.sensor.frame_info();
        let too_large = || StopCause::Missing(format!("memory for frames of {info}"));
        let mut last = None;
        for _ in 0..FRAME_TRIES {
            let mut bytes = vec![0; info.byte_len().ok_or_else(too_large)?];
            let into = FrameMut::new(info, &mut bytes)
                .expect("the buffer was made with the length of the frame");
            match self.sensor.capture(into, FRAME_DEADLINE) {
                Ok(stamp) if is_news(&stamp, from_s, tip.clock.now_s()) => {
                    let frame = Frame::new(info, bytes)
                        .expect("the buffer was made with the length of the frame");
                    if self.freeze.is_frozen(&frame, Moment::of(tip)) {
                        events(&Event::FrameFrozen);
                        return Err(StopCause::FrozenFrame);
                    }
                    return Ok((frame, stamp));
                }
                // A frame from before `from_s` is neither lost nor damaged, so it gives no event.
                Ok(stamp) if stamp.valid_s < from_s => {}
                Ok(_) => events(&Event::FrameRetried),
                Err(error) if [ErrorKind::Timeout, ErrorKind::Protocol].contains(&error.kind()) => {
                    last = Some(error.to_string());
                    events(&Event::FrameRetried);
                }
                Err(error) => return Err(StopCause::Device(error)),
            }
        }
        Err(StopCause::Frames {
            attempts: FRAME_TRIES,
            last,
        })
    }
}

/// True if a frame was captured between `from_s` and now.
fn is_news(stamp: &Stamp, from_s: f64, now_s: f64) -> bool {
    (from_s..=now_s + AHEAD_S).contains(&stamp.valid_s)
}

#[cfg(test)]
pub(super) mod tests;
