//! The built-in driver `gcode/grbl`.

use taceva_core::{
    ArgSpec, ArgValue, Args, Descriptor, DescriptorError, DescriptorSpec, DriverError,
    DriverSource, ErrorKind, Factory, Facts, Rig, Robot, RobotFacts, Speed, submit_builtin,
};

use super::KEY;
use super::machine::{GrblOptions, Machine, failed};

submit_builtin!(dyn Robot, || Ok(Box::new(GrblFactory::new()?)));

/// Opens machines with GRBL 1.1 on a serial line: `gcode/grbl:port=/dev/ttyUSB0`.
///
/// # The physical contract
/// - Places are those of the **machine's own frame** (`MPos`), in mm; it has three axes and does not turn. It must report them (`$10=1`).
/// - Opening takes the line for itself alone, which resets many boards; nothing moves. A machine in alarm is not moved: a person resets and
///   homes it.
/// - A move is one `G53 G1`. It ends once the machine is idle within 0.02 mm of the target.
/// - A halt is the byte `!`, which the machine takes at once and slows down for. `clear_halt` resets it once it stands, which loses no place.
///
/// # What confirmed it
/// An emulated machine on a pseudo-terminal, on which the driver passes its suite; its dialect is that of GRBL's documents, and no firmware has
/// spoken to the driver. **Not verified without the device**: how soon it stands, and boards that reset otherwise.
///
/// ```
/// use taceva_core::Factory;
/// use taceva_drivers::GrblFactory;
/// let factory = GrblFactory::new()?;
/// assert!(factory.descriptor().args("port=/dev/ttyUSB0;speed_max_mm_s=10").is_ok());
/// # Ok::<(), taceva_core::DescriptorError>(())
/// ```
#[derive(Debug)]
pub struct GrblFactory {
    descriptor: Descriptor,
}

impl GrblFactory {
    /// The driver.
    ///
    /// # Errors
    /// [`DescriptorError`] if it contradicted itself, which its tests rule out.
    pub fn new() -> Result<GrblFactory, DescriptorError> {
        let arguments = [
            ArgSpec::path("port").help("the serial line, such as /dev/ttyUSB0"),
            ArgSpec::whole("baud", 1_200, 4_000_000)
                .default(ArgValue::Whole(115_200))
                .help("its speed"),
            ArgSpec::number("speed_max_mm_s", 0.01, 250.0)
                .default(ArgValue::Number(20.0))
                .help("the greatest speed of the tip, in mm/s")
                .changes_facts(),
        ];
        let facts = Facts::Robot(RobotFacts::default().with_base_frame(true));
        let spec = DescriptorSpec::new(KEY, "a machine with GRBL", DriverSource::Real, facts);
        Ok(GrblFactory {
            descriptor: spec.arguments(arguments).check()?,
        })
    }
}

impl Factory<dyn Robot> for GrblFactory {
    fn descriptor(&self) -> &Descriptor {
        &self.descriptor
    }

    fn describe(&self, args: &Args) -> Result<Descriptor, DescriptorError> {
        let mut spec = self.descriptor.to_spec();
        if let Facts::Robot(facts) = &mut spec.facts {
            facts.speed_max = Speed::try_new(args.number("speed_max_mm_s")).ok();
        }
        spec.check()
    }

    fn open(&self, args: &Args, _: &mut Rig) -> Result<Box<dyn Robot>, DriverError> {
        let doing = "open the machine";
        let speed_max = Speed::try_new(args.number("speed_max_mm_s"))
            .map_err(|error| failed(ErrorKind::InvalidArgument, doing, error))?;
        let options = GrblOptions {
            port: args.text("port").to_owned(),
            baud: u32::try_from(args.whole("baud")).unwrap_or(0),
            speed_max,
        };
        Ok(Box::new(Machine::open(options)?))
    }
}
