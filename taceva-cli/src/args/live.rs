//! Arguments of the commands that use a sensor without a robot.

use std::path::PathBuf;
use std::time::Duration;

use clap::builder::NonEmptyStringValueParser;
use clap::{ArgGroup, Args};

/// Devices of a capture or a preview.
#[derive(Debug, Args)]
pub(crate) struct LiveArgs {
    /// The sensor, as `taceva devices` lists it: camera/mjpeg:url=http://192.168.1.20:8080/?action=stream
    #[arg(long, value_name = "DRIVER")]
    pub(crate) sensor: Option<String>,
    /// The force transducer under the sensor or in the indenter: sri/m8128:host=192.168.0.108; without one, frames have no labels
    #[arg(long, value_name = "DRIVER")]
    pub(crate) force: Option<String>,
    /// A rig file with a sensor and optionally a transducer, instead of --sensor and --force; it also states the axis that presses into the gel and
    /// the latency of devices, see docs/capture.md. Its robot is not used
    #[arg(long, value_name = "FILE")]
    pub(crate) rig: Option<PathBuf>,
}

const CAPTURE_HELP: &str = "\
First the force is zeroed and a frame without contact is stored: touch nothing until it says `press`. Then press by hand, many times, at
different places, harder and softer. A contact begins above 0.1 N and ends below 0.05 N. Each contact is its own point, hand-1, hand-2 …,
so no contact is in both the training and the test part. Frames between contacts are rest-0, rest-1 …

  taceva capture presses --rig hand.toml --for 5min    frames and forces, five minutes
  taceva check presses                                 lost frames, saturation, timing
  taceva evaluate presses --model ridge --html presses.html

With --model a fitted model predicts frames as they arrive. Page, terminal and recording mark these numbers as predictions:
OUT/predictions.csv has them by frame, dataset.toml names the model and its digest, and they never become labels. The model never slows the
capture: it skips frames that arrive too fast, and counts them. A model that needs a frame without contact uses the first one.

  taceva capture more --rig hand.toml --model presses.taceva    forces measured and predicted, side by side on a page

Ctrl-C ends the capture; the dataset is complete. The progress line, the header and `taceva check` (TAC015) count lost frames.
A frame is lost if the queue of 8 frames is full, or if the program does not read it in time: frame numbers then have a gap.

The exit code is 0 after --for or --frames, or at Ctrl-C without either; 4 if a device failed; 5 at Ctrl-C before --for or --frames. The
dataset is complete in each case. After a full disk or a power cut `taceva capture OUT --close` closes the interrupted recording.";

/// Record a sensor without a robot: frames, and the force of presses by hand
#[derive(Debug, Args)]
#[command(after_help = CAPTURE_HELP, group = ArgGroup::new("what").required(true).multiple(true).args(["sensor", "rig", "close"]))]
pub(crate) struct Capture {
    /// The dataset to write: a new folder
    #[arg(value_name = "OUT")]
    pub(crate) path: PathBuf,
    #[command(flatten)]
    pub(crate) live: LiveArgs,
    /// Duration of the capture by the timestamps of its frames: 60s, 5min [default: until Ctrl-C]
    #[arg(long = "for", value_name = "TIME", value_parser = duration)]
    pub(crate) lasts: Option<Duration>,
    /// Number of frames after which the capture ends
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    pub(crate) frames: Option<u64>,
    /// Name of the sensor in reports [default: the name of its driver]
    #[arg(long, value_name = "NAME")]
    pub(crate) name: Option<String>,
    /// The serial number of the sensor
    #[arg(long, value_name = "TEXT")]
    pub(crate) serial: Option<String>,
    /// The id of the gel
    #[arg(long, value_name = "TEXT")]
    pub(crate) gel: Option<String>,
    /// The name of the person who presses, for reports [default: `name` under [operator] of the rig file]
    #[arg(long, value_name = "NAME", value_parser = NonEmptyStringValueParser::new())]
    pub(crate) operator: Option<String>,
    /// The name of the laboratory, for reports [default: `laboratory` of the rig file]
    #[arg(long, value_name = "NAME", value_parser = NonEmptyStringValueParser::new())]
    pub(crate) laboratory: Option<String>,
    /// A fitted model, as `taceva fit` writes it; predicts as many frames as time permits, on a page and into OUT/predictions.csv
    #[arg(long, value_name = "FILE")]
    pub(crate) model: Option<PathBuf>,
    /// The port of the page that --model opens on 127.0.0.1, 0 for any free port
    #[arg(long, value_name = "N", default_value_t = 0, requires = "model")]
    pub(crate) port: u16,
    /// Open no device: close a capture that was interrupted by a full disk, a power cut or a kill
    #[arg(long, conflicts_with_all = ["sensor", "force", "rig", "lasts", "frames", "name", "serial", "gel", "operator", "laboratory", "model"])]
    pub(crate) close: bool,
}

/// Port of the page of a preview or a run.
#[derive(Clone, Copy, Debug, Args)]
pub(crate) struct PortArgs {
    /// The port of the page on 127.0.0.1, 0 for any free port
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(crate) port: u16,
}

const PREVIEW_HELP: &str = "Prints the address of a page on this machine. The page shows the camera at 15 pictures a second, the force, lost frames, the share of saturated
pixels, and a sharpness that is greatest in focus. Nothing is recorded. Ctrl-C or the button of the page ends the preview.

With --model a fitted model predicts the newest picture, up to 60 a second. The page shows predicted newtons and millimetres over that picture,
marked as predictions, and marks pictures unlike the training pictures. The preview skips and counts older pictures if the model is too slow.
At the end the command prints the frames seen, shown and skipped, and the share unlike the training pictures. It also prints the delay
from the stamp to the page that 95 % of the pictures did not exceed.

  taceva preview --sensor camera/mjpeg:url=http://192.168.1.20:8080/?action=stream
  taceva preview --rig hand.toml
  taceva preview --rig hand.toml --model presses.taceva

Keep the address secret: its token after # lets anyone view and stop the preview. The page is reachable only from this machine; from another one, use
ssh -L 8000:127.0.0.1:8000 with --port 8000.";

/// Look at a sensor in a browser: live frames, force, focus and saturation; nothing is recorded
#[derive(Debug, Args)]
#[command(after_help = PREVIEW_HELP, group = ArgGroup::new("seen").required(true).multiple(true).args(["sensor", "rig"]))]
pub(crate) struct Preview {
    #[command(flatten)]
    pub(crate) live: LiveArgs,
    /// A fitted model, as `taceva fit` writes it, whose predictions are shown over the picture
    #[arg(long, value_name = "FILE")]
    pub(crate) model: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) page: PortArgs,
}

/// Maximum duration of a capture, s: a day.
const LONGEST_S: f64 = 86_400.0;

fn duration(text: &str) -> Result<Duration, String> {
    let expected = || "expected a time up to a day, such as 60s, 2.5min or 1h".to_owned();
    let units = [("min", 60.0), ("h", 3600.0), ("s", 1.0)];
    let found = units
        .into_iter()
        .find_map(|(unit, seconds)| Some((text.strip_suffix(unit)?, seconds)));
    let (number, seconds) = found.ok_or_else(expected)?;
    let number: f64 = number.trim().parse().map_err(|_| expected())?;
    let lasts_s = number * seconds;
    match lasts_s > 0.0 && lasts_s <= LONGEST_S {
        true => Ok(Duration::from_secs_f64(lasts_s)),
        false => Err(expected()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_have_a_unit_and_an_end() {
        assert_eq!(duration("60s"), Ok(Duration::from_secs(60)));
        assert_eq!(duration("2.5min"), Ok(Duration::from_secs(150)));
        assert_eq!(duration("1 h"), Ok(Duration::from_secs(3600)));
        for wrong in [
            "", "60", "s", "0s", "-1s", "25h", "NaNs", "infs", "1e9s", "5 m",
        ] {
            assert!(duration(wrong).is_err(), "{wrong}");
        }
    }
}
