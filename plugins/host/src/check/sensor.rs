//! Checks of sensors.

use taceva_core::{
    Deadline, DriverError, DriverKind, DriverSource, ErrorKind, FrameInfo, FrameMut, Sensor, Stamp,
};

use super::subject::{Ending, PATIENT, Subject, ensure};
use super::{Check, Of, waiting};
use crate::device::PluginSensor;

pub(super) const CHECKS: &[Check] = &[
    check("sensor/gives-the-frames-it-says", gives_frames),
    check("sensor/stamps-in-order", stamps),
    check("sensor/capture-before-start", before_start),
    check("sensor/starts-and-stops-in-any-order", any_order),
    check("sensor/passed-deadline", passed_deadline),
    check("sensor/keeps-deadlines", keeps_deadlines),
    check("sensor/interrupt-within-50-ms", interrupt),
    check("sensor/same-frames-of-a-simulation", same_frames),
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

pub(super) fn capture(
    sensor: &mut PluginSensor,
    deadline: Deadline,
) -> Result<(Stamp, Vec<u8>), DriverError> {
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

fn passed_deadline(subject: &Subject) -> Result<(), Ending> {
    waiting::passed_deadline(&mut started(subject)?)
}

fn keeps_deadlines(subject: &Subject) -> Result<(), Ending> {
    waiting::keeps_deadlines(&mut started(subject)?)
}

fn interrupt(subject: &Subject) -> Result<(), Ending> {
    waiting::interrupt(&mut started(subject)?)
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
