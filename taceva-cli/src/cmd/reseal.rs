//! `taceva reseal`.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::{SystemTime, UNIX_EPOCH};

use anyhow::{Context as _, bail};
use taceva_dataset::Dataset;
use taceva_evaluate::StateFile;
use taceva_report::Study;

use super::{Context, Usage};
use crate::args::Reseal;
use crate::{exit, output};

/// Name of the header of a dataset.
const HEADER: &str = "dataset.toml";
/// Maximum file size, bytes: larger files are not edited by hand.
const MOST: u64 = 1 << 30;

pub(crate) fn run(args: &Reseal, context: &Context) -> anyhow::Result<u8> {
    let reason = args.reason.trim();
    if reason.is_empty() {
        return Err(Usage::error(
            "--reason is empty: reports show why a file was changed",
        ));
    }
    let path = file_of(&args.file);
    let text = text_of(&path)?;
    let date = date_of(SystemTime::now());
    let is_header = path.file_name().is_some_and(|name| name == HEADER);
    let accepted = match is_header {
        true => taceva_files::seal::toml_text::reseal(&text, &date, reason),
        false => taceva_files::seal::json::reseal(&text, &date, reason),
    };
    let accepted = accepted.with_context(|| path.display().to_string())?;
    if accepted == text {
        context.say(format_args!(
            "{}: the seal matches, nothing to accept",
            path.display()
        ));
        return Ok(exit::DONE);
    }
    replace(&path, &text, &accepted, is_header)?;
    output::write(None, |out| writeln!(out, "sealed   {}", path.display()))?;
    Ok(exit::DONE)
}

/// The sealed file; for a dataset its header.
fn file_of(named: &Path) -> PathBuf {
    match named.is_dir() {
        true => named.join(HEADER),
        false => named.to_owned(),
    }
}

fn text_of(path: &Path) -> anyhow::Result<String> {
    let cannot = || format!("cannot read {}", path.display());
    let metadata = fs::metadata(path).with_context(cannot)?;
    if !metadata.is_file() || metadata.len() > MOST {
        bail!(
            "{}: expected dataset.toml, results or a state",
            path.display()
        );
    }
    let bytes = fs::read(path).with_context(cannot)?;
    String::from_utf8(bytes).map_err(|_| {
        anyhow::anyhow!(
            "{}: not text: models cannot be edited, fit again; expected dataset.toml, results or a state",
            path.display()
        )
    })
}

/// Replaces the file by the accepted text if that can be read back; else leaves it unchanged.
fn replace(path: &Path, before: &str, accepted: &str, is_header: bool) -> anyhow::Result<()> {
    let write = |text: &str| output::write(Some(path), |out| out.write_all(text.as_bytes()));
    write(accepted)?;
    let read = match is_header {
        true => Dataset::open(path.parent().unwrap_or(Path::new(".")))
            .map(drop)
            .map_err(Into::into),
        false => readable(path, accepted),
    };
    if read.is_err() {
        write(before)?;
    }
    read.with_context(|| format!("{}: left unchanged", path.display()))
}

fn readable(path: &Path, text: &str) -> anyhow::Result<()> {
    match Study::read(text) {
        Ok(_) => Ok(()),
        Err(taceva_results::ResultsError::Schema { .. }) => Ok(StateFile::read(path).map(drop)?),
        Err(error) => Err(error.into()),
    }
}

/// The UTC day of a time: `2026-11-22`.
fn date_of(time: SystemTime) -> String {
    let days = time
        .duration_since(UNIX_EPOCH)
        .map_or(0, |since| since.as_secs() / 86_400);
    // In the calendar that repeats every 400 years, with years that begin in March.
    let days = days + 719_468;
    let (era, day) = (days / 146_097, days % 146_097);
    let year = (day - day / 1_460 + day / 36_524 - day / 146_096) / 365;
    let day = day - (365 * year + year / 4 - year / 100);
    let month = (5 * day + 2) / 153;
    let day = day - (153 * month + 2) / 5 + 1;
    let (month, next) = if month < 10 {
        (month + 3, 0)
    } else {
        (month - 9, 1)
    };
    format!("{:04}-{month:02}-{day:02}", era * 400 + year + next)
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;

    #[test]
    fn days_have_their_dates() {
        for (day, date) in [
            (0_u64, "1970-01-01"),
            (59, "1970-03-01"),
            (11_016, "2000-02-29"),
            (20_779, "2026-11-22"),
            (47_540, "2100-02-28"),
            (47_541, "2100-03-01"),
        ] {
            assert_eq!(
                date_of(UNIX_EPOCH + Duration::from_secs(day * 86_400)),
                date
            );
        }
    }
}
