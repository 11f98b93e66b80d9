//! Which models were tried, with which error, and why one was chosen.

use std::fmt;

use serde::{Deserialize, Serialize};

/// How a model was chosen among others.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AutoCard {
    /// The work that could be spent, in seconds of a core that does a thousand million multiplications each second.
    pub budget_s: f64,
    /// How many folds each model was tried on.
    pub folds: usize,
    /// Whether folds are whole groups of samples; runs of neighbours if not.
    pub by_group: bool,
    /// The models that were tried, in order.
    pub tried: Vec<AutoTrial>,
    /// The models that were not.
    pub untried: Vec<Untried>,
}

/// A model that was tried.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AutoTrial {
    /// Its name.
    pub model: String,
    /// Root mean square error on folds left out, relative to the deviation of the labels, mean over the channels that vary.
    pub error: f64,
    /// The work of trying it, in the seconds of the budget.
    pub cost_s: f64,
}

/// A model that was not tried.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Untried {
    /// Its name.
    pub model: String,
    /// The work of trying it, in the seconds of the budget.
    pub cost_s: f64,
    /// Why not.
    pub reason: String,
}

impl AutoCard {
    /// The one of least error; of equals the first that was tried.
    pub fn best(&self) -> Option<&AutoTrial> {
        let trials = self.tried.iter();
        trials.reduce(|best, next| if next.error < best.error { next } else { best })
    }
}

impl fmt::Display for AutoCard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(best) = self.best() else {
            return f.write_str("auto tried no model");
        };
        let folds = if self.by_group {
            "folds of whole groups"
        } else {
            "folds of neighbouring samples"
        };
        write!(
            f,
            "auto took {}: error {:.3} of the deviation of labels on {} {folds}",
            best.model, best.error, self.folds
        )?;
        let mut others: Vec<&AutoTrial> =
            self.tried.iter().filter(|trial| *trial != best).collect();
        others.sort_by(|left, right| left.error.total_cmp(&right.error));
        for (position, other) in others.iter().enumerate() {
            let before = if position == 0 { "; " } else { ", " };
            write!(f, "{before}{} {:.3}", other.model, other.error)?;
        }
        for (position, other) in self.untried.iter().enumerate() {
            let before = if position == 0 { "; not tried: " } else { ", " };
            write!(f, "{before}{} ({})", other.model, other.reason)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_card_says_what_was_taken_and_why() {
        let trial = |model: &str, error| AutoTrial {
            model: model.to_owned(),
            error,
            cost_s: 1.0,
        };
        let card = AutoCard {
            budget_s: 60.0,
            folds: 5,
            by_group: true,
            tried: vec![
                trial("baseline", 1.01),
                trial("ridge", 0.25),
                trial("knn", 0.5),
            ],
            untried: vec![Untried {
                model: "cnn".to_owned(),
                cost_s: 90.0,
                reason: "beyond the budget".to_owned(),
            }],
        };
        assert_eq!(
            card.to_string(),
            "auto took ridge: error 0.250 of the deviation of labels on 5 folds of whole groups; \
             knn 0.500, baseline 1.010; not tried: cnn (beyond the budget)"
        );
    }
}
