//! How finely a frame is looked at: the coarsest grid that costs no accuracy.

use std::fmt;

use serde::{Deserialize, Serialize};
use taceva_core::FrameInfo;

use crate::features::{FeatureSpec, SIZE};
use crate::settings::Settings;

/// What a person writes for `size` to have it chosen.
const CHOSEN: &str = "auto";

/// How the size of the features was chosen.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SizeCard {
    /// Samples of the training part that were not learnt from, and scored.
    pub samples: usize,
    /// How many independent groups they are.
    pub groups: usize,
    /// The sizes, from the coarsest to the finest.
    pub tried: Vec<SizeTrial>,
}

/// A size that was tried.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SizeTrial {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Root mean square error relative to the deviation of labels, over the channels that vary.
    pub error: f64,
    /// How much more of the labels' variance is missed than at the size of least error; 0 there.
    pub excess: f64,
    /// The standard error of that difference, by group.
    pub standard_error: f64,
}

impl SizeCard {
    /// `settings` without that of the size, where it is left open.
    pub fn left_open(settings: &Settings) -> Option<Settings> {
        (settings.get(SIZE.key) == Some(CHOSEN)).then(|| settings.clone().partition(&[SIZE]).1)
    }

    /// The sizes to try around that of `spec`, from the coarsest to the finest: a quarter, half, the whole and twice, as far as frames of
    /// `info` allow.
    ///
    /// ```
    /// use taceva_core::{FrameInfo, PixelFormat};
    /// use taceva_models::{FeatureSpec, SizeCard};
    /// let frame = FrameInfo { width: 160, height: 48, format: PixelFormat::Gray8 };
    /// let sizes = SizeCard::candidates(&FeatureSpec::DEFAULT, frame);
    /// let widths: Vec<u32> = sizes.iter().map(|spec| spec.width).collect();
    /// assert_eq!(widths, [8, 16, 32]);
    /// ```
    pub fn candidates(spec: &FeatureSpec, info: FrameInfo) -> Vec<FeatureSpec> {
        let scaled = |(times, parts): (u32, u32)| FeatureSpec {
            width: spec.width * times / parts,
            height: spec.height * times / parts,
            ..*spec
        };
        let fits = |spec: &FeatureSpec| {
            spec.is_valid() && spec.width <= info.width && spec.height <= info.height
        };
        let scales = [(1, 4), (1, 2), (1, 1), (2, 1)];
        scales.into_iter().map(scaled).filter(fits).collect()
    }

    /// The card of sizes with the loss of each scored sample: squared errors relative to the variance of labels, mean over channels.
    ///
    /// # Shapes
    /// `tried`: a size each, `[samples]`; `groups`: `[samples]`, a number for each independent group.
    pub fn new(tried: &[(FeatureSpec, Vec<f64>)], groups: &[usize]) -> SizeCard {
        let of_groups: Vec<Vec<f64>> = tried
            .iter()
            .map(|(_, losses)| means_of_groups(losses, groups))
            .collect();
        let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
        let least = of_groups
            .iter()
            .min_by(|left, right| mean(left).total_cmp(&mean(right)));
        let trial = |((spec, _), own): (&(FeatureSpec, Vec<f64>), &Vec<f64>)| {
            let least = least.expect("one of them");
            let excess: Vec<f64> = own
                .iter()
                .zip(least)
                .map(|(own, least)| own - least)
                .collect();
            let centre = mean(&excess);
            let squares: f64 = excess.iter().map(|value| (value - centre).powi(2)).sum();
            let freedom = (excess.len() * excess.len().saturating_sub(1)).max(1) as f64;
            SizeTrial {
                width: spec.width,
                height: spec.height,
                error: mean(own).sqrt(),
                excess: centre,
                standard_error: (squares / freedom).sqrt(),
            }
        };
        SizeCard {
            samples: groups.len(),
            groups: of_groups.first().map_or(0, Vec::len),
            tried: tried.iter().zip(&of_groups).map(trial).collect(),
        }
    }

    /// The coarsest size whose error exceeds the least by no more than one standard error of the difference.
    pub fn chosen(&self) -> Option<&SizeTrial> {
        self.tried
            .iter()
            .find(|trial| trial.excess <= trial.standard_error)
    }

    /// Whether the finest size tried is better than the next by more than one standard error: then a finer one may be better still.
    pub fn may_gain(&self) -> bool {
        match &self.tried[..] {
            [.., before, last] => last.excess <= 0.0 && before.excess > before.standard_error,
            _ => true,
        }
    }
}

/// The mean of each group, so that a group counts once however many samples it has.
fn means_of_groups(losses: &[f64], groups: &[usize]) -> Vec<f64> {
    let mut sums = std::collections::BTreeMap::<usize, (f64, f64)>::new();
    for (loss, group) in losses.iter().zip(groups) {
        let (sum, count) = sums.entry(*group).or_default();
        *sum += loss;
        *count += 1.0;
    }
    sums.into_values().map(|(sum, count)| sum / count).collect()
}

impl fmt::Display for SizeCard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(chosen) = self.chosen() else {
            return f.write_str("no size was tried");
        };
        let SizeTrial { width, height, .. } = chosen;
        write!(
            f,
            "size {width}×{height}: the coarsest within a standard error of the least on {} samples of {} groups left out; error relative to \
             the deviation of labels",
            self.samples, self.groups
        )?;
        for (position, trial) in self.tried.iter().enumerate() {
            let before = if position == 0 { " " } else { ", " };
            let SizeTrial { width, height, .. } = trial;
            write!(f, "{before}{width}×{height} {:.3}", trial.error)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tried(losses: [[f64; 6]; 3]) -> SizeCard {
        let sizes = [8, 16, 32].map(|side| FeatureSpec {
            width: side,
            height: side,
            ..FeatureSpec::DEFAULT
        });
        let tried: Vec<_> = sizes
            .into_iter()
            .zip(losses.map(|losses| losses.to_vec()))
            .collect();
        SizeCard::new(&tried, &[0, 0, 1, 1, 2, 2])
    }

    #[test]
    fn the_coarsest_is_taken_that_no_finer_one_beats_beyond_chance() {
        let coarse = [0.9, 0.9, 0.8, 0.8, 0.9, 0.9];
        let middle = [0.2, 0.2, 0.1, 0.1, 0.3, 0.3];
        let fine = [0.1, 0.1, 0.15, 0.15, 0.3, 0.3];
        let card = tried([coarse, middle, fine]);
        assert_eq!(card.chosen().map(|trial| trial.width), Some(16));
        assert!(!card.may_gain(), "{card:?}");
        let card = tried([coarse, middle, fine.map(|loss| loss / 4.0)]);
        assert_eq!(card.chosen().map(|trial| trial.width), Some(32));
        assert!(card.may_gain());
    }

    #[test]
    fn a_card_says_what_each_size_costs() {
        let text = tried([[0.25; 6], [0.04; 6], [0.04; 6]]).to_string();
        assert_eq!(
            text,
            "size 16×16: the coarsest within a standard error of the least on 6 samples of 3 groups left out; error relative to the \
             deviation of labels 8×8 0.500, 16×16 0.200, 32×32 0.200"
        );
    }

    #[test]
    fn a_size_is_left_open_by_a_word_and_only_by_that() {
        let parse = |words: &[&str]| Settings::parse(words.iter().copied()).expect("pairs");
        let open = SizeCard::left_open(&parse(&["size=auto", "color=rgb"]));
        assert_eq!(open, Some(parse(&["color=rgb"])));
        assert_eq!(SizeCard::left_open(&parse(&["size=32"])), None);
        assert_eq!(SizeCard::left_open(&parse(&["budget=auto"])), None);
    }
}
