//! Gauge studies, calibration curves and budgets for programs that embed these commands.

use std::ffi::OsString;
use std::num::NonZeroUsize;

use anyhow::anyhow;
use taceva_report::Table;

use crate::args::{Cli, Command};
use crate::cmd;

/// Result of `taceva gauge`, `curve` or `budget`, in the forms that these commands write.
///
/// ```
/// # let folder = std::env::temp_dir().join(format!("taceva-metrology-{}", std::process::id()));
/// # std::fs::create_dir_all(&folder)?;
/// let path = folder.join("budget.toml");
/// let lamp = "measurand = \"Fz\"\nat = [\"1 N\"]\nsource = [{ name = \"lamp\", u = \"10 mN\" }]\n";
/// std::fs::write(&path, format!("budget_version = 1\n{lamp}"))?;
/// let words = [std::ffi::OsString::from("taceva"), "budget".into(), path.into()];
/// let found: taceva_cli::Metrology = taceva_cli::metrology(words)?;
/// assert!(found.documents[0].contains("taceva.budget/1"));
/// assert!(found.table.text().contains("lamp"));
/// # std::fs::remove_dir_all(&folder)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Metrology {
    /// Table for readers.
    pub table: Table,
    /// Table for programs.
    pub numbers: Table,
    /// JSON of each channel of a gauge study or of each value of a budget, or of the only curve.
    pub documents: Vec<String>,
}

/// Computes the `gauge`, `curve` or `budget` of `arguments`, which begin with the name of the program. Writes nothing and handles no signal.
///
/// # Errors
/// Errors of the command, and an error for arguments of another command. [`one_line`](crate::one_line) formats them.
pub fn metrology<W: Into<OsString> + Clone>(
    arguments: impl IntoIterator<Item = W>,
) -> anyhow::Result<Metrology> {
    let cli = Cli::parsed_from(arguments)?;
    cmd::check_isa()?;
    // A Parquet file is read on one thread, because the caller decides on the number of threads.
    let jobs = NonZeroUsize::MIN;
    match &cli.command {
        Some(Command::Gauge(args)) => {
            let found = cmd::gauge::studies(args, jobs)?;
            Ok(Metrology {
                table: found.table(),
                numbers: found.numbers(),
                documents: found.channels.iter().map(|of| found.json(of)).collect(),
            })
        }
        Some(Command::Curve(args)) => {
            let found = cmd::curve::fitted(args, jobs)?;
            Ok(Metrology {
                table: found.table(),
                numbers: found.numbers(),
                documents: vec![found.json()],
            })
        }
        Some(Command::Budget(args)) => {
            let found = cmd::budget::report(args)?;
            Ok(Metrology {
                table: found.table(),
                numbers: found.numbers(),
                documents: found.budgets.iter().map(|of| found.json(of)).collect(),
            })
        }
        _ => Err(anyhow!("expected gauge, curve or budget")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refusal(words: &[&str]) -> String {
        let refused = metrology(words.iter().copied());
        refused.map_or_else(|error| crate::one_line(&error), |_| String::new())
    }

    #[test]
    fn other_commands_and_wrong_arguments_are_refused_in_one_line() {
        let other = refusal(&["taceva", "check", "nowhere"]);
        assert_eq!(other, "expected gauge, curve or budget");
        let order = refusal(&["taceva", "curve", "t.csv", "--x=Fz", "--y=u", "--order=7"]);
        assert!(order.contains("--order") && order.contains('7'), "{order}");
        assert_eq!(order.lines().count(), 1);
        assert!(!order.starts_with("error"), "{order}");
    }
}
