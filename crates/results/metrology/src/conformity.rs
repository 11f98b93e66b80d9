//! Conformity with a limit: probability, guard bands, decision rules and global risks.
//!
//! ```
//! use taceva_metrology::conformity::{DecisionRule, Limits, Measurement, Word, decide};
//! // 0.045 N with a standard uncertainty of 0.004 N from 9 degrees of freedom, against at most 0.050 N.
//! let measured = Measurement::new(0.045, 0.004, 9.0)?;
//! let limits = Limits::at_most(0.050)?;
//! let rule = DecisionRule::Guarded { r: 1.0, coverage: 0.95 };
//! let decision = decide(&measured, &limits, &rule)?;
//! let p = decision.conformance_probability.ok_or("an uncertainty")?;
//! assert!((p - 0.8786).abs() < 5e-5);
//! assert_eq!(decision.word, Word::ConditionalPass);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Reference
//! JCGM 106:2012, Evaluation of measurement data — The role of measurement uncertainty in conformity assessment; ILAC-G8:09/2019.

mod decision;
mod error;
mod limits;
mod measurement;
mod population;
mod risk;
mod rule;
mod scale;

pub use decision::{Decision, Word, decide};
pub use error::ConformityError;
pub use limits::Limits;
pub use measurement::Measurement;
pub use population::Population;
pub use risk::{GlobalRisk, Process};
pub use rule::{DecisionRule, RuleSettings};
