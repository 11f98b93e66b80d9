//! What is typed of scenes, and of lists of what there is.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::{CacheArgs, Format};

/// A scene, and what may be said otherwise than it is written there.
#[derive(Debug, Args)]
pub(crate) struct SceneArgs {
    /// A file, or the name of a scene that is built in: quick, paper
    #[arg(value_name = "SCENE", default_value = "quick")]
    pub(crate) scene: String,
    /// The seed of every draw, in the place of the scene's
    #[arg(long, value_name = "N")]
    pub(crate) seed: Option<u64>,
}

/// The folder then holds `report.html`, one file to look at, to print and to send; every figure as SVG and PDF in `figures/`; `results.json`
/// with every number; and the tables `scores.csv`, `scores.md` and `scores.tex`.
#[derive(Debug, Args)]
pub(crate) struct Run {
    #[command(flatten)]
    pub(crate) scene: SceneArgs,
    /// The folder of the run [default: runs/SCENE-NUMBER, a new one]
    #[arg(long = "out", value_name = "FOLDER")]
    pub(crate) folder: Option<PathBuf>,
    /// Go on with the run in that folder, or with the last one
    #[arg(long, conflicts_with = "force")]
    pub(crate) resume: bool,
    /// Remove the run in that folder, or the last one, and begin anew
    #[arg(long)]
    pub(crate) force: bool,
    #[command(flatten)]
    pub(crate) cache: CacheArgs,
    /// The form of the reports on standard output
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub(crate) format: Format,
}

#[derive(Debug, Args)]
pub(crate) struct PlanArgs {
    #[command(flatten)]
    pub(crate) scene: SceneArgs,
    #[command(flatten)]
    pub(crate) listing: Listing,
}

/// A list, for people or for programs.
#[derive(Debug, Args)]
pub(crate) struct Listing {
    /// The form of the list
    #[arg(long, value_enum, default_value_t = ListFormat::Text)]
    pub(crate) format: ListFormat,
    /// Write the list to a file instead of standard output
    #[arg(long = "out", value_name = "PATH")]
    pub(crate) path: Option<PathBuf>,
    /// Replace a file that stands there already
    #[arg(long)]
    pub(crate) force: bool,
}

/// The form of a list or a plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ListFormat {
    /// For people
    Text,
    /// For programs; the key `schema` says which form it has
    Json,
}
