//! Records the readings of each device of a rig for some time.

use std::time::Duration;

use taceva_core::{
    Deadline, DriverError, ErrorKind, ForceTransducer, FrameMut, Pose, Robot, Sensor,
};
use taceva_drivers::{MonotonicClock, OpenError, plugin_remedy};

use super::stream::{Listener, Stream};
use crate::error::AcquireError;

/// Duration of the measurement of each device.
pub(super) const LISTENED: Duration = Duration::from_secs(2);
const DEADLINE: Deadline = Deadline::after(Duration::from_secs(2));
const READ_DEADLINE: Deadline = Deadline::after(Duration::from_millis(100));
/// Interval between readings of the pose.
const LOOK: Duration = Duration::from_millis(10);

/// Message for an error of an open device, with its remedy.
pub(super) fn without_answer(error: DriverError) -> String {
    let remedy = match (plugin_remedy(&error), error.kind()) {
        (Some(remedy), _) => format!(" {remedy},"),
        // The device answers, and its message names the remedy.
        (None, ErrorKind::DeviceFault) => String::new(),
        _ => " check its cable and power, and whether another program uses it,".to_owned(),
    };
    format!("{error};{remedy} then run `taceva rig check` again")
}

/// Message for a device that did not open, with the remedy if its plugin ended.
pub(super) fn unopened(error: AcquireError) -> String {
    let remedy = match &error {
        AcquireError::OpenOfRig { source, .. } => match &**source {
            OpenError::Device(cause) => plugin_remedy(cause),
            _ => None,
        },
        _ => None,
    };
    match remedy {
        Some(remedy) => format!("{error}; {remedy}, then run `taceva rig check` again"),
        None => error.to_string(),
    }
}

/// Calls `hear` repeatedly until the measurement ends.
fn listen(
    mut hear: impl FnMut(&mut Listener) -> Result<(), DriverError>,
) -> Result<Stream, DriverError> {
    let mut listener = Listener::default();
    let until_s = MonotonicClock.now_s() + LISTENED.as_secs_f64();
    while MonotonicClock.now_s() < until_s {
        match hear(&mut listener) {
            Err(error) if error.kind() != ErrorKind::Timeout => return Err(error),
            _ => {}
        }
    }
    Ok(listener.heard())
}

pub(super) fn listen_to_force(force: &mut dyn ForceTransducer) -> Result<Stream, DriverError> {
    force.start(DEADLINE)?;
    let heard = listen(|listener| {
        let (wrench, stamp) = force.read(READ_DEADLINE)?;
        listener.hear(stamp.valid_s, MonotonicClock.now_s());
        listener.measure(wrench.force.map(|force| force.0));
        Ok(())
    });
    let lost = force.lost();
    let stopped = force.stop();
    let heard = heard?;
    stopped?;
    Ok(Stream { lost, ..heard })
}

pub(super) fn listen_to_robot(robot: &mut dyn Robot) -> Result<Stream, DriverError> {
    listen(|listener| {
        std::thread::sleep(LOOK);
        let (Pose { position, .. }, stamp) = robot.pose(READ_DEADLINE)?;
        listener.hear(stamp.valid_s, MonotonicClock.now_s());
        listener.measure([position.x.0, position.y.0, position.z.0]);
        Ok(())
    })
}

pub(super) fn listen_to_sensor(sensor: &mut dyn Sensor) -> Result<Stream, String> {
    sensor.start(DEADLINE).map_err(without_answer)?;
    let info = sensor.frame_info();
    let too_large = || format!("frames of {info} are too large for this machine");
    let mut bytes = vec![0; info.byte_len().ok_or_else(too_large)?];
    let heard = listen(|listener| {
        let into = FrameMut::new(info, &mut bytes)
            .expect("the buffer was made with the length of the frame");
        match sensor.capture(into, Deadline::after(Duration::from_secs(1))) {
            Ok(stamp) => listener.hear(stamp.valid_s, MonotonicClock.now_s()),
            // A damaged frame counts as a gap.
            Err(error) if error.kind() == ErrorKind::Protocol => {}
            Err(error) => return Err(error),
        }
        Ok(())
    });
    let stopped = sensor.stop();
    heard
        .and_then(|heard| stopped.map(|()| heard))
        .map_err(without_answer)
}

#[cfg(test)]
mod tests {
    use taceva_core::DriverKey;

    use super::*;

    #[test]
    fn a_fault_that_a_device_states_is_not_blamed_on_its_cable() {
        let key = DriverKey::fixed("test/force");
        let said = |kind| without_answer(DriverError::new(kind, &key, "read the force"));
        assert!(said(ErrorKind::Disconnected).contains("check its cable"));
        let fault = said(ErrorKind::DeviceFault);
        assert!(!fault.contains("cable"), "{fault}");
        assert!(fault.contains("run `taceva rig check` again"), "{fault}");
    }
}
