//! Opens one device by its selector, and wraps it with checks of its time stamps.

use taceva_core::{Descriptor, Device, DriverSource, Facts, Registry, Rig, SampleTiming};
use taceva_drivers::{OpenError, Selector, open};

use super::clock_follower::ClockFollower;
use super::latency::{IntoDevice, Late};

/// An open device with its descriptor.
pub(crate) struct Opened<D: ?Sized> {
    pub(crate) device: Box<D>,
    pub(crate) descriptor: Descriptor,
    pub(crate) selector: Selector,
}

impl<D: Device + ?Sized> Opened<D> {
    /// Opens the device of `selector`. The descriptor reflects the arguments of the selector.
    pub(crate) fn open(
        registry: &Registry<D>,
        selector: Selector,
        shared: &mut Rig,
    ) -> Result<Opened<D>, OpenError> {
        let device = open(registry, &selector, shared)?;
        let factory = registry
            .get(selector.driver())
            .expect("the device was opened by this key");
        let arguments = factory.descriptor().args(selector.arguments());
        let described = arguments
            .ok()
            .and_then(|arguments| factory.describe(&arguments).ok());
        Ok(Opened {
            device,
            descriptor: described.unwrap_or_else(|| factory.descriptor().clone()),
            selector,
        })
    }
}

impl<D: ?Sized + 'static> Opened<D>
where
    Late<D>: IntoDevice<D>,
{
    /// Wraps the device: samples with a known latency get earlier time stamps, and the drift of a camera's clock is removed. The timing of samples is
    /// checked.
    pub(crate) fn timely(
        self,
        is_emulated: bool,
        latency_ms: impl Fn(&Descriptor) -> Option<f64>,
    ) -> Box<D> {
        let latency_ms = latency_ms(&self.descriptor).unwrap_or(0.0);
        let timing = timing(&self.descriptor, is_emulated);
        if latency_ms <= 0.0 && timing.is_none() {
            return self.device;
        }
        let driver = self.descriptor.key().clone();
        let follower = timing.is_some().then(ClockFollower::default);
        let timing = timing.unwrap_or_else(SampleTiming::unchecked);
        let late = Late::new(self.device, driver, latency_ms, timing);
        late.with_follower(follower).boxed()
    }
}

/// Timing checks of a real sensor or transducer; `None` for other devices. An emulated device may be late, so only jumps of its time stamps are
/// checked.
fn timing(descriptor: &Descriptor, is_emulated: bool) -> Option<SampleTiming> {
    let rate = match descriptor.facts() {
        Facts::Sensor(facts) => facts.rate,
        Facts::Force(facts) => facts.rate,
        _ => return None,
    };
    let is_real = descriptor.source() == DriverSource::Real;
    is_real.then(|| match is_emulated {
        true => SampleTiming::of(None),
        false => SampleTiming::of(rate).with_unit_check(),
    })
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use taceva_core::{
        Axes, Deadline, DescriptorSpec, DriverError, DriverKey, ErrorKind, ForceFacts,
        ForceTransducer, FrameInfo, FrameMut, Hertz, PixelFormat, Sensor, SensorFacts, Stamp,
        Wrench,
    };
    use taceva_drivers::MonotonicClock;

    use super::*;

    const HOUR: Duration = Duration::from_secs(3600);
    const FRAME: FrameInfo = FrameInfo {
        width: 1,
        height: 1,
        format: PixelFormat::Gray8,
    };

    /// Test device that delays each sample by the next entry of `delays`.
    struct Slow {
        delays: std::vec::IntoIter<Duration>,
    }

    impl Slow {
        /// Test device as its driver would open it.
        fn opened(
            source: DriverSource,
            rate: Hertz,
            delays: Vec<Duration>,
        ) -> Opened<dyn ForceTransducer> {
            let facts = ForceFacts::default()
                .with_axes(Axes::NORMAL)
                .with_rate(rate);
            let device = Slow {
                delays: delays.into_iter(),
            };
            opened::<dyn ForceTransducer>(Box::new(device), source, Facts::Force(facts))
        }
    }

    impl ForceTransducer for Slow {
        fn axes(&self) -> Axes {
            Axes::NORMAL
        }

        fn read(&mut self, _: Deadline) -> Result<(Wrench, Stamp), DriverError> {
            std::thread::sleep(self.delays.next().expect("a delay for each reading"));
            Ok((Wrench::default(), Stamp::at(MonotonicClock.now())))
        }
    }

    impl Sensor for Slow {
        fn frame_info(&self) -> FrameInfo {
            FRAME
        }

        fn capture(&mut self, _: FrameMut<'_>, _: Deadline) -> Result<Stamp, DriverError> {
            std::thread::sleep(self.delays.next().expect("a delay for each frame"));
            Ok(Stamp::at(MonotonicClock.now()))
        }
    }

    /// Test camera whose clock jumps ahead by an hour once.
    struct Jumping {
        frames: u32,
    }

    impl Jumping {
        fn opened(source: DriverSource) -> Opened<dyn Sensor> {
            let facts = SensorFacts::default().with_frame(FRAME);
            let facts = Facts::Sensor(Box::new(facts));
            opened::<dyn Sensor>(Box::new(Jumping { frames: 0 }), source, facts)
        }
    }

    impl Sensor for Jumping {
        fn frame_info(&self) -> FrameInfo {
            FRAME
        }

        fn capture(&mut self, _: FrameMut<'_>, _: Deadline) -> Result<Stamp, DriverError> {
            self.frames += 1;
            let now = MonotonicClock.now();
            Ok(Stamp::at(if self.frames > 2 { now + HOUR } else { now }))
        }
    }

    /// Test transducer at 25 Hz that stamps its readings in another unit than nanoseconds.
    struct OfUnit {
        nanoseconds: u64,
    }

    impl ForceTransducer for OfUnit {
        fn axes(&self) -> Axes {
            Axes::NORMAL
        }

        fn read(&mut self, _: Deadline) -> Result<(Wrench, Stamp), DriverError> {
            std::thread::sleep(Duration::from_millis(40));
            let count = MonotonicClock.now().as_nanos() / u128::from(self.nanoseconds);
            let stamp = Duration::from_nanos(u64::try_from(count).expect("a time since start"));
            Ok((Wrench::default(), Stamp::at(stamp)))
        }
    }

    fn opened<D: ?Sized>(device: Box<D>, source: DriverSource, facts: Facts) -> Opened<D> {
        let key = DriverKey::fixed("test/device");
        let spec = DescriptorSpec::new(key, "a device of this test", source, facts);
        Opened {
            device,
            descriptor: spec.check().expect("no contradiction"),
            selector: "test/device".parse().expect("a selector"),
        }
    }

    /// Number of readings before the first error, and this error.
    fn readings(device: &mut dyn ForceTransducer, count: usize) -> (usize, Option<DriverError>) {
        for number in 0..count {
            if let Err(error) = device.read(Deadline::PASSED) {
                return (number, Some(error));
            }
        }
        (count, None)
    }

    /// Delays of `count` readings: 55 ms each, which is eleven periods at 200 Hz.
    fn eleven_periods(count: usize) -> Vec<Duration> {
        vec![Duration::from_millis(55); count]
    }

    #[test]
    fn a_transducer_that_is_ten_times_too_slow_for_ten_readings_is_an_error_of_that_device() {
        let slow = Slow::opened(DriverSource::Real, Hertz(200.0), eleven_periods(10));
        let (read, error) = readings(&mut *slow.timely(false, |_| None), 10);
        let error = error.expect("the tenth");
        assert_eq!((read, error.kind()), (9, ErrorKind::DeviceFault));
        let error = error.to_string();
        assert!(
            error.starts_with("test/device: cannot read the force: 10 samples in a row"),
            "{error}"
        );
    }

    #[test]
    fn a_sensor_that_is_ten_times_too_slow_for_ten_frames_is_an_error_of_that_device() {
        let facts = SensorFacts::default()
            .with_frame(FRAME)
            .with_rate(Hertz(200.0));
        let device = Slow {
            delays: eleven_periods(10).into_iter(),
        };
        let facts = Facts::Sensor(Box::new(facts));
        let slow = opened::<dyn Sensor>(Box::new(device), DriverSource::Real, facts);
        let mut slow = slow.timely(false, |_| None);
        let mut bytes = [0];
        let errors = (0..10).filter_map(|number| {
            let frame = FrameMut::new(FRAME, &mut bytes).expect("a byte");
            let error = slow.capture(frame, Deadline::PASSED).err()?;
            Some((number, error))
        });
        let errors: Vec<(usize, DriverError)> = errors.collect();
        assert_eq!(errors.len(), 1, "{errors:?}");
        let (number, error) = &errors[0];
        assert_eq!((*number, error.kind()), (9, ErrorKind::DeviceFault));
        assert!(error.to_string().contains("10 samples in a row"), "{error}");
    }

    #[test]
    fn an_emulated_or_simulated_transducer_may_be_slow() {
        for (source, is_emulated) in [
            (DriverSource::Real, true),
            (DriverSource::Simulated, false),
            (DriverSource::Recorded, false),
        ] {
            let slow = Slow::opened(source, Hertz(200.0), eleven_periods(10));
            let (read, error) = readings(&mut *slow.timely(is_emulated, |_| None), 10);
            assert!(error.is_none(), "{source}, reading {read}: {error:?}");
        }
    }

    #[test]
    fn a_sensor_whose_stamps_jump_by_an_hour_is_refused_unless_its_time_is_its_own() {
        for (source, is_emulated, is_refused) in [
            (DriverSource::Real, false, true),
            (DriverSource::Real, true, true),
            (DriverSource::Simulated, false, false),
            (DriverSource::Recorded, false, false),
        ] {
            let mut sensor = Jumping::opened(source).timely(is_emulated, |_| None);
            let mut bytes = [0];
            let mut capture = || {
                let frame = FrameMut::new(FRAME, &mut bytes).expect("a byte");
                sensor.capture(frame, Deadline::PASSED)
            };
            capture().expect("the first");
            capture().expect("the second");
            // The device stays rejected after a jump.
            for _ in 0..2 {
                let third = capture();
                assert_eq!(third.is_err(), is_refused, "{source}: {third:?}");
                if let Err(error) = third {
                    assert_eq!(error.kind(), ErrorKind::DeviceFault);
                    assert!(error.to_string().contains("the stamps jump"), "{error}");
                }
            }
        }
    }

    /// Test camera with 500 frames a second, whose clock is too fast by 900 ppm.
    struct Drifting {
        begun_s: f64,
        is_stamped_by_host: bool,
    }

    impl Sensor for Drifting {
        fn frame_info(&self) -> FrameInfo {
            FRAME
        }

        fn capture(&mut self, _: FrameMut<'_>, _: Deadline) -> Result<Stamp, DriverError> {
            std::thread::sleep(Duration::from_millis(2));
            let now_s = MonotonicClock.now_s();
            Ok(Stamp {
                valid_s: now_s + 900e-6 * (now_s - self.begun_s),
                received_s: Some(now_s),
            })
        }

        fn is_stamped_by_host(&self) -> bool {
            self.is_stamped_by_host
        }
    }

    mod waiting {
        use super::*;

        #[test]
        fn a_transducer_whose_stamps_are_in_milliseconds_is_refused_unless_its_time_is_its_own() {
            for (source, nanoseconds, is_refused) in [
                (DriverSource::Real, 1, false),
                (DriverSource::Real, 1_000_000, true),
                (DriverSource::Simulated, 1_000_000, false),
            ] {
                let facts = ForceFacts::default()
                    .with_axes(Axes::NORMAL)
                    .with_rate(Hertz(25.0));
                let device = Box::new(OfUnit { nanoseconds });
                let facts = Facts::Force(facts);
                let force = opened::<dyn ForceTransducer>(device, source, facts);
                let (read, error) = readings(&mut *force.timely(false, |_| None), 40);
                assert_eq!(error.is_some(), is_refused, "{source}, {read}: {error:?}");
                let Some(error) = error else { continue };
                assert_eq!(error.kind(), ErrorKind::DeviceFault);
                let error = error.to_string();
                let unit = "milliseconds where nanoseconds are expected";
                assert!(error.contains(unit), "{error}");
            }
        }

        #[test]
        fn the_drift_of_a_camera_is_taken_off_its_stamps_unless_it_is_recorded_or_the_host_stamps_it()
         {
            for (source, is_stamped_by_host, is_followed) in [
                (DriverSource::Real, false, true),
                (DriverSource::Real, true, false),
                (DriverSource::Recorded, false, false),
            ] {
                let facts = SensorFacts::default().with_frame(FRAME);
                let facts = Facts::Sensor(Box::new(facts));
                let begun_s = MonotonicClock.now_s();
                let device = Box::new(Drifting {
                    begun_s,
                    is_stamped_by_host,
                });
                let camera = opened::<dyn Sensor>(device, source, facts);
                // A latency wraps a device whose timing is not checked, too.
                let mut camera = camera.timely(false, |_| Some(1.0));
                assert_eq!(camera.is_stamped_by_host(), is_stamped_by_host);
                let mut off_s = 0.0;
                while MonotonicClock.now_s() < begun_s + 4.0 {
                    let mut bytes = [0];
                    let frame = FrameMut::new(FRAME, &mut bytes).expect("a byte");
                    let stamp = camera.capture(frame, Deadline::PASSED).expect("a frame");
                    off_s = stamp.valid_s - stamp.received_s.expect("stated") + 1e-3;
                }
                let drifted_s = if is_followed { 0.0 } else { 3.6e-3 };
                assert!((off_s - drifted_s).abs() < 1e-3, "{source}: {off_s}");
                let settings = camera.settings();
                let ppm = settings.get("sensor_clock_drift_ppm");
                let ppm: Option<f64> = ppm.map(|ppm| ppm.parse().expect("a number"));
                assert_eq!(ppm.is_some(), is_followed, "{settings:?}");
                assert!(ppm.is_none_or(|ppm| (ppm - 900.0).abs() < 20.0), "{ppm:?}");
            }
        }

        #[test]
        fn a_transducer_that_is_slow_for_nine_readings_only_is_no_error() {
            let mut delays = vec![Duration::from_millis(210); 9];
            delays.push(Duration::ZERO);
            delays.extend_from_within(..9);
            let slow = Slow::opened(DriverSource::Real, Hertz(50.0), delays);
            let (read, error) = readings(&mut *slow.timely(false, |_| None), 19);
            assert!(error.is_none(), "reading {read}: {error:?}");
        }
    }
}
