//! Arguments of `taceva cache`.

use std::path::PathBuf;
use std::time::Duration;

use clap::{ArgGroup, Args, Subcommand, ValueEnum};
use taceva_core::whole_count;
use taceva_evaluate::CachedStage;

use super::{ExplainArgs, Output};

#[derive(Debug, Args)]
pub(crate) struct CacheCommand {
    #[command(subcommand)]
    pub(crate) subject: CacheSubject,
}

/// Operation on the cache.
#[derive(Debug, Subcommand)]
pub(crate) enum CacheSubject {
    List(CacheList),
    Prune(CachePrune),
}

/// List cache entries: kinds, sizes, ages, and the runs that use them
///
/// Each run lists the cache entries it uses in stages.json. This command reads the runs in the folder `runs`, and those named by --run.
#[derive(Debug, Args)]
pub(crate) struct CacheList {
    #[command(flatten)]
    pub(crate) cache: CacheFolder,
    /// Print a row for every entry, not only for every kind
    #[arg(long)]
    pub(crate) entries: bool,
    /// The folder of another run; may be repeated
    #[arg(long = "run", value_name = "FOLDER")]
    pub(crate) runs: Vec<PathBuf>,
    #[command(flatten)]
    pub(crate) output: Output,
}

/// Remove entries by age or total size; runs in progress are not affected
///
/// Removed entries are computed again when needed.
#[derive(Debug, Args)]
#[command(group = ArgGroup::new("what").required(true).multiple(true).args(["older_than", "keep"]))]
pub(crate) struct CachePrune {
    #[command(flatten)]
    pub(crate) cache: CacheFolder,
    /// Remove entries that were unused for longer than this: 12h, 30d, 8w
    #[arg(long, value_name = "AGE", value_parser = age)]
    pub(crate) older_than: Option<Duration>,
    /// Remove entries, those unused for the longest time first, until the cache holds at most this size: 2GiB, 500MB, 0
    #[arg(long, value_name = "SIZE", value_parser = size)]
    pub(crate) keep: Option<u64>,
    /// Remove only entries of these kinds, separated by commas [default: all]
    #[arg(long, value_enum, value_name = "KINDS", value_delimiter = ',')]
    pub(crate) kind: Vec<StageArg>,
    #[command(flatten)]
    pub(crate) explain: ExplainArgs,
}

#[derive(Debug, Args)]
pub(crate) struct CacheFolder {
    /// The folder of the cache [default: taceva in the user's cache folder]
    #[arg(id = "cache", long, value_name = "DIR")]
    pub(crate) path: Option<PathBuf>,
}

/// Kind of a cache entry.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum StageArg {
    /// Recordings of the simulated bench
    Acquire,
    /// Features of frames
    Features,
    /// Models
    Fit,
    /// Predictions
    Predict,
    /// Predicted spacings of gratings
    Classify,
}

impl From<StageArg> for CachedStage {
    fn from(kind: StageArg) -> CachedStage {
        match kind {
            StageArg::Acquire => CachedStage::Acquire,
            StageArg::Features => CachedStage::Features,
            StageArg::Fit => CachedStage::Fit,
            StageArg::Predict => CachedStage::Predict,
            StageArg::Classify => CachedStage::Classify,
        }
    }
}

/// Splits a text into a number and its unit; `None` for other text.
fn parts(text: &str) -> Option<(f64, &str)> {
    let text = text.trim();
    let end = text
        .find(|letter: char| !(letter.is_ascii_digit() || letter == '.'))
        .unwrap_or(text.len());
    let number: f64 = text[..end].parse().ok()?;
    Some((number, text[end..].trim()))
}

/// Parses a duration: a number of hours, days or weeks.
fn age(text: &str) -> Result<Duration, String> {
    let expected = || "expected a number of hours, days or weeks: 12h, 30d, 8w".to_owned();
    let (number, unit) = parts(text).ok_or_else(expected)?;
    let hours = match unit {
        "h" => 1.0,
        "d" => 24.0,
        "w" => 7.0 * 24.0,
        _ => return Err(expected()),
    };
    Duration::try_from_secs_f64(number * hours * 3600.0).map_err(|_| expected())
}

/// Parses a number of bytes with an optional unit.
fn size(text: &str) -> Result<u64, String> {
    let expected = || "expected a number of bytes: 2GiB, 500MB, 0".to_owned();
    let (number, unit) = parts(text).ok_or_else(expected)?;
    let bytes = match unit.to_ascii_lowercase().as_str() {
        "" | "b" => 1.0,
        "kb" => 1e3,
        "mb" => 1e6,
        "gb" => 1e9,
        "tb" => 1e12,
        "kib" => 1024.0,
        "mib" => 1024.0 * 1024.0,
        "gib" => 1024.0 * 1024.0 * 1024.0,
        "tib" => 1024.0 * 1024.0 * 1024.0 * 1024.0,
        _ => return Err(expected()),
    };
    let bytes = (number * bytes).round();
    // Every whole number below 2⁵³ is exact.
    if !(0.0..9e15).contains(&bytes) {
        return Err(expected());
    }
    Ok(whole_count(bytes))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_and_ages_are_numbers_with_a_unit() {
        assert_eq!(size("2GiB"), Ok(2 << 30));
        assert_eq!(size("1.5 MB"), Ok(1_500_000));
        assert_eq!(size("0"), Ok(0));
        assert_eq!(age("36h"), age("1.5d"));
        assert_eq!(age("1w"), Ok(Duration::from_secs(7 * 24 * 3600)));
        for wrong in ["", "much", "-1", "1e99GB", "2 cats", "99999TB"] {
            assert!(size(wrong).is_err(), "{wrong}");
        }
        for wrong in ["", "30", "1y", "-1d", "99999999999999999999w"] {
            assert!(age(wrong).is_err(), "{wrong}");
        }
    }
}
