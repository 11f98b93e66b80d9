//! A sensor whose frames are also shown to a viewer.

use std::collections::BTreeMap;
use std::sync::Arc;

use taceva_core::{
    Deadline, DriverError, Frame, FrameInfo, FrameMut, Interrupt, Lighting, Sensor, Stamp,
};

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
    fn frame_info(&self) -> FrameInfo {
        self.sensor.frame_info()
    }

    fn start(&mut self, deadline: Deadline) -> Result<(), DriverError> {
        self.sensor.start(deadline)
    }

    fn capture(
        &mut self,
        mut into: FrameMut<'_>,
        deadline: Deadline,
    ) -> Result<Stamp, DriverError> {
        let info = into.info();
        let bytes = into.bytes_mut();
        let again = FrameMut::new(info, bytes).expect("its bytes are those of a frame");
        let stamp = self.sensor.capture(again, deadline)?;
        if let Ok(frame) = Frame::new(info, bytes.to_vec()) {
            self.viewer.frame(&frame);
        }
        Ok(stamp)
    }

    fn sequence(&self) -> Option<u64> {
        self.sensor.sequence()
    }

    fn sent(&self) -> Option<&[u8]> {
        self.sensor.sent()
    }

    fn settings(&self) -> BTreeMap<String, String> {
        self.sensor.settings()
    }

    fn stop(&mut self) -> Result<(), DriverError> {
        self.sensor.stop()
    }

    fn interrupt_handle(&self) -> Option<Arc<dyn Interrupt>> {
        self.sensor.interrupt_handle()
    }

    fn lighting(&mut self) -> Option<&mut dyn Lighting> {
        self.sensor.lighting()
    }
}
