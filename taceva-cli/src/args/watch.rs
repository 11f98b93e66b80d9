//! Arguments of `taceva watch`.

use std::path::PathBuf;

use clap::{ArgGroup, Args};

use super::{LiveArgs, ViewArgs};

const WATCH_HELP: &str = "\
Untouched pictures are those with a force below 0.05 N by --force or by the rig file, and pictures of contact those above 0.1 N. Without a
transducer every picture counts as untouched: touch nothing. The first 10 untouched pictures after a contact are not watched. In a recording the
labels Fz or Pz show the contact.

The mean of 50 untouched pictures is the baseline, and the next 200 set the limits. Both come from --calibration if it has at least 100 (50 or
more then set the limits), otherwise, and with --fresh, from the first 250 watched pictures. Then a change is found within 30 untouched pictures. Each
kind of change is printed once, with its remedy. Drift is a change: switch the sensor on half an hour before.

The exit code is 1 if a change was found, or if the untouched pictures are too few to decide, otherwise 0.";

/// Watch a sensor in use, or a recording of it: changes of the camera, the light and the gel, with remedies
///
/// Untouched pictures are compared with those of the calibration, and pictures of contact with the training pictures of the
/// model. Each change is printed in one line, with its strength and its remedy. The strength is relative to the change by contact. For
/// repeated pictures, and for pictures of contact, the strength is their share of the newest 30 pictures.
#[derive(Debug, Args)]
#[command(after_help = WATCH_HELP, group = ArgGroup::new("watched").required(true).multiple(true).args(["sensor", "rig", "recording"]))]
pub(crate) struct Watch {
    /// A fitted model file
    #[arg(value_name = "MODEL")]
    pub(crate) model: PathBuf,
    /// Watch this recording instead of a sensor
    #[arg(long, value_name = "DATASET", conflicts_with_all = ["sensor", "force", "rig", "frames"])]
    pub(crate) recording: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) live: LiveArgs,
    /// The recording of the calibration: its reference picture and its change by contact [default: the watched recording]
    #[arg(long, value_name = "DATASET", required_unless_present = "recording")]
    pub(crate) calibration: Option<PathBuf>,
    /// Set the limits from the first pictures that are watched, not from the calibration. Use it after a new untouched picture
    #[arg(long, requires = "calibration")]
    pub(crate) fresh: bool,
    /// Number of pictures of the sensor [default: until Ctrl-C]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    pub(crate) frames: Option<u64>,
    #[command(flatten)]
    pub(crate) view: ViewArgs,
}
