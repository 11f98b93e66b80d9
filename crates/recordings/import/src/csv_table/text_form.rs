//! Forms of text tables of force gauges and spreadsheets: lines before the header, a row of units, decimal commas.

use super::{cells_of_first_row, number};
use crate::unit_suffix::UnitSuffix;

/// Form of a text table, except its separator.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct TextForm {
    /// False for a table without header, whose column names are the positions, from 0.
    pub(crate) has_header: bool,
    /// Decimal mark.
    pub(crate) decimal: char,
    /// Separator of groups of three digits; `None` if the map does not set it, empty for no grouping.
    pub(crate) thousands: Option<String>,
    /// Mark that begins comment lines.
    pub(crate) comment: Option<String>,
    /// Number of lines before the header, outside the table.
    pub(crate) skip_lines: u32,
    /// True if the line below the header contains units.
    pub(crate) has_units: bool,
}

/// Maximum number of lines of a text table from which its form is guessed.
const LOOKED_AT: usize = 64;

impl TextForm {
    /// Plain form: decimal points, and only rows of the table below the header.
    pub(crate) fn new(has_header: bool) -> TextForm {
        TextForm {
            has_header,
            decimal: '.',
            thousands: None,
            comment: None,
            skip_lines: 0,
            has_units: false,
        }
    }

    pub(super) fn is_plain(&self) -> bool {
        self.comment.is_none() && self.skip_lines == 0 && !self.has_units
    }

    /// True if cells are converted before they are parsed.
    fn converts(&self) -> bool {
        self.decimal != '.'
            || self
                .thousands
                .as_deref()
                .is_some_and(|sign| !sign.is_empty())
    }

    /// Returns the cell with a decimal point and without digit groups; `None` if the cell is not a number or needs no change.
    ///
    /// # Errors
    /// Error message if a cell of digits and signs does not have this form.
    pub(crate) fn converted(&self, cell: &str) -> Result<Option<String>, String> {
        if !self.converts() || !cell.bytes().any(|byte| byte.is_ascii_digit()) {
            return Ok(None);
        }
        let sign = self.thousands.as_deref().unwrap_or_default();
        let is_of_number = |letter: char| {
            letter.is_ascii_digit() || "+-.,eE'".contains(letter) || sign.contains(letter)
        };
        if !cell.chars().all(is_of_number) {
            return Ok(None);
        }
        let (mantissa, exponent) = cell.split_at(cell.find(['e', 'E']).unwrap_or(cell.len()));
        let (whole, fraction) = match mantissa.rsplit_once(self.decimal) {
            Some((whole, fraction)) => (whole, Some(fraction)),
            None => (mantissa, None),
        };
        let digits = whole.trim_start_matches(['+', '-']);
        let are_groups = match sign {
            "" => true,
            sign => {
                let mut groups = digits.split(sign);
                let first = groups.next().unwrap_or_default();
                let is_grouped = digits.contains(sign);
                groups.all(|group| group.len() == 3)
                    && (!is_grouped || (1..=3).contains(&first.len()))
            }
        };
        let bare = match sign {
            "" => whole.to_owned(),
            sign => whole.replace(sign, ""),
        };
        let is_right = are_groups
            && bare
                .trim_start_matches(['+', '-'])
                .bytes()
                .all(|byte| byte.is_ascii_digit())
            && fraction.is_none_or(|fraction| fraction.bytes().all(|byte| byte.is_ascii_digit()));
        if !is_right {
            let groups = match sign {
                "" => String::new(),
                sign => format!(" and `{sign}` between groups of three digits"),
            };
            return Err(format!(
                "is not a number with the decimal sign `{}`{groups}, as set in the map for this table",
                self.decimal
            ));
        }
        Ok(Some(match fraction {
            Some(fraction) => format!("{bare}.{fraction}{exponent}"),
            None => format!("{bare}{exponent}"),
        }))
    }

    /// Keys of a map for this form, such as `, decimal = ","`. Default values are omitted.
    pub(crate) fn keys(&self) -> String {
        let mut keys = String::new();
        if !self.has_header {
            keys += ", header = false";
        }
        if self.skip_lines > 0 {
            keys += &format!(", skip_lines = {}", self.skip_lines);
        }
        if let Some(comment) = &self.comment {
            keys += &format!(", comment = {comment:?}");
        }
        if self.has_units {
            keys += ", units_row = true";
        }
        if self.decimal != '.' {
            keys += &format!(", decimal = {:?}", self.decimal.to_string());
        }
        if let Some(thousands) = &self.thousands {
            keys += &format!(", thousands = {thousands:?}");
        }
        keys
    }

    /// Guesses the form from the beginning of `text`.
    pub(crate) fn guessed(text: &str) -> TextForm {
        let mut form = TextForm::new(true);
        let lines: Vec<&str> = text.lines().take(LOOKED_AT).collect();
        let first = lines.iter().find(|line| !line.trim().is_empty());
        let marks = ["#", "%", "//"];
        let mark = first.and_then(|first| {
            let first = first.trim_start_matches('"');
            marks.into_iter().find(|mark| first.starts_with(mark))
        });
        form.comment = mark.map(str::to_owned);
        let is_row = |line: &&str| {
            !line.trim().is_empty()
                && mark.is_none_or(|mark| !line.trim_start_matches('"').starts_with(mark))
                && separator_line(line).is_none()
        };
        let rows: Vec<(usize, &str)> = lines
            .iter()
            .enumerate()
            .filter(|(_, line)| is_row(line))
            .map(|(at, line)| (at, *line))
            .collect();
        let Some((_, last)) = rows.last() else {
            return form;
        };
        // The last line belongs to the body, so the header is as wide as that line.
        let header_by = |delimiter: &u8| {
            let expected = cells_of_first_row(last, *delimiter);
            let mut lines = rows.iter();
            let first =
                lines.position(|(_, line)| cells_of_first_row(line, *delimiter) == expected);
            (expected < 2, first)
        };
        let delimiter = [b';', b'\t', b',']
            .into_iter()
            .min_by_key(header_by)
            .unwrap_or(b',');
        let cells = |line: &str| cells_of_first_row(line, delimiter);
        let expected = cells(last);
        if mark.is_none()
            && rows.len() > 2
            && expected > 1
            && let Some(header) = rows.iter().position(|(_, line)| cells(line) == expected)
            && rows[header..]
                .iter()
                .all(|(_, line)| cells(line) == expected)
        {
            let skipped = rows[header].0;
            let separated = usize::from(
                lines
                    .iter()
                    .take(skipped)
                    .any(|line| separator_line(line).is_some()),
            );
            form.skip_lines = u32::try_from(skipped - separated.min(skipped)).unwrap_or_default();
            if separated > 0 && header == 0 {
                form.skip_lines = 0;
            }
        }
        let table: Vec<&str> = rows
            .iter()
            .map(|(_, line)| *line)
            .filter(|line| cells(line) == expected)
            .collect();
        if let [_, units, below, ..] = table.as_slice() {
            form.has_units = is_units_row(units, below, delimiter);
        }
        let body = table
            .get(1 + usize::from(form.has_units)..)
            .unwrap_or_default();
        if delimiter != b',' {
            let cells: Vec<&str> = body
                .iter()
                .flat_map(|line| line.split(char::from(delimiter)))
                .map(|cell| cell.trim().trim_matches('"'))
                .collect();
            let is_comma = |cell: &&&str| is_decimal(cell, ',');
            let is_point = |cell: &&&str| is_decimal(cell, '.');
            let commas = cells.iter().filter(is_comma).count();
            if commas > 0
                && !cells
                    .iter()
                    .any(|cell| is_point(&cell) && !is_grouped(cell, '.'))
            {
                form.decimal = ',';
                if cells.iter().any(|cell| {
                    is_grouped(cell, '.')
                        || is_grouped(cell.split(',').next().unwrap_or_default(), '.')
                }) {
                    form.thousands = Some(".".to_owned());
                }
            }
        }
        form
    }
}

/// True for a cell of digits that contains one decimal mark `sign`.
fn is_decimal(cell: &str, sign: char) -> bool {
    let bare = cell.trim_start_matches(['+', '-']);
    bare.split_once(sign).is_some_and(|(whole, fraction)| {
        let are_digits = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
        are_digits(fraction)
            && !fraction.is_empty()
            && whole
                .chars()
                .all(|letter| letter.is_ascii_digit() || letter == '.')
    })
}

/// True for a number in groups of three digits: `1.333`, `12.345.678`, but not `0.333`.
pub(crate) fn is_grouped(cell: &str, sign: char) -> bool {
    let bare = cell.trim_start_matches(['+', '-']);
    let mut groups = bare.split(sign);
    let first = groups.next().unwrap_or_default();
    let are_digits =
        |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    let mut others = groups.peekable();
    others.peek().is_some()
        && (1..=3).contains(&first.len())
        && !first.starts_with('0')
        && are_digits(first)
        && others.all(|group| group.len() == 3 && are_digits(group))
}

/// Separator stated by the line `sep=;`, which spreadsheets write.
pub(super) fn separator_line(line: &str) -> Option<u8> {
    let line = line.trim().trim_matches('"');
    match line
        .strip_prefix("sep=")
        .or_else(|| line.strip_prefix("SEP="))?
        .as_bytes()
    {
        [only] if matches!(only, b';' | b',' | b'\t' | b'|') => Some(*only),
        _ => None,
    }
}

/// True for a row of units above a row of numbers.
fn is_units_row(units: &str, below: &str, delimiter: u8) -> bool {
    let cells = |line: &str| -> Vec<String> {
        let cells = line.split(char::from(delimiter));
        cells
            .map(|cell| cell.trim().trim_matches('"').trim().to_owned())
            .collect()
    };
    let (units, below) = (cells(units), cells(below));
    let is_number = |cell: &str| {
        number::number(cell).is_ok_and(|found| found.is_some()) || is_decimal(cell, ',')
    };
    let said = units
        .iter()
        .filter(|cell| unit_said(cell).is_some())
        .count();
    said > 0
        && !units.iter().any(|cell| is_number(cell))
        && units
            .iter()
            .zip(&below)
            .any(|(unit, cell)| unit_said(unit).is_some() && is_number(cell))
}

/// Unit in a cell of the units row: `[mN]`, `(mN)`, `mN`.
pub(super) fn unit_said(cell: &str) -> Option<String> {
    let bare = cell
        .trim()
        .trim_matches(['[', ']', '(', ')', '<', '>'])
        .trim();
    let suffix = UnitSuffix::of(&format!("cell ({bare})"))?;
    Some(suffix.any_unit()?.symbol().to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commas_for_points_and_groups_of_digits_are_converted_or_refused() {
        let form = |decimal: char, thousands: Option<&str>| TextForm {
            decimal,
            thousands: thousands.map(str::to_owned),
            ..TextForm::new(true)
        };
        let german = form(',', Some("."));
        for (cell, expected) in [
            ("1.333", "1333"),
            ("1.234.567,5", "1234567.5"),
            ("-12,25", "-12.25"),
            ("756", "756"),
            ("1,5e-3", "1.5e-3"),
        ] {
            assert_eq!(
                german.converted(cell),
                Ok(Some(expected.to_owned())),
                "{cell}"
            );
        }
        for cell in ["1.33", "1.2345", "1,2,3", "1333.000"] {
            assert!(german.converted(cell).is_err(), "{cell}");
        }
        assert_eq!(german.converted("img/00.png"), Ok(None));
        assert_eq!(form('.', Some("")).converted("1.333"), Ok(None));
        assert_eq!(
            form('.', Some("'")).converted("1'333.5"),
            Ok(Some("1333.5".to_owned()))
        );
    }

    #[test]
    fn the_form_of_a_spreadsheet_is_guessed_by_its_cells() {
        let keys = |text: &str| TextForm::guessed(text).keys();
        assert_eq!(keys("a;b\n1,5;2\n2,5;3\n"), ", decimal = \",\"");
        assert_eq!(
            keys("a;b\n1.500,5;2\n2,5;3\n"),
            ", decimal = \",\", thousands = \".\""
        );
        assert_eq!(keys("a,b\n1.5,2\n2.5,3\n"), "");
        assert_eq!(keys("a;b\n1.333;2\n2.500;3\n"), "");
        assert_eq!(keys("sep=;\na;b\n1;2\n2;3\n"), "");
        assert_eq!(keys("t [s],f\ns,N\n0.1,2\n0.2,3\n"), ", units_row = true");
        assert_eq!(keys("name,kind\nm,s\nx,y\n"), "");
    }
}
