//! Polynomial least squares by Householder reflections, in a centred and scaled variable.

/// Greatest number of coefficients.
pub(super) const MOST: usize = 4;

/// Coefficients of powers of z = (x − centre)/scale.
pub(super) type Coefficients = [f64; MOST];

/// Symmetric matrix with a row and a column per coefficient.
pub(super) type Square = [[f64; MOST]; MOST];

/// Centre and scale of x.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Axis {
    pub(super) centre: f64,
    pub(super) scale: f64,
}

impl Axis {
    /// Centre (mean) and scale (greatest distance from the mean); `None` if all x are equal.
    pub(super) fn of(x: &[f64]) -> Option<Axis> {
        let first = x.first()?;
        let off = x.iter().map(|x| x - first).sum::<f64>() / x.len() as f64;
        let centre = first + off;
        let scale = x.iter().map(|x| (x - centre).abs()).fold(0.0, f64::max);
        (scale > 0.0).then_some(Axis { centre, scale })
    }

    /// Powers 0 to 3 of (x − centre)/scale.
    pub(super) fn powers(&self, x: f64) -> Coefficients {
        let z = (x - self.centre) / self.scale;
        [1.0, z, z * z, z * z * z]
    }
}

/// Coefficients, sum of squared residuals, and (ZᵀZ)⁻¹ for the matrix Z whose rows are powers of the scaled x.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Solution {
    pub(super) coefficients: Coefficients,
    pub(super) squares: f64,
    pub(super) inverse: Square,
}

/// Solves the least-squares problem for rows of `count` powers; `None` if the columns are linearly dependent.
///
/// # Reference
/// Golub and Van Loan, Matrix Computations, 5.2.1 and 5.3.2.
pub(super) fn solve(rows: &[(Coefficients, f64)], count: usize) -> Option<Solution> {
    const DEPENDENT: f64 = 1e-10;
    let mut a: Vec<Coefficients> = rows.iter().map(|(powers, _)| *powers).collect();
    let mut y: Vec<f64> = rows.iter().map(|(_, y)| *y).collect();
    let mut r = Square::default();
    for column in 0..count {
        let whole: f64 = rows.iter().map(|(powers, _)| powers[column].powi(2)).sum();
        let square: f64 = a.iter().skip(column).map(|row| row[column].powi(2)).sum();
        if square.is_nan() || square <= whole * DEPENDENT * DEPENDENT {
            return None;
        }
        let length = -square.sqrt().copysign(a[column][column]);
        let mut v: Vec<f64> = a.iter().skip(column).map(|row| row[column]).collect();
        v[0] -= length;
        let scale = 2.0 / v.iter().map(|part| part * part).sum::<f64>();
        for other in column..count {
            let pairs = v.iter().zip(a.iter().skip(column));
            let dot = scale * pairs.map(|(part, row)| part * row[other]).sum::<f64>();
            let parts = v.iter().zip(a.iter_mut().skip(column));
            parts.for_each(|(part, row)| row[other] -= dot * part);
            r[column][other] = a[column][other];
        }
        let pairs = v.iter().zip(y.iter().skip(column));
        let dot = scale * pairs.map(|(part, y)| part * y).sum::<f64>();
        let parts = v.iter().zip(y.iter_mut().skip(column));
        parts.for_each(|(part, y)| *y -= dot * part);
    }
    let mut coefficients = Coefficients::default();
    for row in (0..count).rev() {
        let known = (row + 1..count).map(|other| r[row][other] * coefficients[other]);
        coefficients[row] = (y[row] - known.sum::<f64>()) / r[row][row];
    }
    Some(Solution {
        coefficients,
        squares: y.iter().skip(count).map(|rest| rest * rest).sum(),
        inverse: inverse_of_square(&r, count),
    })
}

/// Inverse of RᵀR for an upper triangle R: R⁻¹R⁻ᵀ.
fn inverse_of_square(r: &Square, count: usize) -> Square {
    // Columns of R⁻¹.
    let mut columns = Square::default();
    for (column, cells) in columns.iter_mut().enumerate().take(count) {
        for row in (0..=column).rev() {
            let own = if row == column { 1.0 } else { 0.0 };
            let known: f64 = (row + 1..=column).map(|k| r[row][k] * cells[k]).sum();
            cells[row] = (own - known) / r[row][row];
        }
    }
    let cell = |i: usize, j: usize| columns.iter().map(|cells| cells[i] * cells[j]).sum();
    std::array::from_fn(|i| std::array::from_fn(|j| cell(i, j)))
}

/// Bilinear form aᵀ M b.
pub(super) fn form(a: &Coefficients, matrix: &Square, b: &Coefficients) -> f64 {
    let row = |row: &Coefficients| row.iter().zip(b).map(|(cell, b)| cell * b).sum::<f64>();
    a.iter().zip(matrix).map(|(a, cells)| a * row(cells)).sum()
}
