//! Replay of a recording as a live sensor.

mod factory;
mod timeline;

pub use factory::ReplayFactory;

use taceva_core::{
    Deadline, DriverError, DriverKey, ErrorKind, FrameInfo, FrameMut, Sensor, Stamp,
};

use crate::pace::Pace;
use crate::source::FrameSource;
use timeline::Timeline;

/// A sensor that replays recorded frames.
///
/// In virtual time every frame is delivered on request, stamped with its recorded time. In real time, a frame is delivered when due, stamped on the
/// clock of the rig. A slow caller then misses frames. A call for an unreadable frame returns an error; the next call returns the next frame.
pub struct Replay {
    source: Box<dyn FrameSource>,
    pace: Box<dyn Pace>,
    driver: DriverKey,
    timeline: Timeline,
    /// Number of frames that were delivered, missed or unreadable.
    passed: usize,
    running: bool,
}

/// Options of a replay.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ReplayOptions {
    /// Key of the driver in error messages.
    pub driver: DriverKey,
    /// True to restart after the last frame instead of ending.
    pub repeat: bool,
}

impl Replay {
    /// Creates a sensor that delivers the frames of `source`, timed by the clock `pace`.
    pub fn new(
        source: Box<dyn FrameSource>,
        pace: Box<dyn Pace>,
        options: ReplayOptions,
    ) -> Replay {
        Replay {
            timeline: Timeline::new(source.times_s().to_vec(), options.repeat),
            source,
            pace,
            driver: options.driver,
            passed: 0,
            running: false,
        }
    }

    fn refused(
        &self,
        kind: ErrorKind,
        why: impl Into<Box<dyn std::error::Error + Send + Sync>>,
    ) -> DriverError {
        DriverError::new(kind, &self.driver, "capture a frame").because(why)
    }
}

impl Sensor for Replay {
    fn frame_info(&self) -> FrameInfo {
        self.source.info()
    }

    fn start(&mut self, _: Deadline) -> Result<(), DriverError> {
        if !self.running
            && let Some(due_s) = self.timeline.time_s(self.passed)
        {
            if self.pace.runs_by_itself() {
                self.timeline.shift(self.pace.now_s() - due_s);
            } else {
                self.pace.wait_until(due_s);
            }
        }
        self.running = true;
        Ok(())
    }

    fn capture(&mut self, into: FrameMut<'_>, deadline: Deadline) -> Result<Stamp, DriverError> {
        let info = self.source.info();
        if into.info() != info {
            let problem = format!("a buffer for {}, expected {info}", into.info());
            return Err(self.refused(ErrorKind::InvalidArgument, problem));
        }
        if !self.running {
            return Err(self.refused(ErrorKind::InvalidArgument, "the sensor is not started"));
        }
        let now_s = self.pace.now_s();
        if self.pace.runs_by_itself() {
            // A late caller gets the newest frame and misses earlier ones.
            self.passed = self.passed.max(self.timeline.newest(now_s));
        }
        let Some(due_s) = self.timeline.time_s(self.passed) else {
            return Err(self.refused(ErrorKind::EndOfStream, "the recording has ended"));
        };
        let patience_s = deadline.remaining().as_secs_f64();
        if due_s - now_s > patience_s {
            self.pace.wait_until(now_s + patience_s);
            let problem = format!("no frame within {deadline}");
            return Err(self.refused(ErrorKind::Timeout, problem));
        }
        self.pace.wait_until(due_s);
        let position = self.timeline.position(self.passed);
        self.passed += 1;
        self.source
            .read(position, into)
            .map_err(|fault| self.refused(fault.kind(), fault))?;
        Ok(Stamp {
            valid_s: due_s,
            // The latency of a recording is unknown. In real time, it is the time to read the file.
            received_s: self
                .pace
                .runs_by_itself()
                .then(|| self.pace.now_s().max(due_s)),
        })
    }

    fn stop(&mut self) -> Result<(), DriverError> {
        self.running = false;
        Ok(())
    }
}
