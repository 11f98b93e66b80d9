//! Checks of sensors: frames, and the discipline of lending them.

#![expect(
    unsafe_code,
    reason = "the functions of the device are called as no host does"
)]

use std::thread;
use std::time::{Duration, Instant};

use taceva_abi as abi;
use taceva_core::{
    Deadline, DriverError, DriverKind, DriverSource, ErrorKind, FrameInfo, FrameMut, Sensor, Stamp,
};

use super::subject::{AT_ONCE, Ending, PATIENT, SOON, Subject, ensure, expect_failure, timed};
use super::{Check, Of};
use crate::call::timeout;
use crate::device::{Opened, PluginSensor};

pub(super) const CHECKS: &[Check] = &[
    check("sensor/gives-the-frames-it-says", gives_frames),
    check("sensor/stamps-in-order", stamps),
    check("sensor/counts-its-frames", counts),
    check("sensor/capture-before-start", before_start),
    check("sensor/starts-and-stops-in-any-order", any_order),
    check("sensor/passed-deadline", passed_deadline),
    check("sensor/keeps-deadlines", keeps_deadlines),
    check("sensor/interrupt-within-50-ms", interrupt),
    check("sensor/same-frames-of-a-simulation", same_frames),
    check("sensor/writes-no-further-than-the-buffer", keeps_to_buffer),
    check("sensor/no-buffer", no_buffer),
    check("sensor/release-says-that-it-is-done", releases),
    check("sensor/release-in-another-thread", releases_elsewhere),
    check("sensor/lends-as-many-as-it-says", lends_many),
    check("sensor/release-after-stop", late_release),
    check("sensor/sets-the-light", sets_light),
    check("sensor/dropped-in-any-state", dropped),
];

const fn check(name: &'static str, run: fn(&Subject) -> Result<(), Ending>) -> Check {
    Check {
        name,
        of: Of::Kind(DriverKind::Sensor),
        run,
    }
}

fn open(subject: &Subject) -> Result<PluginSensor, Ending> {
    Ok(subject
        .session
        .open_sensor(subject.key()?, &subject.args()?)?)
}

fn started(subject: &Subject) -> Result<PluginSensor, Ending> {
    let mut sensor = open(subject)?;
    sensor.start(PATIENT)?;
    Ok(sensor)
}

fn buffer(info: FrameInfo) -> Vec<u8> {
    vec![0; info.byte_len().unwrap_or(0)]
}

fn capture(sensor: &mut PluginSensor, deadline: Deadline) -> Result<(Stamp, Vec<u8>), DriverError> {
    let info = sensor.frame_info();
    let mut pixels = buffer(info);
    let into = FrameMut::new(info, &mut pixels).expect("made for it");
    let stamp = sensor.capture(into, deadline)?;
    Ok((stamp, pixels))
}

fn gives_frames(subject: &Subject) -> Result<(), Ending> {
    let mut sensor = started(subject)?;
    for _ in 0..5 {
        capture(&mut sensor, PATIENT)?;
    }
    Ok(sensor.stop()?)
}

fn stamps(subject: &Subject) -> Result<(), Ending> {
    let mut sensor = started(subject)?;
    let mut last = f64::NEG_INFINITY;
    for _ in 0..10 {
        let (stamp, _) = capture(&mut sensor, PATIENT)?;
        ensure(stamp.valid_s > last, || {
            format!("a frame of {} s after one of {last} s", stamp.valid_s)
        })?;
        last = stamp.valid_s;
    }
    Ok(())
}

/// A sensor behind its bare table, started.
struct Bare {
    opened: Opened<abi::SensorCalls>,
    length: usize,
}

/// A frame as it came; given back when it is dropped.
struct Lent(abi::Frame);

impl Drop for Lent {
    fn drop(&mut self) {
        if let Some(release) = self.0.release {
            // SAFETY: [any], once: set by whoever lent it, and nobody looks at the pixels any more.
            unsafe { release(&raw mut self.0) };
        }
    }
}

impl Bare {
    fn started(subject: &Subject) -> Result<Bare, Ending> {
        let said = subject.said()?;
        let info = said.sensor().and_then(|facts| facts.frame);
        let length = info.and_then(|info| info.byte_len());
        let length = length
            .ok_or_else(|| Ending::Broken("it does not say how large its frames are".to_owned()))?;
        let opened: Opened<abi::SensorCalls> = subject.open()?;
        if let Some(start) = opened.calls.start {
            opened.handle.call("start the sensor", |raw, error| {
                // SAFETY: [owner & open], with an error that outlives the call.
                unsafe { start(raw, timeout(PATIENT), error) }
            })?;
        }
        Ok(Bare { opened, length })
    }

    fn capture(&self, buffer: &mut [u8], within: Deadline) -> Result<Lent, DriverError> {
        let capture = self
            .opened
            .handle
            .needs(self.opened.calls.capture, "capture")?;
        let mut lent = Lent(abi::Frame {
            size: u32::try_from(size_of::<abi::Frame>()).expect("a small struct"),
            format: abi::PixelFormat(0),
            width: 0,
            height: 0,
            flags: 0,
            reserved: 0,
            sequence: 0,
            stamp: abi::Stamp::default(),
            buffer_length: buffer.len() as u64,
            buffer: match buffer {
                [] => std::ptr::null_mut(),
                bytes => bytes.as_mut_ptr(),
            },
            data: std::ptr::null(),
            length: 0,
            release: None,
            private_data: std::ptr::null_mut(),
        });
        self.opened.handle.call("capture a frame", |raw, error| {
            // SAFETY: [owner & started], with a frame, its buffer and an error that outlive the call.
            unsafe { capture(raw, &raw mut lent.0, timeout(within), error) }
        })?;
        Ok(lent)
    }

    /// A frame in the plugin's own memory.
    fn lend(&self) -> Result<Lent, Ending> {
        if self.opened.calls.max_lent == 0 {
            return Err(Ending::Skipped("it never lends".to_owned()));
        }
        let lent = self.capture(&mut [], PATIENT)?;
        ensure(lent.0.release.is_some() && !lent.0.data.is_null(), || {
            "without a buffer it gave a frame that is not lent".to_owned()
        })?;
        Ok(lent)
    }
}

fn counts(subject: &Subject) -> Result<(), Ending> {
    let sensor = Bare::started(subject)?;
    let mut pixels = vec![0; sensor.length];
    let mut last = None;
    for _ in 0..10 {
        let frame = sensor.capture(&mut pixels, PATIENT)?;
        let sequence = frame.0.sequence;
        ensure(last.is_none_or(|last| sequence > last), || {
            format!("frame {sequence} after frame {last:?}")
        })?;
        last = Some(sequence);
    }
    Ok(())
}

/// A frame before the start comes or is refused; either way the sensor goes on.
fn before_start(subject: &Subject) -> Result<(), Ending> {
    let mut sensor = open(subject)?;
    match capture(&mut sensor, PATIENT) {
        Err(error) if error.kind() != ErrorKind::InvalidArgument => return Err(error.into()),
        _ => {}
    }
    sensor.start(PATIENT)?;
    capture(&mut sensor, PATIENT)?;
    Ok(())
}

fn any_order(subject: &Subject) -> Result<(), Ending> {
    let mut sensor = open(subject)?;
    sensor.stop()?;
    for _ in 0..3 {
        sensor.start(PATIENT)?;
        sensor.start(PATIENT)?;
        capture(&mut sensor, PATIENT)?;
        sensor.stop()?;
        sensor.stop()?;
    }
    Ok(())
}

fn in_time(sensor: &mut PluginSensor, given: Duration) -> Result<(), Ending> {
    let (captured, took) = timed(|| capture(sensor, Deadline::after(given)));
    ensure(took < given + SOON, || {
        format!("{given:?} were given, and it took {took:?}")
    })?;
    match captured {
        Err(error) if error.kind() != ErrorKind::Timeout => Err(error.into()),
        _ => Ok(()),
    }
}

fn passed_deadline(subject: &Subject) -> Result<(), Ending> {
    let mut sensor = started(subject)?;
    for _ in 0..5 {
        in_time(&mut sensor, Duration::ZERO)?;
    }
    capture(&mut sensor, PATIENT)?;
    Ok(())
}

fn keeps_deadlines(subject: &Subject) -> Result<(), Ending> {
    let mut sensor = started(subject)?;
    for _ in 0..10 {
        in_time(&mut sensor, Duration::from_millis(5))?;
    }
    Ok(())
}

fn interrupt(subject: &Subject) -> Result<(), Ending> {
    let mut sensor = started(subject)?;
    let interrupt = sensor.interrupt_handle();
    let interrupt =
        interrupt.ok_or_else(|| Ending::Skipped("it cannot be interrupted".to_owned()))?;
    let interrupter = thread::spawn(move || {
        thread::sleep(Duration::from_millis(20));
        let now = Instant::now();
        interrupt.interrupt();
        now
    });
    let long = Deadline::after(Duration::from_secs(3));
    let mut begun = Instant::now();
    loop {
        let captured = capture(&mut sensor, long);
        let ended = Instant::now();
        match captured {
            // A frame that came by itself: whether the interrupt met this call or none, the next must work.
            Ok(_) if !interrupter.is_finished() => begun = ended,
            Ok(_) => break,
            Err(error) if error.kind() == ErrorKind::Interrupted => {
                let at = interrupter
                    .join()
                    .map_err(|_| Ending::Broken("the check panicked".to_owned()))?;
                let late = ended.saturating_duration_since(at.max(begun));
                ensure(late < AT_ONCE, || {
                    format!("it took {late:?}, expected at most {AT_ONCE:?}")
                })?;
                break;
            }
            Err(error) => return Err(error.into()),
        }
    }
    capture(&mut sensor, PATIENT)?;
    Ok(())
}

fn same_frames(subject: &Subject) -> Result<(), Ending> {
    if subject.descriptor()?.source() != DriverSource::Simulated {
        return Err(Ending::Skipped("it is no simulation".to_owned()));
    }
    let frames = || -> Result<Vec<Vec<u8>>, Ending> {
        let rig = crate::in_process::InProcess::open(&subject.library)?;
        let mut sensor = rig.open_sensor(subject.key()?, &subject.args()?)?;
        sensor.start(PATIENT)?;
        let frames = (0..3).map(|_| Ok(capture(&mut sensor, PATIENT)?.1));
        frames.collect()
    };
    ensure(frames()? == frames()?, || {
        "the same arguments gave other frames".to_owned()
    })
}

const CANARY: u8 = 0x5a;

/// A buffer that is too short is refused, or the frame is lent; nothing beyond it is written.
fn keeps_to_buffer(subject: &Subject) -> Result<(), Ending> {
    let sensor = Bare::started(subject)?;
    for room in [1, sensor.length / 2, sensor.length - 1] {
        let mut pixels = vec![CANARY; sensor.length + 64];
        let captured = sensor.capture(&mut pixels[..room.max(1)], PATIENT);
        let beyond = pixels[room.max(1)..].iter().any(|byte| *byte != CANARY);
        ensure(!beyond, || {
            format!("it wrote beyond a buffer of {room} bytes")
        })?;
        match captured {
            Ok(frame) => ensure(frame.0.release.is_some(), || {
                format!(
                    "it says that a frame of {} bytes is in {room}",
                    sensor.length
                )
            })?,
            Err(error) => expect_failure::<(), _>(
                "a buffer that is too short",
                Err(error),
                &[
                    ErrorKind::InvalidArgument,
                    ErrorKind::OutOfRange,
                    ErrorKind::Unsupported,
                ],
            )?,
        }
    }
    let mut pixels = vec![CANARY; sensor.length + 64];
    let length = sensor.length;
    sensor.capture(&mut pixels[..length], PATIENT)?;
    let beyond = pixels[length..].iter().any(|byte| *byte != CANARY);
    ensure(!beyond, || "it wrote beyond a buffer that fits".to_owned())
}

fn no_buffer(subject: &Subject) -> Result<(), Ending> {
    let sensor = Bare::started(subject)?;
    match sensor.capture(&mut [], PATIENT) {
        Ok(frame) => ensure(frame.0.release.is_some() && !frame.0.data.is_null(), || {
            "a frame without a buffer that is not lent".to_owned()
        }),
        Err(error) => expect_failure::<(), _>(
            "no buffer",
            Err(error),
            &[
                ErrorKind::InvalidArgument,
                ErrorKind::OutOfRange,
                ErrorKind::Unsupported,
            ],
        ),
    }
}

/// `release` sets itself to NULL, so that nobody gives a frame back twice.
fn releases(subject: &Subject) -> Result<(), Ending> {
    let sensor = Bare::started(subject)?;
    for _ in 0..100 {
        let mut lent = sensor.lend()?;
        if let Some(release) = lent.0.release {
            // SAFETY: [any], once: `release` is taken as called, whatever it leaves behind.
            unsafe { release(&raw mut lent.0) };
        }
        let is_done = lent.0.release.take().is_none();
        ensure(is_done, || {
            "`release` did not set itself to NULL".to_owned()
        })?;
    }
    Ok(())
}

/// A frame that goes to another thread.
struct Elsewhere(Lent);

// SAFETY: the interface allows `release` from any thread, and a lent frame belongs to whoever holds it.
unsafe impl Send for Elsewhere {}

fn releases_elsewhere(subject: &Subject) -> Result<(), Ending> {
    let sensor = Bare::started(subject)?;
    for _ in 0..20 {
        let lent = Elsewhere(sensor.lend()?);
        let given_back = thread::scope(|scope| {
            let elsewhere = scope.spawn(move || {
                let whole = lent;
                drop(whole.0);
            });
            elsewhere.join()
        });
        ensure(given_back.is_ok(), || {
            "giving a frame back panicked".to_owned()
        })?;
    }
    Ok(())
}

/// Frames that are out at once lie apart; one more is refused or waits, and after they are back all goes on.
fn lends_many(subject: &Subject) -> Result<(), Ending> {
    let sensor = Bare::started(subject)?;
    let most = usize::try_from(sensor.opened.calls.max_lent)
        .unwrap_or(0)
        .min(64);
    let mut out = Vec::new();
    for _ in 0..most {
        out.push(sensor.lend()?);
    }
    if out.is_empty() {
        return Err(Ending::Skipped("it never lends".to_owned()));
    }
    let within = Deadline::after(Duration::from_millis(100));
    drop(sensor.capture(&mut [], within));
    out.clear();
    drop(sensor.lend()?);
    Ok(())
}

fn late_release(subject: &Subject) -> Result<(), Ending> {
    let sensor = Bare::started(subject)?;
    let lent = sensor.lend()?;
    if let Some(stop) = sensor.opened.calls.stop {
        sensor.opened.handle.call("stop the sensor", |raw, error| {
            // SAFETY: [owner & open], with an error that outlives the call.
            unsafe { stop(raw, error) }
        })?;
    }
    drop(lent);
    Ok(())
}

fn sets_light(subject: &Subject) -> Result<(), Ending> {
    let mut sensor = started(subject)?;
    let Some(lighting) = sensor.lighting() else {
        return Err(Ending::Skipped("it does not set the light".to_owned()));
    };
    for scene in lighting.scenes().to_vec() {
        lighting.set(&scene, PATIENT)?;
    }
    capture(&mut sensor, PATIENT)?;
    Ok(())
}

fn dropped(subject: &Subject) -> Result<(), Ending> {
    drop(open(subject)?);
    drop(started(subject)?);
    let mut sensor = started(subject)?;
    let _ = capture(&mut sensor, Deadline::PASSED);
    drop(sensor);
    let mut sensor = started(subject)?;
    sensor.stop()?;
    drop(sensor);
    drop(started(subject)?);
    Ok(())
}
