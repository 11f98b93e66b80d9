//! Unpenalised least squares, accurate to the last digits.

mod double;
mod householder;

#[cfg(test)]
mod strd;

use faer::Mat;
use taceva_core::ModelError;

use self::double::Double;
use self::householder::Householder;
use crate::linalg::invalid;

/// A matrix whose values may have more than double precision.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wide<'a> {
    pub(crate) high: &'a Mat<f64>,
    /// Rounding errors of `high`; `None` if all are 0.
    pub(crate) low: Option<&'a Mat<f64>>,
}

impl Wide<'_> {
    /// Value at a position, with its rounding error.
    fn at(&self, row: usize, column: usize) -> Double {
        let low = self.low.map_or(0.0, |low| low[(row, column)]);
        Double::new(self.high[(row, column)], low)
    }
}

/// Least-squares solution for one column of targets.
#[derive(Clone, Debug)]
pub(crate) struct Solution {
    /// Solution after refinement.
    pub(crate) refined: Vec<f64>,
    /// Solution of the decomposition in double precision, before refinement.
    #[cfg(test)]
    pub(crate) plain: Vec<f64>,
}

/// Maximum number of refinement steps. Each step adds as many correct digits as one solution in double precision has.
const ROUNDS: usize = 40;

/// Finds the x of least ‖y − A x‖ for the matrix A and each column y of `targets`.
///
/// The Householder decomposition of A, with columns scaled by powers of two, gives x and the residual r. Each refinement step computes the residuals
/// of the system r + A x = y, Aᵀr = 0 in doubled precision. The decomposition then gives corrections of x and r. Refinement ends when corrections no
/// longer shrink.
///
/// # Reference
/// Å. Björck, BIT 7 (1967) 257, 322.
/// # Errors
/// [`ModelError`] if there are fewer rows than columns, or a column is a linear combination of earlier columns to within rounding.
pub(crate) fn least_squares(
    matrix: Wide<'_>,
    targets: &Mat<f64>,
) -> Result<Vec<Solution>, ModelError> {
    let (rows, columns) = (matrix.high.nrows(), matrix.high.ncols());
    if rows < columns {
        return Err(invalid(format!(
            "{rows} samples for {columns} weights: least squares needs at least as many; set `strength` above 0 for fewer"
        )));
    }
    let decomposition = Householder::new(matrix.high.clone());
    if let Some(column) = decomposition.dependent() {
        return Err(invalid(format!(
            "column {column} is a linear combination of earlier columns: set `strength` above 0"
        )));
    }
    let solve = |target: usize| solve(matrix, &decomposition, targets.col_as_slice(target));
    Ok((0..targets.ncols()).map(solve).collect())
}

fn solve(matrix: Wide<'_>, decomposition: &Householder, target: &[f64]) -> Solution {
    let (rows, columns) = (matrix.high.nrows(), matrix.high.ncols());
    let (first, residual) = decomposition.solve(target, &vec![0.0; columns]);
    let mut weights: Vec<Double> = first.iter().map(|&value| Double::new(value, 0.0)).collect();
    let mut residual: Vec<Double> = residual
        .iter()
        .map(|&value| Double::new(value, 0.0))
        .collect();
    let mut before = f64::INFINITY;
    for _ in 0..ROUNDS {
        let upper: Vec<f64> = (0..rows)
            .map(|row| {
                let start = Double::new(target[row], 0.0) - residual[row];
                let columns = weights.iter().enumerate();
                let sum = columns.fold(start, |sum, (column, weight)| {
                    sum - matrix.at(row, column) * *weight
                });
                sum.value()
            })
            .collect();
        let lower: Vec<f64> = (0..columns)
            .map(|column| {
                let rows = residual.iter().enumerate();
                let sum = rows.fold(Double::new(0.0, 0.0), |sum, (row, residual)| {
                    sum - matrix.at(row, column) * *residual
                });
                sum.value()
            })
            .collect();
        let (change, shift) = decomposition.solve(&upper, &lower);
        let size = relative(&change, &weights);
        // NaN ends the loop too.
        if size.is_nan() || size >= 0.5 * before {
            break;
        }
        before = size;
        for (weight, change) in weights.iter_mut().zip(&change) {
            *weight = *weight + Double::new(*change, 0.0);
        }
        for (residual, shift) in residual.iter_mut().zip(&shift) {
            *residual = *residual + Double::new(*shift, 0.0);
        }
        if size <= f64::EPSILON * f64::EPSILON {
            break;
        }
    }
    Solution {
        refined: weights.iter().map(Double::value).collect(),
        #[cfg(test)]
        plain: first,
    }
}

/// Greatest magnitude among `changes`, each relative to its weight.
fn relative(changes: &[f64], weights: &[Double]) -> f64 {
    let of = |(change, weight): (&f64, &Double)| match weight.value().abs() {
        size if size > 0.0 => change.abs() / size,
        _ => change.abs(),
    };
    changes.iter().zip(weights).map(of).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_that_repeat_others_and_too_few_rows_are_refused() {
        let matrix = Mat::from_fn(4, 3, |row, column| match column {
            2 => 3.0 * row as f64 + 1.0,
            column => (row as f64).powi(i32::try_from(column).expect("small")),
        });
        let targets = Mat::from_fn(4, 1, |row, _| row as f64);
        let wide = |matrix| Wide {
            high: matrix,
            low: None,
        };
        let error = least_squares(wide(&matrix), &targets).expect_err("dependent");
        assert!(
            error
                .to_string()
                .starts_with("column 2 is a linear combination"),
            "{error}"
        );
        let few = Mat::from_fn(2, 3, |row, column| (row * column) as f64);
        let error = least_squares(wide(&few), &Mat::zeros(2, 1)).expect_err("few");
        assert!(
            error.to_string().starts_with("2 samples for 3 weights"),
            "{error}"
        );
    }
}
