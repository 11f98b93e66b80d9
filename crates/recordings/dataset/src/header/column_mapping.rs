//! Source column, unit and sign of each label.

use serde::{Deserialize, Serialize};

use super::map_conflict::{Misread, differing, number, quoted};

/// Mapping of a label by an import. Before rows are added with another import map, both mappings are compared. Another unit, sign or matrix for the
/// same column would give wrong numbers without an error.
///
/// ```
/// let text = "label = \"Fz\"\nfrom = [\"force_z\"]\nunit = \"mN\"\nsign = -1\n";
/// let column: taceva_dataset::MappedColumn = toml::from_str(text)?;
/// assert_eq!((column.from[0].as_str(), column.sign), ("force_z", -1));
/// # Ok::<(), toml::de::Error>(())
/// ```
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MappedColumn {
    /// Name of the channel; `t_s` for the time, and `signals` for the taxels.
    pub label: String,
    /// Source column; for a matrix or for taxels, all columns in order.
    pub from: Vec<String>,
    /// Unit of the cells, or of the matrix product.
    pub unit: String,
    /// 1, or -1 for an inverted sign.
    #[serde(default = "one", skip_serializing_if = "is_one")]
    pub sign: i8,
    /// Offset subtracted from the cells of each column, in their unit; empty for none.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub offset: Vec<f64>,
    /// Factors of the columns after subtraction of the offsets. The products are summed. Empty for none.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub factors: Vec<f64>,
    /// Number that means "not measured", or `None`. A row is left out if every column with a placeholder contains its placeholder.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub placeholder: Option<f64>,
    /// Order of taxels: `place-first` or `channel-first`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub order: Option<String>,
    /// Description of the mean that is subtracted as the zero; `None` if no mean is subtracted.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub zero: Option<String>,
    /// Description of the weight that is subtracted; `None` if no weight is subtracted.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gravity: Option<String>,
}

/// Remedy for a column that an earlier import mapped differently.
const OTHER_COLUMN: &str =
    "if the column was recorded differently this time, rename it in the table";

impl MappedColumn {
    /// Mapping of `label`, read from `from` in `unit`, without conversion.
    pub fn new(label: &str, from: Vec<String>, unit: &str) -> MappedColumn {
        MappedColumn {
            label: label.to_owned(),
            from,
            unit: unit.to_owned(),
            sign: 1,
            offset: Vec::new(),
            factors: Vec::new(),
            placeholder: None,
            order: None,
            zero: None,
            gravity: None,
        }
    }

    /// Key in the import map for the setting `word`.
    fn key(&self, word: &str) -> String {
        let is_matrix = self.from.len() > 1 && !self.factors.is_empty();
        match (self.label.as_str(), word) {
            ("t_s", _) => format!("time.{word}"),
            ("signals", _) => format!("signals.{word}"),
            (_, "zero" | "gravity") => word.to_owned(),
            (label, "placeholder") => format!("drop.placeholders.{label}"),
            (label, "unit") if is_matrix => format!("matrix.gives.{label}"),
            (_, "factors") if is_matrix => "matrix.by".to_owned(),
            (_, _) if is_matrix => format!("matrix.{word}"),
            (label, "factors") => format!("columns.{label}.scale"),
            (label, _) => format!("columns.{label}.{word}"),
        }
    }

    fn shares_a_column(&self, other: &MappedColumn) -> bool {
        other.from.iter().any(|column| self.from.contains(column))
    }

    /// First setting in which `self`, from a new map, differs from `known`, the mapping of the same column to the same label.
    fn differs_from(&self, known: &MappedColumn) -> Option<Misread> {
        let facts = |column: &MappedColumn| {
            let order = column.order.clone();
            let [zero, gravity] = [&column.zero, &column.gravity]
                .map(|rule| rule.clone().unwrap_or_else(|| "none".to_owned()));
            let facts = [
                ("from", quoted(&column.from)),
                ("unit", column.unit.clone()),
                ("sign", column.sign.to_string()),
                ("offset", numbers(&column.offset)),
                ("factors", numbers(&column.factors)),
                ("placeholder", number(column.placeholder)),
                ("order", order.unwrap_or_else(|| "none".to_owned())),
                ("zero", zero),
                ("gravity", gravity),
            ];
            facts.map(|(word, said)| (self.key(word), said)).to_vec()
        };
        differing(facts(known), facts(self), OTHER_COLUMN)
    }
}

/// First column of `new`, from another map, that contradicts `known`, because the column has another setting or another label there. Source columns
/// that `known` lacks are ignored.
pub(super) fn misread(known: &[MappedColumn], new: &[MappedColumn]) -> Option<Misread> {
    new.iter().find_map(|column| {
        let same_label = known.iter().filter(|known| known.label == column.label);
        let mut shared = same_label.filter(|known| known.shares_a_column(column));
        if shared.clone().any(|known| known == column) {
            return None;
        }
        if let Some(known) = shared.next() {
            return column.differs_from(known);
        }
        // With a matrix every column contributes to several labels.
        let of_one = |column: &MappedColumn| column.from.len() == 1;
        let other = known.iter().filter(|known| of_one(known)).find(|known| {
            of_one(column) && known.label != column.label && known.from == column.from
        })?;
        Some(Misread {
            key: column.key("from"),
            own: format!(
                "another column ({} gives `{}`)",
                quoted(&other.from),
                other.label
            ),
            other: quoted(&column.from),
            mend: OTHER_COLUMN,
        })
    })
}

fn numbers(numbers: &[f64]) -> String {
    match numbers {
        [] => "none".to_owned(),
        [one] => one.to_string(),
        several => format!("{several:?}"),
    }
}

fn one() -> i8 {
    1
}

fn is_one(sign: &i8) -> bool {
    *sign == 1
}

#[cfg(test)]
mod tests {
    use super::*;

    fn column(label: &str, from: &[&str]) -> MappedColumn {
        let from = from.iter().map(|name| (*name).to_owned()).collect();
        MappedColumn::new(label, from, "N")
    }

    #[test]
    fn a_column_that_is_read_otherwise_is_named_by_the_key_of_the_map() {
        let known = [column("Fx", &["f0"]), column("t_s", &["t"])];
        let plain = || column("Fx", &["f0"]);
        for (new, key) in [
            (plain(), None),
            // A table with other columns may have other units.
            (
                MappedColumn {
                    unit: "mN".into(),
                    ..column("Fx", &["g0"])
                },
                None,
            ),
            (
                MappedColumn {
                    unit: "mN".into(),
                    ..plain()
                },
                Some("columns.Fx.unit"),
            ),
            (
                MappedColumn {
                    sign: -1,
                    ..plain()
                },
                Some("columns.Fx.sign"),
            ),
            (
                MappedColumn {
                    offset: vec![0.5],
                    ..plain()
                },
                Some("columns.Fx.offset"),
            ),
            (
                MappedColumn {
                    factors: vec![2.0],
                    ..plain()
                },
                Some("columns.Fx.scale"),
            ),
            (
                MappedColumn {
                    placeholder: Some(-1.0),
                    ..plain()
                },
                Some("drop.placeholders.Fx"),
            ),
            (
                MappedColumn {
                    unit: "ms".into(),
                    ..column("t_s", &["t"])
                },
                Some("time.unit"),
            ),
            // Exchanged axes.
            (column("Fy", &["f0"]), Some("columns.Fy.from")),
            (
                MappedColumn {
                    factors: vec![0.0, 1.0],
                    ..column("Fx", &["f0", "f1"])
                },
                Some("matrix.from"),
            ),
        ] {
            let found = misread(&known, std::slice::from_ref(&new));
            assert_eq!(
                found.as_ref().map(|found| found.key.as_str()),
                key,
                "{new:?}"
            );
        }
    }

    #[test]
    fn two_labels_of_one_column_are_no_exchange_and_a_third_way_is_compared_with_every_one() {
        let known = [column("Fx", &["f0"]), column("Fy", &["f0"])];
        assert_eq!(misread(&known, &known), None);
        let inverted = MappedColumn {
            sign: -1,
            ..column("Fx", &["g0"])
        };
        let both = [&known[..], std::slice::from_ref(&inverted)].concat();
        assert_eq!(misread(&both, &[inverted]), None);
        let plain = column("Fx", &["g0"]);
        assert_eq!(
            misread(&both, &[plain]).map(|found| found.key),
            Some("columns.Fx.sign".to_owned())
        );
    }
}
