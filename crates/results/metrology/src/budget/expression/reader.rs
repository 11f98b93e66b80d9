//! Parser of expressions, from text to steps of a stack machine with columns.

use taceva_core::{shown, suggestion};

use super::{ExpressionError, Function, Step};

/// Greatest number of nested brackets, powers and signs.
const DEEPEST: usize = 100;

const FUNCTIONS: [(&str, Function); 6] = [
    ("sqrt", Function::Sqrt),
    ("sin", Function::Sin),
    ("cos", Function::Cos),
    ("tan", Function::Tan),
    ("exp", Function::Exp),
    ("ln", Function::Ln),
];

pub(super) fn read(text: &str, names: &[&str]) -> Result<Vec<(Step, usize)>, ExpressionError> {
    let mut reader = Reader {
        letters: text.chars().collect(),
        at: 0,
        depth: 0,
        names,
        steps: Vec::new(),
    };
    reader.sum()?;
    match reader.peek() {
        None => Ok(reader.steps),
        Some(letter) => Err(reader.error(format!(
            "`{}` is found, expected an operator",
            shown(&letter.to_string())
        ))),
    }
}

struct Reader<'a> {
    letters: Vec<char>,
    at: usize,
    depth: usize,
    names: &'a [&'a str],
    steps: Vec<(Step, usize)>,
}

impl Reader<'_> {
    /// Next character that is not blank; `None` at the end.
    fn peek(&mut self) -> Option<char> {
        while self
            .letters
            .get(self.at)
            .is_some_and(|letter| letter.is_whitespace())
        {
            self.at += 1;
        }
        self.letters.get(self.at).copied()
    }

    fn error(&self, problem: String) -> ExpressionError {
        ExpressionError {
            column: self.at + 1,
            problem,
        }
    }

    fn push(&mut self, step: Step, column: usize) {
        self.steps.push((step, column));
    }

    /// Parses a left-associative chain of operators with the same precedence.
    fn chain(
        &mut self,
        operators: [(char, Step); 2],
        operand: fn(&mut Self) -> Result<(), ExpressionError>,
    ) -> Result<(), ExpressionError> {
        operand(self)?;
        while let Some(letter) = self.peek() {
            let Some((_, step)) = operators.into_iter().find(|(sign, _)| *sign == letter) else {
                break;
            };
            let column = self.at + 1;
            self.at += 1;
            operand(self)?;
            self.push(step, column);
        }
        Ok(())
    }

    /// Counts one more level of nesting, for a bracket, a sign or a power.
    fn deepen(&mut self) -> Result<(), ExpressionError> {
        self.depth += 1;
        match self.depth > DEEPEST {
            true => Err(self.error(format!("nested deeper than {DEEPEST} levels"))),
            false => Ok(()),
        }
    }

    fn sum(&mut self) -> Result<(), ExpressionError> {
        self.deepen()?;
        self.chain([('+', Step::Add), ('-', Step::Subtract)], Self::product)?;
        self.depth -= 1;
        Ok(())
    }

    fn product(&mut self) -> Result<(), ExpressionError> {
        self.chain([('*', Step::Multiply), ('/', Step::Divide)], Self::signed)
    }

    /// Parses a sign. A sign has lower precedence than a power: -x^2 is -(x^2).
    fn signed(&mut self) -> Result<(), ExpressionError> {
        self.deepen()?;
        match self.peek() {
            Some(sign @ ('-' | '+')) => {
                let column = self.at + 1;
                self.at += 1;
                self.signed()?;
                if sign == '-' {
                    self.push(Step::Negate, column);
                }
            }
            _ => self.power()?,
        }
        self.depth -= 1;
        Ok(())
    }

    fn power(&mut self) -> Result<(), ExpressionError> {
        self.atom()?;
        if self.peek() == Some('^') {
            let column = self.at + 1;
            self.at += 1;
            self.signed()?;
            self.push(Step::Power, column);
        }
        Ok(())
    }

    fn atom(&mut self) -> Result<(), ExpressionError> {
        let start = self.at_next();
        match self.peek() {
            Some('(') => self.bracket(),
            Some('\'') => self.quoted(start),
            Some(letter) if letter.is_ascii_digit() || letter == '.' => self.number(start),
            Some(letter) if letter.is_alphabetic() || letter == '_' => self.word(start),
            other => {
                let quoted = |letter: char| format!("`{}`", shown(&letter.to_string()));
                let found = other.map_or("the end".to_owned(), quoted);
                Err(self.error(format!(
                    "{found} is found, expected a number, a name or `(`"
                )))
            }
        }
    }

    /// Position of the next character that is not blank.
    fn at_next(&mut self) -> usize {
        self.peek();
        self.at
    }

    fn bracket(&mut self) -> Result<(), ExpressionError> {
        if self.peek() != Some('(') {
            return Err(self.error("expected `(` behind the name of a function".to_owned()));
        }
        self.at += 1;
        self.sum()?;
        if self.peek() != Some(')') {
            return Err(self.error("expected `)`".to_owned()));
        }
        self.at += 1;
        Ok(())
    }

    fn quoted(&mut self, start: usize) -> Result<(), ExpressionError> {
        let rest = &self.letters[start + 1..];
        let Some(length) = rest.iter().position(|letter| *letter == '\'') else {
            return Err(self.error("the name has no closing `'`".to_owned()));
        };
        let name: String = rest[..length].iter().collect();
        self.at = start + length + 2;
        self.name(&name, start)
    }

    fn number(&mut self, start: usize) -> Result<(), ExpressionError> {
        let is_part = |at: usize| {
            let letter = self.letters[at];
            let is_sign = matches!(letter, '+' | '-') && matches!(self.letters[at - 1], 'e' | 'E');
            letter.is_ascii_digit() || matches!(letter, '.' | 'e' | 'E') || (at > start && is_sign)
        };
        let end = (start..self.letters.len()).find(|at| !is_part(*at));
        let end = end.unwrap_or(self.letters.len());
        let text: String = self.letters[start..end].iter().collect();
        let value = text.parse::<f64>().ok().filter(|value| value.is_finite());
        let Some(value) = value else {
            return Err(self.error(format!("`{text}` is not a number")));
        };
        self.at = end;
        self.push(Step::Number(value), start + 1);
        Ok(())
    }

    fn word(&mut self, start: usize) -> Result<(), ExpressionError> {
        let is_part = |letter: &char| letter.is_alphanumeric() || *letter == '_';
        let rest = self.letters[start..].iter();
        let name: String = rest.take_while(|letter| is_part(letter)).collect();
        self.at += name.chars().count();
        let function = FUNCTIONS.into_iter().find(|(known, _)| *known == name);
        match function {
            Some((_, function)) if !self.names.contains(&name.as_str()) => {
                self.bracket()?;
                self.push(Step::Call(function), start + 1);
                Ok(())
            }
            _ => self.name(&name, start),
        }
    }

    fn name(&mut self, name: &str, start: usize) -> Result<(), ExpressionError> {
        let Some(index) = self.names.iter().position(|known| *known == name) else {
            self.at = start;
            let (name, hint) = (shown(name), suggestion(name, self.names));
            return Err(self.error(format!("`{name}` is not a source; {hint}")));
        };
        self.push(Step::Input(index), start + 1);
        Ok(())
    }
}
