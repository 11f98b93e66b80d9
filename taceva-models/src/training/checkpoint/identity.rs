//! Identity of a training run.

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use taceva_network::GpuKind;
use taceva_network::{Architecture, Isa, Labels, Recipe, Samples, Summary};

/// Identity of a training run. A checkpoint resumes only a run with an equal identity.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Identity {
    architecture: Architecture,
    recipe: Recipe,
    pub(super) of: Origin,
}

/// Data, rounding and device of the training run that wrote a checkpoint.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Origin {
    /// SHA-256 digest of the labels and preprocessed pictures of the training and validation parts.
    samples: String,
    /// True if the CPU has no fused multiply-add, so that products are rounded before they are summed. This rounding changes the last digits.
    rounds_products: bool,
    /// Training device: `cpu`, or the kind of GPU. GPUs sum in no fixed order.
    device: String,
}

impl Identity {
    pub(crate) fn new(
        architecture: &Architecture,
        recipe: &Recipe,
        training: Samples<'_>,
        validation: Option<Samples<'_>>,
        gpu: Option<GpuKind>,
    ) -> Identity {
        let mut digest = Sha256::new();
        for samples in std::iter::once(training).chain(validation) {
            add_samples(&mut digest, samples);
        }
        Identity {
            architecture: architecture.clone(),
            recipe: recipe.clone(),
            of: Origin {
                samples: hexadecimal(digest),
                rounds_products: Isa::detect() == Isa::Portable,
                device: gpu.map_or("cpu", GpuKind::name).to_owned(),
            },
        }
    }

    /// Name of the first property in which a checkpoint and this training run differ; `None` if they agree.
    pub(super) fn differs_from(&self, of: &Origin, summary: &Summary) -> Option<&'static str> {
        if self.architecture != summary.architecture {
            Some("layers, channels or sizes of pictures")
        } else if self.recipe != summary.recipe {
            Some("settings")
        } else if self.of.samples != of.samples {
            Some("samples or preprocessing")
        } else if self.of.rounds_products != of.rounds_products {
            Some("instructions, which round differently")
        } else if self.of.device != of.device {
            Some("device")
        } else {
            None
        }
    }
}

fn add_samples(digest: &mut Sha256, samples: Samples<'_>) {
    let (kind, labels): (u8, Vec<u8>) = match samples.labels {
        Labels::Values(values) => (
            0,
            values
                .iter()
                .flat_map(|value| value.to_le_bytes())
                .collect(),
        ),
        Labels::Classes(classes) => (
            1,
            classes
                .iter()
                .flat_map(|class| class.to_le_bytes())
                .collect(),
        ),
    };
    for length in [samples.pictures.len(), labels.len()] {
        digest.update((length as u64).to_le_bytes());
    }
    digest.update([kind]);
    digest.update(labels);
    add_numbers(digest, samples.pictures);
}

/// Adds the bytes of `numbers` to `digest`, in chunks to limit memory.
pub(super) fn add_numbers(digest: &mut Sha256, numbers: &[f32]) {
    for numbers in numbers.chunks(1 << 14) {
        let bytes: Vec<u8> = numbers
            .iter()
            .flat_map(|number| number.to_le_bytes())
            .collect();
        digest.update(bytes);
    }
}

pub(super) fn hexadecimal(digest: Sha256) -> String {
    let digits = digest.finalize();
    digits.iter().map(|byte| format!("{byte:02x}")).collect()
}
