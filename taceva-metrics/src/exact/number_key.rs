//! Finite numbers as keys of maps.

use std::cmp::Ordering;

/// A finite binary64 with a total order. Both zeros are one key.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ordered(f64);

impl Ordered {
    /// Key of a finite `value`.
    pub(crate) fn new(value: f64) -> Ordered {
        Ordered(value + 0.0)
    }

    /// Number of the key.
    pub(crate) fn value(self) -> f64 {
        self.0
    }
}

impl PartialEq for Ordered {
    fn eq(&self, other: &Ordered) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Ordered {}

impl PartialOrd for Ordered {
    fn partial_cmp(&self, other: &Ordered) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Ordered {
    fn cmp(&self, other: &Ordered) -> Ordering {
        self.0.total_cmp(&other.0)
    }
}

/// Indices below `length`, sorted by `compare`. The sort is stable.
pub(crate) fn ranked(length: usize, compare: &dyn Fn(usize, usize) -> Ordering) -> Vec<usize> {
    let mut order: Vec<usize> = (0..length).collect();
    order.sort_by(|&left, &right| compare(left, right));
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_zeros_are_one_key() {
        assert_eq!(Ordered::new(-0.0), Ordered::new(0.0));
        assert!(Ordered::new(-1.0) < Ordered::new(-0.5));
        assert_eq!(Ordered::new(-0.0).value().to_bits(), 0);
    }
}
