//! Samples: pictures and their labels.

use crate::architecture::Architecture;
use crate::error::{NetworkError, SampleSet};
use crate::labels::Labels;
use crate::loss::Loss;

/// Pictures and their labels.
#[derive(Clone, Copy, Debug)]
pub struct Samples<'a> {
    /// Pictures, shape `[samples, height, width, channels]`.
    pub pictures: &'a [f32],
    /// Labels of each picture.
    pub labels: Labels<'a>,
}

impl Samples<'_> {
    /// Number of samples.
    pub(crate) fn count(&self, architecture: &Architecture) -> usize {
        self.pictures.len() / architecture.input.len()
    }

    /// Checks that the samples are finite, and match the architecture and the loss.
    pub(crate) fn check(
        &self,
        part: SampleSet,
        architecture: &Architecture,
        loss: Loss,
    ) -> Result<(), NetworkError> {
        let (picture, outputs) = (architecture.input, architecture.outputs);
        if !self.pictures.len().is_multiple_of(picture.len()) {
            let values = self.pictures.len();
            return Err(NetworkError::Pictures {
                values,
                expected: picture,
            });
        }
        let samples = self.count(architecture);
        let (labels, expected) = match self.labels {
            Labels::Values(values) => (values.len(), samples.checked_mul(outputs)),
            Labels::Classes(classes) => (classes.len(), Some(samples)),
        };
        if Some(labels) != expected || samples == 0 {
            return Err(NetworkError::Labels {
                part,
                labels,
                pictures: samples,
                outputs,
            });
        }
        if let Some(at) = self.pictures.iter().position(|value| !value.is_finite()) {
            return Err(NetworkError::PictureNotFinite {
                part,
                picture: at / picture.len(),
                position: at % picture.len(),
            });
        }
        match (self.labels, loss) {
            (Labels::Values(_), Loss::CrossEntropy) => Err(NetworkError::Recipe {
                name: "loss",
                found: "cross entropy for numbers".into(),
                expected: "squared error or Huber's loss for numbers; cross entropy is for classes",
            }),
            (Labels::Classes(_), Loss::SquaredError | Loss::Huber { .. }) => {
                Err(NetworkError::Recipe {
                    name: "loss",
                    found: "a distance loss for classes".into(),
                    expected: "cross entropy",
                })
            }
            (Labels::Values(values), _) => {
                match values.iter().position(|value| !value.is_finite()) {
                    None => Ok(()),
                    Some(at) => Err(NetworkError::LabelNotFinite {
                        part,
                        sample: at / outputs,
                        output: at % outputs,
                    }),
                }
            }
            (Labels::Classes(classes), _) => {
                match classes.iter().position(|class| *class as usize >= outputs) {
                    None => Ok(()),
                    Some(sample) => Err(NetworkError::Class {
                        part,
                        sample,
                        class: classes[sample],
                        classes: outputs,
                    }),
                }
            }
        }
    }
}
