//! Running sums that round at every addition, some with compensation of the rounding errors.

/// A running sum.
pub(super) trait RunningSum: Copy + Default {
    /// Adds a number.
    fn add(&mut self, value: f64);
    /// Sum of the added numbers.
    fn total(self) -> f64;
}

/// Running sum in binary64, rounded at every addition.
#[derive(Clone, Copy, Default)]
pub(super) struct Plain(f64);

impl RunningSum for Plain {
    #[inline]
    fn add(&mut self, value: f64) {
        self.0 += value;
    }

    fn total(self) -> f64 {
        self.0
    }
}

/// Running sum in binary32, rounded at every addition, as is usual on graphics cards.
#[derive(Clone, Copy, Default)]
pub(super) struct Single(f32);

impl RunningSum for Single {
    #[inline]
    #[expect(
        clippy::cast_possible_truncation,
        reason = "this sum rounds to binary32"
    )]
    fn add(&mut self, value: f64) {
        self.0 += value as f32;
    }

    fn total(self) -> f64 {
        f64::from(self.0)
    }
}

/// Running sum that carries each rounding error into the next addition (Kahan 1965).
#[derive(Clone, Copy, Default)]
pub(super) struct Kahan {
    sum: f64,
    error: f64,
}

impl RunningSum for Kahan {
    #[inline]
    fn add(&mut self, value: f64) {
        let value = value - self.error;
        let next = self.sum + value;
        self.error = (next - self.sum) - value;
        self.sum = next;
    }

    fn total(self) -> f64 {
        self.sum
    }
}

/// Running sum of the numbers, with a separate sum of the rounding errors (Neumaier 1974).
#[derive(Clone, Copy, Default)]
pub(super) struct Neumaier {
    sum: f64,
    errors: f64,
}

impl RunningSum for Neumaier {
    #[inline]
    fn add(&mut self, value: f64) {
        let next = self.sum + value;
        self.errors += if self.sum.abs() >= value.abs() {
            (self.sum - next) + value
        } else {
            (value - next) + self.sum
        };
        self.sum = next;
    }

    fn total(self) -> f64 {
        self.sum + self.errors
    }
}

/// Sum of `term` over all rows by recursive halving of the rows. Blocks of at most 128 rows are summed in order, as in numpy.
pub(super) fn pairwise<T: Copy>(rows: &[T], term: &impl Fn(T) -> f64) -> f64 {
    if rows.len() <= 128 {
        return rows.iter().fold(0.0, |sum, &row| sum + term(row));
    }
    let (left, right) = rows.split_at(rows.len() / 2);
    pairwise(left, term) + pairwise(right, term)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn total<S: RunningSum>(values: &[f64]) -> f64 {
        let mut sum = S::default();
        values.iter().for_each(|&value| sum.add(value));
        sum.total()
    }

    #[test]
    fn each_keeps_what_the_one_before_loses() {
        let small = [1.0, 2.0_f64.powi(-53), 2.0_f64.powi(-53)];
        assert_eq!(total::<Plain>(&small).to_bits(), 1.0_f64.to_bits());
        assert_eq!(
            total::<Kahan>(&small).to_bits(),
            (1.0 + f64::EPSILON).to_bits()
        );
        let large = [1.0, 1e100, 1.0, -1e100];
        assert_eq!(total::<Kahan>(&large).to_bits(), 0.0_f64.to_bits());
        assert_eq!(total::<Neumaier>(&large).to_bits(), 2.0_f64.to_bits());
    }
}
