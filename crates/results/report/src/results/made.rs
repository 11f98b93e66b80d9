//! How a result was made, as far as a paragraph of methods needs it in parts.

/// How a result was made.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Made {
    /// The name of the model: `ridge`.
    pub model: Option<String>,
    /// The settings of the model, chosen ones included, by name.
    pub settings: Vec<(String, String)>,
    /// The number of samples of each part of the split, by its name: `train`, `validation`, `test`.
    pub samples: Vec<(String, u64)>,
    /// Presses of the recording, however they ended; 0 where the result does not say.
    pub presses: u64,
}
