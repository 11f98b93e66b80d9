//! Prediction of classes from network outputs: the class of the greatest output, and probabilities by softmax with one fitted temperature.

/// Allowed range of the softmax temperature. Outside it, probabilities are nearly equal, or nearly 0 and 1.
const RANGE: [f64; 2] = [0.05, 20.0];

/// Number of bisection steps in the search for the inverse temperature.
const HALVINGS: usize = 60;

/// Appends to `into` the softmax of `outputs` divided by `temperature`.
pub(super) fn softmax(outputs: &[f64], temperature: f64, into: &mut Vec<f64>) {
    let most = outputs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let start = into.len();
    into.extend(
        outputs
            .iter()
            .map(|output| ((output - most) / temperature).exp()),
    );
    let sum: f64 = into[start..].iter().sum();
    into[start..].iter_mut().for_each(|share| *share /= sum);
}

/// Index of the greatest of `outputs`; the first index if several are equal.
pub(super) fn greatest(outputs: &[f64]) -> usize {
    let mut places = 0..outputs.len();
    let first = places.next().unwrap_or(0);
    places.fold(first, |best, place| {
        if outputs[place] > outputs[best] {
            place
        } else {
            best
        }
    })
}

/// Softmax temperature that maximises the likelihood of the true `classes`. The negative log likelihood is convex in the inverse temperature, so its
/// slope has one zero.
///
/// # Shapes
/// `outputs`: `[samples, width]`; `classes`: `[samples]`.
/// # Reference
/// C. Guo, G. Pleiss, Y. Sun, K. Q. Weinberger, "On calibration of modern neural networks", ICML 2017.
pub(super) fn temperature(outputs: &[f64], width: usize, classes: &[u32]) -> f64 {
    let [least, most] = RANGE;
    let (mut low, mut high) = (1.0 / most, 1.0 / least);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        match slope(outputs, width, classes, middle) > 0.0 {
            true => high = middle,
            false => low = middle,
        }
    }
    (2.0 / (low + high)).clamp(least, most)
}

/// Derivative of the negative log likelihood with respect to the inverse temperature. Each sample adds its expected output minus the output of its
/// true class.
fn slope(outputs: &[f64], width: usize, classes: &[u32], inverse: f64) -> f64 {
    let mut shares = Vec::with_capacity(width);
    let each = outputs.chunks_exact(width).zip(classes);
    each.map(|(outputs, class)| {
        shares.clear();
        softmax(outputs, 1.0 / inverse, &mut shares);
        let expected: f64 = shares.iter().zip(outputs).map(|(p, z)| p * z).sum();
        expected - outputs[*class as usize]
    })
    .sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_are_those_of_the_frequencies_with_which_outputs_are_right() {
        // Outputs claim odds of e⁴, and three of four samples are right: odds of 3.
        let outputs = [4.0, 0.0].repeat(4);
        let found = temperature(&outputs, 2, &[0, 0, 0, 1]);
        assert!((found - 4.0 / 3.0_f64.ln()).abs() < 1e-9, "{found}");
        let mut shares = Vec::new();
        softmax(&[4.0, 0.0], found, &mut shares);
        assert!((shares[0] - 0.75).abs() < 1e-12, "{shares:?}");
    }

    #[test]
    fn a_temperature_stays_in_its_range_if_all_or_no_samples_are_right() {
        let outputs = [4.0, 0.0].repeat(3);
        let all_right = temperature(&outputs, 2, &[0, 0, 0]);
        assert!((all_right - RANGE[0]).abs() < 1e-9, "{all_right}");
        let none_right = temperature(&outputs, 2, &[1, 1, 1]);
        assert!((none_right - RANGE[1]).abs() < 1e-6, "{none_right}");
    }
}
