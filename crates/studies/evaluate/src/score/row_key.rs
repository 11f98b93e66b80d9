//! Row keys: columns that identify rows and pair two tables.

use taceva_core::shown;
use taceva_import::CsvTable;

use crate::error::EvaluateError;
use crate::note::PairedBy;

/// Column names that identify a row key. This program writes the first name. An unnamed index has the empty name.
pub(super) const KEY_NAMES: [&str; 5] = ["sample", "id", "sample_id", "index", ""];

/// Choice of the row key that pairs two tables.
///
/// ```
/// use taceva_evaluate::RowKey;
///
/// assert_eq!(RowKey::from("order"), RowKey::Order);
/// assert_eq!(RowKey::from("press"), RowKey::Column("press".to_owned()));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum RowKey {
    /// Pairs rows by position and ignores keys.
    Order,
    /// Pairs rows with equal cells in the column of this name.
    Column(String),
}

impl From<&str> for RowKey {
    fn from(word: &str) -> RowKey {
        match word {
            "order" => RowKey::Order,
            name => RowKey::Column(name.to_owned()),
        }
    }
}

/// Key columns of the truth and of the predictions.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct KeyPair {
    pub(super) truth: String,
    pub(super) prediction: String,
}

impl KeyPair {
    fn shared(name: &str) -> KeyPair {
        KeyPair {
            truth: name.to_owned(),
            prediction: name.to_owned(),
        }
    }
}

/// Row keys that both tables have, in the order in which they are tried.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct RowKeys {
    /// Keys that may pair rows; empty if rows are paired by order.
    pub(super) pairs: Vec<KeyPair>,
    /// True if the caller chose the pairing. Other keys are then not compared.
    is_chosen: bool,
}

impl RowKeys {
    /// Keys of two tables with these headers. Columns with a declared unit are channels.
    ///
    /// # Errors
    /// [`EvaluateError`] if one of the tables lacks the column that `chosen` names.
    pub(super) fn of(
        truth: &CsvTable,
        prediction: &CsvTable,
        chosen: Option<&RowKey>,
        is_declared: impl Fn(&str) -> bool,
    ) -> Result<RowKeys, EvaluateError> {
        match chosen {
            Some(RowKey::Order) => {
                return Ok(RowKeys {
                    pairs: Vec::new(),
                    is_chosen: true,
                });
            }
            Some(RowKey::Column(name)) => {
                truth.position(name)?;
                prediction.position(name)?;
                return Ok(RowKeys {
                    pairs: vec![KeyPair::shared(name)],
                    is_chosen: true,
                });
            }
            None => {}
        }
        let names = KEY_NAMES.into_iter().filter(|name| !is_declared(name));
        let shared = names
            .clone()
            .filter(|name| truth.has(name) && prediction.has(name));
        let mut pairs: Vec<KeyPair> = shared.map(KeyPair::shared).collect();
        if pairs.is_empty() {
            let first = |table: &CsvTable| names.clone().find(|name| table.has(name));
            // An unnamed index counts the rows of its own file, so it does not identify rows of the other file.
            let crossed = first(truth).zip(first(prediction));
            let crossed = crossed.filter(|(one, other)| !one.is_empty() && !other.is_empty());
            pairs.extend(crossed.map(|(truth, prediction)| KeyPair {
                truth: truth.to_owned(),
                prediction: prediction.to_owned(),
            }));
        }
        Ok(RowKeys {
            pairs,
            is_chosen: false,
        })
    }

    /// True if there is a key that may pair rows.
    pub(super) fn are_there(&self) -> bool {
        !self.pairs.is_empty()
    }

    /// Names of the columns that contain keys in the truth or in the predictions.
    pub(super) fn names(&self) -> impl Iterator<Item = &str> {
        self.pairs
            .iter()
            .flat_map(|pair| [pair.truth.as_str(), pair.prediction.as_str()])
    }

    /// Key columns that must agree in every pair of rows. These are the keys that did not pair the rows; empty if the caller chose the pairing.
    pub(super) fn others(&self, by: Option<&KeyPair>) -> impl Iterator<Item = &KeyPair> {
        let pairs = self.pairs.iter().filter(|_| !self.is_chosen);
        pairs.filter(move |pair| Some(*pair) != by)
    }

    /// Method of pairing: by the key `pair`, or by order.
    pub(super) fn paired_by(&self, pair: Option<&KeyPair>) -> PairedBy {
        match pair {
            Some(KeyPair { truth, prediction }) => PairedBy::Key {
                truth: truth.clone(),
                prediction: prediction.clone(),
            },
            None if self.is_chosen => PairedBy::ChosenOrder,
            None => PairedBy::Order,
        }
    }
}

/// Description of a row key, for messages.
pub(super) fn in_words(name: &str) -> String {
    match name {
        "" => "unnamed column".to_owned(),
        name => shown(name).to_string(),
    }
}

/// Normal form of a key for comparison: `7.0` becomes `7`, and other text is unchanged.
pub(super) fn key_of(cell: &str) -> &str {
    match cell.strip_suffix(".0") {
        Some(whole) if is_whole(whole) => whole,
        _ => cell,
    }
}

/// True if `text` is a whole number, with or without a sign.
pub(super) fn is_whole(text: &str) -> bool {
    let digits = text.strip_prefix('-').unwrap_or(text);
    !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit())
}

/// Key among `known` that differs from `key` only in blanks or case; `None` without such a key.
pub(super) fn nearly<'a>(key: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let bare = |text: &str| -> String {
        let letters = text.chars().filter(|letter| !letter.is_whitespace());
        letters.flat_map(char::to_lowercase).collect()
    };
    let wanted = bare(key);
    known.into_iter().find(|known| bare(known) == wanted)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(names: &[&str]) -> CsvTable {
        let rows: [Vec<&str>; 0] = [];
        CsvTable::of_cells("table.csv".as_ref(), names, rows).expect("a table")
    }

    fn keys(truth: &[&str], prediction: &[&str]) -> Vec<[String; 2]> {
        let keys = RowKeys::of(&table(truth), &table(prediction), None, |_| false);
        let pairs = keys.expect("keys").pairs.into_iter();
        pairs.map(|pair| [pair.truth, pair.prediction]).collect()
    }

    #[test]
    fn shared_keys_come_in_their_order_and_others_are_crossed() {
        let both = keys(&["Fz", "index", "sample"], &["sample", "index", "Fz"]);
        assert_eq!(both, [["sample", "sample"], ["index", "index"]]);
        assert_eq!(keys(&["sample", "Fz"], &["id", "Fz"]), [["sample", "id"]]);
        assert_eq!(keys(&["", "Fz"], &["", "Fz"]), [["", ""]]);
        assert!(keys(&["", "Fz"], &["id", "Fz"]).is_empty());
        assert!(keys(&["Fz"], &["id", "Fz"]).is_empty());
    }

    #[test]
    fn a_key_with_a_declared_unit_is_a_channel() {
        let both = table(&["index", "Fz"]);
        let keys = RowKeys::of(&both, &both, None, |name| name == "index").expect("keys");
        assert!(!keys.are_there());
    }

    #[test]
    fn a_chosen_key_must_stand_in_both_tables() {
        let [one, other] = [table(&["press", "Fz"]), table(&["Fz"])];
        let chosen = RowKey::Column("press".to_owned());
        assert!(RowKeys::of(&one, &one, Some(&chosen), |_| false).is_ok());
        let error = RowKeys::of(&one, &other, Some(&chosen), |_| false).expect_err("no such key");
        assert!(error.to_string().contains("no column `press`"), "{error}");
    }

    #[test]
    fn keys_are_compared_as_numbers_where_they_are_whole() {
        assert_eq!(
            ["7.0", "-7.0", "7.5", "a.0", ".0"].map(key_of),
            ["7", "-7", "7.5", "a.0", ".0"]
        );
        assert_eq!(nearly("Press 1", ["press1", "press2"]), Some("press1"));
        assert_eq!(nearly("Press 1", ["press2"]), None);
    }
}
