//! Options and limits of G-code machines on a serial port, for GRBL and Marlin.

use taceva_core::{
    ArgSpec, ArgValue, Args, DriverError, DriverKey, ErrorKind, Point, Pose, Rotation, Speed,
    SpeedError, check_pose,
};

use crate::arguments::robot::{deceleration, robot_facts, speed_limit, speed_max};

/// Options for opening a machine.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SerialOptions {
    pub(super) port: String,
    pub(super) baud: u32,
    pub(super) speed_max: Speed,
}

/// Name of a move in error messages.
pub(super) const MOVE: &str = "move the machine";
/// Seconds per minute, to convert mm/s to mm/min.
const SECONDS: f64 = 60.0;

impl SerialOptions {
    /// Arguments that every driver of a G-code machine accepts.
    pub(super) fn arguments() -> Vec<ArgSpec> {
        let mut arguments = vec![
            ArgSpec::path("port")
                .help("serial port, such as /dev/ttyUSB0 or a file below /dev/serial/by-id"),
            ArgSpec::whole("baud", 1_200, 4_000_000)
                .default(ArgValue::Whole(115_200))
                .help("baud rate of the port"),
            speed_limit(0.01, 20.0),
            deceleration(),
        ];
        arguments.extend(robot_facts());
        arguments
    }

    /// Reads the options from `args`.
    ///
    /// # Errors
    /// [`SpeedError`] for an invalid speed, which the range of the argument rules out.
    pub(super) fn of(args: &Args) -> Result<SerialOptions, SpeedError> {
        Ok(SerialOptions {
            port: args.text("port").to_owned(),
            baud: u32::try_from(args.whole("baud")).unwrap_or(0),
            speed_max: speed_max(args)?,
        })
    }

    /// Rejects a motion with an invalid pose, with a rotation, or above the speed limit of the machine.
    ///
    /// # Errors
    /// `InvalidArgument` and `OutOfRange`, as [`Robot::move_to`](taceva_core::Robot::move_to).
    pub(super) fn check(
        &self,
        driver: &DriverKey,
        target: &Pose,
        speed: Speed,
    ) -> Result<(), DriverError> {
        let failed = |kind, why: String| Err(DriverError::new(kind, driver, MOVE).because(why));
        if let Err(error) = check_pose(target) {
            return failed(ErrorKind::InvalidArgument, error.to_string());
        }
        if target.rotation != Rotation::default() {
            let why = format!(
                "a rotation of {}, expected none: the machine has three axes",
                target.rotation
            );
            return failed(ErrorKind::OutOfRange, why);
        }
        let most = self.speed_max;
        if speed > most {
            let why = format!("a speed of {speed}, expected at most {most}");
            return failed(ErrorKind::OutOfRange, why);
        }
        Ok(())
    }
}

/// G-code command for a straight motion to `target`, in mm and mm/min.
pub(super) fn straight(target: &Point, speed: Speed) -> String {
    let Point { x, y, z } = target;
    let feed = speed.mm_per_s() * SECONDS;
    format!("G1 X{:.4} Y{:.4} Z{:.4} F{feed:.3}", x.0, y.0, z.0)
}

/// Distance between `place_mm` and `target`, mm.
pub(super) fn short_mm(place_mm: [f64; 3], target: &Point) -> f64 {
    let target = [target.x.0, target.y.0, target.z.0];
    let sides = place_mm.iter().zip(target).map(|(at, to)| at - to);
    sides.map(|side| side * side).sum::<f64>().sqrt()
}
