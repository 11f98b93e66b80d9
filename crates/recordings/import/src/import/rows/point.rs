//! Computes the contact point of a row.

use super::MappedTable;

impl MappedTable<'_> {
    pub(super) fn point_id(&self, row: usize) -> Option<String> {
        let cells: Vec<&str> = self
            .point_id
            .iter()
            .map(|column| self.table.cell(row, *column))
            .collect();
        // A file directly in the source folder has an empty folder part.
        let names = self.map.ids.point_id.iter();
        let is_given = names
            .zip(&cells)
            .all(|(name, cell)| !cell.is_empty() || name.starts_with("path."));
        let is_named = is_given && cells.iter().any(|cell| !cell.is_empty());
        is_named.then(|| match cells[..] {
            [only] => only.to_owned(),
            _ => joined(&cells),
        })
    }
}

/// Joins cells with `:`. A `:` or `\` within a cell is escaped with `\`, so that the result is unambiguous.
fn joined(cells: &[&str]) -> String {
    let mut joined = String::new();
    for (at, cell) in cells.iter().enumerate() {
        if at > 0 {
            joined.push(':');
        }
        for letter in cell.chars() {
            if matches!(letter, ':' | '\\') {
                joined.push('\\');
            }
            joined.push(letter);
        }
    }
    joined
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn other_cells_never_make_the_same_id() {
        assert_eq!(joined(&["1.5", "b-2"]), "1.5:b-2");
        assert_eq!(joined(&["a:b", "c"]), "a\\:b:c");
        assert_eq!(joined(&["a", "b:c"]), "a:b\\:c");
        assert_eq!(joined(&["a\\", "b"]), "a\\\\:b");
        assert_eq!(joined(&["a\\:b"]), "a\\\\\\:b");
    }
}
