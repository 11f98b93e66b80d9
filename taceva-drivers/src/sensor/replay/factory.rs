//! The built-in driver `sensor/replay`.

use std::path::{Path, PathBuf};

use taceva_core::{
    ArgSpec, ArgValue, Args, Descriptor, DescriptorError, DescriptorSpec, DriverError, DriverKey,
    DriverSource, Factory, Facts, Hertz, Rig, Sensor, SensorFacts, submit_builtin,
};

use super::{Replay, ReplayOptions};
use crate::pace::{Pace, RealPace, VirtualPace};
use crate::source::{FolderSource, FrameSource, Timing};

const KEY: DriverKey = DriverKey::fixed("sensor/replay");

submit_builtin!(dyn Sensor, || Ok(Box::new(ReplayFactory::new()?)));

/// Opens a folder of PNG or JPEG files as a sensor.
#[derive(Debug)]
pub struct ReplayFactory {
    descriptor: Descriptor,
}

impl ReplayFactory {
    /// Creates the factory.
    ///
    /// # Errors
    /// [`DescriptorError`] if the descriptor is inconsistent, which tests rule out.
    pub fn new() -> Result<ReplayFactory, DescriptorError> {
        let arguments = [
            ArgSpec::path("folder").help("folder of the frames, PNG or JPEG"),
            ArgSpec::number("rate", 0.001, 100_000.0)
                .unit("Hz")
                .default(ArgValue::Number(30.0))
                .help("frames per second, if no table of times is given"),
            ArgSpec::path("times")
                .optional()
                .help("CSV table with the columns `file` and `t_s`, one row per frame"),
            ArgSpec::choice("pace", ["virtual", "real"])
                .default(ArgValue::Text("virtual".to_owned()))
                .help("virtual: as fast as frames are requested; real: at the recorded times"),
            ArgSpec::flag("repeat")
                .default(ArgValue::Flag(false))
                .help("start again after the last frame"),
        ];
        let facts = Facts::Sensor(Box::default());
        let title = "a folder of frames, replayed";
        let spec = DescriptorSpec::new(KEY, title, DriverSource::Recorded, facts);
        Ok(ReplayFactory {
            descriptor: spec.arguments(arguments).check()?,
        })
    }
}

impl Factory<dyn Sensor> for ReplayFactory {
    fn descriptor(&self) -> &Descriptor {
        &self.descriptor
    }

    fn describe(&self, args: &Args) -> Result<Descriptor, DescriptorError> {
        let mut spec = self.descriptor.to_spec();
        spec.facts = Facts::Sensor(Box::new(SensorFacts::default().with_rate(
            match timing(args) {
                Timing::Rate(rate) => Some(rate),
                Timing::Table(_) => None,
            },
        )));
        spec.check()
    }

    fn open(&self, args: &Args, _: &mut Rig) -> Result<Box<dyn Sensor>, DriverError> {
        let folder = Path::new(args.text("folder"));
        let source = FolderSource::open(folder, &timing(args)).map_err(|fault| {
            DriverError::new(fault.kind(), &KEY, "open the recording").because(fault)
        })?;
        let pace: Box<dyn Pace> = match args.text("pace") {
            "real" => Box::new(RealPace),
            _ => Box::new(VirtualPace::starting_at(source.times_s()[0])),
        };
        let options = ReplayOptions {
            driver: KEY,
            repeat: args.flag("repeat"),
        };
        Ok(Box::new(Replay::new(Box::new(source), pace, options)))
    }
}

fn timing(args: &Args) -> Timing {
    match args.get("times").and_then(ArgValue::as_text) {
        Some(table) => Timing::Table(PathBuf::from(table)),
        None => Timing::Rate(Hertz(args.number("rate"))),
    }
}
