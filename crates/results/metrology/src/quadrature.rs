//! Integrals of smooth functions by Gauss and Legendre's rule of ten points in each panel.

/// Distances of the points from the middle of a panel, and their weights, in halves of the panel.
const POINTS: [[f64; 2]; 5] = [
    [0.148_874_338_981_631_22, 0.295_524_224_714_752_87],
    [0.433_395_394_129_247_2, 0.269_266_719_309_996_35],
    [0.679_409_568_299_024_4, 0.219_086_362_515_982_04],
    [0.865_063_366_688_984_5, 0.149_451_349_150_580_6],
    [0.973_906_528_517_171_7, 0.066_671_344_308_688_14],
];

/// ∫ of `function` over `from`..`to`, in panels no wider than `width`.
pub(crate) fn integral(function: impl Fn(f64) -> f64, from: f64, to: f64, width: f64) -> f64 {
    let panels = ((to - from) / width).ceil().max(1.0);
    let half = (to - from) / panels / 2.0;
    let (mut sum, mut panel) = (0.0, 0.0);
    while panel < panels {
        let middle = from + (2.0 * panel + 1.0) * half;
        for [off, weight] in POINTS {
            sum += weight * (function(middle - off * half) + function(middle + off * half));
        }
        panel += 1.0;
    }
    sum * half
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_polynomial_of_degree_nineteen_is_exact() {
        let found = integral(|x| x.powi(19) + x.powi(4), 0.0, 1.0, 1.0);
        assert!((found - 0.25).abs() < 1e-15, "{found}");
    }
}
