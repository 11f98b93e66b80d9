//! Law of propagation of uncertainty, with effective degrees of freedom and second-order terms.

use super::correlation::Correlations;
use super::expression::Expansion;
use super::freedom::{Freedom, Undefined};
use super::input::Input;

/// First-order combined uncertainty.
pub(super) struct Combined {
    pub(super) u: f64,
    pub(super) freedom: Freedom,
    /// Standard uncertainty including second-order terms.
    pub(super) second_order_u: f64,
    /// Indices of the two inputs with the greatest second-order term.
    pub(super) greatest_term: Option<[usize; 2]>,
}

/// Combined uncertainty of the model. The derivatives in `expansion` are those of the inputs, then those of constants.
///
/// u² = Σ cᵢ²uᵢ² + 2 ΣΣ cᵢcⱼuᵢuⱼrᵢⱼ, with the sensitivity cᵢ and standard uncertainty uᵢ of input i, and the correlation rᵢⱼ.
///
/// Degrees of freedom by Welch and Satterthwaite, with the inputs of a set as one component (GUM H.2).
///
/// # Reference
/// GUM 5.1.2, 5.2.2 and G.4.1. The second-order terms are ½ tr((HΣ)²), H the Hessian and Σ the covariance; third derivatives are omitted.
pub(super) fn combine(inputs: &[Input], expansion: &Expansion, r: &Correlations) -> Combined {
    let contributions = contributions(inputs, expansion);
    let covariance = |i: usize, j: usize| contributions[i] * contributions[j] * r.get(i, j);
    let count = inputs.len();
    let (mut total, mut fourth, mut is_correlated) = (0.0, 0.0, false);
    for (i, input) in inputs.iter().enumerate() {
        let is_same = |j: &usize| *j == i || input.is_of_set_of(&inputs[*j]);
        for (j, other) in inputs.iter().enumerate() {
            total += covariance(i, j);
            let is_finite = input.is_of_finite_freedom() || other.is_of_finite_freedom();
            is_correlated |= !is_same(&j) && is_finite && covariance(i, j).abs() > 0.0;
        }
        // One component, counted at its first input.
        let members: Vec<usize> = (0..count).filter(is_same).collect();
        if let (Some(true), Freedom::Finite(number)) =
            (members.first().map(|at| *at == i), input.freedom)
        {
            let row = |j: &usize| members.iter().map(|k| covariance(*j, *k)).sum::<f64>();
            fourth += members.iter().map(row).sum::<f64>().powi(2) / number;
        }
    }
    let variance = total.max(0.0);
    let freedom = if variance <= 0.0 {
        Freedom::Undefined(Undefined::NoUncertainty)
    } else if is_correlated {
        Freedom::Undefined(Undefined::CorrelatedFreedom)
    } else if fourth > 0.0 {
        Freedom::Finite(variance * variance / fourth)
    } else {
        Freedom::Infinite
    };
    let (second, greatest_term) = second_order(inputs, expansion, r);
    Combined {
        u: variance.sqrt(),
        freedom,
        second_order_u: (variance + second).sqrt(),
        greatest_term,
    }
}

/// Contribution of each input: sensitivity times standard uncertainty.
pub(super) fn contributions(inputs: &[Input], expansion: &Expansion) -> Vec<f64> {
    let slopes = inputs.iter().zip(&expansion.gradient);
    slopes.map(|(input, slope)| slope * input.u).collect()
}

/// Second-order variance ½ tr((HΣ)²) for the Hessian H and the covariance Σ.
///
/// Also returns the indices i, j with the greatest |Hᵢⱼ| uᵢ uⱼ, for standard uncertainties u.
fn second_order(
    inputs: &[Input],
    expansion: &Expansion,
    r: &Correlations,
) -> (f64, Option<[usize; 2]>) {
    let (count, width) = (inputs.len(), expansion.gradient.len());
    let curved = |i: usize, j: usize| expansion.hessian[i * width + j] * inputs[i].u * inputs[j].u;
    // In units of the standard uncertainties: scaled Hessian times correlations.
    let mut product = vec![0.0; count * count];
    let mut greatest = (0.0, None);
    for i in 0..count {
        for j in 0..count {
            product[i * count + j] = (0..count).map(|k| curved(i, k) * r.get(k, j)).sum();
            // A squared term counts half.
            let size = curved(i, j).abs()
                * if i == j {
                    std::f64::consts::FRAC_1_SQRT_2
                } else {
                    1.0
                };
            if i <= j && size > greatest.0 {
                greatest = (size, Some([i, j]));
            }
        }
    }
    let trace: f64 = (0..count)
        .flat_map(|i| (0..count).map(move |j| [i, j]))
        .map(|[i, j]| product[i * count + j] * product[j * count + i])
        .sum();
    (trace.max(0.0) / 2.0, greatest.1)
}
