//! Copies of an unfitted network with shorter training, or with another seed.

use super::NetworkEstimator;
use taceva_core::whole_count;

impl NetworkEstimator {
    /// Copy that trains for `share` of the epochs, at least one, without checkpoints. The learning-rate cycle is shortened to these epochs.
    pub(super) fn shortened(&self, share: f64) -> NetworkEstimator {
        let mut own = self.with_recipe(|recipe| {
            let epochs = whole_count((share * recipe.epochs as f64).round());
            recipe.epochs = epochs.max(1);
        });
        own.checkpoints = None;
        own
    }

    /// Copy with the seed increased by `by`. The copy writes no checkpoints.
    pub(super) fn with_later_seed(&self, by: u64) -> NetworkEstimator {
        let mut own = self.with_recipe(|recipe| recipe.seed = recipe.seed.wrapping_add(by));
        own.checkpoints = None;
        own
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::settings::ModelSettings;

    #[test]
    fn a_shorter_training_has_a_share_of_the_epochs_and_at_least_one() {
        let of = |words: &[&str]| {
            let settings = ModelSettings::parse(words.iter().copied()).expect("pairs");
            NetworkEstimator::cnn(&settings).expect("valid")
        };
        assert_eq!(of(&["epochs=80"]).shortened(0.25), of(&["epochs=20"]));
        assert_eq!(of(&["epochs=1"]).shortened(0.25), of(&["epochs=1"]));
    }
}
