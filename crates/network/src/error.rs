//! Why a network cannot be made, trained or used.

use crate::picture::Picture;

/// Why a network cannot be made, trained or used.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum NetworkError {
    /// Layers that cannot be built.
    #[error("a network cannot be built: {reason}")]
    Architecture {
        /// What cannot.
        reason: String,
    },
    /// A tensor of the architecture that is missing.
    #[error("no tensor `{name}`, which the architecture has", name = taceva_core::shown(name))]
    MissingTensor {
        /// Its name.
        name: String,
    },
    /// A tensor that the architecture does not have.
    #[error("unexpected tensor `{name}`: the architecture has none of that name", name = taceva_core::shown(name))]
    UnexpectedTensor {
        /// Its name.
        name: String,
    },
    /// A tensor of another shape than the architecture says.
    #[error("tensor `{name}` has the shape {found:?} and {values} numbers, expected {expected:?}", name = taceva_core::shown(name))]
    TensorShape {
        /// Its name.
        name: String,
        /// The shape found.
        found: Vec<usize>,
        /// How many numbers were given.
        values: usize,
        /// The shape of the architecture.
        expected: Vec<usize>,
    },
    /// A tensor with a number that is not finite.
    #[error("tensor `{name}`: number {position} is not finite", name = taceva_core::shown(name))]
    TensorNotFinite {
        /// Its name.
        name: String,
        /// Which of its numbers.
        position: usize,
    },
    /// Pictures that are no whole number of those that the network takes.
    #[error("{values} numbers are no whole number of pictures of {expected}")]
    Pictures {
        /// How many numbers were given.
        values: usize,
        /// The picture that the network takes.
        expected: Picture,
    },
    /// A picture with a number that is not finite.
    #[error("{part} picture {picture}: number {position} is not finite")]
    PictureNotFinite {
        /// What the samples are for.
        part: SampleSet,
        /// Which picture.
        picture: usize,
        /// Which of its numbers.
        position: usize,
    },
    /// Labels that are no whole number of samples, or of another number of samples than there are pictures.
    #[error("{part}: {labels} labels for {pictures} pictures of {outputs} outputs")]
    Labels {
        /// What the samples are for.
        part: SampleSet,
        /// How many labels were given.
        labels: usize,
        /// How many pictures were given.
        pictures: usize,
        /// Outputs of the network.
        outputs: usize,
    },
    /// A label that is not finite.
    #[error("{part} sample {sample}: label {output} is not finite")]
    LabelNotFinite {
        /// What the samples are for.
        part: SampleSet,
        /// Which sample.
        sample: usize,
        /// Which of its labels.
        output: usize,
    },
    /// A class that no output stands for.
    #[error("{part} sample {sample}: class {class}, the network has 0 to {}", classes - 1)]
    Class {
        /// What the samples are for.
        part: SampleSet,
        /// Which sample.
        sample: usize,
        /// Its class.
        class: u32,
        /// Classes that there are.
        classes: usize,
    },
    /// Labels that are all the same: there is nothing to scale them by, nor to learn.
    #[error("output {output}: every training label is {value}, so there is nothing to learn")]
    ConstantLabels {
        /// Which output.
        output: usize,
        /// The label.
        value: f64,
    },
    /// Fewer samples than make a batch.
    #[error("{samples} training samples, a batch takes {batch}")]
    FewSamples {
        /// How many there are.
        samples: usize,
        /// How many a batch takes.
        batch: usize,
    },
    /// A loss that does not go with the labels, or a number out of its range.
    #[error("`{name}`: {found}, expected {expected}")]
    Recipe {
        /// The name of the setting.
        name: &'static str,
        /// What was asked for.
        found: String,
        /// What would be accepted.
        expected: &'static str,
    },
    /// A loss that is not finite: training stopped before that step changed a weight.
    #[error("step {step}: the loss is not finite")]
    LossNotFinite {
        /// The step, counted from 0.
        step: u64,
    },
    /// A weight, or a running moment of a normalisation, that a step made not finite.
    #[error("step {step}: a weight or a running moment is not finite")]
    WeightNotFinite {
        /// The step, counted from 0.
        step: u64,
    },
    /// A checkpoint of another training.
    #[error("the checkpoint is of another training: {what}")]
    Checkpoint {
        /// What differs.
        what: String,
    },
    /// A device that does not do what is asked of it.
    #[error("{device}: {problem}")]
    Device {
        /// Which one.
        device: String,
        /// What is wrong, as the device reports it.
        problem: String,
    },
    /// Less memory than transformed weights take.
    #[error(
        "no room in memory for {bytes} bytes of transformed weights: free some, or take a network of fewer channels"
    )]
    Memory {
        /// How many they take.
        bytes: usize,
    },
    /// Room for results that has another length than there are results.
    #[error("room for {found} numbers where {expected} are written")]
    Room {
        /// Numbers there is room for.
        found: usize,
        /// Numbers that are written.
        expected: usize,
    },
}

/// What samples are for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SampleSet {
    /// For training.
    Training,
    /// For choosing the best epoch.
    Validation,
    /// To be predicted.
    Prediction,
}

impl std::fmt::Display for SampleSet {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            SampleSet::Training => "training",
            SampleSet::Validation => "validation",
            SampleSet::Prediction => "prediction",
        })
    }
}
