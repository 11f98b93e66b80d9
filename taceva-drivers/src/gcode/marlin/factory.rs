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

/// Opens printers with Marlin 2 on a serial line: `gcode/marlin:port=/dev/ttyACM0`.
///
/// # The physical contract
/// - Places are those of `M114`, in mm, in the frame that homing gave it: **home it before**, which this program never does. It has three axes
///   and does not turn.
/// - Opening takes the line for itself alone, which resets many boards; nothing moves. Firmware without `EMERGENCY_PARSER` is refused: a stop would
///   wait behind the motion that it is to stop.
/// - A move is one `G1` and the wait `M400` behind it. It ends once the wait is answered and `M114` is within 0.02 mm of the target. On its way
///   the printer does not tell where it is. One that says nothing for 5 s counts as gone: its firmware needs `HOST_KEEPALIVE_FEATURE`, which it has
///   unless somebody took it out.
/// - A halt is `M410`, by which the motors stand **without slowing down**: from more than a few mm/s a printer may lose steps, and with them its
///   place. Move slowly, and home it after a halt at speed. `clear_halt` sends nothing that moves.
/// - An `Error:` of the firmware ends a move with `DeviceFault`; a person resets it.
///
/// # What confirmed it
/// An emulated printer on a pseudo-terminal, on which the driver passes its suite, and the virtual printer of OctoPrint 1.11.8, which answers `M114`,
/// `M115`, `M118`, `G1` and `M400` (it knows no `M410`, and makes its moves in a tenth of their time: it proves the dialect alone). **Not verified
/// without the device**: every time, how a printer stands after `M410`, and which places it has then.
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
    /// The driver.
    ///
    /// # Errors
    /// [`DescriptorError`] if it contradicted itself, which its tests rule out.
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
