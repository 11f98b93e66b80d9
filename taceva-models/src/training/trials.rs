//! Choice of a setting from held-out errors: rounds of training and held-out samples, and errors of the candidate values.

use std::borrow::Cow;

use faer::Mat;
use taceva_core::{Features, ModelError, Progress};

use crate::linalg::progress::{ReportedStage, interrupted};
use crate::training::choice::{ChannelChoice, Choice, ChosenBy, Errors, least, rmse};
use crate::training::problem::{Problem, Validation, joined, stacked};

/// Maximum number of rounds of a choice without a validation part.
pub(crate) const FOLDS: usize = 10;

/// Samples for a choice of settings, and the rounds in which some of them are held out.
#[derive(Debug)]
pub(crate) struct Trials<'a> {
    /// Features of the training part, followed by the features of the validation part.
    pub(crate) features: Cow<'a, Features>,
    /// Labels of the samples in `features`, scaled and centred like the training labels.
    pub(crate) labels: Mat<f64>,
    by: ChosenBy,
    rounds: Vec<Round>,
    training: usize,
}

/// One round of a choice: rows to which candidates are fitted, and held-out rows on which they are compared.
#[derive(Debug)]
pub(crate) struct Round {
    pub(crate) learnt: Vec<usize>,
    pub(crate) held: Vec<usize>,
}

impl<'a> Trials<'a> {
    /// Holds out the validation part, if one exists, in a single round. Otherwise holds out each group of the training part once. More than ten
    /// groups are combined in ten folds. Without groups, ten runs of neighbouring samples are held out. If no setting is to be chosen and no
    /// validation part exists, nothing is held out.
    pub(crate) fn new(
        problem: &Problem<'a>,
        validation: Option<&Validation<'_>>,
        has_choice: bool,
    ) -> Trials<'a> {
        let training = problem.centred.nrows();
        let held = |held: Vec<usize>| {
            let mut inside = vec![false; training];
            held.iter().for_each(|&row| inside[row] = true);
            Round {
                learnt: (0..training).filter(|&row| !inside[row]).collect(),
                held,
            }
        };
        let Some(part) = validation else {
            let (by, folds) = match (has_choice, problem.groups()) {
                (false, _) => (ChosenBy::Nobody, Vec::new()),
                (true, Some(groups)) if groups.len() <= FOLDS => {
                    (ChosenBy::LeaveOneGroupOut, groups)
                }
                (true, Some(groups)) => (ChosenBy::TenFolds, folds_of(groups)),
                (true, None) => (ChosenBy::TenFolds, folds(training)),
            };
            return Trials {
                features: Cow::Borrowed(problem.training.features),
                labels: problem.centred.clone(),
                by,
                rounds: folds.into_iter().map(held).collect(),
                training,
            };
        };
        let samples = training + part.labels.nrows();
        Trials {
            features: Cow::Owned(joined(problem.training.features, part.features)),
            labels: stacked(&problem.centred, &part.labels),
            by: if has_choice {
                ChosenBy::Validation
            } else {
                ChosenBy::Nobody
            },
            rounds: vec![Round {
                learnt: (0..training).collect(),
                held: (training..samples).collect(),
            }],
            training,
        }
    }

    /// Rows to which the final model is fitted: the training part, and the validation part if `refit` is true.
    pub(crate) fn learnt(&self, refit: bool) -> Vec<usize> {
        if refit {
            (0..self.labels.nrows()).collect()
        } else {
            (0..self.training).collect()
        }
    }

    /// True if there is a validation part.
    pub(crate) fn has_validation(&self) -> bool {
        self.labels.nrows() > self.training
    }

    /// Mean squared error of each candidate and channel over all held-out samples; `None` if nothing is held out. `squares` returns the sum of
    /// squared errors over the held-out samples of a round.
    pub(crate) fn errors(
        &self,
        progress: &dyn Progress,
        mut squares: impl FnMut(&Round) -> Result<Errors, ModelError>,
    ) -> Result<Option<Errors>, ModelError> {
        let stage = ReportedStage::begin(progress, "settings tried", self.rounds.len());
        let mut total: Option<Errors> = None;
        for round in self.rounds.iter().filter(|round| !round.learnt.is_empty()) {
            interrupted(progress)?;
            let own = squares(round)?;
            match &mut total {
                None => total = Some(own),
                Some(total) => {
                    let places = total.iter_mut().flatten();
                    places
                        .zip(own.iter().flatten())
                        .for_each(|(place, own)| *place += own);
                }
            }
            stage.advance();
        }
        let held: usize = self.rounds.iter().map(|round| round.held.len()).sum();
        if let Some(total) = &mut total {
            let places = total.iter_mut().flatten();
            places.for_each(|place| *place /= held as f64);
        }
        Ok(total)
    }

    /// Chooses a candidate for each channel: the one with the least error in this channel, or the first one if `errors` is `None`. Returns the index
    /// of the chosen candidate for each channel, and a record with its value and error. `values` contains the values of the candidates.
    pub(crate) fn choose(
        &self,
        problem: &Problem<'_>,
        setting: &str,
        values: &[f64],
        errors: Option<&Errors>,
    ) -> (Vec<usize>, Choice) {
        let chosen: Vec<usize> = (0..problem.channels())
            .map(|channel| errors.map_or(0, |errors| least(errors, channel)))
            .collect();
        let spans = problem.scaling.span();
        let channels = chosen.iter().enumerate().map(|(channel, &candidate)| {
            let error = errors.map(|errors| errors[candidate][channel]);
            ChannelChoice {
                value: values.get(candidate).copied(),
                rmse: error.and_then(|error| rmse(error, spans[channel])),
                at_edge: values.len() > 1 && (candidate == 0 || candidate == values.len() - 1),
            }
        });
        let choice = Choice {
            by: self.by,
            setting: Some(setting.to_owned()),
            channels: channels.collect(),
        };
        (chosen, choice)
    }
}

/// Combines groups of rows in ten folds, to limit the number of fits. No group is divided.
pub(crate) fn folds_of(groups: Vec<Vec<usize>>) -> Vec<Vec<usize>> {
    let mut folds = vec![Vec::new(); FOLDS];
    for (position, group) in groups.into_iter().enumerate() {
        folds[position % FOLDS].extend(group);
    }
    folds
}

/// Divides row numbers into ten runs of neighbouring samples. With fewer than ten samples, every sample is a run.
pub(crate) fn folds(samples: usize) -> Vec<Vec<usize>> {
    let count = FOLDS.min(samples);
    (0..count)
        .map(|fold| (fold * samples / count..(fold + 1) * samples / count).collect())
        .collect()
}

/// Matrix of the given `rows` of `labels`, shape `[rows, channels]`.
pub(crate) fn rows_of(labels: &Mat<f64>, rows: &[usize]) -> Mat<f64> {
    Mat::from_fn(rows.len(), labels.ncols(), |row, channel| {
        labels[(rows[row], channel)]
    })
}
