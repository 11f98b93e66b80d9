//! Arguments of `taceva init`.

use std::path::PathBuf;

use clap::{Args, Subcommand};

/// Write a first map, scene or rig file by questions with defaults
///
/// Each question is answered by one line; Enter takes the default in brackets. Answers may also come from a file or a pipe. Every file is
/// checked by the rules of the command that reads it, and the next commands are printed.
#[derive(Debug, Args)]
pub(crate) struct Init {
    #[command(subcommand)]
    pub(crate) subject: Option<InitSubject>,
}

/// File that `taceva init` writes.
#[derive(Debug, Subcommand)]
pub(crate) enum InitSubject {
    /// A map for a folder of pictures and labels: drafted from the files, then completed by questions
    Recording(InitRecording),
    /// A scene of the simulated bench, or of a real rig
    Scene(InitTarget),
    /// A rig file: robot or hand, force transducer, camera, limits
    Rig(InitTarget),
}

#[derive(Debug, Args)]
pub(crate) struct InitRecording {
    /// The folder of the recording, or a file in it
    #[arg(value_name = "FOLDER")]
    pub(crate) folder: PathBuf,
    #[command(flatten)]
    pub(crate) target: InitTarget,
}

#[derive(Debug, Default, Args)]
pub(crate) struct InitTarget {
    /// The file to write [default: map.toml, scene.toml or rig.toml in the working folder]
    #[arg(long = "out", value_name = "FILE")]
    pub(crate) path: Option<PathBuf>,
    /// Ask nothing and take every default; values of a map without a default stay open, and the devices of a rig file have no default
    #[arg(long, short)]
    pub(crate) yes: bool,
    /// Replace a file that exists already
    #[arg(long)]
    pub(crate) force: bool,
}
