//! Specification of a split into training, validation and test parts.

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
    /// Method that assigns samples to parts.
    pub kind: SplitKind,
    /// Shares of the parts. Ignored if the specification lists the values or recordings of each part.
    pub fractions: Fractions,
}

/// Method of assigning samples to parts.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum SplitKind {
    /// Assigns each sample at random.
    Random,
    /// Assigns samples by time: the first to training, the next to validation, the last to test.
    Chronological,
    /// Assigns contact points at random. All presses at a point are in one part.
    #[default]
    ByPoint,
    /// Assigns samples by their value in a column.
    ByColumn(ColumnSplit),
    /// Assigns recordings to the listed parts. If the list is empty, recordings are assigned at random.
    ByRecording(BTreeMap<String, Part>),
    /// Assigns blocks of consecutive samples at random. Samples too close to a block of a later part are left out.
    ByBlock,
    /// Cross-validation with one fold per recording. Each recording is predicted by a model fitted to the other recordings.
    LeaveOneRecordingOut,
    /// Cross-validation with groups of samples. Each group is predicted by a model fitted to other groups.
    Folds(FoldSpec),
    /// Uses the parts that the recording declares.
    Declared,
    /// Assigns all samples to training, for a final model that is tested on other recordings.
    All,
}

/// Column whose values determine the part of each sample.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ColumnSplit {
    /// Name of the column.
    pub column: String,
    /// Part of each value. If empty, each value is assigned to a part at random.
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

    /// Parses a specification as written by `Display`. Accepted are `random`, `chronological`, `by-point`, `by-block`, `cv:5`, `cv:5 by-point`,
    /// `loo`, `by-column:NAME`, `by-column:NAME=train:1,2;val:3;test:4`, `by-recording`, `by-recording=train:a,b;test:c`, `leave-one-recording-out`,
    /// `declared` and `all`. Shares may follow after a space: `random 70/20/10`. A `\` escapes `,`, `;` and `\` in values.
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

/// Converts `chronological:80/0/20` to `chronological 80/0/20`; `None` if `text` does not end in a colon and three numbers.
fn with_shares(text: &str) -> Option<String> {
    let (word, shares) = text.rsplit_once(':')?;
    three_numbers(shares).map(|_| format!("{word} {shares}"))
}

/// Returns an error for `text` if its `shares` sum to neither 100 nor 1. [`Fractions::new`] rejects infinite and negative shares.
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

/// Part of each value in `assignment`, such as `train:1,2;val:3;test:4`. `text` is the whole specification, for error messages.
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

/// Splits `text` at each `separator` that is not escaped by `\`.
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

/// Characters that are escaped in values: both separators and the escape character.
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

/// Escapes `,`, `;` and `\` in a value by `\`.
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
