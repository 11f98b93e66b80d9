//! Columns of an SQLite table, parsed from its SQL text.

/// Columns of a table.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Columns {
    pub(super) names: Vec<String>,
    /// Position of the column that stands for the row number; `None` if no column does.
    pub(super) id: Option<usize>,
}

/// Parses the columns of `CREATE TABLE name (…)`; `None` for other SQL, and for tables such as `WITHOUT ROWID`.
pub(super) fn columns(sql: &str) -> Option<Columns> {
    let (_, behind) = sql.split_once('(')?;
    let (inside, after) = behind.rsplit_once(')')?;
    let begin = sql.split('(').next()?.to_ascii_uppercase();
    if !begin.trim_start().starts_with("CREATE") || begin.contains("VIRTUAL") {
        return None;
    }
    if after.to_ascii_uppercase().contains("WITHOUT") {
        return None;
    }
    let mut names = Vec::new();
    let mut id = None;
    for part in parts(inside) {
        let part = part.trim();
        let (name, rest) = first_word(part);
        let is_constraint = ["CONSTRAINT", "PRIMARY", "UNIQUE", "CHECK", "FOREIGN"]
            .iter()
            .any(|word| part.len() > name.len() && word.eq_ignore_ascii_case(&name));
        let is_quoted = part.starts_with(['"', '`', '[', '\'']);
        if name.is_empty() || (is_constraint && !is_quoted) {
            continue;
        }
        let rest = rest.to_ascii_uppercase();
        let words: Vec<&str> = rest.split_whitespace().collect();
        // Only the exact type INTEGER makes a primary key an alias of the row number.
        if words.first() == Some(&"INTEGER")
            && words.windows(2).any(|pair| pair == ["PRIMARY", "KEY"])
        {
            id = Some(names.len());
        }
        names.push(name);
    }
    (!names.is_empty()).then_some(Columns { names, id })
}

/// Splits SQL text at the commas outside brackets and quotes.
fn parts(text: &str) -> Vec<&str> {
    let mut parts = Vec::new();
    let mut depth = 0_usize;
    let mut quote = None;
    let mut begin = 0;
    for (at, letter) in text.char_indices() {
        match (quote, letter) {
            (Some(end), letter) if letter == end => quote = None,
            (Some(_), _) => {}
            (None, '"' | '`' | '\'') => quote = Some(letter),
            (None, '[') => quote = Some(']'),
            (None, '(') => depth += 1,
            (None, ')') => depth = depth.saturating_sub(1),
            (None, ',') if depth == 0 => {
                parts.push(&text[begin..at]);
                begin = at + 1;
            }
            _ => {}
        }
    }
    parts.push(&text[begin..]);
    parts
}

/// First word of `part` without quotes, and the text after the word.
fn first_word(part: &str) -> (String, &str) {
    let closing = match part.chars().next() {
        Some(quote @ ('"' | '`' | '\'')) => Some(quote),
        Some('[') => Some(']'),
        _ => None,
    };
    match closing.and_then(|closing| part.get(1..)?.split_once(closing)) {
        Some((name, rest)) => (name.to_owned(), rest),
        None => {
            let end = part.find(|letter: char| letter.is_whitespace() || letter == '(');
            let (name, rest) = part.split_at(end.unwrap_or(part.len()));
            (name.to_owned(), rest)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_the_first_words_of_the_parts_of_a_table() {
        for (sql, names, id) in [
            (
                "CREATE TABLE messages(id INTEGER PRIMARY KEY,topic_id INTEGER NOT NULL,timestamp INTEGER NOT NULL, data BLOB NOT NULL)",
                &["id", "topic_id", "timestamp", "data"][..],
                Some(0),
            ),
            (
                "CREATE TABLE \"t\" (\n\"a b\" TEXT DEFAULT (x, 'y,)'), [c] INT PRIMARY KEY, `primary` INTEGER, PRIMARY KEY (c), UNIQUE(c))",
                &["a b", "c", "primary"],
                None,
            ),
            ("create table t(a integer primary key)", &["a"], Some(0)),
        ] {
            let found = columns(sql).expect(sql);
            assert_eq!(found.names, names, "{sql}");
            assert_eq!(found.id, id, "{sql}");
        }
        for sql in [
            "",
            "CREATE VIRTUAL TABLE t USING fts5(a)",
            "CREATE TABLE t(a PRIMARY KEY) WITHOUT ROWID",
            "CREATE VIEW v",
        ] {
            assert_eq!(columns(sql), None, "{sql}");
        }
    }
}
