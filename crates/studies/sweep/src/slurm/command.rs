//! Runs commands of the scheduler and reads their output.

use std::process::Command;

use taceva_core::shown;

use crate::error::SweepError;

/// Default `MaxArraySize` of Slurm.
const ARRAY_MOST: u32 = 1001;

/// Greatest number of jobs in one array, as configured at this site.
pub(super) fn array_most() -> u32 {
    let asked = Command::new("scontrol").args(["show", "config"]).output();
    let text = asked.map(|output| String::from_utf8_lossy(&output.stdout).into_owned());
    let text = text.unwrap_or_default();
    let mut lines = text.lines();
    let said = lines.find_map(|line| {
        let (name, value) = line.split_once('=')?;
        (name.trim() == "MaxArraySize").then(|| value.trim().parse::<u32>().ok())?
    });
    // Indices go up to this number minus one.
    said.unwrap_or(ARRAY_MOST).saturating_sub(1).max(1)
}

/// Runs a command of the scheduler and returns its standard output.
pub(super) fn run(command: &'static str, words: &[String]) -> Result<String, SweepError> {
    let refused = |words: String| SweepError::Scheduler { command, words };
    let output = Command::new(command).args(words).output().map_err(|error| {
        refused(format!(
            "cannot be started ({error}): this machine may have no Slurm. The scripts are written and can be submitted elsewhere"
        ))
    })?;
    if output.status.success() {
        return Ok(String::from_utf8_lossy(&output.stdout).into_owned());
    }
    let said = String::from_utf8_lossy(&output.stderr);
    let said: Vec<&str> = said
        .lines()
        .map(str::trim)
        .filter(|line| !line.is_empty())
        .collect();
    Err(refused(match said.is_empty() {
        true => format!("{}", output.status),
        false => shown(&said.join("; ")).to_string(),
    }))
}
