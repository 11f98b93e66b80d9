//! A wrist with a load of 4 N.

use std::thread;
use std::time::Duration;

use taceva_core::{
    Args, Axes, Deadline, Descriptor, DescriptorError, DriverError, ErrorKind, Factory, Facts,
    ForceFacts, ForceTransducer, Newton, Rig, Stamp, Tare, Wrench,
};

use super::{descriptor, error, way};

pub(super) struct ForceMaker(Descriptor);

impl ForceMaker {
    pub(super) fn new() -> Result<ForceMaker, DescriptorError> {
        let facts = ForceFacts::default().with_axes(Axes::SIX).with_tare(true);
        Ok(ForceMaker(descriptor("wrist", Facts::Force(facts), way())?))
    }
}

impl Factory<dyn ForceTransducer> for ForceMaker {
    fn descriptor(&self) -> &Descriptor {
        &self.0
    }
    fn open(&self, args: &Args, _: &mut Rig) -> Result<Box<dyn ForceTransducer>, DriverError> {
        Ok(Box::new(Wrist {
            way: args.text("way").to_owned(),
            zero: 0.0,
        }))
    }
}

struct Wrist {
    way: String,
    zero: f64,
}

impl ForceTransducer for Wrist {
    fn axes(&self) -> Axes {
        Axes::SIX
    }
    fn read(&mut self, deadline: Deadline) -> Result<(Wrench, Stamp), DriverError> {
        if self.way == "block" {
            // Only the timeout ends this call: a driver that cannot be interrupted.
            thread::sleep(deadline.remaining().min(Duration::from_millis(200)));
            return Err(error(ErrorKind::Timeout));
        }
        let mut wrench = Wrench::default();
        wrench.force[2] = Newton(if self.way == "nan" {
            f64::NAN
        } else {
            4.0 - self.zero
        });
        wrench.torque[0].0 = 12.5;
        Ok((wrench, Stamp::at(Duration::from_nanos(1_234_567_891))))
    }
    fn lost(&self) -> Option<u64> {
        (self.way == "well").then_some(3)
    }
    fn tare(&mut self) -> Option<&mut dyn Tare> {
        Some(self)
    }
}

impl Tare for Wrist {
    fn zero(&mut self, _: Deadline) -> Result<(), DriverError> {
        self.zero = 4.0;
        Ok(())
    }
}
