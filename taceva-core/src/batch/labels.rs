//! Column with a name or no name in each row.

use std::collections::HashMap;
use std::sync::Arc;

/// One optional name per row. Each distinct name is stored once.
///
/// ```
/// use taceva_core::Labels;
/// let mut points = Labels::default();
/// ["left", "right", "left"].iter().for_each(|name| points.push(name));
/// assert_eq!((points.names().len(), points.get(2)), (2, Some("left")));
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Labels {
    known: Arc<Known>,
    index: Vec<u32>,
}

/// Distinct names. [`Labels`] that differ only in the order of their rows share them.
#[derive(Clone, Debug, Default, PartialEq)]
struct Known {
    names: Vec<String>,
    lookup: HashMap<String, u32>,
}

/// Maximum size of the lookup table for whole numbers, in entries per row. A larger range of numbers uses a hash map.
const PLACES_A_ROW: usize = 4;

impl Labels {
    /// Adds a row called `name`.
    ///
    /// # Panics
    /// If the labels would have 2³² distinct names.
    pub fn push(&mut self, name: &str) {
        // Rows of one name mostly follow each other.
        if let Some(&last) = self.index.last()
            && self
                .names()
                .get(last as usize)
                .is_some_and(|known| known == name)
        {
            self.index.push(last);
            return;
        }
        let index = match self.known.lookup.get(name) {
            Some(&index) => index,
            None => {
                let index = u32::try_from(self.names().len())
                    .ok()
                    .filter(|index| *index != Labels::ABSENT)
                    .expect("fewer than 2^32 distinct names fit in memory");
                let known = Arc::make_mut(&mut self.known);
                known.names.push(name.to_owned());
                known.lookup.insert(name.to_owned(), index);
                index
            }
        };
        self.index.push(index);
    }

    /// Labels from whole numbers, one per row, named by their digits.
    ///
    /// ```
    /// use taceva_core::Labels;
    /// let labels = Labels::of_numbers([7, -1, 7]);
    /// assert_eq!((labels.names(), labels.index()), (&["7".to_owned(), "-1".to_owned()][..], &[0, 1, 0][..]));
    /// ```
    ///
    /// # Panics
    /// If the labels would have 2³² distinct names.
    pub fn of_numbers(numbers: impl IntoIterator<Item = i64>) -> Labels {
        let numbers: Vec<i64> = numbers.into_iter().collect();
        let mut labels = Labels::default();
        let least = numbers.iter().copied().min().unwrap_or(0);
        let most = numbers.iter().copied().max().unwrap_or(0);
        // Point numbers are mostly dense; a table then costs less than a hash map.
        match most.checked_sub(least).map(usize::try_from) {
            Some(Ok(width)) if width / PLACES_A_ROW < numbers.len() => {
                let mut places = vec![Labels::ABSENT; width + 1];
                for number in numbers {
                    let place = usize::try_from(number - least).expect("between the two");
                    if places[place] == Labels::ABSENT {
                        places[place] = labels.named(number);
                    }
                    labels.index.push(places[place]);
                }
            }
            _ => {
                let mut known: HashMap<i64, u32> = HashMap::new();
                for number in numbers {
                    let index = *known.entry(number).or_insert_with(|| labels.named(number));
                    labels.index.push(index);
                }
            }
        }
        labels
    }

    /// Adds the digits of `number` as a name, without a row, and returns the index of the name.
    fn named(&mut self, number: i64) -> u32 {
        self.push(&number.to_string());
        // The caller adds the row.
        self.index.pop().expect("just pushed")
    }

    /// Adds a row without a name.
    pub fn push_absent(&mut self) {
        self.index.push(Labels::ABSENT);
    }

    /// The entry of [`index`](Labels::index) for a row without a name.
    pub const ABSENT: u32 = u32::MAX;

    /// The distinct names, in the order in which they were added.
    pub fn names(&self) -> &[String] {
        &self.known.names
    }

    /// Index of each row's name in [`names`](Labels::names); [`ABSENT`](Labels::ABSENT) for a row without a name.
    pub fn index(&self) -> &[u32] {
        &self.index
    }

    /// Labels in the order of the row indices `rows`, each row once. The list of names is unchanged.
    ///
    /// ```
    /// use taceva_core::Labels;
    /// let labels = Labels::of_numbers([7, -1, 7]);
    /// assert_eq!(labels.in_order(&[1, 0]).get(0), Some("-1"));
    /// ```
    ///
    /// # Panics
    /// If an index is out of range.
    #[must_use]
    pub fn in_order(&self, rows: &[u32]) -> Labels {
        Labels {
            known: Arc::clone(&self.known),
            index: rows.iter().map(|&row| self.index[row as usize]).collect(),
        }
    }

    /// True if every row has a name.
    pub fn all_named(&self) -> bool {
        !self.index.contains(&Labels::ABSENT)
    }

    /// The name of `row`; `None` for a row without a name.
    pub fn get(&self, row: usize) -> Option<&str> {
        let index = self.index[row];
        (index != Labels::ABSENT).then(|| self.names()[index as usize].as_str())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_named_by_their_digits_however_far_apart_they_lie() {
        let lists: [&[i64]; 5] = [
            &[],
            &[5],
            &[3, 1, 2, 3, 3, -1, 1],
            &[1_000_000, 0, 1_000_000, -7],
            &[i64::MIN, i64::MAX, 0, i64::MIN],
        ];
        for numbers in lists {
            let mut expected = Labels::default();
            for number in numbers {
                expected.push(&number.to_string());
            }
            let labels = Labels::of_numbers(numbers.iter().copied());
            assert_eq!(labels, expected, "{numbers:?}");
        }
    }
}
