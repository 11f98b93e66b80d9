//! The built-in driver `ufactory/xarm`.

use taceva_core::{
    ArgSpec, ArgValue, Args, Descriptor, DescriptorError, DescriptorSpec, DriverError,
    DriverSource, ErrorKind, Factory, Facts, Rig, Robot, RobotFacts, submit_builtin,
};

use super::KEY;
use super::arm::Arm;
use super::options::XarmOptions;
use crate::arguments::network::port;
use crate::arguments::robot::{deceleration, facts_of_robot, robot_facts, speed_limit};

submit_builtin!(dyn Robot, || Ok(Box::new(XarmFactory::new()?)));

/// Opens arms of UFACTORY's xArm family: `ufactory/xarm:host=192.168.1.200`.
///
/// # The physical contract
/// - Poses are of the tool in the **base frame** of the arm, in mm and degrees (roll, pitch, yaw), as UFACTORY Studio shows them.
/// - Opening connects and changes nothing. The arm must be enabled, in position mode and without an error. A person does that in UFACTORY
///   Studio: this driver never enables motors and never clears an error.
/// - A move is one straight line with all six numbers of the pose. The move ends once the controller is ready, its queue is empty and the
///   reported pose is within 0.05 mm of the target.
/// - The controller states its limits in a report on `rich_port`. The driver refuses speeds and accelerations outside these limits, because the
///   controller would change them without an error. Without this report the limits are unknown, and the driver gives a warning.
/// - An expiring motion uses velocities that last 0.2 s (register 82, since firmware 1.10.0). The driver renews them 20 times per second. The last
///   0.1 s of the path is a move. The arm stops for a moment whenever the controller changes between velocity mode and position mode.
/// - A halt uses a separate connection, which the driver tests twice per second. No move begins without this connection. The controller confirms
///   the halt. After 40 ms without an answer, the driver also sends the halt over the connection for moves. `clear_halt` makes the controller
///   ready again unless it has an error.
/// - The emergency stop, a collision, the safety boundary and every other error of the controller end a move with `DeviceFault`.
///
/// # Verification
/// Frames match those of the public client `xarm-python-sdk` 1.18.4, for both layouts of a straight line (before and since firmware
/// 1.11.100). The driver passes its tests on an emulated controller, which serves that client too. **Not verified without the device**: how
/// fast an arm stops, how exactly it keeps a velocity and reaches its end, and how long an idle connection lasts. Also whether the pose of
/// port 30003 is measured or commanded.
///
/// ```
/// use taceva_drivers::ufactory::xarm::XarmFactory;
/// use taceva_core::Factory;
/// let factory = XarmFactory::new()?;
/// assert!(factory.descriptor().args("host=192.168.1.200;speed_max_mm_s=20").is_ok());
/// # Ok::<(), taceva_core::DescriptorError>(())
/// ```
#[derive(Debug)]
pub struct XarmFactory {
    descriptor: Descriptor,
}

impl XarmFactory {
    /// Creates the factory.
    ///
    /// # Errors
    /// [`DescriptorError`] if the descriptor is inconsistent, which tests rule out.
    pub fn new() -> Result<XarmFactory, DescriptorError> {
        let arguments = [
            ArgSpec::text("host").help("name or address of the control box"),
            port("port", 502, "port for commands"),
            port("pose_port", 30_003, "port of 100 pose reports per second; if it is closed, poses are polled"),
            port("status_port", 30_001, "port of reports with errors; if it is closed, errors are polled"),
            port("rich_port", 30_002, "port of complete reports, read once for limits; if it is closed, limits are unknown"),
            speed_limit(0.1, 100.0),
            ArgSpec::number("acceleration_mm_s2", 10.0, 5_000.0)
                .default(ArgValue::Number(500.0))
                .help("acceleration and deceleration of the tip, mm/s²"),
            ArgSpec::text("workspace")
                .optional()
                .help("box that the tip must stay in, mm in the base frame: smallest x,y,z, then largest, six numbers with commas")
                .changes_facts(),
        ];
        let facts = Facts::Robot(RobotFacts::default().with_base_frame(true));
        let spec = DescriptorSpec::new(KEY, "an arm of UFACTORY", DriverSource::Real, facts);
        Ok(XarmFactory {
            descriptor: spec
                .arguments(arguments)
                .arguments([deceleration()])
                .arguments(robot_facts())
                .check()?,
        })
    }
}

impl Factory<dyn Robot> for XarmFactory {
    fn descriptor(&self) -> &Descriptor {
        &self.descriptor
    }

    fn describe(&self, args: &Args) -> Result<Descriptor, DescriptorError> {
        let mut spec = self.descriptor.to_spec();
        // Inconsistent arguments are rejected with a message at open.
        if let Ok(options) = XarmOptions::read(args) {
            spec.facts = Facts::Robot(facts_of_robot(args).with_workspace(options.workspace));
        }
        spec.check()
    }

    fn open(&self, args: &Args, _: &mut Rig) -> Result<Box<dyn Robot>, DriverError> {
        let options = XarmOptions::read(args).map_err(|error| {
            DriverError::new(ErrorKind::InvalidArgument, &KEY, "open the arm").because(error)
        })?;
        Ok(Box::new(Arm::open(options)?))
    }
}
