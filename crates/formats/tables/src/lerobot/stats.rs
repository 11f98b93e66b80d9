//! Statistics of a feature over all rows of a LeRobot dataset, for `meta/stats.json`.

use serde_json::{Value, json};

/// Minimum, maximum, mean and standard deviation of each element of a feature, in the unit of the feature. Policies normalise data by these
/// statistics. They run over all added rows and pixels. They are not scores, and rounding errors accumulate with each row.
///
/// ```
/// use taceva_tables::FeatureStats;
/// let mut stats = FeatureStats::new(1);
/// for force in [1.0, 2.0, 3.0, f64::NAN] {
///     stats.add([force]);
/// }
/// assert_eq!(stats.mean(), [2.0]);
/// assert_eq!(stats.rows(), 4);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct FeatureStats {
    elements: Vec<Element>,
    rows: u64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Element {
    count: f64,
    least: f64,
    greatest: f64,
    mean: f64,
    /// Sum of squared deviations of the numbers from their mean (Welford 1962).
    squares: f64,
}

impl FeatureStats {
    /// Empty statistics of a feature with `length` numbers in each row.
    pub fn new(length: usize) -> FeatureStats {
        let nothing = Element {
            count: 0.0,
            least: f64::INFINITY,
            greatest: f64::NEG_INFINITY,
            mean: 0.0,
            squares: 0.0,
        };
        FeatureStats {
            elements: vec![nothing; length],
            rows: 0,
        }
    }

    /// Adds a row, one number per element. Skips a number that is not finite.
    pub fn add(&mut self, numbers: impl IntoIterator<Item = f64>) {
        self.rows += 1;
        let places = self.elements.iter_mut().zip(numbers);
        for (element, number) in places.filter(|(_, number)| number.is_finite()) {
            element.count += 1.0;
            element.least = element.least.min(number);
            element.greatest = element.greatest.max(number);
            let before = number - element.mean;
            element.mean += before / element.count;
            element.squares += before * (number - element.mean);
        }
    }

    /// Adds the pixels of a picture. `numbers` contains the colours of the first pixel, then of the second, and so on. A picture counts as one row.
    pub fn add_picture(&mut self, numbers: impl IntoIterator<Item = f64>) {
        let length = self.elements.len().max(1);
        let rows = self.rows + 1;
        let mut pixel = Vec::with_capacity(length);
        for number in numbers {
            pixel.push(number);
            if pixel.len() == length {
                self.add(pixel.drain(..));
            }
        }
        self.rows = rows;
    }

    /// Number of rows or pictures.
    pub fn rows(&self) -> u64 {
        self.rows
    }

    /// Mean of each element over its finite numbers; 0 for an element without any.
    pub fn mean(&self) -> Vec<f64> {
        self.elements.iter().map(|element| element.mean).collect()
    }

    /// Statistics in the form of `meta/stats.json`; `None` if an element has no finite number. Each element of a picture is nested: `[[0.5]]`.
    pub(super) fn json(&self, is_picture: bool) -> Option<Value> {
        let is_seen = self.elements.iter().all(|element| element.count > 0.0);
        if !is_seen || self.elements.is_empty() {
            return None;
        }
        let of = |value: fn(&Element) -> f64| -> Value {
            let values = self.elements.iter().map(value);
            match is_picture {
                true => values.map(|value| json!([[value]])).collect(),
                false => values.map(Value::from).collect(),
            }
        };
        Some(json!({
            "min": of(|element| element.least),
            "max": of(|element| element.greatest),
            "mean": of(|element| element.mean),
            "std": of(|element| (element.squares / element.count).max(0.0).sqrt()),
            "count": [self.rows],
        }))
    }
}
