//! Lines that change between successive pictures, and single changes far beyond all earlier changes.

use std::collections::VecDeque;

use taceva_core::Frame;

use super::limit::{LEARNT, RUNS, WINDOW};

/// Least number of newest pictures beyond the limit that counts as a change.
const BEYOND: usize = 3;

/// Mean absolute change of the line that changes most from `before` to `frame`, minus the mean over all lines, as a share of full scale. A lasting
/// change appears only once.
pub(super) fn line_change(before: &Frame, frame: &Frame) -> f64 {
    let info = frame.info();
    let length = info.width as usize * info.format.samples();
    let height = info.height as usize;
    if length == 0 || height == 0 {
        return 0.0;
    }
    let mut lines = vec![0_u64; height];
    let numbers = before.samples().zip(frame.samples());
    for (place, (before, now)) in numbers.enumerate() {
        lines[place / length] += u64::from(before.abs_diff(now));
    }
    let farthest = lines.iter().copied().max().unwrap_or_default();
    let mean = lines.iter().sum::<u64>() as f64 / height as f64;
    (farthest as f64 - mean) / (length as f64 * f64::from(info.format.full_scale()))
}

/// One measured value of each untouched picture, with a limit that only outliers exceed.
#[derive(Clone, Debug)]
pub(super) struct Outliers {
    /// Least excess over the median that counts as beyond.
    least: f64,
    /// Number of pictures that set the limit.
    wanted: usize,
    learnt: Vec<f64>,
    /// Median and limit, set by the last of the `wanted` pictures.
    limit: Option<[f64; 2]>,
    newest: VecDeque<f64>,
}

impl Outliers {
    pub(super) fn new(least: f64) -> Outliers {
        Outliers {
            least,
            wanted: LEARNT,
            learnt: Vec::new(),
            limit: None,
            newest: VecDeque::new(),
        }
    }

    /// Sets the number of pictures that set the limit. Call it before the first picture.
    pub(super) fn want(&mut self, pictures: usize) {
        self.wanted = pictures;
    }

    /// Least excess over the median that is found. `None` before the limit is set.
    pub(super) fn smallest(&self) -> Option<f64> {
        self.limit.map(|[median, limit]| limit - median)
    }

    /// Takes the value of the next picture. If at least [`BEYOND`] of the newest pictures are beyond the limit, returns their median excess.
    pub(super) fn push(&mut self, number: f64) -> Option<f64> {
        let Some([median, limit]) = self.limit else {
            self.learnt.push(number);
            if self.learnt.len() >= self.wanted {
                self.limit = self.limit_of_learnt();
            }
            return None;
        };
        if self.newest.len() == WINDOW {
            self.newest.pop_front();
        }
        self.newest.push_back(number);
        let beyond = self.newest.iter().copied();
        let mut beyond: Vec<f64> = beyond.filter(|number| *number > limit).collect();
        beyond.sort_unstable_by(f64::total_cmp);
        (beyond.len() >= BEYOND).then(|| beyond[beyond.len() / 2] - median)
    }

    /// [`RUNS`] times the excess of the greatest value over the median.
    fn limit_of_learnt(&self) -> Option<[f64; 2]> {
        let mut sorted = self.learnt.clone();
        sorted.sort_unstable_by(f64::total_cmp);
        let (median, greatest) = (*sorted.get(sorted.len() / 2)?, *sorted.last()?);
        Some([median, median + self.least.max(RUNS * (greatest - median))])
    }
}

#[cfg(test)]
mod tests {
    use taceva_core::{FrameInfo, PixelFormat};

    use super::*;

    #[test]
    fn the_change_of_a_line_is_that_of_no_whole_picture() {
        let info = FrameInfo {
            width: 8,
            height: 4,
            format: PixelFormat::Gray8,
        };
        let picture = |of: fn(usize) -> u8| {
            let numbers = (0..32).map(|place| of(place / 8));
            Frame::new(info, numbers.collect()).expect("whole")
        };
        let rest = picture(|_| 100);
        let found = |other: &Frame| 255.0 * line_change(&rest, other);
        assert!(found(&picture(|_| 120)).abs() < 1e-12, "brighter");
        let lost = found(&picture(|line| if line == 2 { 20 } else { 100 }));
        assert!(
            (lost - 60.0).abs() < 1e-9,
            "80 of one line less 20 of the mean: {lost}"
        );
    }

    #[test]
    fn three_strange_pictures_among_thirty_are_a_change_and_two_are_none() {
        let mut outliers = Outliers::new(0.1);
        for number in 0..200_u8 {
            assert_eq!(outliers.push(f64::from(number % 5) / 100.0), None);
        }
        let smallest = outliers.smallest().expect("a limit");
        assert!((smallest - 0.1).abs() < 1e-12, "{smallest}");
        for _ in 0..100 {
            let newest = [0.5, 0.5].into_iter().chain([0.04; 28]);
            let found: Vec<f64> = newest.filter_map(|number| outliers.push(number)).collect();
            assert!(found.is_empty(), "{found:?}");
        }
        let found = [0.5, 0.5, 0.04, 0.5].map(|number| outliers.push(number));
        let excess = found[3].expect("a change");
        assert!((excess - 0.48).abs() < 1e-12, "{excess}");
    }
}
