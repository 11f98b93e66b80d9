//! Adapter that puts a real sensor on the clock of a simulated bench.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

use taceva_core::{
    Deadline, DriverError, FrameInfo, FrameMut, Interrupt, Lighting, Sensor, SimulatedBench, Stamp,
};

/// Sensor that is not simulated, with time stamps on the clock of a simulated bench.
///
/// Between two frames, at least as much time passes on the bench as on the sensor's clock. More time passes if other devices keep the bench busy. The
/// bench does not simulate the sensor, so its frames show presses only if the real sensor is pressed.
pub struct OnBench {
    sensor: Box<dyn Sensor>,
    bench: Arc<dyn SimulatedBench>,
    /// Times of the last frame, on the sensor's clock and on the clock of the bench; `None` before the first frame.
    last: Option<[Duration; 2]>,
}

impl OnBench {
    /// Wraps `sensor`, so that its frames have time stamps on the clock of `bench`.
    pub fn new(sensor: Box<dyn Sensor>, bench: Arc<dyn SimulatedBench>) -> OnBench {
        OnBench {
            sensor,
            bench,
            last: None,
        }
    }
}

impl Sensor for OnBench {
    fn frame_info(&self) -> FrameInfo {
        self.sensor.frame_info()
    }

    fn start(&mut self, deadline: Deadline) -> Result<(), DriverError> {
        self.sensor.start(deadline)
    }

    fn capture(&mut self, into: FrameMut<'_>, deadline: Deadline) -> Result<Stamp, DriverError> {
        let own = self.sensor.capture(into, deadline)?.valid();
        if let Some([last, on_bench]) = self.last {
            let due = on_bench + own.saturating_sub(last);
            self.bench.rest(due.saturating_sub(self.bench.now()))?;
        }
        let now = self.bench.now();
        self.last = Some([own, now]);
        Ok(Stamp::at(now))
    }

    fn sequence(&self) -> Option<u64> {
        self.sensor.sequence()
    }

    fn sent(&self) -> Option<&[u8]> {
        self.sensor.sent()
    }

    fn stop(&mut self) -> Result<(), DriverError> {
        self.sensor.stop()
    }

    fn interrupt_handle(&self) -> Option<Arc<dyn Interrupt>> {
        self.sensor.interrupt_handle()
    }

    fn settings(&self) -> BTreeMap<String, String> {
        self.sensor.settings()
    }

    fn lighting(&mut self) -> Option<&mut dyn Lighting> {
        self.sensor.lighting()
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Mutex;

    use taceva_core::{PixelFormat, Specimen};

    use super::*;

    const FRAME: FrameInfo = FrameInfo {
        width: 1,
        height: 1,
        format: PixelFormat::Gray8,
    };

    /// Sensor whose next frames have the listed time stamps, ms.
    struct Timed(Vec<u64>);

    impl Sensor for Timed {
        fn frame_info(&self) -> FrameInfo {
            FRAME
        }

        fn capture(&mut self, _: FrameMut<'_>, _: Deadline) -> Result<Stamp, DriverError> {
            let time_ms = self.0.remove(0);
            Ok(Stamp::at(Duration::from_millis(time_ms)))
        }
    }

    /// Sensor that numbers its frames from 41 and provides each frame as a file.
    #[derive(Default)]
    struct Sending {
        frames: u64,
        file: Vec<u8>,
    }

    impl Sensor for Sending {
        fn frame_info(&self) -> FrameInfo {
            FRAME
        }

        fn capture(&mut self, _: FrameMut<'_>, _: Deadline) -> Result<Stamp, DriverError> {
            self.frames += 1;
            self.file = format!("file {}", self.frames).into_bytes();
            Ok(Stamp::at(Duration::from_millis(10 * self.frames)))
        }

        fn sequence(&self) -> Option<u64> {
            Some(40 + self.frames)
        }

        fn sent(&self) -> Option<&[u8]> {
            Some(&self.file)
        }
    }

    /// Bench that only provides a clock.
    struct Clock(Mutex<Duration>);

    impl SimulatedBench for Clock {
        fn now(&self) -> Duration {
            *self.0.lock().expect("whole")
        }

        fn rest(&self, rest: Duration) -> Result<(), DriverError> {
            *self.0.lock().expect("whole") += rest;
            Ok(())
        }

        fn mount(&self, _: Specimen) -> Result<(), DriverError> {
            Ok(())
        }

        fn name_press(&self, _: u64) -> Result<(), DriverError> {
            Ok(())
        }

        fn schedule(&self, _: Duration) -> Result<(), DriverError> {
            Ok(())
        }

        fn provenance(&self) -> Option<String> {
            None
        }
    }

    #[test]
    fn frames_are_stamped_by_the_bench_on_which_no_less_time_passes_than_between_them() {
        let bench = Arc::new(Clock(Mutex::new(Duration::from_secs(7))));
        let times_ms = vec![500, 510, 510, 540, 570, 600];
        let mut sensor = OnBench::new(Box::new(Timed(times_ms)), bench.clone());
        let mut byte = [0];
        let mut stamp_ms = || {
            let into = FrameMut::new(FRAME, &mut byte).expect("a byte");
            let stamp = sensor.capture(into, Deadline::after(Duration::from_secs(1)));
            stamp.expect("a frame").valid().as_millis()
        };
        assert_eq!([stamp_ms(), stamp_ms(), stamp_ms()], [7_000, 7_010, 7_010]);
        // Time that other devices spent before the next frame is not counted twice.
        bench.rest(Duration::from_millis(20)).expect("it rests");
        assert_eq!(stamp_ms(), 7_040);
        bench.rest(Duration::from_secs(1)).expect("it rests");
        assert_eq!([stamp_ms(), stamp_ms()], [8_040, 8_070]);
    }

    #[test]
    fn a_frame_keeps_the_number_and_the_file_that_its_camera_gave_it() {
        let bench = Arc::new(Clock(Mutex::new(Duration::ZERO)));
        let mut sensor = OnBench::new(Box::new(Sending::default()), bench);
        let mut byte = [0];
        for frame in 1..=2 {
            let into = FrameMut::new(FRAME, &mut byte).expect("a byte");
            let taken = sensor.capture(into, Deadline::PASSED);
            taken.expect("a frame");
            assert_eq!(sensor.sequence(), Some(40 + frame));
            let file = format!("file {frame}");
            assert_eq!(sensor.sent(), Some(file.as_bytes()));
        }
    }
}
