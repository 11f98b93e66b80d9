//! Specification of cross-validation.

use std::fmt;
use std::str::FromStr;

use super::error::SplitError;
use crate::settings::Suggestion;

/// Specification of cross-validation: number of folds, and groups of samples that are never divided.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FoldSpec {
    /// Number of folds; `None` for one fold per group.
    pub count: Option<usize>,
    /// Kind of groups. All samples of a group are in one fold.
    pub by: FoldGroups,
}

/// Kind of groups whose samples are always in one fold.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum FoldGroups {
    /// Groups detected in the recording: repeated points, otherwise blocks of similar neighbouring samples, otherwise single samples.
    #[default]
    Detected,
    /// Every sample is a group of its own.
    Samples,
    /// Samples of the same contact point form a group.
    Points,
    /// Consecutive samples of the same time block form a group.
    Blocks,
    /// Samples of the same recording form a group.
    Recordings,
    /// Samples with the same value in the named column form a group.
    Column(String),
}

/// Accepted names of kinds of groups, in the order in which an error message suggests them.
const GROUPS: [&str; 5] = [
    "random",
    "by-point",
    "by-block",
    "by-recording",
    "by-column:NAME",
];

impl FoldSpec {
    /// Parses the text of a cross-validation, such as `cv:5`, `cv:10 by-point` or `loo by-column:object`; `None` for other splits.
    pub(super) fn parse(text: &str) -> Option<Result<FoldSpec, SplitError>> {
        let (word, by) = text.split_once(' ').unwrap_or((text, ""));
        let count = match (word, word.strip_prefix("cv:")) {
            ("loo", _) => None,
            (_, Some(count)) => Some(count),
            _ => return None,
        };
        let refused = |found: &str| SplitError::Folds {
            found: found.to_owned(),
        };
        let count = count.map(|text| {
            let count = text.parse().ok().filter(|count| *count >= 2);
            count.ok_or_else(|| refused(text))
        });
        let spec = count.transpose().and_then(|count| {
            Ok(FoldSpec {
                count,
                by: by.trim().parse()?,
            })
        });
        Some(spec)
    }
}

impl FromStr for FoldGroups {
    type Err = SplitError;

    fn from_str(text: &str) -> Result<FoldGroups, SplitError> {
        Ok(match text {
            "" => FoldGroups::Detected,
            "random" => FoldGroups::Samples,
            "by-point" => FoldGroups::Points,
            "by-block" => FoldGroups::Blocks,
            "by-recording" => FoldGroups::Recordings,
            _ => match text.strip_prefix("by-column:") {
                Some(name) if !name.is_empty() && !name.contains('=') => {
                    FoldGroups::Column(name.to_owned())
                }
                _ => {
                    return Err(SplitError::Kind {
                        given: text.to_owned(),
                        suggestion: Suggestion::of(text, GROUPS),
                    });
                }
            },
        })
    }
}

impl fmt::Display for FoldGroups {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            FoldGroups::Detected => Ok(()),
            FoldGroups::Samples => f.write_str("random"),
            FoldGroups::Points => f.write_str("by-point"),
            FoldGroups::Blocks => f.write_str("by-block"),
            FoldGroups::Recordings => f.write_str("by-recording"),
            FoldGroups::Column(name) => write!(f, "by-column:{name}"),
        }
    }
}

impl fmt::Display for FoldSpec {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.count {
            Some(count) => write!(f, "cv:{count}")?,
            None => f.write_str("loo")?,
        }
        match self.by {
            FoldGroups::Detected => Ok(()),
            _ => write!(f, " {}", self.by),
        }
    }
}
