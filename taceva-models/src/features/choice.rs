//! Choice of feature settings that the user leaves to TacEva. The simplest features without a loss of accuracy are chosen.

use std::collections::BTreeMap;
use std::fmt;

use serde::{Deserialize, Serialize};
use taceva_core::InputInfo;

use crate::features::{DIFFERENCE, FeatureSpec, SIZE};
use crate::settings::ModelSettings;

/// Setting value by which the user leaves a setting to TacEva.
const CHOSEN: &str = "auto";

/// Feature settings that TacEva chooses: size, difference, or both.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OpenFeatures {
    size: bool,
    difference: bool,
}

impl OpenFeatures {
    /// Separates the settings `size=auto` and `difference=auto` from all other settings. `None` if neither setting is given.
    pub fn of(settings: &ModelSettings) -> Option<(OpenFeatures, ModelSettings)> {
        let is_open = |key: &str| settings.get(key) == Some(CHOSEN);
        let open = OpenFeatures {
            size: is_open(SIZE.key),
            difference: is_open(DIFFERENCE.key),
        };
        let mut rest = settings.clone();
        for (is_open, setting) in [(open.size, SIZE), (open.difference, DIFFERENCE)] {
            if is_open {
                rest = rest.partition(&[setting]).1;
            }
        }
        (open.size || open.difference).then_some((open, rest))
    }

    /// Feature specifications to compare, the simplest first. They equal `spec` except for the settings that TacEva chooses. If the size is chosen,
    /// grids have 1/4, 1/2, 1 and 2 times the resolution of `spec`, as far as frames of `info` allow. Signals have one grid. If the difference is
    /// chosen, each grid is tried without and with it. Without a reference, or for markers and gradients alone, the difference is not tried.
    ///
    /// ```
    /// use taceva_core::{FrameInfo, PixelFormat};
    /// use taceva_models::{FeatureSpec, OpenFeatures, ModelSettings};
    /// let frame = FrameInfo { width: 160, height: 48, format: PixelFormat::Gray8 };
    /// let (open, _) = OpenFeatures::of(&ModelSettings::parse(["size=auto"])?).expect("the size is open");
    /// let tried = open.candidates(&FeatureSpec::DEFAULT, frame, true);
    /// let widths: Vec<u32> = tried.iter().map(|spec| spec.width).collect();
    /// assert_eq!(widths, [8, 16, 32]);
    /// # Ok::<(), taceva_models::SettingError>(())
    /// ```
    pub fn candidates(
        self,
        spec: &FeatureSpec,
        info: impl Into<InputInfo>,
        has_reference: bool,
    ) -> Vec<FeatureSpec> {
        let frame = match info.into() {
            InputInfo::Frame(frame) => Some(frame),
            _ => None,
        };
        let scales: &[(u32, u32)] = match self.size && frame.is_some() {
            true => &[(1, 4), (1, 2), (1, 1), (2, 1)],
            false => &[(1, 1)],
        };
        // Markers and gradients compare with the reference anyway.
        let may_differ = has_reference && spec.kinds.iter().any(|kind| !kind.needs_reference());
        let differences: &[bool] = match (self.difference, may_differ) {
            (true, true) => &[false, true],
            (true, false) => &[false],
            (false, _) => &[spec.difference],
        };
        let mut candidates = Vec::new();
        for (times, parts) in scales {
            let (width, height) = (spec.width * times / parts, spec.height * times / parts);
            candidates.extend(differences.iter().map(|&difference| FeatureSpec {
                width,
                height,
                difference,
                ..*spec
            }));
        }
        // A frame too small for the requested size causes its own error later.
        candidates.retain(|candidate| {
            let fits = frame.is_none_or(|frame| {
                candidate.width <= frame.width && candidate.height <= frame.height
            });
            candidate.is_valid() && (fits || !self.size)
        });
        candidates
    }
}

/// Record of a choice of features.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FeatureChoice {
    /// Number of training samples that were held out and scored.
    pub samples: usize,
    /// Number of independent groups, such as contact points, among the scored samples.
    pub groups: usize,
    /// Results of the compared features, the simplest first.
    pub tried: Vec<FeatureTrial>,
    /// Features for which no model could be fitted.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub failed: Vec<FailedFeatures>,
}

/// Features for which no model could be fitted, and the reason.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FailedFeatures {
    /// Specification of these features.
    pub features: FeatureSpec,
    /// Reason for which the fit failed.
    pub reason: String,
}

/// Accuracy of the models fitted to one of the compared features.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FeatureTrial {
    /// Specification of these features.
    pub features: FeatureSpec,
    /// Root mean square prediction error of the channels whose labels vary, in standard deviations of the labels. Every group of samples has equal
    /// weight.
    pub error: f64,
    /// Mean squared error relative to label variance, minus that of the most accurate features. 0 for the most accurate features.
    pub excess: f64,
    /// Standard error of `excess`, from its scatter between groups.
    pub standard_error: f64,
}

impl FeatureTrial {
    /// True if the features are at most one standard error less accurate than the most accurate features.
    fn is_enough(&self) -> bool {
        self.excess <= self.standard_error
    }

    fn cells(&self) -> u64 {
        u64::from(self.features.width) * u64::from(self.features.height)
    }
}

impl FeatureChoice {
    /// Compares features by their losses. The loss of a sample is its squared error relative to label variance, averaged over channels.
    ///
    /// # Shapes
    /// `tried`, the simplest first: `[samples]` each. `groups`: `[samples]`, the number of each sample's independent group.
    pub fn new(tried: &[(FeatureSpec, Vec<f64>)], groups: &[usize]) -> FeatureChoice {
        let losses = tried.iter().map(|(_, losses)| of_groups(losses, groups));
        let losses: Vec<Vec<f64>> = losses.collect();
        let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
        let least = losses
            .iter()
            .min_by(|left, right| mean(left).total_cmp(&mean(right)));
        let trial = |((features, _), own): (&(FeatureSpec, Vec<f64>), &Vec<f64>)| {
            let least = least.expect("one of them");
            let excess = own.iter().zip(least).map(|(own, least)| own - least);
            let excess: Vec<f64> = excess.collect();
            let centre = mean(&excess);
            let squares: f64 = excess.iter().map(|value| (value - centre).powi(2)).sum();
            let freedom = excess.len() * excess.len().saturating_sub(1);
            FeatureTrial {
                features: *features,
                error: mean(own).sqrt(),
                excess: centre,
                standard_error: (squares / freedom.max(1) as f64).sqrt(),
            }
        };
        FeatureChoice {
            samples: groups.len(),
            groups: losses.first().map_or(0, Vec::len),
            tried: tried.iter().zip(&losses).map(trial).collect(),
            failed: Vec::new(),
        }
    }

    /// Sets the list of features for which no model could be fitted, with the reasons.
    #[must_use]
    pub fn with_failed(
        mut self,
        failed: impl IntoIterator<Item = (FeatureSpec, String)>,
    ) -> FeatureChoice {
        let failed = failed.into_iter();
        self.failed = failed
            .map(|(features, reason)| FailedFeatures { features, reason })
            .collect();
        self
    }

    /// The simplest features that are at most one standard error less accurate than the best. `None` if there are none.
    pub fn chosen(&self) -> Option<&FeatureTrial> {
        self.tried.iter().find(|trial| trial.is_enough())
    }

    /// True if only the finest grid is accurate enough. A still finer grid may then improve the model.
    pub fn may_gain(&self) -> bool {
        let finest = self.tried.iter().map(FeatureTrial::cells).max();
        let enough = self.tried.iter().filter(|trial| trial.is_enough());
        enough
            .into_iter()
            .all(|trial| Some(trial.cells()) == finest)
    }
}

/// Mean loss over the samples of each group, in ascending order of group numbers. A large group thus counts no more than a small group.
fn of_groups(losses: &[f64], groups: &[usize]) -> Vec<f64> {
    let mut sums = BTreeMap::<usize, (f64, f64)>::new();
    for (loss, group) in losses.iter().zip(groups) {
        let (sum, count) = sums.entry(*group).or_default();
        *sum += loss;
        *count += 1.0;
    }
    sums.into_values().map(|(sum, count)| sum / count).collect()
}

impl fmt::Display for FeatureChoice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(chosen) = self.chosen() else {
            return f.write_str("no features were tried");
        };
        write!(
            f,
            "features {}: the simplest within a standard error of the least error on {} held-out samples of {} groups; errors relative \
                to the standard deviation of labels:",
            chosen.features, self.samples, self.groups
        )?;
        for (position, trial) in self.tried.iter().enumerate() {
            let before = if position == 0 { " " } else { "; " };
            write!(f, "{before}{} {:.3}", trial.features, trial.error)?;
        }
        for FailedFeatures { features, reason } in &self.failed {
            write!(f, "; {features} not fitted ({reason})")?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use taceva_core::{FrameInfo, PixelFormat};

    fn of_sides<const N: usize>(losses: [(u32, [f64; 6]); N]) -> FeatureChoice {
        let tried = losses.map(|(side, losses)| {
            let features = FeatureSpec {
                width: side,
                height: side,
                ..FeatureSpec::DEFAULT
            };
            (features, losses.to_vec())
        });
        FeatureChoice::new(&tried, &[0, 0, 1, 1, 2, 2])
    }

    #[test]
    fn the_simplest_are_taken_that_no_finer_ones_beat_beyond_chance() {
        let coarse = [0.9, 0.9, 0.8, 0.8, 0.9, 0.9];
        let middle = [0.2, 0.2, 0.1, 0.1, 0.3, 0.3];
        let fine = [0.1, 0.1, 0.15, 0.15, 0.3, 0.3];
        let width = |choice: &FeatureChoice| choice.chosen().map(|trial| trial.features.width);
        let choice = of_sides([(8, coarse), (16, middle), (32, fine)]);
        assert_eq!(width(&choice), Some(16));
        assert!(!choice.may_gain(), "{choice:?}");
        let choice = of_sides([(8, coarse), (16, middle), (32, fine.map(|loss| loss / 4.0))]);
        assert_eq!(width(&choice), Some(32));
        assert!(choice.may_gain());
    }

    #[test]
    fn a_choice_says_what_each_costs() {
        let text = of_sides([(8, [0.25; 6]), (16, [0.04; 6]), (32, [0.04; 6])]).to_string();
        assert_eq!(
            text,
            "features 16×16 gray: the simplest within a standard error of the least error on 6 held-out samples of 3 groups; errors \
             relative to the standard deviation of labels: 8×8 gray 0.500; 16×16 gray 0.200; 32×32 gray 0.200"
        );
    }

    #[test]
    fn differences_are_tried_where_there_is_something_to_differ_from() {
        let parse = |words: &[&str]| ModelSettings::parse(words.iter().copied()).expect("pairs");
        let settings = parse(&["difference=auto", "color=rgb"]);
        let (open, rest) = OpenFeatures::of(&settings).expect("open");
        assert_eq!(rest, parse(&["color=rgb"]));
        let info = FrameInfo {
            width: 64,
            height: 64,
            format: PixelFormat::Gray8,
        };
        let tried = |has_reference| open.candidates(&FeatureSpec::DEFAULT, info, has_reference);
        let differences = |has_reference: bool| -> Vec<bool> {
            let tried = tried(has_reference).into_iter();
            tried.map(|spec| spec.difference).collect()
        };
        assert_eq!(differences(true), [false, true]);
        assert_eq!(differences(false), [false]);
        let both = parse(&["size=auto", "difference=auto"]);
        let (open, _) = OpenFeatures::of(&both).expect("open");
        assert_eq!(open.candidates(&FeatureSpec::DEFAULT, info, true).len(), 8);
        assert_eq!(OpenFeatures::of(&parse(&["size=32", "budget=auto"])), None);
    }
}
