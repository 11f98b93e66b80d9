//! Dot product of two vectors.

/// Dot product, computed with eight partial sums, so that additions do not wait for each other. Their order is fixed.
pub(crate) fn dot<T: Copy + Into<f64>>(left: &[f64], right: &[T]) -> f64 {
    let (left, last_left) = left.as_chunks::<8>();
    let (right, last_right) = right.as_chunks::<8>();
    let product = |(left, right): (&f64, &T)| -> f64 {
        let right: f64 = (*right).into();
        left * right
    };
    let mut sums = [0.0; 8];
    for (left, right) in left.iter().zip(right) {
        for (sum, pair) in sums.iter_mut().zip(left.iter().zip(right)) {
            *sum += product(pair);
        }
    }
    let last = last_left.iter().zip(last_right);
    sums.iter().sum::<f64>() + last.map(product).sum::<f64>()
}
