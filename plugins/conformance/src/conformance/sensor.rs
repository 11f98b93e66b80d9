//! The suite for sensors.

use taceva_core::{
    Deadline, DriverError, DriverSource, ErrorKind, Factory, FrameInfo, FrameMut, PixelFormat,
    Sensor, Stamp,
};

use super::bench::{Bench, Test, Unmet, answered, broken, expect, in_order, refused, run};
use super::lighting::{has_scenes, sets_scenes};
use super::{Report, Trial};

/// Tries a sensor.
pub fn sensor(factory: &dyn Factory<dyn Sensor>, trial: &Trial) -> Report {
    run(factory, trial, TESTS)
}

type Subject<'a> = Bench<'a, dyn Sensor>;

const TESTS: &[Test<dyn Sensor>] = &[
    ("gives the frames it declares", gives_declared_frames),
    (
        "captures frames in the order of their stamps",
        captures_in_order,
    ),
    (
        "refuses a buffer of another size or format, and goes on",
        refuses_other_buffers,
    ),
    (
        "answers a deadline that has passed at once",
        keeps_deadlines,
    ),
    ("starts and stops in any order", starts_and_stops),
    ("gives back what it held when it is dropped", opens_again),
    (
        "gives the same frames to the same arguments",
        repeats_itself,
    ),
    (
        "sets the light it declares, and no other",
        lights_as_declared,
    ),
];

fn gives_declared_frames(bench: &Subject<'_>) -> Result<(), Unmet> {
    let facts = bench.descriptor.sensor();
    let declared = facts
        .ok_or_else(|| broken("does not declare itself a sensor"))?
        .frame;
    let given = bench.open()?.frame_info();
    expect(given.byte_len().is_some_and(|length| length > 0), || {
        format!("frames of {given}, which no buffer can hold")
    })?;
    let Some(declared) = declared else {
        return Err(Unmet::Inapplicable(format!(
            "{given}, and declares no size"
        )));
    };
    expect(given == declared, || {
        format!("frames of {given}, declares {declared}")
    })
}

fn captures_in_order(bench: &Subject<'_>) -> Result<(), Unmet> {
    let mut sensor = started(bench)?;
    let mut stamps = Vec::new();
    for _ in 0..FRAMES {
        stamps.push(
            bench
                .reading(capture(sensor.as_mut(), bench.trial.deadline))?
                .0,
        );
    }
    in_order(&stamps)
}

/// How many frames a check looks at.
const FRAMES: usize = 4;

fn refuses_other_buffers(bench: &Subject<'_>) -> Result<(), Unmet> {
    let mut sensor = started(bench)?;
    let info = sensor.frame_info();
    let other_format = match info.format {
        PixelFormat::Gray8 => PixelFormat::Rgb8,
        _ => PixelFormat::Gray8,
    };
    let others = [
        FrameInfo {
            width: info.width + 1,
            ..info
        },
        FrameInfo {
            format: other_format,
            ..info
        },
    ];
    for other in others {
        let mut pixels = vec![0; other.byte_len().unwrap_or_default()];
        let frame = FrameMut::new(other, &mut pixels).map_err(|error| broken(error.to_string()))?;
        let captured = sensor.capture(frame, bench.trial.deadline);
        refused(
            &format!("capturing into {other}"),
            captured,
            &[ErrorKind::InvalidArgument],
        )?;
    }
    bench.reading(capture(sensor.as_mut(), bench.trial.deadline))?;
    Ok(())
}

fn keeps_deadlines(bench: &Subject<'_>) -> Result<(), Unmet> {
    let mut sensor = started(bench)?;
    for _ in 0..FRAMES {
        let captured = bench.at_once("capturing a frame without time", || {
            capture(sensor.as_mut(), Deadline::PASSED)
        })?;
        let stamp = captured.map(|(stamp, _)| stamp);
        answered("capturing a frame without time", stamp, ErrorKind::Timeout)?;
    }
    bench.reading(capture(sensor.as_mut(), bench.trial.deadline))?;
    Ok(())
}

fn starts_and_stops(bench: &Subject<'_>) -> Result<(), Unmet> {
    let deadline = bench.trial.deadline;
    let mut sensor = bench.open()?;
    sensor.stop()?;
    sensor.start(deadline)?;
    sensor.start(deadline)?;
    let (before, _) = bench.reading(capture(sensor.as_mut(), deadline))?;
    sensor.stop()?;
    sensor.stop()?;
    let stopped = bench.at_once("capturing while stopped", || {
        capture(sensor.as_mut(), Deadline::PASSED).map(|(stamp, _)| stamp)
    })?;
    let between = stopped.as_ref().ok().copied();
    if between.is_none() {
        let kinds = [ErrorKind::InvalidArgument, ErrorKind::Timeout];
        refused("capturing while stopped", stopped, &kinds)?;
    }
    sensor.start(deadline)?;
    let (after, _) = bench.reading(capture(sensor.as_mut(), deadline))?;
    let stamps: Vec<Stamp> = [Some(before), between, Some(after)]
        .into_iter()
        .flatten()
        .collect();
    in_order(&stamps)
}

fn opens_again(bench: &Subject<'_>) -> Result<(), Unmet> {
    for _ in 0..2 {
        let mut sensor = started(bench)?;
        bench.reading(capture(sensor.as_mut(), bench.trial.deadline))?;
    }
    Ok(())
}

fn repeats_itself(bench: &Subject<'_>) -> Result<(), Unmet> {
    if bench.descriptor.source() != DriverSource::Simulated {
        let source = bench.descriptor.source();
        return Err(Unmet::Inapplicable(format!("its readings are {source}")));
    }
    let frames = || -> Result<Vec<_>, Unmet> {
        let mut sensor = started(bench)?;
        let mut next = || bench.reading(capture(sensor.as_mut(), bench.trial.deadline));
        (0..FRAMES).map(|_| next()).collect()
    };
    let (first, second) = (frames()?, frames()?);
    expect(first == second, || "two runs differ".to_owned())
}

fn lights_as_declared(bench: &Subject<'_>) -> Result<(), Unmet> {
    let facts = bench.descriptor.sensor();
    let declared = facts.map_or(&[][..], |facts| &facts.scenes);
    let mut sensor = started(bench)?;
    match (sensor.lighting(), declared.is_empty()) {
        (None, true) => Err(Unmet::Inapplicable("it sets no light".to_owned())),
        (None, false) => Err(broken(format!("sets no light, declares {declared:?}"))),
        (Some(lighting), _) => {
            has_scenes(lighting, declared)?;
            sets_scenes(bench, lighting)?;
            bench.reading(capture(sensor.as_mut(), bench.trial.deadline))?;
            Ok(())
        }
    }
}

fn started(bench: &Subject<'_>) -> Result<Box<dyn Sensor>, Unmet> {
    let mut sensor = bench.open()?;
    sensor.start(bench.trial.deadline)?;
    Ok(sensor)
}

fn capture(sensor: &mut dyn Sensor, deadline: Deadline) -> Result<(Stamp, Vec<u8>), DriverError> {
    let info = sensor.frame_info();
    let mut pixels = vec![0; info.byte_len().unwrap_or_default()];
    let frame = FrameMut::new(info, &mut pixels).expect("the buffer was made for the frame");
    let stamp = sensor.capture(frame, deadline)?;
    Ok((stamp, pixels))
}
