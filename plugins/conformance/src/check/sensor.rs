//! Checks of sensors.

use std::sync::Arc;

use taceva_core::{
    Deadline, DriverError, DriverKind, DriverSource, FrameMut, Interrupt, Sensor, Stamp,
};

use super::streaming::{self, Streams};
use super::subject::{Ending, PATIENT, Subject, ensure};
use super::{Check, Of};
use taceva_host::PluginSensor;

pub(super) const CHECKS: &[Check] = &[
    check(
        "sensor/gives-the-frames-it-says",
        streaming::gives::<PluginSensor>,
    ),
    check("sensor/stamps-in-order", streaming::stamps::<PluginSensor>),
    check(
        "sensor/capture-before-start",
        streaming::before_start::<PluginSensor>,
    ),
    check(
        "sensor/starts-and-stops-in-any-order",
        streaming::any_order::<PluginSensor>,
    ),
    check(
        "sensor/passed-deadline",
        streaming::passed_deadline::<PluginSensor>,
    ),
    check(
        "sensor/keeps-deadlines",
        streaming::keeps_deadlines::<PluginSensor>,
    ),
    check(
        "sensor/interrupt-within-50-ms",
        streaming::interrupt::<PluginSensor>,
    ),
    check("sensor/same-frames-of-a-simulation", same_frames),
    check("sensor/sets-the-light", sets_light),
    check(
        "sensor/dropped-in-any-state",
        streaming::dropped::<PluginSensor>,
    ),
];

const fn check(name: &'static str, run: fn(&Subject) -> Result<(), Ending>) -> Check {
    Check {
        name,
        of: Of::Kind(DriverKind::Sensor),
        run,
    }
}

fn capture(sensor: &mut PluginSensor, deadline: Deadline) -> Result<(Stamp, Vec<u8>), DriverError> {
    let info = sensor.frame_info();
    let mut pixels = vec![0; info.byte_len().unwrap_or(0)];
    let into = FrameMut::new(info, &mut pixels).expect("made for it");
    let stamp = sensor.capture(into, deadline)?;
    Ok((stamp, pixels))
}

impl Streams for PluginSensor {
    const ITEM: &'static str = "frame";
    const COUNT: usize = 10;

    fn open(subject: &Subject) -> Result<PluginSensor, Ending> {
        let args = subject.args()?;
        subject.opened(subject.session.open_sensor(subject.key()?, &args))
    }

    fn begin(&mut self) -> Result<(), DriverError> {
        self.start(PATIENT)
    }

    fn end(&mut self) -> Result<(), DriverError> {
        self.stop()
    }

    fn next(&mut self, deadline: Deadline) -> Result<Stamp, DriverError> {
        Ok(capture(self, deadline)?.0)
    }

    fn interrupter(&self) -> Option<Arc<dyn Interrupt>> {
        self.interrupt_handle()
    }
}

fn same_frames(subject: &Subject) -> Result<(), Ending> {
    if subject.descriptor()?.source() != DriverSource::Simulated {
        return Err(Ending::Skipped("it is no simulation".to_owned()));
    }
    let frames = || -> Result<Vec<Vec<u8>>, Ending> {
        let rig = taceva_host::InProcess::open(&subject.library)?;
        let mut sensor = subject.opened(rig.open_sensor(subject.key()?, &subject.args()?))?;
        sensor.start(PATIENT)?;
        let frames = (0..3).map(|_| Ok(capture(&mut sensor, PATIENT)?.1));
        frames.collect()
    };
    ensure(frames()? == frames()?, || {
        "the same arguments gave other frames".to_owned()
    })
}

fn sets_light(subject: &Subject) -> Result<(), Ending> {
    let mut sensor = PluginSensor::started(subject)?;
    let Some(lighting) = sensor.lighting() else {
        return Err(Ending::Skipped("it does not set the light".to_owned()));
    };
    for scene in lighting.scenes().to_vec() {
        lighting.set(&scene, PATIENT)?;
    }
    capture(&mut sensor, PATIENT)?;
    Ok(())
}
