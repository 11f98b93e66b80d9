//! Page of a result for programs that embed the command.

use std::ffi::OsString;
use std::path::PathBuf;

use anyhow::anyhow;

use crate::args::{Cli, Command};
use crate::cmd::{self, Context};

/// Writes the report of `arguments`, which begin with the name of the program, and returns the path of its page. Prints nothing and handles no signal.
///
/// ```
/// let refused = taceva_cli::write_report(["taceva", "report", "nowhere.json"]).expect_err("no such file");
/// assert!(taceva_cli::one_line(&refused).starts_with("nowhere.json: no such file or folder"));
/// ```
///
/// # Errors
/// Errors of the command, and an error for arguments of another command. [`one_line`](crate::one_line) formats them.
pub fn write_report<W: Into<OsString> + Clone>(
    arguments: impl IntoIterator<Item = W>,
) -> anyhow::Result<PathBuf> {
    let cli = Cli::parsed_from(arguments)?;
    cmd::check_isa()?;
    let Some(Command::Report(args)) = &cli.command else {
        return Err(anyhow!("expected the command `report`"));
    };
    let context = Context::embedded(&cli.everywhere.plugins);
    Ok(cmd::report::written(args, &context)?.page)
}
