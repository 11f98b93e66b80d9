//! Arguments of `taceva rig`.

use std::path::PathBuf;

use clap::{Args, Subcommand};

use super::{ListFormat, Output};

#[derive(Debug, Args)]
pub(crate) struct RigCommand {
    #[command(subcommand)]
    pub(crate) subject: RigSubject,
}

/// What to do with a rig.
#[derive(Debug, Subcommand)]
pub(crate) enum RigSubject {
    /// Listen to its devices, and halt its robot once on its way up: rates, gaps, noise, and how soon it stops
    Check(RigCheckArgs),
    /// Tap the gel to measure how late each device is: `latency_ms` is written into the rig file
    Tap(RigTapArgs),
    /// Learn where its robot stands: you jog it to three places, and `origin_mm` and `axes` are written into the rig file
    Teach(RigTeachArgs),
}

/// Every device is listened to for 2 seconds while nothing moves: how often it sends, its longest pause, how old its values are, and how far
/// that scatters. Then, if you let it by typing its name, the robot goes 5 mm straight up, away from the gel, and is halted on the way. Put the
/// tip at least a centimetre above the gel before. Whatever would stop a run is reported with its remedy; the exit code is 1 then.
///
/// Do this once before the first run on a rig, and again whenever its network, its machine or a device has changed.
#[derive(Debug, Args)]
pub(crate) struct RigCheckArgs {
    /// The rig file
    #[arg(value_name = "FILE")]
    pub(crate) rig: PathBuf,
    #[command(flatten)]
    pub(crate) output: Output<ListFormat>,
}

/// Nothing is moved by this program: you jog the robot by its own tool, and this program reads where it stands.
///
/// 1. until the tip just touches the middle of the untouched gel,
/// 2. a little up and 5 to 10 mm along x of the sensor,
/// 3. from the middle 5 to 10 mm along y of the sensor, so that z points into the gel.
///
/// A way that ends more than 0.5 mm off an axis of the robot's base is refused, and so is a turned tool. The file needs both keys
/// before, with any values: origin_mm = [0.0, 0.0, 0.0] and axes = ["x", "y", "z"]. Everything else in it stays as it is.
#[derive(Debug, Args)]
pub(crate) struct RigTeachArgs {
    /// The rig file, which is written anew
    #[arg(value_name = "FILE")]
    pub(crate) rig: PathBuf,
}

/// The robot taps the middle of the gel 20 times, fast and slowly in turn, with the specimen of the first press. Tip, force and picture change at
/// the same moment: what a device says later than the robot is its latency. A spread of more than half a frame from tap to tap is refused.
///
/// The gel is touched under the same guard and with the same beginning as of a run: you let the robot move by typing its name, it passes through
/// the air and touches gently, and what contradicts the rig file ends it. How deep and how hard the gel may be pressed must be stated by the driver
/// of the sensor or under [limits] of the rig file: Pz_max_mm and Fz_max_N. Every tap stays below half of both.
///
/// What was found is printed, and then written into the file; everything else in it stays as it is. Taps show differences alone: a latency that all
/// devices share is not found.
#[derive(Debug, Args)]
pub(crate) struct RigTapArgs {
    /// The rig file, which is written anew
    #[arg(value_name = "FILE")]
    pub(crate) rig: PathBuf,
    /// Print what is found, and write nothing into the rig file
    #[arg(long)]
    pub(crate) dry_run: bool,
    #[command(flatten)]
    pub(crate) output: Output<ListFormat>,
}
