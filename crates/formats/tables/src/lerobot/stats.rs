//! What a feature is like over all rows, as `meta/stats.json` says it: policies normalise by it.

use serde_json::{Value, json};

/// Least, greatest, mean and standard deviation of each element of a feature, in its unit. Policies normalise by them; they are no scores, and are rounded with each
/// row.
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
    /// The sum of squared differences from the mean (Welford 1962).
    squares: f64,
}

impl FeatureStats {
    /// The statistics of a feature of `length` numbers a row, before its first row.
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

    /// Adds a row, a number an element; one that is not finite is left out of its element.
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

    /// Adds the pixels of a picture, a number an element and pixel, the elements of a pixel together; they count as one row.
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

    /// How many rows there were, or pictures.
    pub fn rows(&self) -> u64 {
        self.rows
    }

    /// The mean of each element, 0 of one that had no number.
    pub fn mean(&self) -> Vec<f64> {
        self.elements.iter().map(|element| element.mean).collect()
    }

    /// As `meta/stats.json` has it; none if an element had no number, of which nothing can be said. Elements of a picture lie in lists of lists.
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
