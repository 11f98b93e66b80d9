//! Training data of a fit, with checked values and with scaled and centred labels.

use faer::Mat;
use taceva_core::{Features, ModelError, TrainingSet, counted};

use crate::linalg::invalid;
use crate::training::label_scaling::LabelScaling;

/// Training part of a fit, with checked values and with scaled and centred labels.
#[derive(Debug)]
pub(crate) struct Problem<'a> {
    pub(crate) training: TrainingSet<'a>,
    pub(crate) scaling: LabelScaling,
    /// Mean of the scaled labels of each channel over the training samples.
    pub(crate) mean: Vec<f64>,
    /// Scaled labels minus the mean of their channel, shape `[samples, channels]`.
    pub(crate) centred: Mat<f64>,
}

impl<'a> Problem<'a> {
    /// Minimum number of samples for a fit.
    pub(crate) const SAMPLES_MIN: usize = 2;

    pub(crate) fn new(training: TrainingSet<'a>) -> Result<Problem<'a>, ModelError> {
        check(&training, "training")?;
        let samples = training.features.samples();
        if samples < Problem::SAMPLES_MIN {
            return Err(invalid(format!(
                "{}, at least {} are needed",
                counted(samples, "training sample"),
                Problem::SAMPLES_MIN
            )));
        }
        let scaling = LabelScaling::of(training.targets);
        let (mean, centred) = centred(scaling.scaled(training.targets));
        Ok(Problem {
            training,
            scaling,
            mean,
            centred,
        })
    }

    /// Checks the validation part and scales its labels like the training labels; `None` if it has no samples.
    pub(crate) fn validation<'v>(
        &self,
        validation: Option<&TrainingSet<'v>>,
    ) -> Result<Option<Validation<'v>>, ModelError> {
        let Some(part) = validation.filter(|part| part.features.samples() > 0) else {
            return Ok(None);
        };
        check(part, "validation")?;
        if part.features.shape() != self.training.features.shape() {
            return Err(invalid(format!(
                "validation samples of {} features, expected {} as in training",
                part.features.shape().len(),
                self.training.features.shape().len()
            )));
        }
        if part.targets.channels != self.training.targets.channels {
            return Err(invalid("validation and training have different channels"));
        }
        let mut labels = self.scaling.scaled(part.targets);
        subtract(&mut labels, &self.mean);
        Ok(Some(Validation {
            features: part.features,
            labels,
        }))
    }

    /// Row numbers of each sample group in the training part; `None` for fewer than two groups.
    pub(crate) fn groups(&self) -> Option<Vec<Vec<usize>>> {
        let groups = self.training.groups?;
        let mut members = std::collections::BTreeMap::<u32, Vec<usize>>::new();
        for (row, &group) in groups.iter().enumerate() {
            members.entry(group).or_default().push(row);
        }
        (members.len() > 1).then(|| members.into_values().collect())
    }

    pub(crate) fn channels(&self) -> usize {
        self.mean.len()
    }
}

/// Validation part, with labels scaled and centred like the training labels.
#[derive(Debug)]
pub(crate) struct Validation<'v> {
    pub(crate) features: &'v Features,
    /// Labels scaled like the training labels, minus the mean of each channel over the training part.
    pub(crate) labels: Mat<f64>,
}

/// Returns the mean of each column, and the matrix with these means subtracted.
pub(crate) fn centred(mut values: Mat<f64>) -> (Vec<f64>, Mat<f64>) {
    let rows = values.nrows() as f64;
    let mean: Vec<f64> = (0..values.ncols())
        .map(|column| values.col_as_slice(column).iter().sum::<f64>() / rows)
        .collect();
    subtract(&mut values, &mean);
    (mean, values)
}

fn subtract(values: &mut Mat<f64>, mean: &[f64]) {
    for (column, mean) in mean.iter().enumerate() {
        values
            .col_as_slice_mut(column)
            .iter_mut()
            .for_each(|value| *value -= mean);
    }
}

/// Matrix with the rows of `upper`, followed by the rows of `lower`.
pub(crate) fn stacked(upper: &Mat<f64>, lower: &Mat<f64>) -> Mat<f64> {
    let mut whole = Mat::zeros(upper.nrows() + lower.nrows(), upper.ncols());
    whole.subrows_mut(0, upper.nrows()).copy_from(upper);
    whole
        .subrows_mut(upper.nrows(), lower.nrows())
        .copy_from(lower);
    whole
}

/// Samples of `first`, followed by the samples of `second`. Both must have the same shape per sample.
pub(crate) fn joined(first: &Features, second: &Features) -> Features {
    first.followed_by(second).expect("samples of one shape")
}

fn check(part: &TrainingSet<'_>, name: &str) -> Result<(), ModelError> {
    let (samples, length) = (part.features.samples(), part.features.shape().len());
    let channels = part.targets.channels.len();
    if length == 0 || channels == 0 {
        return Err(invalid(format!(
            "{length} features and {channels} channels: at least one of each is needed"
        )));
    }
    if part.targets.values.len() != samples * channels {
        return Err(invalid(format!(
            "{} labels for {samples} {name} samples of {channels} channels, expected a label for each sample and channel",
            part.targets.values.len()
        )));
    }
    if let Some(groups) = part.groups.filter(|groups| groups.len() != samples) {
        return Err(invalid(format!(
            "{} groups for {samples} {name} samples, expected a group for each sample",
            groups.len()
        )));
    }
    if let Some(position) = part
        .features
        .values()
        .iter()
        .position(|value| !value.is_finite())
    {
        return Err(invalid(format!(
            "{name} sample {}: feature {} is not finite",
            position / length,
            position % length
        )));
    }
    if let Some(position) = part
        .targets
        .values
        .iter()
        .position(|value| !value.is_finite())
    {
        return Err(invalid(format!(
            "{name} sample {}: `{}` is not finite",
            position / channels,
            part.targets.channels.as_slice()[position % channels]
        )));
    }
    Ok(())
}
