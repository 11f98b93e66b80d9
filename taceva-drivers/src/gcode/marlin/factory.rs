//! The built-in driver `gcode/marlin`.

use taceva_core::{
    Args, Descriptor, DescriptorError, DescriptorSpec, DriverError, DriverSource, ErrorKind,
    Factory, Facts, Found, Rig, Robot, RobotFacts, submit_builtin,
};

use super::KEY;
use super::machine::Printer;
use crate::arguments::robot::facts_of_robot;
use crate::gcode::limits::SerialOptions;
use crate::gcode::present::adapters;

submit_builtin!(dyn Robot, || Ok(Box::new(MarlinFactory::new()?)));

/// Opens printers with Marlin 2 on a serial port: `gcode/marlin:port=/dev/ttyACM0`.
///
/// # The physical contract
/// - Positions come from `M114`, in mm, in the frame set by homing: **home the printer first**, which this program never does. The printer has
///   three axes and does not rotate.
/// - Opening locks the serial port, which resets many boards; nothing moves. Firmware without `EMERGENCY_PARSER` is rejected, since a stop
///   would wait for the end of the motion. Firmware without `M118` is rejected too: it sends no echo. The firmware, machine type and UUID
///   that `M115` states become settings of the robot.
/// - A move is one `G1` followed by the wait `M400` and an echo (`M118`). It ends once the echo has come and `M114` is within 0.02 mm of the
///   target. The printer reports no position during the move. After 5 s without output, or without a whole echo, the printer counts as gone. The
///   firmware therefore needs `HOST_KEEPALIVE_FEATURE`, which is on by default.
/// - A halt is `M410`, which stops the motors **without deceleration**. Above a few mm/s a printer may lose steps, and with the steps its
///   position. Move slowly, and home the printer after a halt at speed. `clear_halt` sends no motion.
/// - An `Error:` of the firmware ends a move with `DeviceFault`; a person resets the printer.
///
/// # Verification
/// The driver passes its suite on an emulated printer on a pseudo-terminal. The virtual printer of OctoPrint 1.11.8 answers `M114`, `M115`,
/// `M118`, `G1` and `M400`. It does not know `M410` and makes its moves in a tenth of their time, so it confirms only the syntax of commands.
/// **Not verified without the device**: all timing, how a printer stops after `M410`, and its position afterwards.
///
/// ```
/// use taceva_core::Factory;
/// use taceva_drivers::gcode::marlin::MarlinFactory;
/// let factory = MarlinFactory::new()?;
/// assert!(factory.descriptor().args("port=/dev/ttyACM0;baud=250000;speed_max_mm_s=5").is_ok());
/// # Ok::<(), taceva_core::DescriptorError>(())
/// ```
#[derive(Debug)]
pub struct MarlinFactory {
    descriptor: Descriptor,
}

impl MarlinFactory {
    /// Creates the factory.
    ///
    /// # Errors
    /// [`DescriptorError`] if the descriptor is inconsistent, which tests rule out.
    pub fn new() -> Result<MarlinFactory, DescriptorError> {
        let facts = Facts::Robot(RobotFacts::default().with_base_frame(true));
        let spec = DescriptorSpec::new(KEY, "a printer with Marlin", DriverSource::Real, facts);
        Ok(MarlinFactory {
            descriptor: spec.arguments(SerialOptions::arguments()).check()?,
        })
    }
}

impl Factory<dyn Robot> for MarlinFactory {
    fn descriptor(&self) -> &Descriptor {
        &self.descriptor
    }

    fn describe(&self, args: &Args) -> Result<Descriptor, DescriptorError> {
        let mut spec = self.descriptor.to_spec();
        spec.facts = Facts::Robot(facts_of_robot(args));
        spec.check()
    }

    fn open(&self, args: &Args, _: &mut Rig) -> Result<Box<dyn Robot>, DriverError> {
        let options = SerialOptions::of(args).map_err(|error| {
            DriverError::new(ErrorKind::InvalidArgument, &KEY, "open the printer").because(error)
        })?;
        Ok(Box::new(Printer::open(options)?))
    }

    fn discover(&self) -> Result<Vec<Found>, DriverError> {
        Ok(adapters(&KEY))
    }
}
