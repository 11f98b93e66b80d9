//! Arguments of the commands that plan and run scenes.

use std::path::PathBuf;

use clap::Args;

use super::{CacheArgs, FigureArgs, Format, ListFormat, Output, TableArgs};

/// A scene, and its overrides.
#[derive(Debug, Args)]
pub(crate) struct SceneArgs {
    /// A file, or the name of a built-in scene: quick, paper
    #[arg(value_name = "SCENE", default_value = "quick")]
    pub(crate) scene: String,
    /// The seed of all random numbers, instead of the scene's
    #[arg(long, value_name = "N")]
    pub(crate) seed: Option<u64>,
    /// The rig file with the robot, the force transducer and the sensor to measure with, instead of those that the scene names; if the file
    /// names an enabling switch, an operator holds it while the robot moves; see docs/rig.md
    #[arg(long, value_name = "FILE")]
    pub(crate) rig: Option<PathBuf>,
    /// A finished run of this scene, or of a pilot with fewer points, that predicts the widths of intervals under `want_width` of the scene
    #[arg(long, value_name = "RUN")]
    pub(crate) from: Option<PathBuf>,
}

/// Plan, acquire, fit, evaluate and report a scene; without a scene, four sensors on the simulated bench
///
/// The folder of the run contains `report.html`, one file that needs no network; every figure as SVG and PDF in `figures/`; `results.json`
/// with every number; and the tables `scores.csv`, `scores.md` and `scores.tex`. `taceva plan` prints the steps beforehand.
#[derive(Debug, Args)]
pub(crate) struct Run {
    #[command(flatten)]
    pub(crate) scene: SceneArgs,
    /// The model of every sensor, instead of the model and the settings of the scene: ridge, fast, cnn, auto and others of `taceva fit`; folds or the
    /// split remain
    #[arg(long, value_name = "NAME")]
    pub(crate) model: Option<String>,
    /// A setting of the model or of its features, such as epochs=30 or size=32x32, in addition to those of the scene; may be repeated
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub(crate) set: Vec<String>,
    /// Seeds of the model, such as 1-5 or 1,2,7, to estimate the spread of scores over trainings. Presses and split stay the same; reports are
    /// those of the first seed, with means and intervals over all seeds
    #[arg(long, value_name = "SEEDS", value_parser = Seeds::read)]
    pub(crate) seeds: Option<Seeds>,
    /// Visit every place in the air, 10 mm above the height of travel, with the guard of a run: nothing is pressed or recorded. Recommended
    /// on a real rig before the first press
    #[arg(long, conflicts_with_all = ["resume", "force", "folder", "from"])]
    pub(crate) air: bool,
    /// The folder of the run [default: runs/SCENE-NUMBER, a new one]
    #[arg(long = "out", value_name = "FOLDER")]
    pub(crate) folder: Option<PathBuf>,
    /// Continue the run in the folder of --out, or the last run
    #[arg(long, conflicts_with = "force")]
    pub(crate) resume: bool,
    /// Remove the run in the folder of --out, or the last run, and start again
    #[arg(long)]
    pub(crate) force: bool,
    /// Show the run on a page of this machine, whose address is printed: frames, force against its limits, presses, questions and a stop
    /// button. The page is not a safety function
    #[arg(long)]
    pub(crate) page: bool,
    /// The port of the page of --page on 127.0.0.1, 0 for any free port
    #[arg(long, value_name = "N", default_value_t = 0, requires = "page")]
    pub(crate) port: u16,
    #[command(flatten)]
    pub(crate) cache: CacheArgs,
    #[command(flatten)]
    pub(crate) figure: FigureArgs,
    #[command(flatten)]
    pub(crate) table: TableArgs,
    /// The format of the reports on standard output
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub(crate) format: Format,
}

#[derive(Debug, Args)]
pub(crate) struct PlanArgs {
    #[command(flatten)]
    pub(crate) scene: SceneArgs,
    #[command(flatten)]
    pub(crate) output: Output<ListFormat>,
}

/// Seeds, as numbers and ranges.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Seeds(pub(crate) Vec<u64>);

impl Seeds {
    /// Maximum number of seeds; more are treated as a typing error.
    const MOST: usize = 100;

    fn read(text: &str) -> Result<Seeds, String> {
        let wrong = || {
            format!(
                "expected 2 to {} different whole numbers, as 1-5 or 1,2,7",
                Seeds::MOST
            )
        };
        let mut seeds = Vec::new();
        for part in text.split(',') {
            let (first, last) = part.split_once('-').unwrap_or((part, part));
            let read = |word: &str| word.trim().parse::<u64>().map_err(|_| wrong());
            let (first, last) = (read(first)?, read(last)?);
            let room = Seeds::MOST - seeds.len();
            let count = last.checked_sub(first).ok_or_else(wrong)?;
            if usize::try_from(count).map_or(true, |count| count >= room) {
                return Err(wrong());
            }
            seeds.extend(first..=last);
        }
        let mut different = seeds.clone();
        different.sort_unstable();
        different.dedup();
        if different.len() != seeds.len() || seeds.len() < 2 {
            return Err(wrong());
        }
        Ok(Seeds(seeds))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seeds_are_numbers_and_ranges_and_never_the_same_twice() {
        assert_eq!(Seeds::read("1-5"), Ok(Seeds(vec![1, 2, 3, 4, 5])));
        assert_eq!(Seeds::read("7, 2"), Ok(Seeds(vec![7, 2])));
        for wrong in [
            "",
            "1",
            "1,1",
            "1-3,2",
            "5-1",
            "1-101",
            "a-b",
            "0-18446744073709551615",
        ] {
            assert!(Seeds::read(wrong).is_err(), "{wrong}");
        }
    }
}
