//! Uncertainty budgets: parser of the sources, law of propagation, and a Monte Carlo check.
//!
//! [`BudgetText`] reads `budget.toml`; [`Evidence`] contains measured figures that sources use by name; [`Budget`] is the result.

mod amount;
mod assembly;
mod certificate;
mod certificate_text;
mod correlation;
mod digits;
mod dual;
mod error;
mod evidence;
mod expression;
mod freedom;
mod input;
mod monte_carlo;
mod overlap;
mod propagation;
mod report;
mod residuals;
mod schema;
mod shape;
mod source;
mod text;

pub use certificate::Certificate;
pub use digits::two_digits;
pub use error::{BudgetError, BudgetProblem};
pub use evidence::{Evidence, Figure};
pub use expression::{Expansion, Expression, ExpressionError};
pub use freedom::{Freedom, Undefined};
pub use monte_carlo::{MonteCarlo, MonteCarloResult};
pub use report::{BUDGET_SCHEMA, Budget, Correlation, Method, Missing, Source, Traceability};
pub use residuals::{Components, Residuals, TooFewRows};
pub use shape::Shape;
pub use text::BudgetText;
