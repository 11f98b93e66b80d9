//! Predictions of some rows of a dataset.

use std::collections::BTreeMap;

use taceva_core::{Channel, Channels, Column};

use super::task_cells::TaskCells;
use crate::bounded_share::Bounded;
use crate::error::EvaluateError;
use crate::note::Note;
use crate::rows::DataPart;

/// Predictions of one channel that the model clipped to one of its label bounds.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct AtBound {
    /// The channel.
    pub channel: Channel,
    /// The bound, in the unit of the channel.
    pub bound: f64,
    /// Number of predictions equal to the bound.
    pub count: usize,
}

/// Predictions of some rows of a dataset, with their truth.
#[derive(Debug)]
pub struct Predicted {
    pub(super) part: DataPart,
    pub(super) channels: Channels,
    pub(super) ids: Vec<String>,
    pub(super) points: Option<Vec<String>>,
    /// Fields of the rows by column name, except contact points and channels.
    pub(super) beside: Vec<(&'static str, Vec<Option<String>>)>,
    pub(super) truth: Vec<Column>,
    /// Predictions that were clipped to the label bounds of the model.
    pub(super) prediction: Vec<Column>,
    /// Predictions that were not clipped.
    pub(super) unbounded: Vec<Column>,
    /// Standard deviation of each prediction, if the model predicts it.
    pub(super) deviation: Option<Vec<Column>>,
    /// Distance of each frame from the training part, if requested and known. A frame at a distance above 1 is unlike the training frames.
    pub(super) distance: Option<Vec<f64>>,
    /// True for each prediction beyond the bounds of the model, by channel; `None` for a channel without bounds.
    pub(super) beyond: Vec<Option<Vec<bool>>>,
    /// Names, clusters and probabilities of classes, for a model of a task; `None` for other models.
    pub(super) task: Option<TaskCells>,
    /// Best constant predictions by channel, if the model states them.
    pub(super) constants: BTreeMap<String, f64>,
    /// Number of frames decoded for the predictions.
    pub frames_decoded: u64,
    /// Number of rows of the part that could not be predicted.
    pub left_out: usize,
}

impl Predicted {
    /// Appends the predictions of `other`, made by another model. The constants are discarded.
    ///
    /// # Errors
    /// [`EvaluateError::Unsuited`] if the channels differ.
    pub fn followed_by(mut self, other: Predicted) -> Result<Predicted, EvaluateError> {
        if self.channels != other.channels {
            return Err(EvaluateError::Unsuited(
                "the models of two folds predict different channels: name them with --channels"
                    .to_owned(),
            ));
        }
        fn join(own: &mut [Column], other: &[Column]) {
            for (own, other) in own.iter_mut().zip(other) {
                (0..other.len()).for_each(|row| own.push(other.get(row)));
            }
        }
        self.ids.extend(other.ids);
        self.points = self.points.zip(other.points).map(|(mut own, other)| {
            own.extend(other);
            own
        });
        for (name, texts) in other.beside {
            if let Some((_, own)) = self.beside.iter_mut().find(|(known, _)| *known == name) {
                own.extend(texts);
            }
        }
        join(&mut self.truth, &other.truth);
        join(&mut self.prediction, &other.prediction);
        join(&mut self.unbounded, &other.unbounded);
        self.deviation = self.deviation.zip(other.deviation).map(|(mut own, other)| {
            join(&mut own, &other);
            own
        });
        self.distance = self.distance.zip(other.distance).map(|(mut own, other)| {
            own.extend(other);
            own
        });
        let beyond = self.beyond.into_iter().zip(other.beyond);
        let both = beyond.map(|pair| match pair {
            (Some(mut own), Some(other)) => {
                own.extend(other);
                Some(own)
            }
            _ => None,
        });
        self.beyond = both.collect();
        let cells = self.task.zip(other.task);
        self.task = cells.map(|(own, other)| own.followed_by(other));
        self.constants.clear();
        self.frames_decoded += other.frames_decoded;
        self.left_out += other.left_out;
        Ok(self)
    }

    /// Sorts the predictions of `rows` by row, the order of the recording. Also returns the sorted rows.
    pub fn in_order_of(self, rows: Vec<usize>) -> (Vec<usize>, Predicted) {
        let mut order: Vec<usize> = (0..rows.len()).collect();
        order.sort_by_key(|at| rows[*at]);
        let columns = |columns: Vec<Column>| -> Vec<Column> {
            let sorted = |column: &Column| {
                let mut sorted = Column::default();
                order.iter().for_each(|&at| sorted.push(column.get(at)));
                sorted
            };
            columns.iter().map(sorted).collect()
        };
        let texts = |texts: &[String]| order.iter().map(|&at| texts[at].clone()).collect();
        let predicted = Predicted {
            ids: texts(&self.ids),
            points: self.points.as_deref().map(texts),
            beside: self
                .beside
                .into_iter()
                .map(|(name, cells)| (name, order.iter().map(|&at| cells[at].clone()).collect()))
                .collect(),
            truth: columns(self.truth),
            prediction: columns(self.prediction),
            unbounded: columns(self.unbounded),
            deviation: self.deviation.map(columns),
            distance: self
                .distance
                .map(|distance| order.iter().map(|&at| distance[at]).collect()),
            beyond: self
                .beyond
                .into_iter()
                .map(|beyond| beyond.map(|beyond| order.iter().map(|&at| beyond[at]).collect()))
                .collect(),
            task: self.task.map(|task| task.in_order(&order)),
            ..self
        };
        (order.iter().map(|&at| rows[at]).collect(), predicted)
    }

    /// Name of the predicted part of the dataset.
    pub fn part(&self) -> &'static str {
        self.part.name()
    }

    /// Number of samples.
    pub fn rows(&self) -> usize {
        self.ids.len()
    }

    /// The predicted channels.
    pub fn channels(&self) -> &Channels {
        &self.channels
    }

    /// Note on the shares of predictions that the bounds of the model changed, by channel; `None` if no prediction was changed.
    pub fn beyond(&self) -> Option<Note> {
        let shares = self.bounded(0..self.rows());
        let channels = self.channels.iter();
        let shares: Vec<(String, f64)> = channels
            .filter_map(|channel| {
                let share = shares.share(channel.name()).filter(|share| *share > 0.0)?;
                Some((channel.name().to_owned(), share))
            })
            .collect();
        (!shares.is_empty()).then_some(Note::Bounded(shares))
    }

    /// Number of predictions beyond the bounds of the model at `positions`, by channel.
    pub fn bounded(&self, positions: impl Iterator<Item = usize> + Clone) -> Bounded {
        let mut bounded = Bounded::default();
        for (channel, beyond) in self.channels.iter().zip(&self.beyond) {
            if let Some(beyond) = beyond {
                let own = positions.clone().map(|position| beyond[position]);
                bounded.add(channel.name(), own);
            }
        }
        bounded
    }

    /// Best constant predictions by channel, if the model states them.
    pub fn constants(&self) -> &BTreeMap<String, f64> {
        &self.constants
    }

    /// The truth, channel by channel.
    pub fn truth(&self) -> &[Column] {
        &self.truth
    }

    /// Predictions, clipped to the label bounds of the model.
    pub fn prediction(&self) -> &[Column] {
        &self.prediction
    }

    /// Unclipped predictions.
    pub fn unbounded(&self) -> &[Column] {
        &self.unbounded
    }

    /// Standard deviations of the predictions, if the model predicts them.
    pub fn deviation(&self) -> Option<&[Column]> {
        self.deviation.as_deref()
    }

    /// Probabilities of the classes of a task, row by row; `None` if the model estimates none.
    pub(crate) fn shares(&self) -> Option<&[f64]> {
        self.task.as_ref()?.shares()
    }

    /// [Distance](taceva_models::FeatureDistance) of each frame from the training part, if [`predict`](super::predict) computed it.
    pub fn distance(&self) -> Option<&[f64]> {
        self.distance.as_deref()
    }

    /// Number of frames whose distance from the training part exceeds 1, if the distance is known.
    pub fn outside(&self) -> Option<usize> {
        let distance = self.distance()?;
        Some(distance.iter().filter(|distance| **distance > 1.0).count())
    }

    /// Number of predictions at each bound of the model, by channel and bound. Empty if no prediction was clipped.
    pub fn at_bounds(&self) -> Vec<AtBound> {
        let mut found: Vec<AtBound> = Vec::new();
        let columns = self.prediction.iter().zip(&self.beyond);
        for (channel, (clipped, beyond)) in self.channels.iter().zip(columns) {
            let beyond = beyond.iter().flatten().enumerate();
            let rows = beyond.filter_map(|(row, is_beyond)| is_beyond.then_some(row));
            for bound in rows.filter_map(|row| clipped.get(row)) {
                let is_same = |own: &&mut AtBound| {
                    own.channel == *channel && own.bound.total_cmp(&bound).is_eq()
                };
                match found.iter_mut().find(is_same) {
                    Some(own) => own.count += 1,
                    None => found.push(AtBound {
                        channel: *channel,
                        bound,
                        count: 1,
                    }),
                }
            }
        }
        found
    }

    /// Contact point of each row, or the group in its place; `None` if a row has neither.
    pub fn points(&self) -> Option<&[String]> {
        self.points.as_deref()
    }
}
