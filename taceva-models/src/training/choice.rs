//! Which settings were chosen, and by what.

use serde::{Deserialize, Serialize};
use taceva_core::{ModelError, Regressor, TrainingSet};

/// What a setting was chosen by.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ChosenBy {
    /// There is nothing to choose, or a person set it.
    Nobody,
    /// The least squared error on the validation part.
    Validation,
    /// The least squared error on groups left out one after the other.
    LeaveOneGroupOut,
    /// The likelihood of the labels that were learnt from.
    Likelihood,
    /// The least squared error on samples left out one after the other.
    LeaveOneOut,
    /// The least squared error on ten folds left out one after the other: whole groups, or runs of neighbouring samples.
    TenFolds,
}

/// The choice for every channel.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Choice {
    /// What it was chosen by.
    pub by: ChosenBy,
    /// The name of what was chosen: `strength`, `components`.
    pub setting: Option<String>,
    /// A choice a channel.
    pub channels: Vec<ChannelChoice>,
}

impl Choice {
    /// Nothing was chosen, and each channel has that error on the validation part, where there is one.
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

/// The choice for one channel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ChannelChoice {
    /// The value of the setting.
    pub value: Option<f64>,
    /// The root mean square error there, in the unit of the channel, on what the choice was made by or on the validation
    /// part; `None` if there was neither, or rounding left no number.
    pub rmse: Option<f64>,
    /// Whether the value is the first or the last that was tried: a better one may lie beyond.
    pub at_edge: bool,
}

/// The mean squared error of each channel (inner) at each candidate (outer).
pub(crate) type Errors = Vec<Vec<f64>>;

/// The candidate of least error for each channel; of equals, the one that `candidates` lists last: the plainer model.
pub(crate) fn least(errors: &Errors, channel: usize) -> usize {
    let mut best = errors.len().saturating_sub(1);
    for candidate in (0..best).rev() {
        if errors[candidate][channel] < errors[best][channel] {
            best = candidate;
        }
    }
    best
}

/// The error of each channel on the validation part.
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

/// The root of a mean squared error in the unit of a channel whose labels span `span`.
pub(crate) fn rmse(mean_squared: f64, span: f64) -> Option<f64> {
    let rmse = mean_squared.sqrt() * span;
    rmse.is_finite().then_some(rmse)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_equal_errors_the_plainest_model_wins() {
        let errors = vec![vec![2.0], vec![1.0], vec![1.0], vec![3.0]];
        assert_eq!(least(&errors, 0), 2);
    }
}
