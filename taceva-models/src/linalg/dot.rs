//! Dot product of two vectors.

/// Dot product with eight partial sums, so that additions do not wait for each other. The order is fixed.
pub(crate) fn dot(left: &[f64], right: &[f64]) -> f64 {
    let (left, last_left) = left.as_chunks::<8>();
    let (right, last_right) = right.as_chunks::<8>();
    let mut sums = [0.0; 8];
    for (left, right) in left.iter().zip(right) {
        for ((sum, left), right) in sums.iter_mut().zip(left).zip(right) {
            *sum += left * right;
        }
    }
    let last = last_left.iter().zip(last_right);
    sums.iter().sum::<f64>() + last.map(|(left, right)| left * right).sum::<f64>()
}
