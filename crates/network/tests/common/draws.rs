//! Random draws that other programs can reproduce, and networks filled with them.

#![allow(dead_code, reason = "the program `memory` uses a part of it")]

use taceva_network::{Architecture, NamedTensor, Network};

/// Random number `position` of `seed`, uniform in 0..1: the output of SplitMix64 at step position + 1.
pub(crate) fn unit(seed: u64, position: u64) -> f64 {
    let state = seed.wrapping_add((position + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15));
    let state = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let state = (state ^ (state >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((state ^ (state >> 31)) >> 11) as f64 * 0.5_f64.powi(53)
}

/// First `count` random numbers of `seed`, in single precision.
#[expect(
    clippy::cast_possible_truncation,
    reason = "inputs of single precision"
)]
pub(crate) fn singles(seed: u64, count: usize) -> Vec<f32> {
    (0..count as u64).map(|at| unit(seed, at) as f32).collect()
}

/// First `count` random numbers of `seed`.
pub(crate) fn doubles(seed: u64, count: usize) -> Vec<f64> {
    (0..count as u64).map(|at| unit(seed, at)).collect()
}

/// Network whose tensors, sorted by name, are computed from random numbers of the seeds `seed`, `seed` + 1, …
#[expect(
    clippy::cast_possible_truncation,
    reason = "weights of single precision"
)]
pub(crate) fn filled(architecture: &Architecture, seed: u64) -> Network {
    let empty = Network::new(architecture, 0).expect("a network that can be built");
    let tensors = (seed..).zip(empty.tensors()).map(|(seed, tensor)| {
        let last = tensor.name.rsplit('.').next().expect("a name");
        let shape: Vec<f64> = tensor.shape.iter().map(|&size| size as f64).collect();
        let value = |u: f64| match (shape.as_slice(), last) {
            ([outputs, _, rows, columns], _) => {
                (2.0 * u - 1.0) * (6.0 / (outputs * rows * columns)).sqrt()
            }
            ([_, features], _) => (2.0 * u - 1.0) / features.sqrt(),
            (_, "weight" | "running_var") => 0.75 + 0.5 * u,
            _ => 0.2 * (u - 0.5),
        };
        let draws = doubles(seed, tensor.values.len());
        NamedTensor {
            values: draws.into_iter().map(|u| value(u) as f32).collect(),
            ..tensor
        }
    });
    Network::from_tensors(architecture, tensors.collect::<Vec<_>>()).expect("its own tensors")
}
