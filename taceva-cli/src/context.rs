//! State that all commands share.

use std::num::NonZeroUsize;

use taceva_evaluate::{Cache, EvaluateError, Plan, Work};

use crate::args::{Everywhere, PluginArgs};
use crate::invocation::Invocation;
use crate::progress::TerminalProgress;
use crate::stderr;

/// Resolved values of the options that every command has.
pub(crate) struct Context {
    pub(crate) progress: TerminalProgress,
    pub(crate) jobs: NonZeroUsize,
    pub(crate) plugins: PluginArgs,
    pub(crate) invocation: Invocation,
    pub(crate) verbose: bool,
    pub(crate) quiet: bool,
}

impl Context {
    pub(crate) fn new(everywhere: &Everywhere, invocation: Invocation) -> Context {
        let all_cores = || std::thread::available_parallelism().unwrap_or(NonZeroUsize::MIN);
        let asked = everywhere
            .jobs
            .and_then(|jobs| NonZeroUsize::new(usize::from(jobs)));
        let wanted = asked.unwrap_or_else(all_cores);
        let there = taceva_models::prepare_threads(wanted);
        if there < wanted.get() && !everywhere.quiet {
            stderr::say(format_args!(
                "the system started {there} of {wanted} threads: the command is slower, the result is the same (raise `ulimit -u` or the limit of the container)"
            ));
        }
        Context {
            progress: TerminalProgress::new(everywhere.quiet, everywhere.verbose > 0),
            // No result depends on the number of threads.
            jobs: NonZeroUsize::new(there).unwrap_or(NonZeroUsize::MIN),
            verbose: everywhere.verbose > 0,
            quiet: everywhere.quiet,
            plugins: everywhere.plugins.clone(),
            invocation,
        }
    }

    /// Context of a command in another program: one thread, because the caller decides on the number of threads, and no messages.
    pub(crate) fn embedded(plugins: &PluginArgs) -> Context {
        Context {
            progress: TerminalProgress::new(true, false),
            jobs: NonZeroUsize::MIN,
            verbose: false,
            quiet: true,
            plugins: plugins.clone(),
            invocation: Invocation::new(&[]),
        }
    }

    /// Number of threads, progress and cache for a stage.
    pub(crate) fn work<'a>(&'a self, cache: Option<&'a Cache>) -> Work<'a> {
        Work {
            jobs: self.jobs,
            progress: &self.progress,
            cache,
        }
    }

    /// Prints a message on standard error, unless `--quiet` is given.
    pub(crate) fn say(&self, words: std::fmt::Arguments<'_>) {
        if !self.quiet {
            stderr::say(words);
        }
    }

    /// Prints a message if `-v` is given.
    pub(crate) fn say_more(&self, words: std::fmt::Arguments<'_>) {
        if self.verbose {
            self.say(words);
        }
    }

    /// Prints the plan of a command if `-v` is given.
    pub(crate) fn print_plan(
        &self,
        plan: impl FnOnce() -> Result<Plan, EvaluateError>,
    ) -> anyhow::Result<()> {
        if self.verbose {
            stderr::write(&plan()?.to_string());
        }
        Ok(())
    }
}
