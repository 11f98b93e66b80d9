//! Varying parts of similar file names. For example, `x+0.5_007.png` has a number after `x` and a counter.

use std::collections::BTreeSet;

/// Varying parts of paths that are otherwise equal.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct PathParts {
    /// Paths with `*` for the varying parts.
    pub(super) glob: String,
    /// Paths with `{name}`, `{name:digits}` or `{name:number}` for the varying parts.
    pub(super) pattern: String,
    /// Name of each part, in order, with true for a number.
    pub(super) names: Vec<(String, bool)>,
    /// Values of each part that is a word.
    pub(super) words: Vec<(String, Vec<String>)>,
    /// First part that is a time since 1970.
    pub(super) stamp: Option<Stamp>,
}

/// Part of a name that is a time since 1970.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Stamp {
    pub(super) name: String,
    pub(super) unit: &'static str,
}

/// Unit of numbers that are times from 2001 on; `None` for other numbers, and for seconds, which may be counters.
fn unit_since_1970(numbers: &BTreeSet<&str>) -> Option<&'static str> {
    let is_stamp = |number: &&str, digits: usize| {
        number.len() == digits
            && number.starts_with(['1', '2', '3', '4'])
            && number.bytes().all(|byte| byte.is_ascii_digit())
    };
    let units = [("ms", 13), ("us", 16), ("ns", 19)];
    let mut units = units.into_iter();
    let found = units.find(|(_, digits)| numbers.iter().all(|number| is_stamp(number, *digits)));
    found.map(|(unit, _)| unit)
}

/// Token of a name: letters, a number, or a separator.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Token<'a> {
    Letters(&'a str),
    Number(&'a str),
    Other(&'a str),
}

impl<'a> Token<'a> {
    fn text(&self) -> &'a str {
        match self {
            Token::Letters(text) | Token::Number(text) | Token::Other(text) => text,
        }
    }
}

/// Finds the varying parts of `paths`; `None` if their folder depths differ.
pub(super) fn varying(paths: &[&str]) -> Option<PathParts> {
    let first = paths.first()?;
    let depth = first.split('/').count();
    if paths.iter().any(|path| path.split('/').count() != depth) {
        return None;
    }
    let mut parts = PathParts {
        glob: String::new(),
        pattern: String::new(),
        names: Vec::new(),
        words: Vec::new(),
        stamp: None,
    };
    for level in 0..depth {
        if level > 0 {
            parts.glob.push('/');
            parts.pattern.push('/');
        }
        let names: Vec<&str> = paths
            .iter()
            .filter_map(|path| path.split('/').nth(level))
            .collect();
        parts.add_level(&names);
    }
    Some(parts)
}

impl PathParts {
    /// Path pattern for pictures of a table, with the varying parts taken from the path of the table: `s{path.s}/frames.npy`.
    pub(super) fn of_table(&self) -> String {
        let plain = self.pattern.replace(":digits}", "}");
        plain.replace(":number}", "}").replace('{', "{path.")
    }

    /// Letters directly after the part called `name`, usually the unit of the part.
    pub(super) fn letters_behind(&self, name: &str) -> Option<&str> {
        let (_, behind) = self.pattern.split_once(&format!("{{{name}:"))?;
        let (_, behind) = behind.split_once('}')?;
        let end = behind
            .find(|letter: char| !letter.is_alphabetic())
            .unwrap_or(behind.len());
        (end > 0).then(|| &behind[..end])
    }

    /// Adds one folder level, or the file name. `names` are the names at this level in all paths.
    fn add_level(&mut self, names: &[&str]) {
        let rows: Vec<Vec<Token<'_>>> = names.iter().map(|name| tokens(name)).collect();
        let first = &rows[0];
        let is_alike = rows.iter().all(|row| {
            row.len() == first.len()
                && row
                    .iter()
                    .zip(first)
                    .all(|(one, other)| match (one, other) {
                        (Token::Other(one), Token::Other(other)) => one == other,
                        _ => std::mem::discriminant(one) == std::mem::discriminant(other),
                    })
        });
        if !is_alike {
            let (stem, ending) = common_ending(names);
            self.add_part("name", stem.iter().copied().collect(), false);
            self.glob.push_str(ending);
            self.pattern.push_str(ending);
            return;
        }
        for at in 0..first.len() {
            let values: BTreeSet<&str> = rows.iter().map(|row| row[at].text()).collect();
            if values.len() == 1 {
                self.glob.push_str(first[at].text());
                self.pattern.push_str(first[at].text());
                continue;
            }
            let is_number = matches!(first[at], Token::Number(_));
            // Names the part by the nearest letters before it, if all paths share them.
            let letters = first[..at]
                .iter()
                .enumerate()
                .rev()
                .find_map(|(before, token)| match token {
                    // Letters directly after a number are its unit.
                    Token::Letters(_)
                        if before > 0 && matches!(first[before - 1], Token::Number(_)) =>
                    {
                        Some(None)
                    }
                    Token::Letters(letters) => {
                        let is_same = rows.iter().all(|row| row[before] == *token);
                        Some(is_same.then_some(*letters))
                    }
                    Token::Number(_) => Some(None),
                    Token::Other(_) => None,
                });
            let before = match (is_number, letters) {
                (true, Some(Some(letters))) => letters,
                (true, _) => "number",
                (false, _) => "object",
            };
            self.add_part(before, values, is_number);
        }
    }

    fn add_part(&mut self, stem: &str, values: BTreeSet<&str>, is_number: bool) {
        let stem: String = stem.chars().filter(char::is_ascii_alphanumeric).collect();
        let taken = |name: &str| self.names.iter().any(|(known, _)| known == name);
        let mut name = stem.clone();
        for count in 2.. {
            if !taken(&name) {
                break;
            }
            name = format!("{stem}{count}");
        }
        let are_digits = values
            .iter()
            .all(|value| value.bytes().all(|byte| byte.is_ascii_digit()));
        let kind = match (is_number, are_digits) {
            (false, _) => "",
            (true, true) => ":digits",
            (true, false) => ":number",
        };
        self.pattern.push_str(&format!("{{{name}{kind}}}"));
        if !self.glob.ends_with('*') {
            self.glob.push('*');
        }
        if is_number
            && self.stamp.is_none()
            && let Some(unit) = unit_since_1970(&values)
        {
            let name = name.clone();
            self.stamp = Some(Stamp { name, unit });
        }
        if !is_number {
            let words = values.iter().map(|value| (*value).to_owned()).collect();
            self.words.push((name.clone(), words));
        }
        self.names.push((name, is_number));
    }
}

/// Splits the common file extension off the names.
fn common_ending<'a>(names: &[&'a str]) -> (BTreeSet<&'a str>, &'a str) {
    let ending = names[0].rfind('.').map_or("", |at| &names[0][at..]);
    let stems: Option<BTreeSet<&str>> =
        names.iter().map(|name| name.strip_suffix(ending)).collect();
    match stems {
        Some(stems) => (stems, ending),
        None => (names.iter().copied().collect(), ""),
    }
}

/// Splits a name into tokens. A sign at the start, or after a letter or `_`, belongs to the following number.
fn tokens(name: &str) -> Vec<Token<'_>> {
    let bytes = name.as_bytes();
    let is_digit = |at: usize| bytes.get(at).is_some_and(u8::is_ascii_digit);
    let mut found = Vec::new();
    let mut at = 0;
    while at < bytes.len() {
        let begin = at;
        let is_signed = matches!(bytes[at], b'+' | b'-')
            && is_digit(at + 1)
            && (at == 0 || bytes[at - 1].is_ascii_alphabetic() || bytes[at - 1] == b'_');
        if is_signed || is_digit(at) {
            at += 1;
            while is_digit(at) {
                at += 1;
            }
            if bytes.get(at) == Some(&b'.') && is_digit(at + 1) {
                at += 1;
                while is_digit(at) {
                    at += 1;
                }
            }
            found.push(Token::Number(&name[begin..at]));
        } else if bytes[at].is_ascii_alphabetic() || !bytes[at].is_ascii() {
            while at < bytes.len() && (bytes[at].is_ascii_alphabetic() || !bytes[at].is_ascii()) {
                at += 1;
            }
            found.push(Token::Letters(&name[begin..at]));
        } else {
            at += 1;
            found.push(Token::Other(&name[begin..at]));
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(paths: &[&str]) -> (String, String) {
        let parts = varying(paths).expect("of one depth");
        (parts.glob, parts.pattern)
    }

    #[test]
    fn numbers_and_words_that_vary_are_named_by_what_stands_before_them() {
        assert_eq!(
            of(&[
                "ball/unit1/x+0.5_z0.25_Fz2.219N_001.png",
                "cube/unit2/x-1.5_z0.30_Fz3.1N_002.png"
            ]),
            (
                "*/unit*/x*_z*_Fz*N_*.png".to_owned(),
                "{object}/unit{unit:digits}/x{x:number}_z{z:number}_Fz{Fz:number}N_{number:digits}.png".to_owned()
            )
        );
        assert_eq!(
            of(&["cube_1_forces.csv", "ball_2_forces.csv"]),
            (
                "*_*_forces.csv".to_owned(),
                "{object}_{number:digits}_forces.csv".to_owned()
            )
        );
        assert_eq!(of(&["a.csv"]), ("a.csv".to_owned(), "a.csv".to_owned()));
    }

    #[test]
    fn what_varies_is_named_as_a_part_of_the_path_of_a_table() {
        let parts = varying(&["ball/u1_x-0.5.npy", "cube/u2_x0.5.npy"]).expect("of one depth");
        assert_eq!(parts.of_table(), "{path.object}/u{path.u}_x{path.x}.npy");
    }

    #[test]
    fn names_that_are_unlike_are_one_part_and_depths_that_differ_are_none() {
        assert_eq!(
            of(&["a_1.png", "b-c.png"]),
            ("*.png".to_owned(), "{name}.png".to_owned())
        );
        assert_eq!(varying(&["a/b.png", "c.png"]), None);
        assert_eq!(varying(&[]), None);
        assert_eq!(of(&["größe1.png", "größe2.png"]).0, "größe*.png");
    }
}
