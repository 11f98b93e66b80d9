//! Settings of a network's output layer: it predicts numbers or classes.

use crate::settings::SettingInfo;

pub(super) const HEAD: SettingInfo = SettingInfo {
    key: "head",
    accepts: "numbers or classes",
    default: "numbers; classes with --task",
    about: "outputs of the network: a number for each channel, or a score for each label of a single channel, of which the greatest is predicted",
};
pub(super) const CLASS_WEIGHTS: SettingInfo = SettingInfo {
    key: "class_weights",
    accepts: "equal or balanced",
    default: "equal",
    about: "weights of samples with head=classes: all equal, or such that rare classes count as much as frequent ones; probabilities are then those of \
            equally frequent classes",
};

/// Rule for the weight of each class in the loss.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ClassWeights {
    /// All samples have equal weights.
    Equal,
    /// The weights of a class's samples sum to the same value for every class. Rare classes thus count as much as frequent classes.
    Balanced,
}

impl ClassWeights {
    /// Parses the setting `class_weights`; `None` for an unknown word.
    pub(super) fn of(word: &str) -> Option<ClassWeights> {
        match word {
            "equal" => Some(ClassWeights::Equal),
            "balanced" => Some(ClassWeights::Balanced),
            _ => None,
        }
    }

    /// Weight in the loss of each of `count` classes; empty for equal weights. Each class must occur in `classes`, the class of each sample.
    pub(super) fn in_loss(self, classes: &[u32], count: usize) -> Vec<f64> {
        if self == ClassWeights::Equal {
            return Vec::new();
        }
        let mut samples = vec![0.0_f64; count];
        classes
            .iter()
            .for_each(|class| samples[*class as usize] += 1.0);
        let all = classes.len() as f64;
        let weight = |own: &f64| all / (count as f64 * own);
        samples.iter().map(weight).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn balanced_weights_give_each_class_the_same_sum_and_the_mean_weight_one() {
        let classes = [0, 0, 0, 1];
        let weights = ClassWeights::Balanced.in_loss(&classes, 2);
        assert!((3.0 * weights[0] - weights[1]).abs() < 1e-12, "{weights:?}");
        assert!(
            (3.0 * weights[0] + weights[1] - 4.0).abs() < 1e-12,
            "{weights:?}"
        );
        assert_eq!(ClassWeights::Equal.in_loss(&classes, 2), Vec::<f64>::new());
    }
}
