//! Checks of sensors.

use std::thread;
use std::time::{Duration, Instant};

use taceva_core::{
    Deadline, DriverError, DriverKind, DriverSource, ErrorKind, FrameInfo, FrameMut, Sensor, Stamp,
};

use super::subject::{AT_ONCE, Ending, PATIENT, SOON, Subject, ensure, timed};
use super::{Check, Of};
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
