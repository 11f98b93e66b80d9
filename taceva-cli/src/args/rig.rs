//! Arguments of `taceva rig`.

use std::path::PathBuf;

use clap::{Args, Subcommand};

use super::{ListFormat, Output};

const RIG_HELP: &str = "\
Order for a new rig (docs/rig.md):
  taceva init rig --out lab.toml               asks for devices and limits; writes the file
  taceva rig teach lab.toml                    origin and axes of the robot, which you jog
  taceva rig check lab.toml                    every device for 2 s, and one halt
  taceva rig check lab.toml --weight 100g      the unit and calibration of the force
  taceva init scene                            asks what is measured; then taceva plan
  taceva run scene.toml --rig lab.toml --air   every contact point in the air
  taceva rig tap lab.toml                      latencies
  taceva run scene.toml --rig lab.toml         the measurement";

#[derive(Debug, Args)]
#[command(after_help = RIG_HELP)]
pub(crate) struct RigCommand {
    #[command(subcommand)]
    pub(crate) subject: RigSubject,
}

/// Operation on a rig.
#[derive(Debug, Subcommand)]
pub(crate) enum RigSubject {
    Teach(RigTeachArgs),
    Check(RigCheckArgs),
    Tap(RigTapArgs),
}

/// Measure rates, gaps and noise of its devices, and halt its robot once on its way up to measure the stopping time
///
/// Every device is read for 2 seconds without motion: its rate, its longest gap, the age of its values, and their noise. Put the tip at least a
/// centimetre above the gel first. You then permit motion by typing the name of the robot. The robot goes 5 mm straight up, away from the gel, and is
/// halted on the way.
///
/// Each device has a line: `ok`, `problem` for a value that would stop a run, or `error` with the remedy. A device that fails does not end
/// the check: the next one is tried. If the robot, the force transducer or the enabling switch failed, nothing moves, and the line of the
/// halt states why it was skipped. The exit code is 1 after any error or problem.
///
/// Do this once before the first run on a rig, and again after every change of its network, its machine or a device.
///
/// With --weight nothing moves and only the force transducer is opened: you take every load off it and hang a known weight on it once. The
/// change of Fz is compared with m·g, and the result is written into the rig file. If the force is in a wrong unit, the message names this unit.
#[derive(Debug, Args)]
pub(crate) struct RigCheckArgs {
    /// The rig file
    #[arg(value_name = "FILE")]
    pub(crate) rig: PathBuf,
    /// Compare only the force under this known weight with m·g: 100g, 0.2kg
    #[arg(long, value_name = "MASS", value_parser = mass_g)]
    pub(crate) weight: Option<f64>,
    #[command(flatten)]
    pub(crate) output: Output<ListFormat>,
}

/// Greatest accepted mass, g.
const GREATEST_MASS_G: f64 = 100_000.0;

/// Parses a mass and returns it in g.
fn mass_g(text: &str) -> Result<f64, String> {
    let is_of_unit = |letter: char| letter.is_ascii_alphabetic();
    let (number, unit) = text.split_at(text.find(is_of_unit).unwrap_or(text.len()));
    let per_g = match unit {
        "g" => Some(1.0),
        "kg" => Some(1e3),
        "mg" => Some(1e-3),
        _ => None,
    };
    let number: Option<f64> = number.trim().parse().ok();
    let mass_g = number.zip(per_g).map(|(number, per_g)| number * per_g);
    mass_g
        .filter(|mass_g| *mass_g > 0.0 && *mass_g <= GREATEST_MASS_G)
        .ok_or_else(|| "expected a mass in mg, g or kg, such as 100g, up to 100kg".to_owned())
}

/// Measure the position of its robot: you jog it to three places, and `origin_mm` and `axes` are written into the rig file
///
/// taceva does not move the robot. Jog it with its own pendant or program, to three places; taceva reads its position:
///
/// 1. the tip just touches the middle of the untouched gel,
/// 2. a little up and 5 to 10 mm along x of the sensor,
/// 3. from the middle, 5 to 10 mm along y of the sensor: a quarter turn clockwise from x, looking at the gel from outside.
///
/// A step that ends more than 0.5 mm off an axis of the robot's base is rejected, and so is a turned tool. The file must contain both keys,
/// with any values: origin_mm = [0.0, 0.0, 0.0] and axes = ["x", "y", "z"]. Everything else in it stays.
#[derive(Debug, Args)]
pub(crate) struct RigTeachArgs {
    /// The rig file, which is updated
    #[arg(value_name = "FILE")]
    pub(crate) rig: PathBuf,
}

/// Tap the gel to measure the latency of each device: `latency_ms` is written into the rig file
///
/// The robot taps the middle of the gel 20 times, fast and slowly in turn, with the specimen of the first press. Tip, force and picture
/// change at the same moment, so a delay after the robot is a latency. A spread of more than half a frame between taps is rejected.
///
/// The taps begin and are guarded like a run. You permit motion by typing the name of the robot. The robot moves through the air and touches gently,
/// and any contradiction to the rig file ends the command. The maximum depth and force of the gel must be stated by the driver of the sensor or under
/// [limits] of the rig file: Pz_max_mm and Fz_max_N. Every tap stays below half of both.
///
/// Latencies are printed, and then written into the file; everything else in it stays. Taps show only differences: a latency that all
/// devices share is not found.
#[derive(Debug, Args)]
pub(crate) struct RigTapArgs {
    /// The rig file, which is updated
    #[arg(value_name = "FILE")]
    pub(crate) rig: PathBuf,
    /// Print the latencies without changing the rig file
    #[arg(long)]
    pub(crate) dry_run: bool,
    #[command(flatten)]
    pub(crate) output: Output<ListFormat>,
}
