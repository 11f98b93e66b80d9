//! Key of a stage's result: the digest of all its inputs.

use std::fmt::{self, Debug};

use taceva_dataset::Digest;

/// A stage of a run whose result is stored in the cache.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, serde::Serialize)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum CachedStage {
    /// Acquisition of the presses of a study. The result is a recording.
    Acquire,
    /// Computation of the features of a recording's frames.
    Features,
    /// Fit of the model.
    Fit,
    /// Prediction of the presses that the model was not fitted on.
    Predict,
    /// Prediction of spacings for presses on gratings.
    Classify,
}

impl CachedStage {
    /// Every stage, in the order of a run.
    pub const ALL: [CachedStage; 5] = [
        CachedStage::Acquire,
        CachedStage::Features,
        CachedStage::Fit,
        CachedStage::Predict,
        CachedStage::Classify,
    ];

    /// Name of the stage in files and folders.
    pub const fn name(self) -> &'static str {
        match self {
            CachedStage::Acquire => "acquire",
            CachedStage::Features => "features",
            CachedStage::Fit => "fit",
            CachedStage::Predict => "predict",
            CachedStage::Classify => "classify",
        }
    }

    /// Version of the stage's result. It must be incremented if the same inputs give another result within one version of this program.
    const fn version(self) -> u32 {
        match self {
            // 2: the recording states how its presses ended.
            // 3: the recording has a frame of the untouched gel.
            CachedStage::Acquire => 3,
            // 2: standard deviations follow the predictions.
            // 3: predictions are unclipped.
            CachedStage::Predict => 3,
            // 2: elastic nets stop their descent earlier; Gaussian processes extrapolate as far as they state.
            // 3: the card states the mean of the labels.
            // 4: residual networks train with Winograd convolutions, and their cards state the form in which they predict.
            CachedStage::Fit => 4,
            // 2: the same change as version 2 of `Fit`.
            CachedStage::Classify => 2,
            CachedStage::Features => 1,
        }
    }
}

/// Key of a stage's result.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct Key {
    stage: CachedStage,
    digest: Digest,
}

impl Key {
    /// Starts the key of a result of `stage`. The caller then adds the parts of the key.
    pub fn of(stage: CachedStage) -> KeyBuilder {
        let builder = KeyBuilder {
            stage,
            parts: Vec::new(),
        };
        builder
            .part("stage", stage.name())
            .part("version", &stage.version().to_string())
            .part("taceva", env!("CARGO_PKG_VERSION"))
    }

    /// Stage of the result.
    pub fn stage(&self) -> CachedStage {
        self.stage
    }

    /// The 64 hexadecimal digits that name the entry.
    pub fn digits(&self) -> String {
        let bytes = self.digest.as_bytes().iter();
        bytes.map(|byte| format!("{byte:02x}")).collect()
    }
}

impl fmt::Display for Key {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(&self.digest, f)
    }
}

/// Builder of a key. Parts are added with their name and length, so that different sequences of parts never give the same key.
pub struct KeyBuilder {
    stage: CachedStage,
    parts: Vec<u8>,
}

impl KeyBuilder {
    /// Adds a text part.
    pub fn part(mut self, name: &str, part: &str) -> KeyBuilder {
        for text in [name, part] {
            self.parts.extend((text.len() as u64).to_le_bytes());
            self.parts.extend(text.as_bytes());
        }
        self
    }

    /// Adds a part in its `Debug` form. This form names every field, so a field that is added to the type later becomes part of the key.
    pub fn whole(self, name: &str, part: &impl Debug) -> KeyBuilder {
        self.part(name, &format!("{part:?}"))
    }

    /// Computes the key of all parts.
    pub fn finish(self) -> Key {
        Key {
            stage: self.stage,
            digest: Digest::of(&self.parts),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_differ_in_stage_name_and_part_and_parts_do_not_run_together() {
        let keys = [
            Key::of(CachedStage::Fit).finish(),
            Key::of(CachedStage::Classify).finish(),
            Key::of(CachedStage::Fit).part("ab", "c").finish(),
            Key::of(CachedStage::Fit).part("a", "bc").finish(),
            Key::of(CachedStage::Fit)
                .part("a", "b")
                .part("c", "")
                .finish(),
        ];
        for (position, key) in keys.iter().enumerate() {
            assert!(keys[..position].iter().all(|other| other != key), "{key}");
        }
        let again = Key::of(CachedStage::Fit).part("ab", "c").finish();
        assert_eq!(again.digits(), keys[2].digits());
    }
}
