//! Fit of a straight line to points.

/// A straight line y = `at_zero` + `slope` · x, fitted by least squares.
pub(super) struct Line {
    pub(super) at_zero: f64,
    pub(super) slope: f64,
    /// Standard deviation of a point from the line, along y.
    pub(super) deviation: f64,
    /// Standard error of `at_zero`.
    pub(super) error: f64,
}

impl Line {
    /// Fits a line through pairs of x and y.
    pub(super) fn through(points: &[(f64, f64)]) -> Line {
        let mut count = 0.0_f64;
        let (mut sum_x, mut sum_y) = (0.0, 0.0);
        for (x, y) in points {
            count += 1.0;
            sum_x += x;
            sum_y += y;
        }
        let (mean_x, mean_y) = (sum_x / count, sum_y / count);
        let (mut squares, mut products) = (0.0, 0.0);
        for (x, y) in points {
            squares += (x - mean_x).powi(2);
            products += (x - mean_x) * (y - mean_y);
        }
        let slope = products / squares;
        let at_zero = mean_y - slope * mean_x;
        let beside = points
            .iter()
            .map(|(x, y)| (y - at_zero - slope * x).powi(2));
        let deviation = (beside.sum::<f64>() / (count - 2.0)).sqrt();
        let error = deviation * (1.0 / count + mean_x * mean_x / squares).sqrt();
        Line {
            at_zero,
            slope,
            deviation,
            error,
        }
    }
}
