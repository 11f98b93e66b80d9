//! Errors in a budget file, with line, key, value found and value expected.

use std::fmt;

use super::expression::ExpressionError;

/// Reason for rejecting a budget file.
///
/// ```
/// use taceva_metrology::budget::BudgetText;
/// let error = BudgetText::parse("budget_version = 2\nmeasurand = \"Fz\"").unwrap_err();
/// assert_eq!(error.to_string(), "line 1, `budget_version`: `2` is found, expected 1");
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct BudgetError {
    /// Line, from 1; `None` if no single line is at fault.
    pub line: Option<usize>,
    /// Key or table at fault; `None` if no single key is at fault.
    pub key: Option<String>,
    /// Problem found.
    pub problem: Box<BudgetProblem>,
}

impl BudgetError {
    pub(super) fn new(
        line: impl Into<Option<usize>>,
        key: &str,
        problem: BudgetProblem,
    ) -> BudgetError {
        BudgetError {
            line: line.into(),
            key: (!key.is_empty()).then(|| key.to_owned()),
            problem: Box::new(problem),
        }
    }
}

impl fmt::Display for BudgetError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(line) = self.line {
            write!(f, "line {line}")?;
        }
        if let Some(key) = &self.key {
            let separator = if self.line.is_some() { ", " } else { "" };
            write!(f, "{separator}`{}`", taceva_core::shown(key))?;
        }
        let separator = if self.line.is_some() || self.key.is_some() {
            ": "
        } else {
            ""
        };
        write!(f, "{separator}{}", self.problem)
    }
}

impl std::error::Error for BudgetError {}

/// Problem in a budget file.
///
/// ```
/// use taceva_metrology::budget::BudgetProblem;
/// let problem = BudgetProblem::Keys("the key `at` is missing".to_owned());
/// assert_eq!(problem.to_string(), "the key `at` is missing");
/// ```
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BudgetProblem {
    /// Invalid TOML, an unknown key, or a value of the wrong type.
    #[error("{0}")]
    Syntax(String),
    /// A number outside its range, or an amount that cannot be parsed.
    #[error("`{found}` is found, expected {expected}")]
    Value {
        /// Text as found.
        found: String,
        /// Accepted values.
        expected: String,
    },
    /// A key that requires or excludes another key.
    #[error("{0}")]
    Keys(String),
    /// An unknown name.
    #[error("`{name}` is not a {kind}; {suggestion}")]
    UnknownName {
        /// Name as written.
        name: String,
        /// Kind of the unknown name, for the message.
        kind: &'static str,
        /// Nearest known name, or all known names.
        suggestion: String,
    },
    /// A measured figure without a value.
    #[error("`{name}` is not measured here: {reason}")]
    NotMeasured {
        /// Name of the figure.
        name: String,
        /// Reason for the missing value.
        reason: String,
    },
    /// Two sources with the same name, or with the same figure.
    #[error("`{name}` is used twice, here and in line {other}")]
    Twice {
        /// Name of the source or figure.
        name: String,
        /// Line of the first source.
        other: usize,
    },
    /// A source whose effect another source already includes.
    #[error("`{inner}` is inside `{outer}` (line {line}); remove one of them")]
    Inside {
        /// Included figure.
        inner: String,
        /// Figure that includes `inner`.
        outer: String,
        /// Line of `outer`.
        line: usize,
    },
    /// Contradicting correlations: the correlation matrix has a negative eigenvalue.
    #[error(
        "the correlations contradict each other: the least eigenvalue of their matrix is {eigenvalue:.3e}, expected 0 or more"
    )]
    NotPositive {
        /// Least eigenvalue.
        eigenvalue: f64,
    },
    /// An expression with a syntax error or without a value.
    #[error("{0}")]
    Expression(ExpressionError),
    /// A certificate that does not apply to the instrument or the value.
    #[error("{0}")]
    Certificate(String),
}
