//! Choice of a model setting: chosen value of each channel, and criterion.

use serde::{Deserialize, Serialize};
use taceva_core::{ModelError, Regressor, TrainingSet};

/// Criterion by which a setting was chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ChosenBy {
    /// No choice was made, because the model has no such setting or the user set it.
    Nobody,
    /// Least mean squared error on the validation part.
    Validation,
    /// Least mean squared error on groups of training samples, each held out once.
    LeaveOneGroupOut,
    /// Greatest likelihood of the training labels under the model.
    Likelihood,
    /// Least mean squared error on training samples, each held out once.
    LeaveOneOut,
    /// Least mean squared error on ten folds, each held out once. Folds consist of whole groups, or of runs of neighbouring samples.
    TenFolds,
}

/// Record of the choice of one setting, with a value for each channel.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Choice {
    /// Criterion of the choice.
    pub by: ChosenBy,
    /// Name of the chosen setting, such as `strength` or `components`; `None` without a choice.
    pub setting: Option<String>,
    /// Chosen value and error of each channel.
    pub channels: Vec<ChannelChoice>,
}

impl Choice {
    /// Record for a model without a choice. `errors` contains the root mean square validation error of each channel, if known.
    pub(crate) fn nobodys(errors: impl IntoIterator<Item = Option<f64>>) -> Choice {
        let scored = |rmse| ChannelChoice {
            rmse,
            ..ChannelChoice::default()
        };
        Choice {
            by: ChosenBy::Nobody,
            setting: None,
            channels: errors.into_iter().map(scored).collect(),
        }
    }
}

/// Chosen value of a setting for one channel, and its error.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ChannelChoice {
    /// Chosen value of the setting; `None` if no setting was chosen.
    pub value: Option<f64>,
    /// Root mean square error in the unit of the channel, over the held-out samples of the choice or else over the validation part. `None` without
    /// such samples, or if the error is not finite.
    pub rmse: Option<f64>,
    /// True if the first or last candidate value was chosen. A better value may then lie outside the range of candidates.
    pub at_edge: bool,
}

/// Mean squared errors, indexed by candidate value, then by channel.
pub(crate) type Errors = Vec<Vec<f64>>;

/// Index of the candidate with the least error for `channel`. Among equal errors, the last candidate wins, because it is the simplest.
pub(crate) fn least(errors: &Errors, channel: usize) -> usize {
    let mut best = errors.len().saturating_sub(1);
    for candidate in (0..best).rev() {
        if errors[candidate][channel] < errors[best][channel] {
            best = candidate;
        }
    }
    best
}

/// Root mean square error of each channel over the samples of `set`; `None` if it is not finite.
pub(crate) fn errors(
    regressor: &dyn Regressor,
    set: &TrainingSet<'_>,
) -> Result<Vec<Option<f64>>, ModelError> {
    let channels = set.targets.channels.len();
    let mut found = vec![0.0; set.targets.values.len()];
    regressor.predict(set.features, &mut found)?;
    let samples = set.features.samples() as f64;
    let of = |channel: usize| {
        let pairs = found
            .iter()
            .zip(set.targets.values)
            .skip(channel)
            .step_by(channels);
        let squares: f64 = pairs.map(|(found, label)| (found - label).powi(2)).sum();
        rmse(squares / samples, 1.0)
    };
    Ok((0..channels).map(of).collect())
}

/// Root mean square error in the unit of a channel with the label range `span`; `None` if it is not finite.
pub(crate) fn rmse(mean_squared: f64, span: f64) -> Option<f64> {
    let rmse = mean_squared.sqrt() * span;
    rmse.is_finite().then_some(rmse)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_equal_errors_the_simplest_model_wins() {
        let errors = vec![vec![2.0], vec![1.0], vec![1.0], vec![3.0]];
        assert_eq!(least(&errors, 0), 2);
    }
}
