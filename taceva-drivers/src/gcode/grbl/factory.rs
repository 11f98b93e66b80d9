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

/// Opens machines with GRBL 1.1 on a serial port: `gcode/grbl:port=/dev/ttyUSB0`.
///
/// # The physical contract
/// - Positions are in the **machine's own frame** (`MPos`), in mm. The machine has three axes and does not rotate. It must report these
///   positions (`$10=1`).
/// - Opening locks the serial port, which resets many boards; nothing moves. A machine in alarm is not moved: a person resets and homes it.
///   The answer to `$I`, a version and the owner's text, becomes settings of the robot. A machine in motion or in a hold does not answer `$I`.
/// - A move is one `G53 G1`. It ends once the machine is idle within 0.02 mm of the target.
/// - A halt is the byte `!`, on which the machine decelerates at once. `clear_halt` resets the machine once it is at rest, which keeps its
///   position.
///
/// # Verification
/// The driver passes its suite on an emulated machine on a pseudo-terminal. The emulated dialect follows GRBL's documents; no firmware was tested.
/// **Not verified without the device**: stopping times, and boards that reset differently.
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
    /// Creates the factory.
    ///
    /// # Errors
    /// [`DescriptorError`] if the descriptor is inconsistent, which tests rule out.
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
