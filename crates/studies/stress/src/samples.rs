//! Samples with pictures that a model has not seen.

use taceva_dataset::Dataset;
use taceva_evaluate::{
    DataPart, EvaluateError, Need, Target, model_provenance, provenance_of, usable,
};
use taceva_models::Model;
use taceva_results::Provenance;

/// Samples of a recording that a model has not seen.
pub(crate) struct Unseen {
    pub(crate) target: Target,
    /// Samples with a picture, ascending.
    pub(crate) rows: Vec<usize>,
}

impl Unseen {
    /// Samples of `part`, or of the part that the model has not seen. Reads no picture.
    pub(crate) fn of(
        dataset: &Dataset,
        model: &Model,
        part: Option<DataPart>,
    ) -> Result<Unseen, EvaluateError> {
        require_pictures(dataset, model)?;
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
        Unseen::with_pictures(dataset, target)
    }

    /// Samples of `target`, which the caller knows to be unseen.
    pub(crate) fn of_target(
        dataset: &Dataset,
        model: &Model,
        target: Target,
    ) -> Result<Unseen, EvaluateError> {
        require_pictures(dataset, model)?;
        Unseen::with_pictures(dataset, target)
    }

    fn with_pictures(dataset: &Dataset, target: Target) -> Result<Unseen, EvaluateError> {
        let need = Need {
            frame: true,
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

    /// Number of samples of the part without a picture.
    pub(crate) fn left_out(&self) -> usize {
        self.target.left_out + self.target.rows.len() - self.rows.len()
    }

    /// Origin of scores of these samples of `dataset`, for which `decoded` further pictures were decoded.
    pub(crate) fn provenance(
        &self,
        dataset: &Dataset,
        model: &Model,
        decoded: u64,
    ) -> Result<Provenance, EvaluateError> {
        let divided = self.target.divided.as_ref();
        Ok(Provenance {
            model: Some(model_provenance(model)?),
            split: divided.map(|divided| divided.spec.to_string()),
            seed: divided.map(|divided| divided.seed),
            part: Some(self.target.part.name().to_owned()),
            samples: divided.map(|of| of.counts()).unwrap_or_default(),
            frames_decoded: decoded + self.rows.len() as u64,
            ..provenance_of(dataset)
        })
    }
}

/// Time of each row of `dataset`, a share of the time from its first row to its last. `None` if one of `rows` has no time, or all times are equal.
pub(crate) fn shares(dataset: &Dataset, rows: &[usize]) -> Option<Vec<f64>> {
    let times = dataset.table().t_s();
    let known = || times.iter().copied().flatten();
    let first = known().fold(f64::INFINITY, f64::min);
    let last = known().fold(f64::NEG_INFINITY, f64::max);
    let is_timed = rows.iter().all(|row| times[*row].is_some());
    let share = |time: &Option<f64>| time.map_or(1.0, |time| (time - first) / (last - first));
    (is_timed && last > first).then(|| times.iter().map(share).collect())
}

/// Refuses recordings without pictures of one sensor, and models that read no pictures.
fn require_pictures(dataset: &Dataset, model: &Model) -> Result<(), EvaluateError> {
    let refused = |words: &str| Err(EvaluateError::Request(words.to_owned()));
    if !dataset.recordings().is_empty() {
        return refused(
            "several recordings, expected one, because each has its own untouched picture; test them one by one",
        );
    }
    if model.reads_features() && !model.reads_frames() {
        return refused(
            "the model reads signals, expected a model that reads pictures: fit one by `taceva fit --set input=frame`",
        );
    }
    dataset.require_view()?;
    match dataset.header().frames {
        Some(_) => Ok(()),
        None => refused("the recording has no pictures, expected a recording with pictures"),
    }
}
