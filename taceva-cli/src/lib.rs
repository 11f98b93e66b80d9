//! The commands of `taceva`: how well does a vision-based tactile sensor measure?
//!
//! This crate parses arguments and renders results. Other crates do the work: `taceva-study`, `taceva-evaluate` and `taceva-import`. The program
//! calls [`main_if_child`] and then [`main_with`]. A program in another language with these commands calls only [`main_with`].

mod amount;
mod args;
mod av1_child;
mod bundle_verification;
mod cmd;
mod context;
mod date;
mod disk_space;
mod exit;
mod invocation;
mod metrology;
mod output;
mod process_limits;
mod progress;
mod report;
mod result_page;
mod stderr;

// Linked for its drivers: a crate that is only named in Cargo.toml is not linked.
use taceva_sim as _;

use std::ffi::OsString;
use std::path::Path;
use std::time::Duration;

use anyhow::Error;
use clap::FromArgMatches as _;
use taceva_acquire::AcquireError;
use taceva_bundle::CatalogueFolderError;
use taceva_core::{ErrorKind, ModelError};
use taceva_dataset::DatasetError;
use taceva_evaluate::EvaluateError;
use taceva_import::ImportError;
use taceva_study::StudyError;
use taceva_sweep::SweepError;

use args::{Cli, Command};
use cmd::Context;
use invocation::Invocation;

pub use bundle_verification::{BundleVerification, verify_bundle};
pub use metrology::{Metrology, metrology};
pub use result_page::write_report;

/// Acts as the child process of another `taceva` and exits, if this process was started as such; otherwise returns. Without this call at the start
/// of `main`, no child process can be started. Plugins in libraries are then rejected unless an interpreter was named for them
/// ([`taceva_host::run_within`]). AV1 clips are then decoded by ffmpeg, if it is there.
///
/// ```
/// taceva_cli::main_if_child();
/// ```
pub fn main_if_child() {
    #[cfg(target_os = "linux")]
    taceva_conformance::main_if_child();
    #[cfg(feature = "av1")]
    av1_child::main_if_child();
}

/// Runs the command in `arguments`, which begin with the name of the program, and returns the exit code. SIGINT and SIGTERM of the
/// process are handled from then on, so a program calls it once and exits with its result.
///
/// ```
/// assert_eq!(taceva_cli::main_with(["taceva", "catalogue", "show", "TacTip", "--quiet"]), 0);
/// ```
pub fn main_with(arguments: impl IntoIterator<Item = impl Into<OsString> + Clone>) -> u8 {
    if process_limits::standard_output_is_closed() {
        stderr::say(format_args!(
            "standard output is closed, and the result would be lost: nothing was done; redirect standard output to a file or to /dev/null"
        ));
        return exit::BAD_INPUT;
    }
    let words: Vec<OsString> = arguments.into_iter().map(Into::into).collect();
    let cli = match typed(&words) {
        Ok(cli) => cli,
        Err(code) => return code,
    };
    progress::listen_for_signals(cli.command.as_ref().and_then(patience));
    process_limits::refuse_to_end_at_the_limit_of_file_sizes();
    let context = Context::new(&cli.everywhere, Invocation::new(&words));
    let done = cmd::check_isa().and_then(|()| match &cli.command {
        Some(command) => run(command, &context),
        None => cmd::start(),
    });
    done.unwrap_or_else(|error| {
        complain(&error);
        code_of(&error)
    })
}

fn run(command: &Command, context: &Context) -> anyhow::Result<u8> {
    match command {
        Command::Init(args) => cmd::init::run(args, context),
        Command::Import(args) => cmd::import::run(args, context),
        Command::Show(args) => cmd::show::run(args),
        Command::Check(args) => cmd::check::run(args, context),
        Command::Export(args) => cmd::export::run(args, context),
        Command::Fit(args) => cmd::fit::run(args, context),
        Command::Evaluate(args) => cmd::evaluate::run(args, context),
        Command::Stress(args) => cmd::stress::run(args, context),
        Command::Wear(args) => cmd::wear::run(args, context),
        Command::Watch(args) => cmd::watch::run(args, context),
        Command::Predict(args) => cmd::predict::run(args, context),
        Command::Score(args) => cmd::score::run(args, context),
        Command::Merge(args) => cmd::merge::run(args, context),
        Command::Bundle(args) => cmd::bundle::run(args, context),
        Command::Reseal(args) => cmd::reseal::run(args, context),
        Command::Report(args) => cmd::report::run(args, context),
        Command::Compare(args) => cmd::compare::run(args, context),
        Command::Choose(args) => cmd::choose::run(args),
        Command::Accept(args) => cmd::accept::run(args, context),
        Command::Gauge(args) => cmd::gauge::run(args, context),
        Command::Curve(args) => cmd::curve::run(args, context),
        Command::Budget(args) => cmd::budget::run(args),
        Command::Catalogue(args) => cmd::catalogue::run(args, context),
        Command::Cache(args) => cmd::cache::run(args, context),
        Command::Bench(args) => cmd::bench::run(args, context),
        Command::Sweep(args) => cmd::sweep::run(args, context),
        Command::Capture(args) => cmd::capture::run(args, context),
        Command::Preview(args) => cmd::preview::run(args, context),
        Command::Run(args) => cmd::run::run(args, context),
        Command::Plan(args) => cmd::plan::run(args, context),
        Command::Rig(args) => cmd::rig::run(args, context),
        Command::Devices(args) => cmd::devices::run(args, context),
        Command::Plugin(which) => cmd::plugin::run(which, context),
        Command::Doctor(args) => cmd::doctor::run(args, context),
        Command::Completions(args) => cmd::completions::run(args),
        Command::Man(args) => cmd::man::run(args, context),
    }
}

/// Time in which `command` must end after a signal: 8 s if it reads pictures or fits a model, else 1 s. `None` for commands with devices, processes
/// or several recordings, which end by themselves.
fn patience(command: &Command) -> Option<Duration> {
    match command {
        Command::Sweep(_)
        | Command::Capture(_)
        | Command::Preview(_)
        | Command::Watch(_)
        | Command::Run(_)
        | Command::Rig(_)
        | Command::Plugin(_) => None,
        Command::Fit(_)
        | Command::Evaluate(_)
        | Command::Stress(_)
        | Command::Wear(_)
        | Command::Predict(_)
        | Command::Bench(_) => Some(Duration::from_secs(8)),
        _ => Some(Duration::from_secs(1)),
    }
}

/// Prints an error and its causes on one line.
fn complain(error: &Error) {
    stderr::say(format_args!("{}", one_line(error)));
}

/// Text of an error and its causes on one line, with advice for a folder that is not a dataset.
///
/// ```
/// let refused = taceva_cli::metrology(["taceva", "budget", "nowhere.toml"]).expect_err("no such file");
/// assert!(taceva_cli::one_line(&refused).starts_with("cannot read nowhere.toml: "));
/// ```
pub fn one_line(error: &Error) -> String {
    let mut text = String::new();
    for cause in error.chain().map(ToString::to_string) {
        // Skips a cause that the error already contains.
        if !text.contains(&cause) {
            text.push_str(if text.is_empty() { "" } else { ": " });
            text.push_str(&cause);
        }
    }
    if let Some(advice) = missing_dataset(error).and_then(taceva_import::advice) {
        text.push_str("; ");
        text.push_str(&advice);
    }
    text
}

/// Folder that was named as a dataset but is not a dataset; `None` for other errors.
fn missing_dataset(error: &Error) -> Option<&Path> {
    error.chain().find_map(|cause| {
        let study = cause.downcast_ref::<StudyError>();
        let sweep = cause.downcast_ref::<SweepError>();
        let evaluated = cause.downcast_ref::<EvaluateError>();
        let evaluated = evaluated.or(match (study, sweep) {
            (Some(StudyError::Evaluate(error)), _) | (_, Some(SweepError::Study(error))) => {
                Some(error)
            }
            _ => None,
        });
        let acquired = cause.downcast_ref::<AcquireError>();
        let acquired = acquired.or(match study {
            Some(StudyError::Acquire(error)) => Some(error),
            _ => None,
        });
        let dataset = match (evaluated, acquired, sweep) {
            (Some(EvaluateError::Dataset(dataset)), ..)
            | (_, Some(AcquireError::Dataset(dataset)), _)
            | (.., Some(SweepError::Dataset(dataset))) => Some(dataset),
            _ => dataset_error(cause),
        };
        match dataset? {
            DatasetError::NoDataset { path, .. } => Some(path.as_path()),
            _ => None,
        }
    })
}

/// Dataset error in `cause`, directly or within an import error; `None` for other errors.
fn dataset_error<'a>(cause: &'a (dyn std::error::Error + 'static)) -> Option<&'a DatasetError> {
    let import = cause.downcast_ref::<ImportError>();
    import.map_or_else(|| cause.downcast_ref(), ImportError::dataset)
}

/// Parses the arguments. For help and for wrong arguments, prints the text and returns the exit code as the error.
fn typed(words: &[OsString]) -> Result<Cli, u8> {
    let matches = Cli::documented().try_get_matches_from(words);
    matches
        .and_then(|matches| Cli::from_arg_matches(&matches))
        .map_err(|error| {
            if error.use_stderr() {
                // The error quotes the arguments, whose control characters are escaped.
                stderr::write(&error.render().to_string());
                return exit::USAGE;
            }
            // This fails if the reader has closed the pipe.
            drop(error.print());
            exit::DONE
        })
}

/// Exit code of an error.
fn code_of(error: &Error) -> u8 {
    if progress::is_stopped() {
        return exit::STOPPED;
    }
    for cause in error.chain() {
        if let Some(usage) = cause.downcast_ref::<cmd::Usage>() {
            return usage.code();
        }
        if let Some(sweep) = cause.downcast_ref::<SweepError>()
            && sweep.is_usage()
        {
            return exit::USAGE;
        }
        let of_catalogue = cause.downcast_ref::<CatalogueFolderError>();
        if let Some(CatalogueFolderError::Unverified { .. }) = of_catalogue {
            return exit::CHECK_FAILED;
        }
        if let Some(code) = code_of_study(cause) {
            return code;
        }
        match dataset_error(cause) {
            Some(DatasetError::View { .. }) => return exit::USAGE,
            Some(other) => return code_of_kind(other.kind()),
            None => {}
        }
        if let Some(import) = cause.downcast_ref::<ImportError>() {
            return code_of_kind(import.kind());
        }
        if let Some(model) = cause.downcast_ref::<ModelError>() {
            return code_of_kind(model.kind());
        }
    }
    exit::BAD_INPUT
}

/// Exit code of an error of acquisition, evaluation or a study; `None` for other errors.
fn code_of_study(cause: &(dyn std::error::Error + 'static)) -> Option<u8> {
    let (is_usage, is_of_device, kind) = if let Some(error) = cause.downcast_ref::<EvaluateError>()
    {
        (error.is_usage(), false, error.kind())
    } else if let Some(error) = cause.downcast_ref::<AcquireError>() {
        (error.is_usage(), error.is_of_device(), error.kind())
    } else {
        let error = cause.downcast_ref::<StudyError>()?;
        (error.is_usage(), error.is_of_device(), error.kind())
    };
    Some(match (is_usage, is_of_device) {
        (true, _) => exit::USAGE,
        (false, true) => exit::DEVICE,
        (false, false) => code_of_kind(kind),
    })
}

fn code_of_kind(kind: ErrorKind) -> u8 {
    match kind {
        ErrorKind::Interrupted => exit::STOPPED,
        ErrorKind::Internal => exit::BUG,
        _ => exit::BAD_INPUT,
    }
}
