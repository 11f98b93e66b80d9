//! Definitions of the arguments of the program, without side effects. Modules of `cmd/` execute the commands.

mod bench;
mod budget;
mod bundle;
mod cache;
mod catalogue;
mod common_options;
mod curve;
mod dataset;
mod examples;
mod figure;
mod gauge;
mod init;
mod live;
mod model;
mod plugin;
mod results;
mod rig;
mod stress;
mod study;
mod sweep;
mod task;
mod watch;
mod wear;

use std::ffi::OsString;
use std::path::PathBuf;

use anyhow::anyhow;
use clap::{Args, CommandFactory as _, FromArgMatches as _, Parser, Subcommand};

pub(crate) use self::bench::{Bench, BenchKernels, BenchModels, BenchStudy, BenchSubject};
pub(crate) use self::budget::Budget;
pub(crate) use self::bundle::{
    Bundle, BundleDiff, BundleMake, BundleSubject, BundleVerify, LevelArg, WithPart, WithoutPart,
};
pub(crate) use self::cache::{CacheCommand, CacheList, CachePrune, CacheSubject};
pub(crate) use self::catalogue::{
    CatalogueAdd, CatalogueArgs, CatalogueCheckArgs, CatalogueExport, CatalogueList, CatalogueShow,
    CatalogueSite, CatalogueSubject,
};
pub(crate) use self::common_options::{
    CacheArgs, ExplainArgs, Format, ListFormat, ModelArgs, OptionalModelArgs, Output, PageArgs,
    PartArg, PartArgs, ScoringArgs, SeedArgs, SettingArgs, SplitArgs, SplitOutArgs, TableArgs,
    TableScores, ViewArgs,
};
pub(crate) use self::curve::Curve;
pub(crate) use self::dataset::{Check, Export, Import, Reseal, Show};
pub(crate) use self::figure::FigureArgs;
pub(crate) use self::gauge::{Gauge, GaugeMethod, GaugeResponse};
pub(crate) use self::init::{Init, InitSubject, InitTarget};
pub(crate) use self::live::{Capture, LiveArgs, Preview};
pub(crate) use self::model::{Evaluate, Fit, Merge, Predict, Score};
pub(crate) use self::plugin::{
    Language, NewKind, NewLibrary, Plugin, PluginAllow, PluginArgs, PluginCheck, PluginDeny,
    PluginHeaders, PluginInfo, PluginInstall, PluginList, PluginManifest, PluginNew, PluginPack,
    PluginRelease, PluginUninstall,
};
pub(crate) use self::results::{Accept, Choose, Compare, Conditional, Like, ReportArgs};
pub(crate) use self::rig::{RigCheckArgs, RigCommand, RigSubject, RigTapArgs, RigTeachArgs};
pub(crate) use self::stress::{Stress, StressBy, StressPart};
pub(crate) use self::study::{PlanArgs, Run, SceneArgs};
pub(crate) use self::sweep::{
    Sweep, SweepCollect, SweepEngine, SweepRun, SweepShow, SweepSubject, SweepTask,
};
pub(crate) use self::task::{TaskArgs, WindowArgs};
pub(crate) use self::watch::Watch;
pub(crate) use self::wear::{Wear, WearByArg};

/// First commands for a new user, by kind of data.
pub(crate) const START: &str = "\
I have a recording: pictures and labels in a folder
  taceva init recording my-folder                           asks for units and names; writes map.toml
  taceva import my-folder --map map.toml --out my-dataset
  taceva evaluate my-dataset                                how well does the sensor measure?

I have no data yet
  taceva run                                                four simulated sensors; about a minute

I have a rig: camera, robot, force transducer
  taceva init rig                                           asks for its devices; writes rig.toml
  taceva rig teach rig.toml                                 jog the robot; it writes the place of the gel
  taceva rig check rig.toml                                 are they fast and quiet enough?";

const EXIT_CODES: &str = "\
Exit codes:
  0 done   1 done, but a check or a limit failed   2 usage   3 bad input   4 a device failed
  5 stopped by a signal   70 an internal error";

/// How well does a vision-based tactile sensor measure?
#[derive(Debug, Parser)]
#[command(name = "taceva", version, after_help = format!("{START}\n\n{EXIT_CODES}"), max_term_width = 110)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Option<Command>,
    #[command(flatten)]
    pub(crate) everywhere: Everywhere,
}

impl Cli {
    /// Commands and options, with examples in the help of each command.
    pub(crate) fn documented() -> clap::Command {
        examples::add_examples(Cli::command())
    }

    /// Command of `arguments`, which begin with the name of the program.
    ///
    /// # Errors
    /// The first line of the message for wrong arguments.
    pub(crate) fn parsed_from<W: Into<OsString> + Clone>(
        arguments: impl IntoIterator<Item = W>,
    ) -> anyhow::Result<Cli> {
        let matches = Cli::documented().try_get_matches_from(arguments);
        let typed = matches.and_then(|matches| Cli::from_arg_matches(&matches));
        typed.map_err(|error| {
            let words = error.to_string();
            let first = words.lines().next().unwrap_or_default();
            anyhow!("{}", first.trim_start_matches("error: "))
        })
    }
}

/// Options that every command accepts.
#[derive(Debug, Args)]
pub(crate) struct Everywhere {
    /// Worker threads; results do not depend on their number [default: all cores]
    #[arg(long, global = true, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub(crate) jobs: Option<u16>,
    /// Print results and errors only
    #[arg(long, short, global = true)]
    pub(crate) quiet: bool,
    /// Print more on standard error
    #[arg(long, short, global = true, action = clap::ArgAction::Count)]
    pub(crate) verbose: u8,
    #[command(flatten)]
    pub(crate) plugins: PluginArgs,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    Init(Init),
    Import(Import),
    Show(Show),
    Check(Check),
    Export(Export),
    Fit(Fit),
    Evaluate(Evaluate),
    Stress(Stress),
    Wear(Wear),
    Watch(Watch),
    /// Write a model's predictions as a table
    Predict(Predict),
    Score(Score),
    Merge(Merge),
    Bundle(Bundle),
    Reseal(Reseal),
    Report(ReportArgs),
    Compare(Compare),
    Choose(Choose),
    Accept(Accept),
    Gauge(Gauge),
    Curve(Curve),
    Budget(Budget),
    /// Published numbers of sensors, each with its source, and numbers of bundles in a folder
    Catalogue(CatalogueArgs),
    /// List cached results, which later runs reuse, or remove old ones
    Cache(CacheCommand),
    /// Benchmarks: run time against error, with the Pareto front marked
    Bench(Bench),
    Sweep(Sweep),
    /// Record a sensor without a robot: frames, and the force of presses by hand
    Capture(Capture),
    /// Look at a sensor in a browser: live frames, force, focus and saturation; nothing is recorded
    Preview(Preview),
    Run(Run),
    /// Print the planned, kept and skipped steps of `run`, with reasons; opens no device
    Plan(PlanArgs),
    /// Set up a rig: measure the position of its robot, and check its devices for a run
    Rig(RigCommand),
    /// List every driver, its abilities and arguments, and the devices that are present
    Devices(Output<ListFormat>),
    /// List, inspect, check or create plugins
    #[command(subcommand)]
    Plugin(Plugin),
    /// Diagnose this machine: the devices it could use, missing parts, and remedies
    Doctor(Output<ListFormat>),
    /// Print a script that completes taceva's arguments in a shell
    Completions(Completions),
    /// Write manual pages
    Man(ManArgs),
}

#[derive(Debug, Args)]
pub(crate) struct Completions {
    /// The shell that runs the script
    pub(crate) shell: clap_complete::Shell,
}

#[derive(Debug, Args)]
pub(crate) struct ManArgs {
    /// The folder for a page of every command [default: only the page of taceva, to standard output]
    #[arg(long = "out", value_name = "FOLDER")]
    pub(crate) folder: Option<PathBuf>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_arguments_are_consistent() {
        Cli::documented().debug_assert();
    }

    #[test]
    fn evaluate_takes_a_model_or_a_name_but_not_both() {
        let parse = |words: &str| Cli::try_parse_from(words.split(' '));
        assert!(parse("taceva evaluate d").is_ok());
        assert!(parse("taceva evaluate d --model ridge").is_ok());
        assert!(parse("taceva evaluate d --with m").is_ok());
        assert!(parse("taceva evaluate d --with m --model ridge").is_err());
    }
}
