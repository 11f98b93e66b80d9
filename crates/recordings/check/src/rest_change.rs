//! Change of the untouched picture, compared with the change by contact.

use crate::tiles::Tiles;

/// Change of the untouched picture above which it is reported, as a fraction of the change by contact. Both changes are means over all tiles.
const THIRD: f64 = 1.0 / 3.0;

/// Change of the untouched picture since the reference, and the change by contact for comparison.
///
/// # Units
/// Values are fractions of the full scale of the pixel format.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RestChange {
    /// Mean change of the untouched picture, over all tiles.
    pub mean: f64,
    /// Maximum change of a tile of the untouched picture.
    pub greatest: f64,
    /// Mean change by contact, over all tiles; the median over the pictures with contact.
    pub contact_mean: f64,
    /// Maximum change of a tile by contact; the median over the pictures with contact.
    pub contact_greatest: f64,
}

impl RestChange {
    /// Compares the change from `reference` to `rest` with the changes from `rest` to the `pressed` pictures. `None` without a change by contact, or for
    /// pictures of different sizes.
    pub fn of(reference: &Tiles, rest: &Tiles, pressed: &[&Tiles]) -> Option<RestChange> {
        let found = RestChange {
            mean: rest.distance(reference),
            greatest: rest.greatest(reference),
            contact_mean: median(pressed.iter().map(|tiles| rest.distance(tiles))),
            contact_greatest: median(pressed.iter().map(|tiles| rest.greatest(tiles))),
        };
        let is_known = found.mean.is_finite() && found.contact_mean.is_finite();
        let has_contact = found.contact_mean > 0.0 && found.contact_greatest > 0.0;
        (is_known && has_contact).then_some(found)
    }

    /// True if the mean change exceeds a third of `contact_mean`.
    pub fn is_overall(&self) -> bool {
        self.mean > THIRD * self.contact_mean
    }

    /// True if the maximum change of a tile exceeds `contact_greatest`.
    pub fn is_local(&self) -> bool {
        self.greatest > self.contact_greatest
    }
}

/// Median of `numbers`, or the lower of two middle numbers; 0 without numbers.
pub(crate) fn lower_median(numbers: impl Iterator<Item = f64>) -> f64 {
    in_order(numbers, |count| count.saturating_sub(1) / 2)
}

/// Median of `numbers`, or the upper of two middle numbers; 0 without numbers.
fn median(numbers: impl Iterator<Item = f64>) -> f64 {
    in_order(numbers, |count| count / 2)
}

/// Number at the index `position(count)` in ascending order; 0 for no numbers.
fn in_order(numbers: impl Iterator<Item = f64>, position: fn(usize) -> usize) -> f64 {
    let mut sorted: Vec<f64> = numbers.collect();
    sorted.sort_by(f64::total_cmp);
    let number = sorted.get(position(sorted.len()));
    number.copied().unwrap_or(0.0)
}
