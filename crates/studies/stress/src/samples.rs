//! Samples with pictures or signals that a model has not seen.

use taceva_core::InputInfo;
use taceva_dataset::Dataset;
use taceva_evaluate::{
    DataPart, EvaluateError, Need, Target, model_provenance, provenance_of, usable,
};
use taceva_models::Model;
use taceva_results::Provenance;

/// Samples of a recording that a model has not seen.
pub(crate) struct Unseen {
    pub(crate) target: Target,
    /// Row numbers of the samples with a picture, or with signals if the model reads signals, ascending.
    pub(crate) rows: Vec<usize>,
}

impl Unseen {
    /// Selects the samples of `part`, or of the part that the model has not seen. Reads no picture and no signal.
    pub(crate) fn of(
        dataset: &Dataset,
        model: &Model,
        part: Option<DataPart>,
    ) -> Result<Unseen, EvaluateError> {
        require_input(dataset, model)?;
        let target = Target::new(dataset, model, part)?;
        let is_fitted = target
            .divided
            .as_ref()
            .is_some_and(|divided| !divided.rows(DataPart::Train).is_empty());
        if is_fitted && target.part != DataPart::Test {
            return Err(EvaluateError::Request(format!(
                "part `{}`: the model was fitted on these samples, so its errors without a fault are too small; use --part test, or another \
                 recording",
                target.part.name()
            )));
        }
        Unseen::with_input(dataset, model, target)
    }

    /// Selects the samples of `target`. The caller knows that the model has not seen them.
    pub(crate) fn of_target(
        dataset: &Dataset,
        model: &Model,
        target: Target,
    ) -> Result<Unseen, EvaluateError> {
        require_input(dataset, model)?;
        Unseen::with_input(dataset, model, target)
    }

    fn with_input(
        dataset: &Dataset,
        model: &Model,
        target: Target,
    ) -> Result<Unseen, EvaluateError> {
        let need = Need {
            frame: !reads_signals(model),
            labels: None,
        };
        let rows = usable(dataset, &target.rows, need);
        if rows.is_empty() {
            return Err(EvaluateError::Request(format!(
                "the part `{}` has no sample with a picture",
                target.part.name()
            )));
        }
        Ok(Unseen { target, rows })
    }

    /// Number of samples of the part that have no picture, or no signals if the model reads signals.
    pub(crate) fn left_out(&self) -> usize {
        self.target.left_out + self.target.rows.len() - self.rows.len()
    }

    /// Origin of the scores of these samples of `dataset`. `decoded` is the number of further pictures that were decoded.
    pub(crate) fn provenance(
        &self,
        dataset: &Dataset,
        model: &Model,
        decoded: u64,
    ) -> Result<Provenance, EvaluateError> {
        let divided = self.target.divided.as_ref();
        let own = match reads_signals(model) {
            true => 0,
            false => self.rows.len() as u64,
        };
        Ok(Provenance {
            model: Some(model_provenance(model)?),
            split: divided.map(|divided| divided.spec.to_string()),
            seed: divided.map(|divided| divided.seed),
            part: Some(self.target.part.name().to_owned()),
            samples: divided.map(|of| of.counts()).unwrap_or_default(),
            frames_decoded: decoded + own,
            ..provenance_of(dataset)
        })
    }
}

/// Time of each row of `dataset`, from 0 at its first row to 1 at its last. `None` if one of `rows` has no time, or all times are equal.
pub(crate) fn shares(dataset: &Dataset, rows: &[usize]) -> Option<Vec<f64>> {
    let elapsed = elapsed_s(dataset, rows)?;
    let whole = elapsed.iter().copied().fold(0.0, f64::max);
    Some(elapsed.iter().map(|time| time / whole).collect())
}

/// Time of each row of `dataset` since its first row, s. A row without a time gets the time of the last row. `None` as for [`shares`].
pub(crate) fn elapsed_s(dataset: &Dataset, rows: &[usize]) -> Option<Vec<f64>> {
    let times = dataset.table().t_s();
    let known = || times.iter().copied().flatten();
    let first = known().fold(f64::INFINITY, f64::min);
    let last = known().fold(f64::NEG_INFINITY, f64::max);
    let is_timed = rows.iter().all(|row| times[*row].is_some());
    let elapsed = |time: &Option<f64>| time.unwrap_or(last) - first;
    (is_timed && last > first).then(|| times.iter().map(elapsed).collect())
}

/// True if the model reads signals of taxels and not pictures.
pub(crate) fn reads_signals(model: &Model) -> bool {
    matches!(model.card().input, InputInfo::Signals(_))
}

/// Refuses models of signals.
pub(crate) fn require_model_of_pictures(model: &Model) -> Result<(), EvaluateError> {
    match reads_signals(model) {
        true => Err(EvaluateError::Request(
            "the model reads signals, expected a model that reads pictures: fit such a model by `taceva fit --set input=frame`"
                .to_owned(),
        )),
        false => Ok(()),
    }
}

/// Refuses several recordings, and a recording without the input of the model.
fn require_input(dataset: &Dataset, model: &Model) -> Result<(), EvaluateError> {
    let refused = |words: &str| Err(EvaluateError::Request(words.to_owned()));
    if !dataset.recordings().is_empty() {
        return refused(
            "several recordings, expected one, because each has its own untouched picture; test them one by one",
        );
    }
    if reads_signals(model) {
        return match dataset.header().signals {
            Some(_) => Ok(()),
            None => refused(
                "the recording has no signals, which the model reads: expected a recording of taxels, or a model that reads pictures",
            ),
        };
    }
    dataset.require_view()?;
    match dataset.header().frames {
        Some(_) => Ok(()),
        None => refused("the recording has no pictures, expected a recording with pictures"),
    }
}
