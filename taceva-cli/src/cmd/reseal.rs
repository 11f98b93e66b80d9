//! `taceva reseal`.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use taceva_dataset::Dataset;
use taceva_evaluate::StateFile;
use taceva_report::Study;

use super::{Context, Usage};
use crate::args::Reseal;
use crate::date::today;
use crate::{exit, output};

/// Name of the header of a dataset.
const HEADER: &str = "dataset.toml";
/// Maximum file size, bytes. Larger files are never edited by hand.
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
    let date = today();
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

/// Path of the sealed file. For a dataset, the path of its header.
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
            "{}: not text, expected dataset.toml, results or a state; a model cannot be edited: fit the model again",
            path.display()
        )
    })
}

/// Replaces the file by the accepted text. Leaves the file unchanged if the text cannot be read back.
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
