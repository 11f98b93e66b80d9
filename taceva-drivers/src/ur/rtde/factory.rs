//! The built-in driver `ur/rtde`.

use taceva_core::{
    ArgSpec, ArgValue, Args, Descriptor, DescriptorError, DescriptorSpec, DriverError,
    DriverSource, ErrorKind, Factory, Facts, Rig, Robot, RobotFacts, submit_builtin,
};

use super::KEY;
use super::arm::{Arm, UrOptions, failed};
use crate::arguments::network::{port, port_of};
use crate::arguments::robot::{facts_of_robot, robot_facts, speed_limit, speed_max};

submit_builtin!(dyn Robot, || Ok(Box::new(UrFactory::new()?)));

/// Opens arms of Universal Robots (CB3 and e-Series): `ur/rtde:host=192.168.56.101`.
///
/// # The physical contract
/// - Poses are of the tool in the **base frame** of the arm, in mm and degrees (about x, y and z in turn).
/// - Opening connects and changes nothing. The arm must be switched on, with open brakes, in remote control and without a safety stop. A
///   person does that at the teach pendant; this driver never does.
/// - A move is a program with one `movel`. The move ends once no program runs and the reported pose is within 0.05 mm of the target.
/// - An expiring move is a program with one `speedl` that lasts 0.2 s and then brakes. The driver renews the program every 50 ms. The last 0.1 s of
///   the path is a `movel`. A short move, or a move with rotation of the tool, is a single `movel`.
/// - A halt sends a program with one `stopl` over a separate connection. The program replaces the running program. The controller does not confirm
///   that a program arrived. No move begins without this connection.
/// - Emergency, protective and safeguard stops end a move with `DeviceFault`.
/// - A speed slider of the pendant below 100 % gives a warning, since every motion is then slower.
/// - The driver refuses a controller that lacks one of the seven required outputs. The error names the output and the version of the controller.
/// - During a move, the driver watches the states that the arm sends. The states also report emergency, protective and safeguard stops.
///
/// # Verification
/// The driver passes its tests on an emulated controller. The public client `ur-rtde` 1.6.5 reads poses from that controller too, but only this
/// driver has sent programs to it. **Not verified without the device**: how soon a program begins, how soon `stopl` ends a program, and the
/// documented bits of the safety status. Also whether an arm keeps its speed if a `speedl` program of 0.2 s replaces another every 50 ms.
///
/// ```
/// use taceva_core::Factory;
/// use taceva_drivers::ur::rtde::UrFactory;
/// let factory = UrFactory::new()?;
/// assert!(factory.descriptor().args("host=192.168.56.101;speed_max_mm_s=20").is_ok());
/// # Ok::<(), taceva_core::DescriptorError>(())
/// ```
#[derive(Debug)]
pub struct UrFactory {
    descriptor: Descriptor,
}

impl UrFactory {
    /// Creates the factory.
    ///
    /// # Errors
    /// [`DescriptorError`] if the descriptor is inconsistent, which tests rule out.
    pub fn new() -> Result<UrFactory, DescriptorError> {
        let number = |key: &str, [least, most, usual]: [f64; 3], help: &str| {
            ArgSpec::number(key, least, most)
                .default(ArgValue::Number(usual))
                .help(help)
        };
        let arguments = [
            ArgSpec::text("host").help("name or address of the controller"),
            port("port", 30_004, "port of the real-time data exchange"),
            port("script_port", 30_002, "port that accepts scripts"),
            number(
                "rate",
                [10.0, 500.0, 125.0],
                "states per second; a CB3 sends at most 125",
            )
            .unit("Hz"),
            speed_limit(0.1, 100.0),
            number(
                "acceleration_mm_s2",
                [10.0, 5_000.0, 500.0],
                "acceleration and deceleration of the tip, mm/s²",
            ),
            number(
                "deceleration_mm_s2",
                [100.0, 10_000.0, 2_000.0],
                "deceleration of the tip after a halt, mm/s²",
            )
            .changes_facts(),
        ];
        let facts = Facts::Robot(RobotFacts::default().with_base_frame(true));
        let spec =
            DescriptorSpec::new(KEY, "an arm of Universal Robots", DriverSource::Real, facts);
        Ok(UrFactory {
            descriptor: spec.arguments(arguments).arguments(robot_facts()).check()?,
        })
    }
}

impl Factory<dyn Robot> for UrFactory {
    fn descriptor(&self) -> &Descriptor {
        &self.descriptor
    }

    fn describe(&self, args: &Args) -> Result<Descriptor, DescriptorError> {
        let mut spec = self.descriptor.to_spec();
        // The driver itself sets this deceleration.
        spec.facts = Facts::Robot(facts_of_robot(args));
        spec.check()
    }

    fn open(&self, args: &Args, _: &mut Rig) -> Result<Box<dyn Robot>, DriverError> {
        let speed_max = speed_max(args)
            .map_err(|error| failed(ErrorKind::InvalidArgument, "open the arm", error))?;
        let options = UrOptions {
            host: args.text("host").to_owned(),
            port: port_of(args, "port"),
            script_port: port_of(args, "script_port"),
            rate_hz: args.number("rate"),
            speed_max,
            acceleration_mm_s2: args.number("acceleration_mm_s2"),
            deceleration_mm_s2: args.number("deceleration_mm_s2"),
        };
        Ok(Box::new(Arm::open(options)?))
    }
}
