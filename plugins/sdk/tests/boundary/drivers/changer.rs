//! A changer that either returns at once or never.

use std::sync::Arc;

use taceva_core::{
    Args, Changer, ChangerFacts, Deadline, Descriptor, DescriptorError, DriverError, ErrorKind,
    Factory, Facts, Interrupt, Rig,
};
use taceva_plugin::Interruption;

use super::{descriptor, error, way};

pub(super) struct ChangerMaker(Descriptor);

impl ChangerMaker {
    pub(super) fn new() -> Result<ChangerMaker, DescriptorError> {
        let facts = ChangerFacts::default().with_holds(vec!["a".to_owned(), "b".to_owned()]);
        let descriptor = descriptor("carousel", Facts::Changer(facts), way())?;
        Ok(ChangerMaker(descriptor))
    }
}

impl Factory<dyn Changer> for ChangerMaker {
    fn descriptor(&self) -> &Descriptor {
        &self.0
    }
    fn open(&self, args: &Args, _: &mut Rig) -> Result<Box<dyn Changer>, DriverError> {
        Ok(Box::new(Carousel {
            way: args.text("way").to_owned(),
            holds: vec!["a".to_owned(), "b".to_owned()],
            interruption: Arc::default(),
        }))
    }
}

struct Carousel {
    way: String,
    holds: Vec<String>,
    interruption: Arc<Interruption>,
}

impl Changer for Carousel {
    fn holds(&self) -> &[String] {
        &self.holds
    }

    fn bring(&mut self, name: &str, deadline: Deadline) -> Result<String, DriverError> {
        match self.way.as_str() {
            "panic" => panic!("gear"),
            "refuse" => return Err(error(ErrorKind::DeviceFault).because("stuck")),
            "block" => {
                let call = self.interruption.call();
                call.rest(deadline.remaining())
                    .map_err(|interrupted| error(ErrorKind::Interrupted).because(interrupted))?;
                return Err(error(ErrorKind::Timeout));
            }
            // Its sensor reports a different item.
            "nan" => return Ok("c".to_owned()),
            _ => {}
        }
        match self.holds.iter().any(|held| held == name) {
            true => Ok(name.to_owned()),
            false => Err(error(ErrorKind::InvalidArgument)),
        }
    }

    fn interrupt_handle(&self) -> Option<Arc<dyn Interrupt>> {
        self.interruption.handle()
    }
}
