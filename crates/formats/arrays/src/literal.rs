//! Python literals, as in NumPy headers: texts, whole numbers, true and false, tuples, lists, dictionaries.

use crate::error::Problem;
use crate::limits;
use crate::scalar::shown;

#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Literal {
    Text(String),
    Whole(u64),
    Bool(bool),
    /// A tuple or a list.
    Sequence(Vec<Literal>),
    Dictionary(Vec<(String, Literal)>),
}

impl Literal {
    /// Parses `text`, which begins at byte `at` of the file.
    pub(crate) fn parse(text: &str, at: u64) -> Result<Literal, Problem> {
        let mut reader = Reader { text, at, place: 0 };
        let literal = reader.value(0)?;
        reader.blank();
        if reader.place < text.len() {
            return Err(reader.expected("the end of the header"));
        }
        Ok(literal)
    }

    /// Value of `key` in a dictionary; `None` if the key is missing.
    pub(crate) fn key(&self, key: &str) -> Option<&Literal> {
        let Literal::Dictionary(entries) = self else {
            return None;
        };
        let found = entries.iter().find(|(name, _)| name == key);
        found.map(|(_, literal)| literal)
    }

    /// Lengths of axes, from one number or several numbers; `None` for other literals.
    pub(crate) fn shape(&self) -> Option<Vec<u64>> {
        match self {
            Literal::Whole(side) => Some(vec![*side]),
            Literal::Sequence(sides) if sides.len() <= limits::AXES => {
                let side = |literal: &Literal| match literal {
                    Literal::Whole(side) => Some(*side),
                    _ => None,
                };
                sides.iter().map(side).collect()
            }
            _ => None,
        }
    }
}

struct Reader<'a> {
    text: &'a str,
    at: u64,
    place: usize,
}

impl Reader<'_> {
    fn rest(&self) -> &str {
        &self.text[self.place..]
    }

    fn blank(&mut self) {
        self.place += self.rest().len() - self.rest().trim_start().len();
    }

    /// Skips `mark` if the remaining text begins with it. Returns true if `mark` was skipped.
    fn skips(&mut self, mark: &str) -> bool {
        self.blank();
        let is_here = self.rest().starts_with(mark);
        if is_here {
            self.place += mark.len();
        }
        is_here
    }

    fn expected(&self, what: &str) -> Problem {
        let found = self.rest().split_whitespace().next();
        let found = found.map_or("the end of the header".to_owned(), |word| {
            format!("`{}`", shown(word))
        });
        Problem::damaged(self.at + self.place as u64, found, what)
    }

    fn value(&mut self, depth: usize) -> Result<Literal, Problem> {
        if depth > limits::LITERAL_DEPTH {
            return Err(self.expected("less nesting"));
        }
        for (open, close) in [("(", ")"), ("[", "]")] {
            if self.skips(open) {
                let mut all = Vec::new();
                while !self.skips(close) {
                    all.push(self.value(depth + 1)?);
                    if !self.skips(",") && !self.skips(close) {
                        return Err(self.expected("`,` or the end of the list"));
                    } else if self.text[..self.place].ends_with(close) {
                        break;
                    }
                }
                return Ok(Literal::Sequence(all));
            }
        }
        if self.skips("{") {
            return self.dictionary(depth);
        }
        if self.skips("True") {
            return Ok(Literal::Bool(true));
        }
        if self.skips("False") {
            return Ok(Literal::Bool(false));
        }
        if self.rest().starts_with(['\'', '"']) {
            return self.string().map(Literal::Text);
        }
        let digits = self.rest().bytes().take_while(u8::is_ascii_digit).count();
        let number = self.rest()[..digits].parse().ok();
        let number = number
            .ok_or_else(|| self.expected("a string, a whole number, a list or a dictionary"))?;
        self.place += digits;
        // Python 2 appended an `L` to long numbers.
        if self.rest().starts_with('L') {
            self.place += 1;
        }
        Ok(Literal::Whole(number))
    }

    fn dictionary(&mut self, depth: usize) -> Result<Literal, Problem> {
        let mut entries = Vec::new();
        while !self.skips("}") {
            self.blank();
            let key = self.string()?;
            if !self.skips(":") {
                return Err(self.expected("`:`"));
            }
            entries.push((key, self.value(depth + 1)?));
            if self.skips("}") {
                break;
            }
            if !self.skips(",") {
                return Err(self.expected("`,` or `}`"));
            }
        }
        Ok(Literal::Dictionary(entries))
    }

    fn string(&mut self) -> Result<String, Problem> {
        let quote = self
            .rest()
            .chars()
            .next()
            .filter(|letter| ['\'', '"'].contains(letter));
        let quote = quote.ok_or_else(|| self.expected("a string in quotes"))?;
        let mut text = String::new();
        let mut letters = self.rest().char_indices().skip(1);
        while let Some((at, letter)) = letters.next() {
            match letter {
                letter if letter == quote => {
                    self.place += at + 1;
                    return Ok(text);
                }
                '\\' => match letters.next() {
                    Some((_, escaped @ ('\\' | '\'' | '"'))) => text.push(escaped),
                    _ => return Err(self.expected("a string without escapes")),
                },
                letter => text.push(letter),
            }
        }
        Err(self.expected("a string with a closing quote"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headers_are_read_whatever_the_order_of_their_keys() {
        let text = "{'shape': (3, 4,), \"descr\": [('a\\'b', '<f4', (6,)), ('c', '|u1')], 'fortran_order': False}  \n";
        let literal = Literal::parse(text, 0).expect("a header");
        assert_eq!(
            literal.key("shape").and_then(Literal::shape),
            Some(vec![3, 4])
        );
        assert_eq!(literal.key("fortran_order"), Some(&Literal::Bool(false)));
        let Some(Literal::Sequence(fields)) = literal.key("descr") else {
            panic!("{literal:?}")
        };
        assert_eq!(fields.len(), 2);
        assert_eq!(
            Literal::parse("()", 0).expect("empty").shape(),
            Some(Vec::new())
        );
        assert_eq!(
            Literal::parse("(24L,)", 0).expect("Python 2").shape(),
            Some(vec![24])
        );
    }

    #[test]
    fn what_is_no_literal_is_named_with_its_place() {
        for (text, expected) in [
            ("{'a': os.system}", "byte 16: `os.system}`"),
            ("{'a': 1", "the end of the header"),
            ("(1 2)", "byte 13: `2)`"),
            ("'x", "a string with a closing quote"),
            ("1 2", "expected the end of the header"),
            ("99999999999999999999", "expected a string"),
            ("-1", "`-1`"),
        ] {
            let message = Literal::parse(text, 10).expect_err(text).to_string();
            assert!(message.contains(expected), "{message}");
        }
        let deep = "(".repeat(1_000_000);
        assert!(Literal::parse(&deep, 0).is_err());
    }
}
