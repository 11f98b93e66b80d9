//! Promises of sensors.

use taceva_core::{ErrorKind, Factory, FrameInfo, FrameMut, PixelFormat, Sensor};

use crate::lighting::{has_scenes, refuses_stranger, sets_scenes};
use crate::promise::{Unmet, broken, expect, refused, skipped};
use crate::report::Report;
use crate::stream::{self, capture, started};
use crate::trial::{Promise, Trial, Tried, report};

/// Tests the promises of a sensor with the settings of `trial`.
pub fn sensor(factory: &dyn Factory<dyn Sensor>, trial: &Trial) -> Report {
    report(factory, trial, PROMISES)
}

pub(crate) const PROMISES: &[Promise<dyn Sensor>] = &[
    ("sensor/gives-the-frames-it-says", gives_declared),
    ("sensor/stamps-in-order", stream::stamps),
    ("sensor/refuses-other-buffers", refuses_other_buffers),
    ("sensor/capture-before-start", stream::before_start),
    ("sensor/starts-and-stops-in-any-order", stream::any_order),
    ("sensor/passed-deadline", stream::passed_deadline),
    ("sensor/keeps-deadlines", stream::keeps_deadlines),
    ("sensor/interrupt-within-50-ms", stream::interrupt),
    ("sensor/same-frames-of-a-simulation", same_frames),
    ("sensor/sets-the-light", lights_as_declared),
    ("sensor/dropped-in-any-state", stream::dropped),
];

type Subject<'a> = Tried<'a, dyn Sensor>;

fn gives_declared(tried: &Subject<'_>) -> Result<(), Unmet> {
    let facts = tried.descriptor.sensor();
    let facts = facts.ok_or_else(|| broken("it does not declare itself a sensor"))?;
    let given = tried.open()?.frame_info();
    expect(given.byte_len().is_some_and(|length| length > 0), || {
        format!("frames of {given} are empty or too large for a buffer")
    })?;
    if let Some(declared) = facts.frame {
        expect(given == declared, || {
            format!("it gives frames of {given}, but declares {declared}")
        })?;
    }
    stream::gives(tried)?;
    match facts.frame {
        Some(_) => Ok(()),
        None => Err(skipped(format!(
            "it gives frames of {given} but declares no size to compare them with"
        ))),
    }
}

fn refuses_other_buffers(tried: &Subject<'_>) -> Result<(), Unmet> {
    let mut sensor = started(tried)?;
    let info = sensor.frame_info();
    let format = match info.format {
        PixelFormat::Gray8 => PixelFormat::Rgb8,
        _ => PixelFormat::Gray8,
    };
    let width = info.width + 1;
    for other in [FrameInfo { width, ..info }, FrameInfo { format, ..info }] {
        let mut pixels = vec![0; other.byte_len().unwrap_or_default()];
        let frame = FrameMut::new(other, &mut pixels).map_err(|error| broken(error.to_string()))?;
        let captured = sensor.capture(frame, tried.trial.deadline);
        let doing = format!("capturing into {other}");
        refused(&doing, captured, &[ErrorKind::InvalidArgument])?;
    }
    tried.reading(capture(&mut *sensor, tried.trial.deadline))?;
    Ok(())
}

#[expect(
    clippy::redundant_closure,
    reason = "the function has one lifetime, but the argument requires any"
)]
fn same_frames(tried: &Subject<'_>) -> Result<(), Unmet> {
    stream::repeats(tried, |sensor, deadline| capture(sensor, deadline))
}

fn lights_as_declared(tried: &Subject<'_>) -> Result<(), Unmet> {
    let facts = tried.descriptor.sensor();
    let declared = facts.map_or(&[][..], |facts| &facts.scenes);
    let mut sensor = started(tried)?;
    let Some(lighting) = sensor.lighting() else {
        return stream::as_declared("set the light", !declared.is_empty(), false);
    };
    has_scenes(lighting, declared)?;
    sets_scenes(tried, lighting)?;
    refuses_stranger(tried, lighting)?;
    tried.reading(capture(&mut *sensor, tried.trial.deadline))?;
    Ok(())
}
