//! Names, one per row.

use std::collections::HashMap;

/// One name per row, each distinct name kept once; a row may have none.
///
/// ```
/// use taceva_core::Labels;
/// let mut points = Labels::default();
/// ["left", "right", "left"].iter().for_each(|name| points.push(name));
/// assert_eq!((points.names().len(), points.get(2)), (2, Some("left")));
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Labels {
    names: Vec<String>,
    index: Vec<u32>,
    lookup: HashMap<String, u32>,
}

impl Labels {
    /// Adds a row called `name`.
    ///
    /// # Panics
    /// Beyond 2³² distinct names, which no memory holds.
    pub fn push(&mut self, name: &str) {
        let index = match self.lookup.get(name) {
            Some(&index) => index,
            None => {
                let index = u32::try_from(self.names.len())
                    .ok()
                    .filter(|index| *index != Labels::ABSENT)
                    .expect("fewer than 2^32 distinct names fit in memory");
                self.names.push(name.to_owned());
                self.lookup.insert(name.to_owned(), index);
                index
            }
        };
        self.index.push(index);
    }

    /// Whole numbers as names, a number a row, called by their digits.
    ///
    /// ```
    /// use taceva_core::Labels;
    /// let labels = Labels::of_numbers([7, -1, 7]);
    /// assert_eq!((labels.names(), labels.index()), (&["7".to_owned(), "-1".to_owned()][..], &[0, 1, 0][..]));
    /// ```
    ///
    /// # Panics
    /// Beyond 2³² distinct names, which no memory holds.
    pub fn of_numbers(numbers: impl IntoIterator<Item = i64>) -> Labels {
        let mut labels = Labels::default();
        let mut known: HashMap<i64, u32> = HashMap::new();
        let mut last = None;
        for number in numbers {
            // Samples of one point mostly follow each other, and looking a number up costs less than a text.
            let found = match last {
                Some((before, index)) if before == number => Some(index),
                _ => known.get(&number).copied(),
            };
            let index = found.unwrap_or_else(|| {
                labels.push(&number.to_string());
                // Its row is added below, as every other.
                labels.index.pop().expect("just pushed")
            });
            if found.is_none() {
                known.insert(number, index);
            }
            last = Some((number, index));
            labels.index.push(index);
        }
        labels
    }

    /// Adds a row without a name.
    pub fn push_absent(&mut self) {
        self.index.push(Labels::ABSENT);
    }

    /// The entry of [`index`](Labels::index) for a row without a name.
    pub const ABSENT: u32 = u32::MAX;

    /// The distinct names, in the order of their first row.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// For each row, which of the names it has; [`ABSENT`](Labels::ABSENT) for none.
    pub fn index(&self) -> &[u32] {
        &self.index
    }

    /// Whether every row has a name.
    pub fn all_named(&self) -> bool {
        !self.index.contains(&Labels::ABSENT)
    }

    /// The name of `row`, if it has one.
    pub fn get(&self, row: usize) -> Option<&str> {
        let index = self.index[row];
        (index != Labels::ABSENT).then(|| self.names[index as usize].as_str())
    }
}
