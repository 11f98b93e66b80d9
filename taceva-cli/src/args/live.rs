//! Arguments of the commands that use a sensor without a robot.

use std::path::PathBuf;
use std::time::Duration;

use clap::{ArgGroup, Args};

/// Devices of a capture or a preview.
#[derive(Debug, Args)]
pub(crate) struct LiveArgs {
    /// The sensor, as `taceva devices` lists it: camera/mjpeg:url=http://192.168.1.20:8080/?action=stream
    #[arg(long, value_name = "DRIVER")]
    pub(crate) sensor: Option<String>,
    /// The force transducer under the sensor or in the indenter: sri/m8128:host=192.168.0.108
    #[arg(long, value_name = "DRIVER")]
    pub(crate) force: Option<String>,
    /// A rig file with a sensor and optionally a transducer, instead of the two options; it also states the axis that presses into the gel
    /// and the latency of devices, see docs/capture.md. Its robot is not used
    #[arg(long, value_name = "FILE")]
    pub(crate) rig: Option<PathBuf>,
}

const CAPTURE_HELP: &str = "\
Before it begins, the force is called zero and a frame is kept as the one without contact: touch nothing until it says `press`. Then press
by hand, again and again, at other places, harder and softer. A contact begins above 0.1 N and ends below 0.05 N; each is a point of its own,
hand-1, hand-2 …, so that none is both trained and tested on. Between contacts frames are rest-0, rest-1 …

  taceva capture presses --rig hand.toml --for 5min    frames and forces, five minutes
  taceva check presses                                 lost frames, saturation, timing
  taceva evaluate presses --model ridge --html presses.html

With --model a fitted model predicts frames as they come. Page, terminal and recording call that predictions: they stand in
OUT/predictions.csv by frame, dataset.toml names the model and its digest, and no label is made of them. The model never slows the capture: a
frame that it has no time for is left out and counted. Where the model needs a frame without contact, the first is it.

  taceva capture more --rig hand.toml --model presses.taceva    forces measured and predicted, side by side on a page

Ctrl-C ends it; what was recorded is a whole dataset. Frames that found no room in the queue of 8, or that the camera numbered and nobody
took in time, are counted: on the progress line, in the header, and by `taceva check` (TAC015).

Exit code 0 at the end that was asked for, and by Ctrl-C where none was; 4 if a device failed and 5 by Ctrl-C before that end: the dataset
is whole then too. After a full disk or a power cut `taceva capture OUT --close` closes what is there.";

/// Record a sensor without a robot: frames, and the force of presses by hand
#[derive(Debug, Args)]
#[command(after_help = CAPTURE_HELP, group = ArgGroup::new("what").required(true).multiple(true).args(["sensor", "rig", "close"]))]
pub(crate) struct Capture {
    /// The dataset to write: a new folder
    #[arg(value_name = "OUT")]
    pub(crate) path: PathBuf,
    #[command(flatten)]
    pub(crate) live: LiveArgs,
    /// Duration by the stamps of the frames: 60s, 5min [default: until Ctrl-C]
    #[arg(long = "for", value_name = "TIME", value_parser = duration)]
    pub(crate) lasts: Option<Duration>,
    /// Number of frames
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
    /// A fitted model, as `taceva fit` writes it; predicts as many frames as time permits, on a page and into OUT/predictions.csv
    #[arg(long, value_name = "FILE")]
    pub(crate) model: Option<PathBuf>,
    /// The port of the page of --model on 127.0.0.1, 0 for any free port
    #[arg(long, value_name = "N", default_value_t = 0, requires = "model")]
    pub(crate) port: u16,
    /// Open no device: close a capture that was interrupted by a full disk, a power cut or a kill
    #[arg(long, conflicts_with_all = ["sensor", "force", "rig", "lasts", "frames", "name", "serial", "gel", "model"])]
    pub(crate) close: bool,
}

/// Port of the page of a preview or a run.
#[derive(Clone, Copy, Debug, Args)]
pub(crate) struct PortArgs {
    /// The port of the page on 127.0.0.1, 0 for any free port
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(crate) port: u16,
}

const PREVIEW_HELP: &str = "Prints the address of a page on this machine, and shows there what the camera sees: 15 pictures a second, the force, lost frames, the share of saturated
numbers, and a sharpness that is greatest in focus. Nothing is recorded. Ctrl-C or the button of the page ends it.

With --model a fitted model predicts the newest picture, up to 60 a second, and its newtons and millimetres stand over the picture that they are
of, named as predictions; a picture outside what the model has seen says so. Older pictures that it has no time for are left out and counted. At the
end: frames seen, shown and left out, how long 95 % took from their stamps, and the share outside.

  taceva preview --sensor camera/mjpeg:url=http://192.168.1.20:8080/?action=stream
  taceva preview --rig hand.toml
  taceva preview --rig hand.toml --model presses.taceva

Keep the address to yourself: what stands behind # lets whoever knows it look, and stop. The page answers this machine alone; to look from another one, use
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
