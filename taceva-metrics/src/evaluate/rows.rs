//! Samples as columns of truth and prediction.

use taceva_core::{Batch, Channel, Channels, Column, Labels};

use crate::error::MetricError;
use crate::evaluate::number::Number;
use crate::evaluate::state::{describe, written};

/// Samples given channel by channel: truth, prediction, and optionally the contact point of each sample.
///
/// # Shapes
/// Every column and the contact points have the same length, the number of samples. Adding the rows checks these lengths.
/// # Units
/// Values are in the unit of their channel: mm for `Px Py Pz`, N for `Fx Fy Fz`.
///
/// ```
/// use taceva_metrics::{Channel, Evaluator, Rows};
/// let mut evaluator = Evaluator::of_channels([Channel::FX, Channel::FZ])?;
/// let rows = Rows::new()
///     .pairs(Channel::FX, &[0.0, 0.5], &[0.0_f32, 0.25])
///     .pairs(Channel::FZ, &[1.0, 2.0], (1..=2).map(f64::from))
///     .points(["left", "right"]);
/// evaluator.update_rows(rows)?;
/// assert_eq!(evaluator.score()?.mae(Channel::FX).and_then(|score| score.value.scalar()), Some(0.125));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Rows {
    columns: Vec<(Channel, Column, Column)>,
    points: Option<Labels>,
}

impl Rows {
    /// Rows without columns.
    ///
    /// ```
    /// use taceva_metrics::{Channel, Evaluator, Rows};
    /// Evaluator::of_channels([Channel::FZ])?.update_rows(Rows::new())?;
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn new() -> Rows {
        Rows::default()
    }

    /// Adds `truth` and `prediction` of `channel`, one number per sample, in the unit of the channel. Values are copied once.
    ///
    /// ```
    /// use taceva_metrics::{Channel, Rows};
    /// let truth = vec![Some(0.25), None];
    /// let rows = Rows::new().pairs(Channel::FZ, &truth, [0.5_f32, 0.5]);
    /// # drop(rows);
    /// ```
    #[must_use]
    pub fn pairs<T: Number, P: Number>(
        mut self,
        channel: Channel,
        truth: impl IntoIterator<Item = T>,
        prediction: impl IntoIterator<Item = P>,
    ) -> Rows {
        let truth = truth.into_iter().map(Number::number).collect();
        let prediction = prediction.into_iter().map(Number::number).collect();
        self.columns.push((channel, truth, prediction));
        self
    }

    /// Adds the name of each sample's contact point. Samples at one contact point form one cluster of the intervals.
    ///
    /// ```
    /// use taceva_metrics::{Channel, Rows};
    /// let rows = Rows::new().pairs(Channel::FZ, &[0.25, 0.5], &[0.25, 0.5]).points(["a", "a"]);
    /// # drop(rows);
    /// ```
    #[must_use]
    pub fn points<S: AsRef<str>>(mut self, names: impl IntoIterator<Item = S>) -> Rows {
        let mut points = Labels::default();
        names
            .into_iter()
            .for_each(|name| points.push(name.as_ref()));
        self.points = Some(points);
        self
    }

    /// Converts the rows to a batch of `channels`. A channel without columns has no value in any row.
    ///
    /// # Errors
    /// [`MetricError::Lengths`] if a prediction and its truth differ in length. [`MetricError::Rows`] if a channel or the contact points
    /// differ in length from the first channel. [`MetricError::Channels`] for a channel outside `channels`, or a repeated channel.
    ///
    /// ```
    /// use taceva_metrics::{Channel, Channels, Rows};
    /// let channels = Channels::new([Channel::FZ])?;
    /// let rows = Rows::new().pairs(Channel::FZ, &[0.25, 0.5], &[0.25]);
    /// let error = rows.into_batch(&channels).unwrap_err();
    /// assert_eq!(error.to_string(), "1 estimates and 2 references, expected equal numbers");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn into_batch(self, channels: &Channels) -> Result<Batch, MetricError> {
        let rows = match (&self.columns.first(), &self.points) {
            (Some((_, truth, _)), _) => truth.len(),
            (None, Some(points)) => points.index().len(),
            (None, None) => 0,
        };
        let mut truths = vec![None; channels.len()];
        let mut predictions = vec![Column::default(); channels.len()];
        for (channel, truth, prediction) in self.columns {
            if truth.len() != prediction.len() {
                return Err(MetricError::Lengths {
                    estimate: prediction.len(),
                    reference: truth.len(),
                });
            }
            same_length(|| format!("`{channel}`"), rows, truth.len())?;
            let position = channels.iter().position(|known| *known == channel);
            match position {
                Some(position) if truths[position].is_none() => {
                    truths[position] = Some(truth);
                    predictions[position] = prediction;
                }
                found => {
                    let twice = if found.is_some() { " twice" } else { "" };
                    return Err(MetricError::Channels {
                        expected: describe(&written(channels)),
                        found: format!("{channel} [{}]{twice}", channel.unit()),
                    });
                }
            }
        }
        if let Some(points) = &self.points {
            same_length(|| "contact points".to_owned(), rows, points.index().len())?;
        }
        let columns = truths.into_iter().zip(predictions);
        let columns = columns.map(|(truth, prediction)| match truth {
            Some(truth) => (truth, prediction),
            None => (Column::absent(rows), Column::absent(rows)),
        });
        let (truths, predictions) = columns.unzip();
        let channels = channels.clone();
        Ok(Batch::from_columns(
            channels,
            truths,
            predictions,
            self.points,
        ))
    }
}

fn same_length(
    what: impl FnOnce() -> String,
    expected: usize,
    found: usize,
) -> Result<(), MetricError> {
    if expected == found {
        return Ok(());
    }
    Err(MetricError::Rows {
        what: what(),
        expected,
        found,
    })
}
