//! Labels in the names of files and folders: `{object}/unit{unit:digits}/x{x:number}_{k:digits}.png`.

/// Maximum number of captured names in a pattern.
const NAMES_MAX: usize = 16;

/// Path pattern with named captures.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct PathPattern {
    /// Column that contains the path. `None` for the path of the table or of the file of the row, relative to the source folder.
    pub(crate) of: Option<String>,
    pieces: Vec<Piece>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
enum Piece {
    Text(String),
    Named { name: String, kind: Kind },
}

/// Kind of a named part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// Text without `/`, as long as the rest of the pattern allows.
    Free,
    /// Leading folders, each with its `/`, as many as the rest of the pattern allows, possibly none.
    Folders,
    /// One or more digits.
    Digits,
    /// Decimal number with optional sign and exponent.
    Number,
}

impl PathPattern {
    /// Parses a pattern. Returns an error message for an invalid pattern.
    pub(super) fn parse(text: &str, of: Option<String>) -> Result<PathPattern, String> {
        let mut pieces = Vec::new();
        let mut rest = text;
        while let Some((before, behind)) = rest.split_once('{') {
            let (named, after) = behind.split_once('}').ok_or("a `{` is never closed")?;
            let (name, kind) = match named.split_once(':') {
                None => (named, Kind::Free),
                Some((name, "digits")) => (name, Kind::Digits),
                Some((name, "number")) => (name, Kind::Number),
                Some((name, "folders")) => (name, Kind::Folders),
                Some((_, other)) => {
                    return Err(format!(
                        "`:{other}` is not a kind of part, expected `:digits`, `:number`, `:folders` or none"
                    ));
                }
            };
            let is_name = name.starts_with(|first: char| first.is_ascii_alphabetic())
                && name
                    .chars()
                    .all(|letter| letter.is_ascii_alphanumeric() || letter == '_');
            if !is_name {
                return Err(format!(
                    "`{name}` is not a valid name: expected a letter, then letters, digits or `_`"
                ));
            }
            let name = name.to_owned();
            if pieces
                .iter()
                .any(|piece| matches!(piece, Piece::Named { name: known, .. } if *known == name))
            {
                return Err(format!(
                    "`{name}` occurs twice in the pattern, expected once"
                ));
            }
            pieces.push(Piece::Text(before.to_owned()));
            pieces.push(Piece::Named { name, kind });
            rest = after;
        }
        pieces.push(Piece::Text(rest.to_owned()));
        let pattern = PathPattern { of, pieces };
        match pattern.names().count() {
            0 => Err("names no part of the path, such as {object}".to_owned()),
            count if count > NAMES_MAX => {
                Err(format!("{count} named parts, expected at most {NAMES_MAX}"))
            }
            _ => Ok(pattern),
        }
    }

    /// Names of the captured parts, in order.
    pub(crate) fn names(&self) -> impl Iterator<Item = &str> {
        self.pieces.iter().filter_map(|piece| match piece {
            Piece::Text(_) => None,
            Piece::Named { name, .. } => Some(name.as_str()),
        })
    }

    /// Letters directly after the part called `name`, usually its unit.
    pub(crate) fn letters_behind(&self, name: &str) -> Option<&str> {
        let is_it =
            |piece: &Piece| matches!(piece, Piece::Named { name: known, .. } if known == name);
        let at = self.pieces.iter().position(is_it)?;
        let Some(Piece::Text(text)) = self.pieces.get(at + 1) else {
            return None;
        };
        let end = text
            .find(|letter: char| !letter.is_alphabetic())
            .unwrap_or(text.len());
        (end > 0).then(|| &text[..end])
    }

    /// True if the part called `name` is free text or folders.
    pub(crate) fn is_text(&self, name: &str) -> bool {
        let is_so = |piece: &Piece| match piece {
            Piece::Named { name: known, kind } => {
                known == name && matches!(kind, Kind::Free | Kind::Folders)
            }
            Piece::Text(_) => false,
        };
        self.pieces.iter().any(is_so)
    }

    /// Values of the named parts of `path`, in the order of [`names`](PathPattern::names); `None` if the path does not match.
    pub(crate) fn captures<'p>(&self, path: &'p str) -> Option<Vec<&'p str>> {
        let mut found = Vec::new();
        // Failed positions are remembered, which bounds the time by length times parts.
        let mut failed = vec![vec![false; path.len() + 1]; self.pieces.len() + 1];
        self.follow(0, 0, path, &mut found, &mut failed)
            .then_some(found)
    }

    fn follow<'p>(
        &self,
        piece: usize,
        at: usize,
        path: &'p str,
        found: &mut Vec<&'p str>,
        failed: &mut Vec<Vec<bool>>,
    ) -> bool {
        if failed[piece][at] {
            return false;
        }
        let rest = &path[at..];
        let matches = match self.pieces.get(piece) {
            None => rest.is_empty(),
            Some(Piece::Text(text)) => {
                rest.starts_with(text.as_str())
                    && self.follow(piece + 1, at + text.len(), path, &mut *found, &mut *failed)
            }
            Some(Piece::Named { kind, .. }) => kind.lengths(rest).into_iter().any(|length| {
                found.push(&rest[..length]);
                let matches = self.follow(piece + 1, at + length, path, &mut *found, &mut *failed);
                if !matches {
                    found.pop();
                }
                matches
            }),
        };
        failed[piece][at] = !matches;
        matches
    }
}

impl Kind {
    /// Possible lengths of a part at the beginning of `text`, longest first.
    fn lengths(self, text: &str) -> Vec<usize> {
        if self == Kind::Folders {
            let ends = text.match_indices('/').map(|(at, _)| at + 1);
            return ends.rev().chain([0]).collect();
        }
        let end = text.find('/').unwrap_or(text.len());
        let part = &text[..end];
        let ends = part
            .char_indices()
            .map(|(at, letter)| at + letter.len_utf8());
        let mut lengths: Vec<usize> = ends.collect();
        match self {
            Kind::Free | Kind::Folders => {}
            Kind::Digits => {
                let digits = part.bytes().take_while(u8::is_ascii_digit).count();
                lengths.retain(|length| *length <= digits);
            }
            Kind::Number => lengths.retain(|length| is_number(&part[..*length])),
        }
        lengths.reverse();
        lengths
    }
}

/// True for a decimal number; false for `inf` and `NaN`.
fn is_number(text: &str) -> bool {
    let is_plain = |letter: u8| letter.is_ascii_digit() || b"+-.eE".contains(&letter);
    text.bytes().all(is_plain)
        && text.ends_with(|last: char| last.is_ascii_digit())
        && text.parse::<f64>().is_ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn captured(pattern: &str, path: &str) -> Option<Vec<String>> {
        let pattern = PathPattern::parse(pattern, None).expect("a pattern");
        let found = pattern.captures(path)?;
        Some(found.into_iter().map(str::to_owned).collect())
    }

    #[test]
    fn parts_of_a_path_are_captured_by_their_kind() {
        let pattern =
            "{object}/unit{unit:digits}/x{x:number}_y{y:number}_Fz{fz:number}N_{k:digits}.png";
        let found = captured(pattern, "ball/unit1/x+2.5_y-0.0_Fz3.004N_005.png");
        assert_eq!(
            found.expect("it follows"),
            ["ball", "1", "+2.5", "-0.0", "3.004", "005"]
        );
        assert_eq!(captured(pattern, "ball/unitA/x1_y1_Fz1N_1.png"), None);
        // A free part is the longest that fits.
        let found = captured("{object}_{repeat:digits}.avi", "two_words_12.avi");
        assert_eq!(found.expect("it follows"), ["two_words", "12"]);
        assert_eq!(captured("{a}.png", "b/c.png"), None);
        let pattern = "{before:folders}{gel}/images/{name}";
        let found = captured(pattern, "/data/set/clear/images/1.png");
        assert_eq!(found.expect("it follows"), ["/data/set/", "clear", "1.png"]);
        let found = captured(pattern, "clear/images/1.png");
        assert_eq!(found.expect("it follows"), ["", "clear", "1.png"]);
        let found = captured("{a}/{b}", "Größe/世界");
        assert_eq!(found.expect("it follows"), ["Größe", "世界"]);
    }

    #[test]
    fn a_pattern_that_could_be_tried_for_ever_is_tried_once_a_place() {
        let pattern: String = (0..16).map(|at| format!("{{n{at}}}-")).collect();
        assert_eq!(captured(&pattern, &"-a".repeat(2_000)), None);
    }

    #[test]
    fn what_is_no_pattern_says_why() {
        for (pattern, expected) in [
            ("{a", "never closed"),
            ("{a:hex}", "`:hex` is not a kind"),
            ("{1a}", "not a valid name"),
            ("{a}{a}", "twice"),
            ("plain", "names no part"),
        ] {
            let problem = PathPattern::parse(pattern, None).expect_err(pattern);
            assert!(problem.contains(expected), "{problem}");
        }
    }
}
