//! Sum of two columns at memory bandwidth, the lower bound of the run time of every kernel.

use taceva_core::Isa;

use crate::exact::{Job, Machine, Vector};
use crate::pair::Paired;

/// Number of independent partial sums per column. An addition need not wait for the result of the previous addition.
const IN_FLIGHT: usize = 4;

/// Rounded sum of all values of both columns, in eight independent vector sums with the widest available vectors. The run time is a lower bound for
/// reading both columns from memory.
pub fn stream_sum(pairs: Paired<&[f64]>) -> f64 {
    let widest = Isa::available().into_iter().find_map(Machine::with);
    widest.unwrap_or_else(Machine::detect).run(Reading(pairs))
}

struct Reading<'a>(Paired<&'a [f64]>);

impl Job for Reading<'_> {
    type Output = f64;

    #[inline(always)]
    fn run<V: Vector>(self, proof: V::Proof) -> f64 {
        let Paired {
            estimate,
            reference,
        } = self.0;
        let mut sums = [[V::splat(proof, 0.0); IN_FLIGHT]; 2];
        let estimates = estimate.chunks_exact(IN_FLIGHT * V::LANES);
        let references = reference.chunks_exact(IN_FLIGHT * V::LANES);
        let rest = estimates.remainder().iter().chain(references.remainder());
        let rest: f64 = rest.sum();
        for (estimate, reference) in estimates.zip(references) {
            add(proof, &mut sums[0], estimate);
            add(proof, &mut sums[1], reference);
        }
        let mut total = sums[0][0];
        for sum in sums.iter().flatten().skip(1) {
            total = total.plus(*sum);
        }
        rest + total.sum_of_lanes()
    }
}

#[inline(always)]
fn add<V: Vector>(proof: V::Proof, sums: &mut [V; IN_FLIGHT], values: &[f64]) {
    for (sum, values) in sums.iter_mut().zip(values.chunks_exact(V::LANES)) {
        *sum = sum.plus(V::load(proof, values));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_reads_every_value_once() {
        let column: Vec<f64> = (0..1003).map(f64::from).collect();
        let pairs = Paired {
            estimate: &column[..],
            reference: &column,
        };
        assert_eq!(
            stream_sum(pairs).to_bits(),
            f64::from(1002 * 1003).to_bits()
        );
    }
}
