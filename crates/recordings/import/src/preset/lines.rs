//! Removes map lines that name missing columns.

use std::collections::BTreeSet;

/// Sections with one name and column per line.
const OPTIONAL: [&str; 3] = ["[columns]", "[attributes]", "[task]"];

/// Removes lines of channels, attributes and tasks whose name and column `has` rejects. Of lines with the same name, the first is kept.
pub(super) fn kept(text: &str, has: impl Fn(&str, &str) -> bool) -> String {
    let mut section = "";
    let mut names = BTreeSet::new();
    let mut kept = String::new();
    for line in text.lines() {
        if line.starts_with('[') {
            section = line;
            names.clear();
        }
        let entry = OPTIONAL.contains(&section).then(|| entry(line)).flatten();
        if let Some((name, column)) = entry
            && (!has(name, column) || !names.insert(name))
        {
            continue;
        }
        kept += line;
        kept.push('\n');
    }
    kept
}

/// Name and column of a line: `Fx = { from = "ft[0]", unit = "N" }`, `object = "path.object"`.
fn entry(line: &str) -> Option<(&str, &str)> {
    let (name, value) = line.split_once(" = ")?;
    let value = value.strip_prefix("{ from = ").unwrap_or(value);
    let (column, _) = value.strip_prefix('"')?.split_once('"')?;
    Some((name, column))
}

/// Removes the section that begins with the line `first`, up to the next section.
pub(super) fn without_section(text: &str, first: &str) -> String {
    let mut is_within = false;
    let mut kept = String::new();
    for line in text.lines() {
        if line.starts_with('[') {
            is_within = line == first;
        }
        if !is_within {
            kept += line;
            kept.push('\n');
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_of_absent_columns_and_second_ones_of_a_name_go() {
        let text = "a = 1\n[columns]\nFx = { from = \"ft/0\", unit = \"N\" }\nFx = { from = \"f/0\", unit = \"N\" }\nFy = { from = \"g\", unit = \"N\" }\n\
                    [time]\ncolumn = \"g\"\n";
        let left = kept(text, |_, column| column.starts_with('f'));
        assert_eq!(
            left,
            "a = 1\n[columns]\nFx = { from = \"ft/0\", unit = \"N\" }\n[time]\ncolumn = \"g\"\n"
        );
        assert_eq!(
            without_section(&left, "[columns]"),
            "a = 1\n[time]\ncolumn = \"g\"\n"
        );
    }
}
