//! Integrals of smooth functions. The range is divided into panels, each integrated by the ten-point Gauss–Legendre rule.

/// Points of the rule in one half of a panel: distance from the middle of the panel, and weight. Both are fractions of half the width.
const POINTS: [[f64; 2]; 5] = [
    [0.148_874_338_981_631_22, 0.295_524_224_714_752_87],
    [0.433_395_394_129_247_2, 0.269_266_719_309_996_35],
    [0.679_409_568_299_024_4, 0.219_086_362_515_982_04],
    [0.865_063_366_688_984_5, 0.149_451_349_150_580_6],
    [0.973_906_528_517_171_7, 0.066_671_344_308_688_14],
];

/// Quadrature point with its weight.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    pub(super) at: f64,
    pub(super) weight: f64,
}

/// Quadrature points over `from`..`to`, in panels no wider than `width`.
pub(super) fn nodes(from: f64, to: f64, width: f64) -> Vec<Node> {
    let panels = ((to - from) / width).ceil().max(1.0);
    let half = (to - from) / panels / 2.0;
    let (mut nodes, mut panel) = (Vec::new(), 0.0);
    while panel < panels {
        let middle = from + (2.0 * panel + 1.0) * half;
        for [off, weight] in POINTS {
            for at in [middle - off * half, middle + off * half] {
                let weight = weight * half;
                nodes.push(Node { at, weight });
            }
        }
        panel += 1.0;
    }
    nodes
}

/// Integral of a smooth `function` over `from`..`to`, with ten points in each panel. Panels are no wider than `width`.
///
/// ```
/// use taceva_metrics::distributions::{integral, normal};
/// assert!((integral(normal::density, -9.0, 9.0, 1.0) - 1.0).abs() < 1e-14);
/// ```
#[must_use]
pub fn integral(function: impl Fn(f64) -> f64, from: f64, to: f64, width: f64) -> f64 {
    let nodes = nodes(from, to, width).into_iter();
    nodes.map(|node| node.weight * function(node.at)).sum()
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
