//! Cells of a table.

use super::Words;
use super::latex::number;
use crate::escape;
use crate::number::FormattedValue;

/// Cell of a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Cell {
    /// Text, even if it looks like a number.
    Text(Words),
    /// Number, formatted as text.
    Number(String),
    /// Number that is rounded for readers.
    Rounded {
        /// Text for readers.
        shown: String,
        /// Shortest round-trip form, for programs.
        exact: String,
    },
    /// Value with its interval.
    Estimate(Estimate),
    /// Result of a limit; true if it is met.
    Verdict(bool),
}

/// Value with its interval and a remark.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Estimate {
    /// Value and interval, or the reason why they are absent.
    pub formatted: FormattedValue,
    /// Unit of the cell; empty for a ratio, or if row or column state the unit.
    pub unit: String,
    /// Remark for readers, if any.
    pub remark: Option<String>,
    /// Sign after the value, explained by a note; empty without a sign.
    pub mark: &'static str,
    /// True if the value is significantly better than all other cells of the row.
    pub is_best: bool,
}

impl Cell {
    /// Cell of text, even if it looks like a number.
    pub fn text(words: impl Into<Words>) -> Cell {
        Cell::Text(words.into())
    }

    /// Cell of a number in shortest round-trip form; empty without a number.
    pub fn exact(value: Option<f64>) -> Cell {
        Cell::Number(value.map_or_else(String::new, |value| format!("{value:?}")))
    }

    /// Cell of a p value; a dash without a value.
    pub(crate) fn p_value(p: Option<f64>) -> Cell {
        match p {
            Some(p) => Cell::Rounded {
                shown: taceva_metrics::p_value(p),
                exact: format!("{p:?}"),
            },
            None => Cell::from("–"),
        }
    }

    /// Cell of a value with its interval; a dash without a value.
    pub(crate) fn estimate(value: Option<f64>, ends: Option<[f64; 2]>) -> Cell {
        let formatted = match value {
            Some(value) => FormattedValue::number(value, ends),
            None => FormattedValue {
                reason: Some("–".to_owned()),
                ..FormattedValue::default()
            },
        };
        Cell::Estimate(Estimate {
            formatted,
            ..Estimate::default()
        })
    }

    /// Text without markup.
    pub fn plain(&self) -> String {
        match self {
            Cell::Text(words) => words.plain().to_owned(),
            Cell::Number(text) | Cell::Rounded { shown: text, .. } => text.clone(),
            Cell::Estimate(estimate) => estimate.plain(),
            Cell::Verdict(true) => "pass".to_owned(),
            Cell::Verdict(false) => "FAIL".to_owned(),
        }
    }

    /// Text of the cell for the renderers.
    pub(super) fn words(&self) -> Words {
        match self {
            Cell::Text(words) => words.clone(),
            Cell::Estimate(estimate) => Words::new(estimate.plain())
                .markdown(estimate.in_markdown())
                .latex(estimate.in_latex()),
            Cell::Number(_) | Cell::Rounded { .. } | Cell::Verdict(_) => Words::new(self.plain()),
        }
    }

    /// Second line of the cell in LaTeX, in small letters; `None` for cells of one line.
    pub(super) fn latex_below(&self) -> Option<String> {
        match self {
            Cell::Estimate(estimate) => Some(estimate.latex_below()),
            _ => None,
        }
    }

    /// Exact number behind a rounded number, for programs and for sorting on a page; `None` for other cells.
    pub(super) fn exact_text(&self) -> Option<&str> {
        match self {
            Cell::Rounded { exact, .. } => Some(exact),
            _ => None,
        }
    }

    pub(super) fn is_number(&self) -> bool {
        matches!(self, Cell::Number(_) | Cell::Rounded { .. })
    }

    /// True for an empty cell.
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
        match self.mark {
            "" => self.with_remark(self.formatted.phrase(&unit)),
            mark => self.with_remark(self.formatted.phrase(&format!("{mark}{unit}"))),
        }
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
        let value = format!("{value}{}", self.mark);
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
        let value = format!("{value}{}", escape::latex(self.mark));
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

/// Converts numeric text to a number, and other text to words.
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
