//! A palm sensor whose frames show a dark or a bright room.

use std::sync::Arc;

use taceva_core::{
    Args, Deadline, Descriptor, DescriptorError, DriverError, ErrorKind, Factory, Facts, Found,
    FrameInfo, FrameMut, Interrupt, Lighting, Rig, Sensor, SensorFacts, Stamp,
};
use taceva_plugin::Interruption;

use super::{FRAME, KEY, descriptor, error, way};

pub(super) struct SensorMaker(Descriptor);

impl SensorMaker {
    pub(super) fn new() -> Result<SensorMaker, DescriptorError> {
        let facts = SensorFacts::default().with_frame(FRAME);
        Ok(SensorMaker(descriptor(
            "palm",
            Facts::Sensor(Box::new(facts)),
            way(),
        )?))
    }
}

impl Factory<dyn Sensor> for SensorMaker {
    fn descriptor(&self) -> &Descriptor {
        &self.0
    }
    fn open(&self, args: &Args, _: &mut Rig) -> Result<Box<dyn Sensor>, DriverError> {
        let way = args.text("way").to_owned();
        Ok(Box::new(Palm {
            way,
            interruption: Arc::default(),
            captured: 0,
            light: "dark".to_owned(),
            scenes: vec!["dark".to_owned(), "room".to_owned()],
        }))
    }
    fn discover(&self) -> Result<Vec<Found>, DriverError> {
        let arguments = "way=well".to_owned();
        Ok(vec![Found::new(KEY, "palm").with_arguments(arguments)])
    }
}

struct Palm {
    way: String,
    interruption: Arc<Interruption>,
    captured: u64,
    light: String,
    scenes: Vec<String>,
}

impl Sensor for Palm {
    fn frame_info(&self) -> FrameInfo {
        FRAME
    }
    fn capture(
        &mut self,
        mut into: FrameMut<'_>,
        deadline: Deadline,
    ) -> Result<Stamp, DriverError> {
        match self.way.as_str() {
            "panic" => panic!("frame {}", self.captured),
            "refuse" => return Err(error(ErrorKind::Disconnected).because("the cable is out")),
            "block" => {
                let call = self.interruption.call();
                call.rest(deadline.remaining())
                    .map_err(|interrupted| error(ErrorKind::Interrupted).because(interrupted))?;
                return Err(error(ErrorKind::Timeout));
            }
            _ => {}
        }
        self.captured += 1;
        into.bytes_mut()
            .fill(if self.light == "dark" { 1 } else { 200 });
        let valid_s = if self.way == "nan" { f64::NAN } else { 1.5 };
        Ok(Stamp {
            valid_s,
            received_s: None,
        })
    }
    fn sequence(&self) -> Option<u64> {
        (self.way == "numbered").then_some(40 + 2 * self.captured)
    }
    fn interrupt_handle(&self) -> Option<Arc<dyn Interrupt>> {
        self.interruption.handle()
    }
    fn lighting(&mut self) -> Option<&mut dyn Lighting> {
        (self.way == "well").then_some(self as &mut dyn Lighting)
    }
}

impl Lighting for Palm {
    fn scenes(&self) -> &[String] {
        &self.scenes
    }
    fn set(&mut self, scene: &str, _: Deadline) -> Result<(), DriverError> {
        if self.scenes.iter().all(|known| known != scene) {
            return Err(error(ErrorKind::InvalidArgument).because(format!("no scene {scene}")));
        }
        self.light = scene.to_owned();
        Ok(())
    }
}

impl Drop for Palm {
    fn drop(&mut self) {
        assert_ne!(self.way, "panic-at-drop", "dropped");
    }
}
