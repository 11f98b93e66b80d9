//! The built-in driver `gcode/grbl`.

use taceva_core::{
    Args, Descriptor, DescriptorError, DescriptorSpec, DriverError, DriverSource, ErrorKind,
    Factory, Facts, Found, Rig, Robot, RobotFacts, submit_builtin,
};

use super::KEY;
use super::machine::{Machine, failed};
use crate::arguments::robot::facts_of_robot;
use crate::gcode::limits::SerialOptions;
use crate::gcode::present::adapters;

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
/// use taceva_drivers::gcode::grbl::GrblFactory;
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
        let facts = Facts::Robot(RobotFacts::default().with_base_frame(true));
        let spec = DescriptorSpec::new(KEY, "a machine with GRBL", DriverSource::Real, facts);
        Ok(GrblFactory {
            descriptor: spec.arguments(SerialOptions::arguments()).check()?,
        })
    }
}

impl Factory<dyn Robot> for GrblFactory {
    fn descriptor(&self) -> &Descriptor {
        &self.descriptor
    }

    fn describe(&self, args: &Args) -> Result<Descriptor, DescriptorError> {
        let mut spec = self.descriptor.to_spec();
        spec.facts = Facts::Robot(facts_of_robot(args));
        spec.check()
    }

    fn open(&self, args: &Args, _: &mut Rig) -> Result<Box<dyn Robot>, DriverError> {
        let options = SerialOptions::of(args)
            .map_err(|error| failed(ErrorKind::InvalidArgument, "open the machine", error))?;
        Ok(Box::new(Machine::open(options)?))
    }

    fn discover(&self) -> Result<Vec<Found>, DriverError> {
        Ok(adapters(&KEY))
    }
}
