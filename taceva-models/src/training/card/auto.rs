//! Record of the automatic choice among models: their trials, errors and reasons for rejection.

use std::fmt;

use serde::{Deserialize, Serialize};

/// Number of folds into which an automatic choice divides the training part.
pub(crate) const FOLDS: usize = 5;

/// Record of the automatic choice among models.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AutoCard {
    /// Limit of the estimated work, in seconds. One second is the time in which a core computes 10⁹ multiplications.
    pub budget_s: f64,
    /// Number of folds of the training part; 0 for a classifier, which was chosen by its errors on the validation part.
    pub folds: usize,
    /// True if folds consist of whole groups of samples. False if they consist of runs of neighbouring samples, or for a classifier.
    pub by_group: bool,
    /// Trials of models. A network has two trials if its shortened training was too close to the other models to decide.
    pub tried: Vec<AutoTrial>,
    /// Models that were not tried.
    pub untried: Vec<Untried>,
    /// Name of the chosen model.
    pub taken: String,
}

/// Trial of one model in an automatic choice.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AutoTrial {
    /// Name of the model.
    pub model: String,
    /// Root mean square error relative to the standard deviation of the labels, over the completed folds. Channels with a constant label do not
    /// count. For a classifier, the share of wrong samples of each class, averaged over classes.
    pub error: f64,
    /// Estimated work of the trial, in seconds as for the budget; 0 for a classifier.
    pub cost_s: f64,
    /// Number of folds completed in the trial, from the first fold on; 1 for a classifier.
    pub folds: usize,
    /// Share of the epochs in a shortened training of a network; `None` for a complete training.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub share: Option<f64>,
    /// Reason why the model was rejected; `None` if it was compared until the end.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub left: Option<String>,
}

/// Model that was not tried in an automatic choice.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Untried {
    /// Name of the model.
    pub model: String,
    /// Estimated work of a trial on one fold, in seconds as for the budget; 0 for a classifier.
    pub cost_s: f64,
    /// Reason why the model was not tried.
    pub reason: String,
}

impl AutoCard {
    /// Last trial of the chosen model; `None` if the record contains no such trial.
    pub fn best(&self) -> Option<&AutoTrial> {
        let mut trials = self.tried.iter();
        trials.rfind(|trial| trial.model == self.taken)
    }

    fn write_untried(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (position, other) in self.untried.iter().enumerate() {
            let before = if position == 0 { "; not tried: " } else { ", " };
            write!(f, "{before}{} ({})", other.model, other.reason)?;
        }
        Ok(())
    }
}

impl fmt::Display for AutoTrial {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {:.3} on {}", self.model, self.error, self.folds)?;
        if let Some(share) = self.share {
            write!(f, ", {:.0} % of its training", 100.0 * share)?;
        }
        match &self.left {
            Some(left) => write!(f, " ({left})"),
            None => Ok(()),
        }
    }
}

impl fmt::Display for AutoCard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(best) = self.best() else {
            return f.write_str("auto tried no model");
        };
        if self.folds == 0 {
            write!(
                f,
                "auto chose {} by the validation part; share of wrong samples, averaged over classes:",
                best.model
            )?;
            for (position, trial) in self.tried.iter().enumerate() {
                let before = if position == 0 { " " } else { "; " };
                write!(f, "{before}{} {:.3}", trial.model, trial.error)?;
            }
            return self.write_untried(f);
        }
        let folds = if self.by_group {
            "folds of whole groups"
        } else {
            "folds of neighbouring samples"
        };
        write!(
            f,
            "auto chose {}; error relative to the standard deviation of labels, and number of folds used (of {} {folds}): {best}",
            best.model, self.folds
        )?;
        let others = self
            .tried
            .iter()
            .filter(|trial| !std::ptr::eq(*trial, best));
        let mut others: Vec<&AutoTrial> = others.collect();
        others.sort_by(|left, right| left.error.total_cmp(&right.error));
        for other in others {
            write!(f, "; {other}")?;
        }
        let spent: f64 = self.tried.iter().map(|trial| trial.cost_s).sum();
        write!(
            f,
            "; trials took {spent:.1} s of work of a budget of {} s",
            self.budget_s
        )?;
        self.write_untried(f)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn card() -> AutoCard {
        let trial = |model: &str, error, folds| AutoTrial {
            model: model.to_owned(),
            error,
            cost_s: 1.0,
            folds,
            share: None,
            left: None,
        };
        AutoCard {
            budget_s: 60.0,
            folds: 5,
            by_group: true,
            tried: vec![
                trial("baseline", 1.01, 5),
                trial("ridge", 0.25, 5),
                AutoTrial {
                    share: Some(0.25),
                    left: Some("why".to_owned()),
                    ..trial("knn", 0.2, 1)
                },
            ],
            untried: vec![Untried {
                model: "cnn".to_owned(),
                cost_s: 90.0,
                reason: "too dear".to_owned(),
            }],
            taken: "ridge".to_owned(),
        }
    }

    #[test]
    fn a_card_says_what_was_taken_and_why() {
        assert_eq!(
            card().to_string(),
            "auto chose ridge; error relative to the standard deviation of labels, and number of folds used (of 5 folds of whole groups): ridge \
             0.250 on 5; knn 0.200 on 1, 25 % of its training (why); baseline 1.010 on 5; trials took 3.0 s of work of a budget of 60 s; not tried: cnn (too dear)"
        );
    }
}
