//! Fisher's linear discriminant.

/// Linear classifier for classes with a common covariance.
pub(crate) struct Discriminant {
    means: Vec<Vec<f64>>,
    /// For each class: covariance⁻¹ · mean, and half the scalar product of this vector with the mean.
    weights: Vec<(Vec<f64>, f64)>,
}

/// Ridge added to the variances, relative to their mean.
const RIDGE: f64 = 1e-3;

impl Discriminant {
    /// Fits the classifier to the vectors of each class.
    pub(crate) fn learn(classes: &[Vec<Vec<f64>>]) -> Discriminant {
        let width = classes[0][0].len();
        let means: Vec<Vec<f64>> = classes
            .iter()
            .map(|vectors| {
                let sum = |index: usize| vectors.iter().map(|vector| vector[index]).sum::<f64>();
                (0..width)
                    .map(|index| sum(index) / vectors.len() as f64)
                    .collect()
            })
            .collect();
        let mut covariance = vec![vec![0.0; width]; width];
        let mut count = 0.0;
        for (vectors, mean) in classes.iter().zip(&means) {
            for vector in vectors {
                count += 1.0;
                for row in 0..width {
                    for column in 0..width {
                        covariance[row][column] +=
                            (vector[row] - mean[row]) * (vector[column] - mean[column]);
                    }
                }
            }
        }
        let trace: f64 = (0..width).map(|index| covariance[index][index]).sum();
        for (index, row) in covariance.iter_mut().enumerate() {
            row[index] += RIDGE * trace / width as f64;
            for value in row {
                *value /= count;
            }
        }
        let weights = means
            .iter()
            .map(|mean| {
                let weight = solved(covariance.clone(), mean.clone());
                let half = 0.5 * product(&weight, mean);
                (weight, half)
            })
            .collect();
        Discriminant { means, weights }
    }

    /// Most probable class of a vector.
    pub(crate) fn classify(&self, vector: &[f64]) -> usize {
        let score = |class: usize| {
            let (weight, half) = &self.weights[class];
            product(weight, vector) - half
        };
        (0..self.means.len())
            .max_by(|one, other| score(*one).total_cmp(&score(*other)))
            .expect("there are classes")
    }
}

fn product(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(one, other)| one * other).sum()
}

/// Gaussian elimination for a positive definite matrix.
fn solved(mut matrix: Vec<Vec<f64>>, mut right: Vec<f64>) -> Vec<f64> {
    let size = right.len();
    for pivot in 0..size {
        for row in pivot + 1..size {
            let (above, below) = matrix.split_at_mut(row);
            let (above, below) = (&above[pivot], &mut below[0]);
            let part = below[pivot] / above[pivot];
            for (below, above) in below.iter_mut().zip(above).skip(pivot) {
                *below -= part * above;
            }
            right[row] -= part * right[pivot];
        }
    }
    for row in (0..size).rev() {
        let known: f64 = (row + 1..size)
            .map(|column| matrix[row][column] * right[column])
            .sum();
        right[row] = (right[row] - known) / matrix[row][row];
    }
    right
}
