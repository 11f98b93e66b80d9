//! A sensor whose frames are also shown to a viewer.

use std::collections::BTreeMap;
use std::sync::Arc;

use taceva_core::{Deadline, DriverError, Frame, FrameMut, Sensor, Stamp};

use super::delegation::delegate_sensor;
use crate::viewer::Viewer;

/// A sensor, and the viewer that receives its frames.
pub(super) struct Seen {
    sensor: Box<dyn Sensor>,
    viewer: Arc<dyn Viewer>,
}

impl Seen {
    pub(super) fn new(sensor: Box<dyn Sensor>, viewer: Arc<dyn Viewer>) -> Seen {
        Seen { sensor, viewer }
    }
}

impl Sensor for Seen {
    delegate_sensor!(sensor);

    fn capture(
        &mut self,
        mut into: FrameMut<'_>,
        deadline: Deadline,
    ) -> Result<Stamp, DriverError> {
        let info = into.info();
        let bytes = into.bytes_mut();
        let again = FrameMut::new(info, bytes).expect("the bytes are those of a frame");
        let stamp = self.sensor.capture(again, deadline)?;
        if let Ok(frame) = Frame::new(info, bytes.to_vec()) {
            self.viewer.frame(&frame);
        }
        Ok(stamp)
    }

    fn settings(&self) -> BTreeMap<String, String> {
        self.sensor.settings()
    }
}
