//! Specification of a split.

use std::collections::BTreeMap;
use std::fmt;
use std::str::FromStr;

use super::error::SplitError;
use super::fold_spec::FoldSpec;
use super::fractions::Fractions;
use super::part::Part;
use crate::settings::Suggestion;

/// Specification of a split into training, validation and test parts.
#[derive(Clone, Debug, PartialEq)]
pub struct SplitSpec {
    /// Method of assignment.
    pub kind: SplitKind,
    /// Sizes of the parts. Ignored if parts are named.
    pub fractions: Fractions,
}

/// Method of assigning samples to parts.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum SplitKind {
    /// Random, by sample.
    Random,
    /// By time: the first samples are for training, the last samples for test.
    Chronological,
    /// Random, by contact point. All presses at a point are in one part.
    #[default]
    ByPoint,
    /// By the values in a column.
    ByColumn(ColumnSplit),
    /// By recording, with named parts. Random if no part is named.
    ByRecording(BTreeMap<String, Part>),
    /// Random, by block of time, with a gap between blocks of different parts.
    ByBlock,
    /// Cross-validation over several recordings: each recording is predicted by a model fitted to all other recordings.
    LeaveOneRecordingOut,
    /// Cross-validation: each group is predicted by a model fitted to other groups.
    Folds(FoldSpec),
    /// Parts that the recording declares.
    Declared,
    /// No split: all samples are for training, for a final model that is tested on other recordings.
    All,
}

/// A column whose values determine the part of a sample.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ColumnSplit {
    /// Name of the column.
    pub column: String,
    /// Part of each value. If empty, values are assigned at random.
    pub parts: BTreeMap<String, Part>,
}

const KINDS: [&str; 11] = [
    "random",
    "chronological",
    "by-point",
    "by-block",
    "cv:5",
    "loo",
    "by-column:NAME",
    "by-recording",
    "leave-one-recording-out",
    "declared",
    "all",
];

impl FromStr for SplitSpec {
    type Err = SplitError;

    /// Parses `random`, `chronological`, `by-point`, `by-block`, `cv:5`, `cv:5 by-point`, `loo`, `by-column:NAME`,
    /// `by-column:NAME=train:1,2;val:3;test:4`, `by-recording`, `by-recording=train:a,b;test:c`, `leave-one-recording-out`, `declared` or
    /// `all`, and shares after a space: `random 70/20/10`. A `\` escapes `,`, `;` and `\` in values. Inverse of `Display`.
    fn from_str(text: &str) -> Result<SplitSpec, SplitError> {
        let shares = text
            .rsplit_once(' ')
            .and_then(|(word, shares)| Some((word, three_numbers(shares)?)));
        let (text, fractions) = match shares {
            Some((word, [train, validation, test])) => {
                check_sum(text, [train, validation, test])?;
                (word, Fractions::new(train, validation, test)?)
            }
            None => (text, Fractions::default()),
        };
        if let Some(folds) = FoldSpec::parse(text) {
            return Ok(SplitSpec {
                kind: SplitKind::Folds(folds?),
                fractions,
            });
        }
        if let Some(shares) = three_numbers(text) {
            check_sum(text, shares)?;
        }
        let kind = match text {
            "by-block" => SplitKind::ByBlock,
            "random" => SplitKind::Random,
            "chronological" => SplitKind::Chronological,
            "by-point" => SplitKind::ByPoint,
            "declared" => SplitKind::Declared,
            "all" => SplitKind::All,
            "by-recording" => SplitKind::ByRecording(BTreeMap::new()),
            "leave-one-recording-out" => SplitKind::LeaveOneRecordingOut,
            _ => match (
                text.strip_prefix("by-column:"),
                text.strip_prefix("by-recording="),
            ) {
                (Some(rest), _) => SplitKind::ByColumn(column_split(rest)?),
                (None, Some(rest)) => SplitKind::ByRecording(named_parts(text, rest)?),
                (None, None) => {
                    return Err(SplitError::Kind {
                        given: text.to_owned(),
                        suggestion: match with_shares(text) {
                            Some(split) => Suggestion::of(text, [split.as_str()]),
                            None => Suggestion::of(text, KINDS),
                        },
                    });
                }
            },
        };
        Ok(SplitSpec { kind, fractions })
    }
}

/// Parses three numbers such as `70/20/10`; `None` for any other text.
fn three_numbers(text: &str) -> Option<[f64; 3]> {
    let numbers: Option<Vec<f64>> = text.split('/').map(|number| number.parse().ok()).collect();
    numbers?.try_into().ok()
}

/// Converts `chronological:80/0/20` to `chronological 80/0/20`; `None` for a text without shares after a colon.
fn with_shares(text: &str) -> Option<String> {
    let (word, shares) = text.rsplit_once(':')?;
    three_numbers(shares).map(|_| format!("{word} {shares}"))
}

/// Rejects `shares` at the end of `text` if their sum is not 100 or 1. [`Fractions::new`] rejects infinite and negative shares.
fn check_sum(text: &str, shares: [f64; 3]) -> Result<(), SplitError> {
    let sum: f64 = shares.iter().sum();
    let is_whole = [100.0, 1.0]
        .iter()
        .any(|whole| (sum - whole).abs() <= 1e-3 * whole);
    match is_whole || !sum.is_finite() || shares.iter().any(|share| *share < 0.0) {
        true => Ok(()),
        false => Err(SplitError::Sum {
            found: text.rsplit(' ').next().unwrap_or(text).to_owned(),
            sum,
        }),
    }
}

fn column_split(text: &str) -> Result<ColumnSplit, SplitError> {
    let malformed = |found: &str| SplitError::Assignment {
        found: found.to_owned(),
    };
    let (column, assignment) = match text.split_once('=') {
        Some((column, assignment)) => (column, Some(assignment)),
        None => (text, None),
    };
    if column.is_empty() {
        return Err(malformed(text));
    }
    Ok(ColumnSplit {
        column: column.to_owned(),
        parts: match assignment {
            Some(assignment) => named_parts(text, assignment)?,
            None => BTreeMap::new(),
        },
    })
}

/// Parses `assignment`, such as `train:1,2;val:3;test:4`, at the end of `text`.
fn named_parts(text: &str, assignment: &str) -> Result<BTreeMap<String, Part>, SplitError> {
    let malformed = |found: &str| SplitError::Assignment {
        found: found.to_owned(),
    };
    let mut parts = BTreeMap::new();
    for section in pieces(assignment, ';') {
        let (name, values) = section.split_once(':').ok_or_else(|| malformed(section))?;
        let part = Part::from_name(name).ok_or_else(|| malformed(section))?;
        for value in pieces(values, ',') {
            if value.is_empty() {
                return Err(malformed(section));
            }
            let value = letters(value);
            if parts.insert(value.clone(), part).is_some() {
                return Err(SplitError::Twice { value });
            }
        }
    }
    let named = |wanted: Part| parts.values().any(|&part| part == wanted);
    match named(Part::Train) && named(Part::Test) {
        true => Ok(parts),
        false => Err(malformed(text)),
    }
}

/// Splits `text` at separators that are not escaped by `\`.
fn pieces(text: &str, separator: char) -> Vec<&str> {
    let (mut pieces, mut begin, mut is_letter) = (Vec::new(), 0, false);
    for (at, letter) in text.char_indices() {
        if letter == separator && !is_letter {
            pieces.push(&text[begin..at]);
            begin = at + letter.len_utf8();
        }
        is_letter = letter == '\\' && !is_letter;
    }
    pieces.push(&text[begin..]);
    pieces
}

/// Separators of values, and the escape character.
const MARKS: [char; 3] = [',', ';', '\\'];

/// Removes the escape characters from a value.
fn letters(text: &str) -> String {
    let mut value = String::with_capacity(text.len());
    let mut rest = text.chars().peekable();
    while let Some(letter) = rest.next() {
        let next = rest.next_if(|next| letter == '\\' && MARKS.contains(next));
        value.push(next.unwrap_or(letter));
    }
    value
}

/// Escapes a value.
fn written(value: &str) -> String {
    let mut text = String::with_capacity(value.len());
    for letter in value.chars() {
        if MARKS.contains(&letter) {
            text.push('\\');
        }
        text.push(letter);
    }
    text
}

impl fmt::Display for SplitSpec {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.kind {
            SplitKind::Random => f.write_str("random")?,
            SplitKind::Chronological => f.write_str("chronological")?,
            SplitKind::ByPoint => f.write_str("by-point")?,
            SplitKind::ByBlock => f.write_str("by-block")?,
            SplitKind::Folds(folds) => return write!(f, "{folds}"),
            SplitKind::Declared => return f.write_str("declared"),
            SplitKind::All => return f.write_str("all"),
            SplitKind::LeaveOneRecordingOut => f.write_str("leave-one-recording-out")?,
            SplitKind::ByRecording(parts) => {
                f.write_str("by-recording")?;
                if !parts.is_empty() {
                    return write_parts(parts, f);
                }
            }
            SplitKind::ByColumn(split) => {
                write!(f, "by-column:{}", split.column)?;
                if !split.parts.is_empty() {
                    return write_parts(&split.parts, f);
                }
            }
        }
        write!(f, " {}", self.fractions)
    }
}

fn write_parts(parts: &BTreeMap<String, Part>, f: &mut fmt::Formatter<'_>) -> fmt::Result {
    let mut separator = '=';
    for part in Part::ALL {
        let values: Vec<String> = parts
            .iter()
            .filter(|(_, own)| **own == part)
            .map(|(value, _)| written(value))
            .collect();
        if !values.is_empty() {
            write!(f, "{separator}{}:{}", part.short_name(), values.join(","))?;
            separator = ';';
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests;
