//! Column in the pattern of a file name: as written `{n}`, padded with zeros `{n:05}`, or from 1 `{row+1:05}`.

/// Maximum number of digits of a padded number.
pub(crate) const DIGITS_MAX: usize = 20;

/// Column that a pattern names, with the form of its whole numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct PatternColumn<'p> {
    pub(super) name: &'p str,
    pub(super) form: NumberForm,
}

/// Form of whole numbers in a file name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct NumberForm {
    /// Number added to the row number.
    add: u64,
    /// Minimum number of digits.
    digits: usize,
}

impl<'p> PatternColumn<'p> {
    /// Parses the text within `{}`. Prefers a column with exactly this name, if `has` returns true for it.
    pub(super) fn parse(text: &'p str, has: impl Fn(&str) -> bool) -> PatternColumn<'p> {
        if has(text) {
            return PatternColumn {
                name: text,
                form: NumberForm::default(),
            };
        }
        let padded = text.rsplit_once(":0").and_then(|(name, digits)| {
            let digits: usize = digits.parse().ok()?;
            (1..=DIGITS_MAX).contains(&digits).then_some((name, digits))
        });
        let (name, digits) = padded.unwrap_or((text, 0));
        let row = name.strip_prefix("row+");
        match row.and_then(|add| add.parse::<u32>().ok()) {
            Some(add) => PatternColumn {
                name: "row",
                form: NumberForm {
                    add: u64::from(add),
                    digits,
                },
            },
            None => PatternColumn {
                name,
                form: NumberForm { add: 0, digits },
            },
        }
    }

    /// Columns of `pattern`, in order. `has` returns true for the existing columns.
    pub(super) fn all(
        pattern: &'p str,
        has: impl Fn(&str) -> bool,
    ) -> impl Iterator<Item = PatternColumn<'p>> {
        let parts = pattern.split('{').skip(1);
        let parts = parts.filter_map(|part| part.split_once('}'));
        parts.map(move |(text, _)| PatternColumn::parse(text, &has))
    }
}

impl NumberForm {
    /// Writes `cell` in the number form of a file name. Texts other than whole numbers are unchanged.
    pub(super) fn write(self, cell: &str) -> String {
        let NumberForm { add, digits } = self;
        let number = match (add, digits) {
            (0, 0) => None,
            _ => whole_number(cell).and_then(|number| number.checked_add(add)),
        };
        match number {
            Some(number) => format!("{number:0digits$}"),
            None => cell.to_owned(),
        }
    }
}

/// Whole number in a cell: `7`, `007` or `7.0`.
pub(crate) fn whole_number(cell: &str) -> Option<u64> {
    let digits = match cell.split_once('.') {
        Some((digits, fraction)) if fraction.bytes().all(|digit| digit == b'0') => digits,
        Some(_) => return None,
        None => cell,
    };
    digits.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_column_is_padded_with_zeros_and_a_row_is_counted_from_another_number() {
        let written = |text: &str, cell: &str| {
            let column = PatternColumn::parse(text, |_| false);
            (column.name.to_owned(), column.form.write(cell))
        };
        let of = |name: &str, text: &str| (name.to_owned(), text.to_owned());
        assert_eq!(written("n:05", "7"), of("n", "00007"));
        assert_eq!(written("n:05", "7.0"), of("n", "00007"));
        assert_eq!(written("n:03", "12345"), of("n", "12345"));
        assert_eq!(written("n:05", "a"), of("n", "a"));
        assert_eq!(written("n", "007"), of("n", "007"));
        assert_eq!(written("row+1", "0"), of("row", "1"));
        assert_eq!(written("row+1:04", "8"), of("row", "0009"));
        // Names that have another meaning are kept.
        for name in ["n:5", "n:0", "n:099", "a+1", "t:00x"] {
            assert_eq!(PatternColumn::parse(name, |_| false).name, name);
        }
    }

    #[test]
    fn a_column_with_the_name_of_a_form_comes_first() {
        for name in ["n:05", "row+1"] {
            let column = PatternColumn::parse(name, |known| known == name);
            assert_eq!((column.name, column.form.write("7").as_str()), (name, "7"));
        }
    }

    #[test]
    fn all_columns_of_a_pattern_are_found() {
        let names: Vec<&str> = PatternColumn::all("{path.run}/x{n:05}_{row}.png", |_| false)
            .map(|column| column.name)
            .collect();
        assert_eq!(names, ["path.run", "n", "row"]);
    }
}
