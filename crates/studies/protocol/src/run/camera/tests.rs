//! Tests of accepted and retried frames.

use taceva_core::{DriverError, FrameInfo, PixelFormat};

use super::*;
use crate::run::rig::{Rig, nothing, with_tip};

/// Test camera. Returns frames with the given capture times, in s, and repeats the last one.
pub(in crate::run) struct Album(pub(in crate::run) Vec<f64>);

impl Sensor for Album {
    fn frame_info(&self) -> FrameInfo {
        FrameInfo {
            width: 1,
            height: 1,
            format: PixelFormat::Gray8,
        }
    }
    fn capture(&mut self, _: FrameMut<'_>, _: Deadline) -> Result<Stamp, DriverError> {
        let valid_s = self.0[0];
        if self.0.len() > 1 {
            self.0.remove(0);
        }
        Ok(Stamp {
            valid_s,
            received_s: None,
        })
    }
}

/// Test camera like `Album`, but frames arrive 10 ms after capture and wait until they are read.
struct Stream(Album);

impl Sensor for Stream {
    fn frame_info(&self) -> FrameInfo {
        self.0.frame_info()
    }
    fn capture(&mut self, into: FrameMut<'_>, deadline: Deadline) -> Result<Stamp, DriverError> {
        let stamp = self.0.capture(into, deadline)?;
        Ok(Stamp {
            received_s: Some(stamp.valid_s + 0.01),
            ..stamp
        })
    }
}

/// Captures a frame of a tip that rests since 4.5 s, from a camera with the capture `times`. Returns the number of retries and the capture time.
fn taken(times: &[f64]) -> (u32, Result<f64, StopCause>) {
    taken_by(&mut Album(times.to_vec()))
}

fn taken_by(sensor: &mut dyn Sensor) -> (u32, Result<f64, StopCause>) {
    let mut retried = 0;
    let frame = with_tip(&Rig::new(-3.0, nothing), |tip| {
        let mut note = |event: &Event| retried += u32::from(matches!(event, Event::FrameRetried));
        let mut camera = Camera::new(sensor);
        camera.frame(4.5, tip, &mut note)
    });
    (retried, frame.map(|(_, stamp)| stamp.valid_s))
}

#[test]
fn a_picture_of_before_the_rest_or_of_another_clock_is_asked_for_again() {
    let (retried, time_s) = taken(&[4.25, 5.25, 4.499, 4.75]);
    // Only the frame of another clock counts as lost.
    assert_eq!((retried, time_s.ok()), (1, Some(4.75)));
    let (retried, time_s) = taken(&[4.5]);
    assert_eq!((retried, time_s.ok()), (0, Some(4.5)));
}

#[test]
fn a_sensor_that_gives_only_old_pictures_is_given_up() {
    let (retried, error) = taken(&[4.0]);
    assert_eq!(retried, 0);
    let error = error.expect_err("no news").to_string();
    assert!(error.starts_with("10 frames in a row were lost"), "{error}");
}

#[test]
fn a_picture_that_waited_for_whoever_asks_is_none_that_was_asked_for_again() {
    let streamed = |times: &[f64]| {
        let (retried, time_s) = taken_by(&mut Stream(Album(times.to_vec())));
        (retried, time_s.ok())
    };
    assert_eq!(streamed(&[4.25, 4.75]), (0, Some(4.75)));
    // Frames that arrive after the call but have stamps of another clock.
    assert_eq!(streamed(&[4.25, 5.25, 4.75]), (1, Some(4.75)));
    assert_eq!(streamed(&[4.0]), (0, None));
}
