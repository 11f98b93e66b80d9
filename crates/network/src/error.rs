//! Errors of building, training and using networks.

use crate::picture::Picture;

/// Error of building, training or using a network.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum NetworkError {
    /// The architecture is invalid.
    #[error("invalid network architecture: {reason}")]
    Architecture {
        /// Description of the fault.
        reason: String,
    },
    /// A tensor of the architecture is missing.
    #[error("the tensor `{name}` of the architecture is missing", name = taceva_core::shown(name))]
    MissingTensor {
        /// Name of the tensor.
        name: String,
    },
    /// A tensor is not part of the architecture.
    #[error("unexpected tensor `{name}`: the architecture has no such tensor", name = taceva_core::shown(name))]
    UnexpectedTensor {
        /// Name of the tensor.
        name: String,
    },
    /// The shape or length of a tensor differs from the architecture.
    #[error("tensor `{name}` has the shape {found:?} and {values} numbers, expected {expected:?}", name = taceva_core::shown(name))]
    TensorShape {
        /// Name of the tensor.
        name: String,
        /// Shape found.
        found: Vec<usize>,
        /// Number of values found.
        values: usize,
        /// Shape expected.
        expected: Vec<usize>,
    },
    /// A tensor has a value that is not finite.
    #[error("tensor `{name}`: number {position} is not finite", name = taceva_core::shown(name))]
    TensorNotFinite {
        /// Name of the tensor.
        name: String,
        /// Index of the value.
        position: usize,
    },
    /// The number of picture values is not a multiple of the picture size.
    #[error("{values} numbers, expected whole pictures of {expected}")]
    Pictures {
        /// Number of values found.
        values: usize,
        /// Shape of one input picture.
        expected: Picture,
    },
    /// A picture has a value that is not finite.
    #[error("{part} picture {picture}: number {position} is not finite")]
    PictureNotFinite {
        /// Part that contains the picture.
        part: SampleSet,
        /// Index of the picture.
        picture: usize,
        /// Index of the value in the picture.
        position: usize,
    },
    /// The number of labels does not match the number of pictures.
    #[error("{part}: {labels} labels, expected {outputs} for each of {pictures} pictures")]
    Labels {
        /// Part that contains the labels.
        part: SampleSet,
        /// Number of labels.
        labels: usize,
        /// Number of pictures.
        pictures: usize,
        /// Number of outputs of the network.
        outputs: usize,
    },
    /// A label is not finite.
    #[error("{part} sample {sample}: label {output} is not finite")]
    LabelNotFinite {
        /// Part that contains the label.
        part: SampleSet,
        /// Index of the sample.
        sample: usize,
        /// Index of the label in the sample.
        output: usize,
    },
    /// A class number is not below the number of outputs.
    #[error("{part} sample {sample}: class {class}, expected 0 to {}", classes - 1)]
    Class {
        /// Part that contains the sample.
        part: SampleSet,
        /// Index of the sample.
        sample: usize,
        /// Class number found.
        class: u32,
        /// Number of classes.
        classes: usize,
    },
    /// All labels of an output are equal, which makes scaling and training impossible.
    #[error("output {output}: every training label is {value}, so there is nothing to learn")]
    ConstantLabels {
        /// Index of the output.
        output: usize,
        /// Value of the labels.
        value: f64,
    },
    /// There are fewer samples than a batch needs.
    #[error("{samples} training samples, fewer than a batch of {batch}")]
    FewSamples {
        /// Number of training samples.
        samples: usize,
        /// Number of samples per batch.
        batch: usize,
    },
    /// The loss does not support the labels, or a setting is out of range.
    #[error("`{name}`: {found}, expected {expected}")]
    Recipe {
        /// Name of the setting.
        name: &'static str,
        /// Value found.
        found: String,
        /// Accepted values.
        expected: &'static str,
    },
    /// The loss is not finite. The training stopped before this step changed a weight.
    #[error("step {step}: the loss is not finite")]
    LossNotFinite {
        /// Index of the step, counted from 0.
        step: u64,
    },
    /// A step made a weight, or a running moment of a normalisation, infinite or NaN.
    #[error("step {step}: a weight or a running moment is not finite")]
    WeightNotFinite {
        /// Index of the step, counted from 0.
        step: u64,
    },
    /// The checkpoint belongs to another training run.
    #[error("the checkpoint belongs to another training run: {what}")]
    Checkpoint {
        /// Setting or number that differs between the two runs.
        what: String,
    },
    /// A device failed.
    #[error("{device}: {problem}")]
    Device {
        /// Name of the device.
        device: String,
        /// Problem that the device reported.
        problem: String,
    },
    /// There is too little memory for the transformed weights.
    #[error(
        "cannot allocate {bytes} bytes for transformed weights: free memory, or use a network with fewer channels"
    )]
    Memory {
        /// Size of the transformed weights, in bytes.
        bytes: usize,
    },
    /// The result buffer has the wrong length.
    #[error("a buffer of {found} numbers, expected {expected}")]
    Room {
        /// Length of the buffer.
        found: usize,
        /// Number of results.
        expected: usize,
    },
}

/// Purpose of samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SampleSet {
    /// Samples for training.
    Training,
    /// Samples for the choice of the best epoch.
    Validation,
    /// Samples to predict.
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
