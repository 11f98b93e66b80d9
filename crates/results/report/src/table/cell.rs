//! What stands in a cell of a table.

use super::Words;
use super::latex::number;
use crate::escape;
use crate::number::FormattedValue;

/// A cell of a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Cell {
    /// Words, however much they look like a number.
    Text(Words),
    /// A number as it is printed.
    Number(String),
    /// A value with its interval.
    Estimate(Estimate),
    /// Whether a limit is kept.
    Verdict(bool),
}

/// A value with its interval and what must be known of it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Estimate {
    /// Value and interval, or why there is none.
    pub formatted: FormattedValue,
    /// The unit of this cell; empty where the table says it elsewhere or there is none.
    pub unit: String,
    /// What a reader must know of it.
    pub remark: Option<String>,
    /// Whether it is shown to be better than all others of its row.
    pub is_best: bool,
}

impl Cell {
    /// Words, even if they look like a number.
    pub fn text(words: impl Into<Words>) -> Cell {
        Cell::Text(words.into())
    }

    /// What it says, without markup.
    pub fn plain(&self) -> String {
        match self {
            Cell::Text(words) => words.plain().to_owned(),
            Cell::Number(text) => text.clone(),
            Cell::Estimate(estimate) => estimate.plain(),
            Cell::Verdict(true) => "pass".to_owned(),
            Cell::Verdict(false) => "FAIL".to_owned(),
        }
    }

    /// The same, as each format writes it.
    pub(super) fn words(&self) -> Words {
        match self {
            Cell::Text(words) => words.clone(),
            Cell::Estimate(estimate) => Words::new(estimate.plain())
                .markdown(estimate.in_markdown())
                .latex(estimate.in_latex()),
            Cell::Number(_) | Cell::Verdict(_) => Words::new(self.plain()),
        }
    }

    /// What LaTeX sets below it in small letters.
    pub(super) fn latex_below(&self) -> Option<String> {
        match self {
            Cell::Estimate(estimate) => Some(estimate.latex_below()),
            _ => None,
        }
    }

    pub(super) fn is_number(&self) -> bool {
        matches!(self, Cell::Number(_))
    }

    /// Whether it says nothing.
    pub(super) fn is_blank(&self) -> bool {
        matches!(self.plain().as_str(), "" | "–")
    }
}

impl Estimate {
    fn plain(&self) -> String {
        let unit = match self.unit.as_str() {
            "" => String::new(),
            unit => format!(" {unit}"),
        };
        self.with_remark(self.formatted.phrase(&unit))
    }

    fn in_markdown(&self) -> String {
        let FormattedValue {
            value,
            interval,
            reason,
        } = &self.formatted;
        if value.is_empty() {
            return escape::markdown(reason.as_deref().unwrap_or("–"));
        }
        let value = match self.is_best {
            true => format!("**{value}**"),
            false => value.clone(),
        };
        let value = match interval {
            Some([low, high]) => format!("{value} ({low} … {high})"),
            None => value,
        };
        let unit = match self.unit.as_str() {
            "" => String::new(),
            unit => format!(" {unit}"),
        };
        self.with_remark(format!("{value}{unit}"))
    }

    fn in_latex(&self) -> String {
        if self.formatted.value.is_empty() {
            return escape::latex(self.formatted.reason.as_deref().unwrap_or("–"));
        }
        let value = match self.is_best {
            true => format!("\\textbf{{{}}}", number(&self.formatted.value)),
            false => number(&self.formatted.value),
        };
        match self.unit.as_str() {
            "" => value,
            unit => format!("{value}\\,{}", escape::latex(unit)),
        }
    }

    fn latex_below(&self) -> String {
        let ends = self.formatted.interval.as_ref();
        let ends = ends.map(|[low, high]| format!("[{}, {}]", number(low), number(high)));
        let remark = self.remark.as_ref().map(|remark| escape::latex(remark));
        let parts: Vec<String> = ends.into_iter().chain(remark).collect();
        match parts.is_empty() {
            true => String::new(),
            false => format!("\\scriptsize {}", parts.join(", ")),
        }
    }

    fn with_remark(&self, value: String) -> String {
        match &self.remark {
            Some(remark) => format!("{value}, {remark}"),
            None => value,
        }
    }
}

/// A number where the text is one, else words.
impl From<String> for Cell {
    fn from(text: String) -> Cell {
        match text.replace('−', "-").parse::<f64>() {
            Ok(_) => Cell::Number(text),
            Err(_) => Cell::text(text),
        }
    }
}

impl From<&str> for Cell {
    fn from(text: &str) -> Cell {
        Cell::from(text.to_owned())
    }
}

impl From<Words> for Cell {
    fn from(words: Words) -> Cell {
        Cell::Text(words)
    }
}
