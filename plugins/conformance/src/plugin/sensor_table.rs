//! Checks of the frames whose memory a plugin lends to its host, and of the release of this memory.

#![expect(
    unsafe_code,
    reason = "the test calls functions of the device with arguments that no host passes"
)]

use std::thread;
use std::time::Duration;

use taceva_abi as abi;
use taceva_core::{Deadline, DriverError, DriverKind, ErrorKind};

use super::subject::{PATIENT, Subject};
use super::{Check, Of};
use crate::promise::{Unmet, broken, expect, refused, skipped};
use taceva_host::bare::Opened;
use taceva_host::bare::timeout;

const OF: Of = Of::Kind(DriverKind::Sensor);

pub(super) const CHECKS: &[Check] = &[
    OF.check("sensor/counts-its-frames", counts),
    OF.check("sensor/writes-no-further-than-the-buffer", keeps_to_buffer),
    OF.check("sensor/no-buffer", no_buffer),
    OF.check("sensor/release-says-that-it-is-done", releases),
    OF.check("sensor/release-in-another-thread", releases_elsewhere),
    OF.check("sensor/lends-as-many-as-it-says", lends_many),
    OF.check("sensor/release-after-stop", late_release),
];

/// Started sensor whose function table a check calls directly.
struct Bare {
    opened: Opened<abi::SensorCalls>,
    length: usize,
}

/// Captured frame, released on drop.
struct Lent(abi::Frame);

impl Drop for Lent {
    fn drop(&mut self) {
        if let Some(release) = self.0.release {
            // SAFETY: [any], once: the lender set `release`, and the pixels are no longer read.
            unsafe { release(&raw mut self.0) };
        }
    }
}

impl Bare {
    fn started(subject: &Subject) -> Result<Bare, Unmet> {
        let said = subject.said()?;
        let info = said.sensor().and_then(|facts| facts.frame);
        let length = info.and_then(|info| info.byte_len());
        let length = length.ok_or_else(|| broken("it does not declare the size of its frames"))?;
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

    /// Captures a frame that stays in memory of the plugin.
    fn lend(&self) -> Result<Lent, Unmet> {
        if self.opened.calls.max_lent == 0 {
            return Err(skipped("it never lends frames"));
        }
        let lent = self.capture(&mut [], PATIENT)?;
        expect(lent.0.release.is_some() && !lent.0.data.is_null(), || {
            "without a buffer, it returned a frame that is not lent".to_owned()
        })?;
        Ok(lent)
    }
}

fn counts(subject: &Subject) -> Result<(), Unmet> {
    let sensor = Bare::started(subject)?;
    let mut pixels = vec![0; sensor.length];
    let mut last = None;
    for _ in 0..10 {
        let frame = sensor.capture(&mut pixels, PATIENT)?;
        let sequence = frame.0.sequence;
        if let Some(last) = last {
            expect(sequence > last, || {
                format!("frame {sequence} after frame {last}, expected increasing numbers")
            })?;
        }
        last = Some(sequence);
    }
    Ok(())
}

const CANARY: u8 = 0x5a;

/// With a buffer that is too short, the plugin rejects the call or returns a frame in its own memory. It writes nothing beyond the buffer.
fn keeps_to_buffer(subject: &Subject) -> Result<(), Unmet> {
    let sensor = Bare::started(subject)?;
    for room in [1, sensor.length / 2, sensor.length - 1] {
        let mut pixels = vec![CANARY; sensor.length + 64];
        let captured = sensor.capture(&mut pixels[..room.max(1)], PATIENT);
        let beyond = pixels[room.max(1)..].iter().any(|byte| *byte != CANARY);
        expect(!beyond, || {
            format!("it wrote beyond a buffer of {room} bytes")
        })?;
        match captured {
            Ok(frame) => expect(frame.0.release.is_some(), || {
                format!(
                    "it claims that a frame of {} bytes is in a buffer of {room} bytes",
                    sensor.length
                )
            })?,
            Err(error) => refused::<(), _>(
                "capturing into a buffer that is too short",
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
    expect(!beyond, || {
        "it wrote beyond a buffer of the right size".to_owned()
    })
}

fn no_buffer(subject: &Subject) -> Result<(), Unmet> {
    let sensor = Bare::started(subject)?;
    match sensor.capture(&mut [], PATIENT) {
        Ok(frame) => expect(frame.0.release.is_some() && !frame.0.data.is_null(), || {
            "without a buffer, it returned a frame that is not lent".to_owned()
        }),
        Err(error) => refused::<(), _>(
            "capturing without a buffer",
            Err(error),
            &[
                ErrorKind::InvalidArgument,
                ErrorKind::OutOfRange,
                ErrorKind::Unsupported,
            ],
        ),
    }
}

/// A frame's function `release` sets the field `release` of the frame to NULL, so that no frame is released twice.
fn releases(subject: &Subject) -> Result<(), Unmet> {
    let sensor = Bare::started(subject)?;
    for _ in 0..100 {
        let mut lent = sensor.lend()?;
        if let Some(release) = lent.0.release {
            // SAFETY: [any], once: `release` counts as called, regardless of its effect.
            unsafe { release(&raw mut lent.0) };
        }
        let is_done = lent.0.release.take().is_none();
        expect(is_done, || {
            "`release` did not set itself to NULL".to_owned()
        })?;
    }
    Ok(())
}

/// Captured frame that may move to another thread.
struct Elsewhere(Lent);

// SAFETY: the interface allows `release` from any thread, and a lent frame belongs to its holder.
unsafe impl Send for Elsewhere {}

fn releases_elsewhere(subject: &Subject) -> Result<(), Unmet> {
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
        expect(given_back.is_ok(), || {
            "releasing a frame in another thread panicked".to_owned()
        })?;
    }
    Ok(())
}

/// The host can hold the declared number of frames at once. A further capture does not crash. Captures work again after the frames are released.
fn lends_many(subject: &Subject) -> Result<(), Unmet> {
    let sensor = Bare::started(subject)?;
    let most = usize::try_from(sensor.opened.calls.max_lent)
        .unwrap_or(0)
        .min(64);
    let mut out = Vec::new();
    for _ in 0..most {
        out.push(sensor.lend()?);
    }
    if out.is_empty() {
        return Err(skipped("it never lends frames"));
    }
    let within = Deadline::after(Duration::from_millis(100));
    drop(sensor.capture(&mut [], within));
    out.clear();
    drop(sensor.lend()?);
    Ok(())
}

fn late_release(subject: &Subject) -> Result<(), Unmet> {
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
