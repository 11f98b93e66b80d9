//! Candidate models and the order of their trials.

use super::cost::{DEEPER, NETWORK, Sizes, seconds, work};
use crate::estimators::library::LibraryModel;
use crate::training::info::ModelInfo;

/// Fraction of the epochs that the first, shortened training of a network runs.
pub(super) const LOOK: f64 = 0.25;
/// Factor applied to a network's work when candidates are sorted. Networks are tried early, because they learn from whole pictures.
const EARLIER: f64 = 0.1;

/// A model to try.
#[derive(Clone, Copy, Debug)]
pub(super) struct Candidate {
    pub(super) info: &'static ModelInfo,
    /// Estimated work of one trial on one fold, in s at 10⁹ multiplications per second. For a network, with all its epochs.
    pub(super) fold_s: f64,
    /// Estimated work of the final fit, in s at 10⁹ multiplications per second.
    pub(super) fit_s: f64,
}

impl Candidate {
    pub(super) fn is_network(&self) -> bool {
        self.info.name == NETWORK
    }

    /// True for models that are fitted only if the user names them.
    pub(super) fn is_named_only(&self) -> bool {
        DEEPER.contains(&self.info.name)
    }

    /// Estimated work of the trial on the first fold, in s at 10⁹ multiplications per second.
    pub(super) fn first_s(&self) -> f64 {
        match self.is_network() {
            true => LOOK * self.fold_s,
            false => self.fold_s,
        }
    }

    fn order(&self) -> f64 {
        match self.is_network() {
            true => EARLIER * self.first_s(),
            false => self.first_s(),
        }
    }
}

/// Candidates of `models` and `libraries` that can be fitted to a part of size `sizes`, the cheapest first. The order counts a tenth of the work of a
/// network.
pub(super) fn candidates(
    models: &'static [ModelInfo],
    libraries: &[&'static LibraryModel],
    sizes: Sizes,
) -> Vec<Candidate> {
    let own = models.iter().filter_map(|info| {
        // A network learns from three folds. Other models are refitted on four with the chosen settings.
        let share = match info.name == NETWORK {
            true => 0.6,
            false => 0.8,
        };
        Some(Candidate {
            info,
            fold_s: seconds(work(info.name, sizes.share(share))?),
            fit_s: seconds(work(info.name, sizes)?),
        })
    });
    let of_libraries = libraries.iter().filter_map(|model| {
        let work = |sizes: Sizes| (model.work)(sizes.of_library());
        Some(Candidate {
            info: &model.info,
            fold_s: seconds(work(sizes.share(0.8))?),
            fit_s: seconds(work(sizes)?),
        })
    });
    let mut candidates: Vec<Candidate> = own.chain(of_libraries).collect();
    // A stable sort keeps the plainer of equal models first.
    candidates.sort_by(|left, right| left.order().total_cmp(&right.order()));
    candidates
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::estimators::registry::ALL;

    #[test]
    fn candidates_come_by_work_and_the_small_network_before_what_takes_a_tenth_of_it() {
        let sizes = Sizes {
            samples: 500.0,
            features: 1024.0,
            picture: Some(128.0 * 96.0),
            channels: 3.0,
        };
        let names = |sizes| -> Vec<&str> {
            let candidates = candidates(ALL, &[], sizes).into_iter();
            candidates.map(|candidate| candidate.info.name).collect()
        };
        let found = names(sizes);
        let position = |name: &str| found.iter().position(|found| *found == name);
        assert_eq!(found[0], "baseline");
        assert_eq!(found.last(), Some(&"resnet34"));
        // All models but `auto` itself and the ensemble.
        assert_eq!(found.len(), ALL.len() - 2);
        assert!(position("ridge") < position("cnn"), "{found:?}");
        assert!(position("cnn") < position("random-forest"), "{found:?}");
        let flat = names(Sizes {
            picture: None,
            ..sizes
        });
        let networks = |name: &&str| *name == "cnn" || name.starts_with("resnet");
        assert!(!flat.iter().any(networks), "{flat:?}");
    }
}
