//! Checks paired rows: both tables must have the same values in shared columns.

use taceva_core::{Field, shown};
use taceva_import::CsvTable;

use super::row_key::{KeyPair, RowKeys, in_words, key_of};
use crate::error::EvaluateError;
use crate::note::PairedBy;

/// Fields on which both tables must agree. They describe the row and its conditions.
const FIELDS: [Field; 7] = [
    Field::Point,
    Field::FrameDigest,
    Field::Stamp,
    Field::Scene,
    Field::Repeat,
    Field::DepthStep,
    Field::Phase,
];

/// Minimum tolerance between two time stamps of one row, in s. Stamps may be rounded to milliseconds, and are not reliable below a microsecond.
const LEAST_S: f64 = 1e-6;

/// Minimum number of decimals for which a stamp counts as rounded.
const LEAST_DECIMALS: usize = 3;

/// A column of both tables in which paired rows must agree.
#[derive(Clone, Debug)]
pub(super) struct Agreement {
    /// Column name in the predictions.
    name: String,
    columns: [usize; 2],
    kind: Kind,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// A key. Both tables must have the same text, or no text.
    Key,
    /// A text. An empty cell agrees with any text.
    Word,
    /// A time stamp in s. Stamps are compared with the precision of the stamp that has fewer decimals.
    Stamp,
}

/// Pairing of the rows of two tables, and the columns in which paired rows must agree.
#[derive(Clone, Debug)]
pub(super) struct Matching {
    pub(super) by: PairedBy,
    agreements: Vec<Agreement>,
}

impl Matching {
    /// Pairing by the key `by`, or by row number if `by` is `None`, with the columns that both tables must agree in.
    pub(super) fn of(
        [truth, prediction]: [&CsvTable; 2],
        keys: &RowKeys,
        by: Option<&KeyPair>,
    ) -> Result<Matching, EvaluateError> {
        let mut agreements = Vec::new();
        for pair in keys.others(by) {
            agreements.push(Agreement {
                name: pair.prediction.clone(),
                columns: [
                    truth.position(&pair.truth)?,
                    prediction.position(&pair.prediction)?,
                ],
                kind: Kind::Key,
            });
        }
        for field in FIELDS {
            let name = field.name();
            let is_key = keys.names().any(|key| key == name);
            if is_key || !truth.has(name) || !prediction.has(name) {
                continue;
            }
            agreements.push(Agreement {
                name: name.to_owned(),
                columns: [truth.position(name)?, prediction.position(name)?],
                kind: match field {
                    Field::Stamp => Kind::Stamp,
                    _ => Kind::Word,
                },
            });
        }
        Ok(Matching {
            by: keys.paired_by(by),
            agreements,
        })
    }

    /// Rejects the first pair of rows that disagrees in a shared column.
    ///
    /// # Errors
    /// [`EvaluateError::Table`] with the cell of the predictions.
    pub(super) fn check(
        &self,
        [truth, prediction]: [&CsvTable; 2],
        mut pairs: impl Iterator<Item = (usize, usize)>,
    ) -> Result<(), EvaluateError> {
        if self.agreements.is_empty() {
            return Ok(());
        }
        pairs.try_for_each(|(row, paired)| {
            let mut agreements = self.agreements.iter();
            let differs = agreements.find(|agreement| {
                let one = truth.cell(row, agreement.columns[0]);
                let other = prediction.cell(paired, agreement.columns[1]);
                !agreement.agrees(one, other)
            });
            match differs {
                Some(agreement) => Err(self.differs(agreement, [truth, prediction], [row, paired])),
                None => Ok(()),
            }
        })
    }

    fn differs(
        &self,
        agreement: &Agreement,
        [truth, prediction]: [&CsvTable; 2],
        [row, paired]: [usize; 2],
    ) -> EvaluateError {
        let [of_truth, of_prediction] = agreement.columns;
        let expected = format!(
            "expected `{}`, as in {}: these rows were paired {}, but differ in {}; name the key column with --key NAME, or correct the \
             tables",
            shown(truth.cell(row, of_truth)),
            truth.place(row, of_truth),
            self.by,
            in_words(&agreement.name),
        );
        prediction.refuse(paired, of_prediction, &expected).into()
    }
}

impl Agreement {
    fn agrees(&self, one: &str, other: &str) -> bool {
        if key_of(one) == key_of(other) {
            return true;
        }
        match self.kind {
            Kind::Key => false,
            Kind::Word => one.is_empty() || other.is_empty(),
            Kind::Stamp => one.is_empty() || other.is_empty() || is_same_time(one, other),
        }
    }
}

/// True if two stamps may be the same time, written with different numbers of decimals. A stamp that is not a number counts as equal here, and is reported by
/// the parser.
fn is_same_time(one: &str, other: &str) -> bool {
    let (Ok(first), Ok(second)) = (one.parse::<f64>(), other.parse::<f64>()) else {
        return true;
    };
    let decimals = |text: &str| {
        text.split_once('.')
            .map_or(0, |(_, decimals)| decimals.len())
    };
    let common = decimals(one).min(decimals(other)).max(LEAST_DECIMALS);
    let rounding = 0.5 * 10_f64.powi(-i32::try_from(common).unwrap_or(i32::MAX));
    // With a margin, because decimals are rounded to binary.
    (first - second).abs() <= LEAST_S.max(rounding) * (1.0 + 1e-9)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stamps_agree_as_far_as_the_shorter_one_is_written() {
        assert!(is_same_time("0.3333333333", "0.333"));
        assert!(is_same_time("0.1", "0.10000000149011612"));
        assert!(is_same_time("0.33333334", "0.3333333333"));
        assert!(is_same_time("1700000000.25", "1700000000.250"));
        assert!(!is_same_time("0.333", "0.334"));
        assert!(!is_same_time("1", "1.02"));
        assert!(!is_same_time("0.30", "0.31"));
    }
}
