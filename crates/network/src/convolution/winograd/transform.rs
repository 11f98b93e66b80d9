//! Winograd transforms along one dimension. Polynomials are evaluated at the points 0, a, −a, b, −b and ∞ with a² = ½ and b² = 2.

use super::{SIDE, TILE};
use crate::simd::Vector;
use taceva_core::single;

const A: f64 = std::f64::consts::FRAC_1_SQRT_2;
const B: f64 = std::f64::consts::SQRT_2;
const A2: f64 = 0.5;
const B2: f64 = 2.0;

/// Factors of kernels at the points ±a and ±b, where a² = ½ and b² = 2. At the point 0 the factor is 1, because a²b² = 1.
const AT_A: f64 = 1.0 / (2.0 * A2 * (A2 - B2));
const AT_B: f64 = 1.0 / (2.0 * B2 * (B2 - A2));

/// Vector with the same constant in every lane.
#[inline(always)]
fn constant<V: Vector>(proof: V::Proof, value: f64) -> V {
    V::constant(proof, single(value))
}

/// Product of `vector` and `factor`.
#[inline(always)]
fn times<V: Vector>(proof: V::Proof, vector: V, factor: f64) -> V {
    vector.times_plus(constant(proof, factor), V::zero(proof))
}

/// Computes `vector` · `factor` + `addend`.
#[inline(always)]
fn times_plus<V: Vector>(proof: V::Proof, vector: V, factor: f64, addend: V) -> V {
    vector.times_plus(constant(proof, factor), addend)
}

/// Transforms the inputs of a tile (Bᵀd in the paper of Lavin and Gray).
#[inline(always)]
pub(super) fn input<V: Vector>(proof: V::Proof, d: [V; SIDE]) -> [V; SIDE] {
    let even_a = times_plus(proof, d[2], -B2, d[4]);
    let odd_a = times_plus(proof, d[1], -B2, d[3]);
    let even_b = times_plus(proof, d[2], -A2, d[4]);
    let odd_b = times_plus(proof, d[1], -A2, d[3]);
    [
        d[0].plus(times_plus(proof, d[2], -(A2 + B2), d[4])),
        times_plus(proof, odd_a, A, even_a),
        times_plus(proof, odd_a, -A, even_a),
        times_plus(proof, odd_b, B, even_b),
        times_plus(proof, odd_b, -B, even_b),
        d[1].plus(times_plus(proof, d[3], -(A2 + B2), d[5])),
    ]
}

/// Transforms the sums at the points back to outputs (Aᵀm in the paper of Lavin and Gray).
#[inline(always)]
pub(super) fn output<V: Vector>(proof: V::Proof, m: [V; SIDE]) -> [V; TILE] {
    let (even_a, odd_a) = (m[1].plus(m[2]), times_plus(proof, m[2], -1.0, m[1]));
    let (even_b, odd_b) = (m[3].plus(m[4]), times_plus(proof, m[4], -1.0, m[3]));
    [
        m[0].plus(even_a).plus(even_b),
        times_plus(proof, odd_a, A, times(proof, odd_b, B)),
        times_plus(proof, even_a, A2, times(proof, even_b, B2)),
        times_plus(proof, odd_a, A * A2, times_plus(proof, odd_b, B * B2, m[5])),
    ]
}

/// Transforms the gradient of a tile of outputs to the gradient of the sums at the points (Ay, with A of Lavin and Gray).
#[inline(always)]
pub(super) fn gradient<V: Vector>(proof: V::Proof, y: [V; TILE]) -> [V; SIDE] {
    let even_a = times_plus(proof, y[2], A2, y[0]);
    let odd_a = times_plus(proof, y[1], A, times(proof, y[3], A * A2));
    let even_b = times_plus(proof, y[2], B2, y[0]);
    let odd_b = times_plus(proof, y[1], B, times(proof, y[3], B * B2));
    [
        y[0],
        even_a.plus(odd_a),
        times_plus(proof, odd_a, -1.0, even_a),
        even_b.plus(odd_b),
        times_plus(proof, odd_b, -1.0, even_b),
        y[3],
    ]
}

/// Transforms a row of a kernel (Gw, with G of Lavin and Gray).
#[inline(always)]
pub(super) fn kernel<V: Vector>(proof: V::Proof, w: [V; 3]) -> [V; SIDE] {
    let even_a = times_plus(proof, w[2], A2 * AT_A, times(proof, w[0], AT_A));
    let even_b = times_plus(proof, w[2], B2 * AT_B, times(proof, w[0], AT_B));
    [
        w[0],
        times_plus(proof, w[1], A * AT_A, even_a),
        times_plus(proof, w[1], -A * AT_A, even_a),
        times_plus(proof, w[1], B * AT_B, even_b),
        times_plus(proof, w[1], -B * AT_B, even_b),
        w[2],
    ]
}

/// Transforms the gradient at the points to the gradient of a row of a kernel (Gᵀu, with G of Lavin and Gray).
#[inline(always)]
pub(super) fn kernel_gradient<V: Vector>(proof: V::Proof, u: [V; SIDE]) -> [V; 3] {
    let (even_a, odd_a) = (u[1].plus(u[2]), times_plus(proof, u[2], -1.0, u[1]));
    let (even_b, odd_b) = (u[3].plus(u[4]), times_plus(proof, u[4], -1.0, u[3]));
    [
        times_plus(proof, even_a, AT_A, times_plus(proof, even_b, AT_B, u[0])),
        times_plus(proof, odd_a, A * AT_A, times(proof, odd_b, B * AT_B)),
        times_plus(
            proof,
            even_a,
            A2 * AT_A,
            times_plus(proof, even_b, B2 * AT_B, u[5]),
        ),
    ]
}
