//! Scales from values to positions, and the ticks of axes.

use crate::number::{fixed, minus, numeral};

/// Margin beyond the values at both ends, as a part of their range.
const BEYOND: f64 = 0.04;

/// Linear or logarithmic scale from values to positions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Scale {
    values: [f64; 2],
    places: [f64; 2],
    is_logarithmic: bool,
}

/// Labelled value of an axis.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Tick {
    pub(crate) value: f64,
    pub(crate) label: String,
}

impl Scale {
    /// Linear scale. Widens an empty range.
    pub(crate) fn linear(values: [f64; 2], places: [f64; 2]) -> Scale {
        Scale {
            values: widened(values),
            places,
            is_logarithmic: false,
        }
    }

    /// Linear scale with a margin beyond both values, so that no mark is on an edge.
    pub(crate) fn padded(values: [f64; 2], places: [f64; 2]) -> Scale {
        let [low, high] = widened(values);
        let beyond = (high - low) * BEYOND;
        Scale::linear([low - beyond, high + beyond], places)
    }

    /// Linear scale between round values that contain `values`.
    pub(crate) fn round(values: [f64; 2], places: [f64; 2]) -> Scale {
        let [low, high] = widened(values);
        let step = step([low, high], 5.0);
        let ends = [(low / step + 1e-9).floor(), (high / step - 1e-9).ceil()];
        Scale::linear(ends.map(|end| end * step), places)
    }

    /// Logarithmic scale; both values must be above 0.
    pub(crate) fn logarithmic([low, high]: [f64; 2], places: [f64; 2]) -> Scale {
        let low = low.max(f64::MIN_POSITIVE);
        Scale {
            values: [low, high.max(low * 1.01)],
            places,
            is_logarithmic: true,
        }
    }

    /// Lowest and highest value of the scale.
    pub(crate) fn values(&self) -> [f64; 2] {
        self.values
    }

    /// Position of `value`. Extrapolates beyond the ends.
    pub(crate) fn at(&self, value: f64) -> f64 {
        let [low, high] = self.values;
        let share = if self.is_logarithmic {
            (value.max(f64::MIN_POSITIVE) / low).ln() / (high / low).ln()
        } else {
            (value - low) / (high - low)
        };
        let [from, to] = self.places;
        from + share * (to - from)
    }

    /// About `count` labelled round values within the scale.
    pub(crate) fn ticks(&self, count: f64) -> Vec<Tick> {
        if self.is_logarithmic {
            return self.logarithmic_ticks();
        }
        let [low, high] = self.values;
        let step = step(self.values, count);
        let decimals = decimals(step);
        let (first, last) = ((low / step - 1e-9).ceil(), (high / step + 1e-9).floor());
        let mut ticks = Vec::new();
        let mut number = first;
        while number <= last && ticks.len() < 50 {
            let value = number * step;
            ticks.push(Tick {
                value,
                label: minus(&fixed(value, decimals)),
            });
            number += 1.0;
        }
        ticks
    }

    fn logarithmic_ticks(&self) -> Vec<Tick> {
        let [low, high] = self.values;
        let decades = (high / low).log10();
        let multiples: &[f64] = if decades > 2.5 {
            &[1.0]
        } else if decades > 1.0 {
            &[1.0, 2.0, 5.0]
        } else {
            &[1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 7.0]
        };
        let mut ticks = Vec::new();
        let mut decade = low.log10().floor();
        while decade <= high.log10() {
            for multiple in multiples {
                let value = multiple * 10_f64.powf(decade);
                if value >= low * (1.0 - 1e-9) && value <= high * (1.0 + 1e-9) {
                    ticks.push(Tick {
                        value,
                        label: numeral(value),
                    });
                }
            }
            decade += 1.0;
        }
        ticks
    }
}

/// Lowest and highest finite value; `None` without a finite value.
pub(crate) fn extent(values: impl IntoIterator<Item = f64>) -> Option<[f64; 2]> {
    values.into_iter().filter(|value| value.is_finite()).fold(
        None,
        |ends: Option<[f64; 2]>, value| {
            let [low, high] = ends.unwrap_or([value; 2]);
            Some([low.min(value), high.max(value)])
        },
    )
}

fn widened([low, high]: [f64; 2]) -> [f64; 2] {
    if high > low {
        return [low, high];
    }
    let half = if low.abs() > 0.0 {
        low.abs() / 2.0
    } else {
        0.5
    };
    [low - half, low + half]
}

/// Step of 1, 2 or 5 times a power of ten, for about `count` steps in the range.
fn step([low, high]: [f64; 2], count: f64) -> f64 {
    let raw = (high - low) / count.max(1.0);
    let power = 10_f64.powf(raw.log10().floor());
    let factor = match raw / power {
        ratio if ratio < 1.5 => 1.0,
        ratio if ratio < 3.5 => 2.0,
        ratio if ratio < 7.5 => 5.0,
        _ => 10.0,
    };
    factor * power
}

/// Number of decimals of a multiple of `step`.
fn decimals(step: f64) -> usize {
    let decimals = (0..12).find(|&decimals| step * 10_f64.powi(decimals) > 0.99);
    decimals.map_or(12, |decimals| decimals.unsigned_abs() as usize)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(scale: &Scale) -> Vec<String> {
        scale
            .ticks(5.0)
            .into_iter()
            .map(|tick| tick.label)
            .collect()
    }

    #[test]
    fn ticks_are_round_and_inside() {
        let scale = Scale::linear([-0.13, 0.42], [0.0, 100.0]);
        assert_eq!(labels(&scale), ["−0.1", "0.0", "0.1", "0.2", "0.3", "0.4"]);
        let scale = Scale::logarithmic([0.9, 120.0], [0.0, 100.0]);
        assert_eq!(labels(&scale), ["1", "2", "5", "10", "20", "50", "100"]);
    }

    #[test]
    fn a_range_without_width_has_one() {
        let scale = Scale::linear([3.0, 3.0], [0.0, 10.0]);
        assert!((scale.at(3.0) - 5.0).abs() < 1e-12);
        let [low, high] = Scale::round([0.0, 0.0], [0.0, 1.0]).values();
        assert!((low + 0.6).abs() < 1e-12 && (high - 0.6).abs() < 1e-12);
    }

    #[test]
    fn ends_become_round_outwards_only() {
        let [low, high] = Scale::round([0.03, 0.98], [0.0, 1.0]).values();
        assert!((low - 0.0).abs() < 1e-12 && (high - 1.0).abs() < 1e-12);
    }
}
