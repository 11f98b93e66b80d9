//! Summation algorithms.

use taceva_core::Isa;

use super::compensation::{Kahan, Neumaier, Plain, Single, pairwise};
use super::reference;
use super::scores::Scores;
use super::textbook::{in_halves, length, mean_error, number, one_pass, two_pass, welford};
use crate::catalogue;
use crate::exact::Machine;
use crate::exact::streams::{Stream, Streams};
use crate::families::accuracy::pair_sums::{PairSpec, PairSums};
use crate::families::accuracy::pairs::value_of;
use crate::pair::Paired;

/// An algorithm for MAE, R² and sMAPE of two columns.
///
/// All kernels except [`Exact`](Kernel::Exact) round at every step, like common libraries.
///
/// ```
/// use taceva_metrics::bench::Kernel;
/// assert!(Kernel::available().iter().any(|kernel| kernel.is_exact()));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Kernel {
    /// One pass in binary64. The total sum of squares of the truth y over n rows is Σy² − (Σy)² / n.
    Naive,
    /// One pass as in `Naive`, with sums in binary32.
    Single,
    /// Two passes: first the mean ȳ of the truth y, then Σ(y − ȳ)².
    TwoPass,
    /// Two passes, with sums by recursive halving of the rows, as in numpy.
    Pairwise,
    /// One pass with the compensated sums of Kahan.
    Kahan,
    /// One pass with the compensated sums of Neumaier.
    Neumaier,
    /// One pass, with the total sum of squares of the truth by the update of Welford.
    Welford,
    /// Exact sums of this crate, computed with this instruction set.
    Exact(Isa),
}

impl Kernel {
    /// Kernels that this machine can run: first the kernels that round, then the exact kernels from the widest to the narrowest vectors.
    pub fn available() -> Vec<Kernel> {
        let rounding = [
            Kernel::Naive,
            Kernel::Single,
            Kernel::TwoPass,
            Kernel::Pairwise,
            Kernel::Kahan,
            Kernel::Neumaier,
            Kernel::Welford,
        ];
        let exact = Isa::available().into_iter().map(Kernel::Exact);
        rounding.into_iter().chain(exact).collect()
    }

    /// Name of the kernel in tables, such as `two-pass` or `exact avx2`.
    pub fn name(self) -> String {
        match self {
            Kernel::Naive => "naive f64".to_owned(),
            Kernel::Single => "naive f32".to_owned(),
            Kernel::TwoPass => "two-pass".to_owned(),
            Kernel::Pairwise => "pairwise".to_owned(),
            Kernel::Kahan => "Kahan".to_owned(),
            Kernel::Neumaier => "Neumaier".to_owned(),
            Kernel::Welford => "Welford".to_owned(),
            Kernel::Exact(isa) => format!("exact {isa}"),
        }
    }

    /// True if the kernel sums exactly and rounds only the scores.
    pub fn is_exact(self) -> bool {
        matches!(self, Kernel::Exact(_))
    }

    /// Computes MAE, R² and sMAPE of `pairs`.
    ///
    /// # Shapes
    /// `pairs.estimate`, `pairs.reference`: equal length.
    pub fn run(self, pairs: Paired<&[f64]>) -> Scores {
        match self {
            Kernel::Naive => one_pass::<Plain>(pairs),
            Kernel::Single => one_pass::<Single>(pairs),
            Kernel::TwoPass => two_pass(pairs),
            Kernel::Pairwise => in_halves(pairs),
            Kernel::Kahan => one_pass::<Kahan>(pairs),
            Kernel::Neumaier => one_pass::<Neumaier>(pairs),
            Kernel::Welford => welford(pairs),
            Kernel::Exact(isa) => scores_of(&exact(isa, THREE_SCORES, pairs)),
        }
    }

    /// Computes only the mean absolute error of `pairs`; `None` if the result is not finite.
    pub fn run_mae(self, pairs: Paired<&[f64]>) -> Option<f64> {
        match self {
            Kernel::Naive | Kernel::TwoPass | Kernel::Welford => mean_error::<Plain>(pairs),
            Kernel::Single => mean_error::<Single>(pairs),
            Kernel::Kahan => mean_error::<Kahan>(pairs),
            Kernel::Neumaier => mean_error::<Neumaier>(pairs),
            Kernel::Pairwise => {
                let rows: Vec<Paired<f64>> = pairs.iter().collect();
                number(pairwise(&rows, &|pair| pair.residual().abs()) / length(pairs))
            }
            Kernel::Exact(isa) => {
                let streams = Streams::of(&[Stream::Absolute]);
                score("mae", &exact(isa, streams, pairs))
            }
        }
    }

    /// True if the algorithm gives bit-identical scores for every order of rows. Equal scores for some orders would not prove this.
    pub fn is_order_free(self) -> bool {
        self.is_exact()
    }

    /// Exact scores of `pairs` by integer arithmetic. The code is separate from all kernels, so no kernel is compared with itself.
    pub fn truth(pairs: Paired<&[f64]>) -> Scores {
        reference::scores(pairs)
    }
}

const THREE_SCORES: Streams = Streams::of(&[
    Stream::Absolute,
    Stream::Squared,
    Stream::Truth,
    Stream::TruthSquared,
    Stream::Symmetric,
]);

fn spec(streams: Streams) -> PairSpec {
    PairSpec {
        streams,
        gate: None,
    }
}

/// Exact sums of `pairs`, computed with `isa` or, if this machine lacks it, another instruction set. The instruction set changes only the run time.
fn exact(isa: Isa, streams: Streams, pairs: Paired<&[f64]>) -> PairSums {
    let machine = Machine::with(isa).unwrap_or_else(Machine::detect);
    let mut sums = PairSums::with_machine(spec(streams), machine);
    sums.update(pairs);
    sums
}

fn score(id: &str, sums: &PairSums) -> Option<f64> {
    let value = value_of(catalogue::find(id)?, sums).ok();
    value.filter(|value| value.is_finite())
}

fn scores_of(sums: &PairSums) -> Scores {
    Scores {
        mae: score("mae", sums),
        r2: score("r2", sums),
        smape: score("smape", sums),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_agree_where_nothing_needs_rounding() {
        let pairs = Paired {
            estimate: &[1.0, 2.0, 6.0, 7.0][..],
            reference: &[1.0, 4.0, 4.0, 7.0],
        };
        for kernel in Kernel::available() {
            let scores = kernel.run(pairs);
            assert_eq!(scores.mae, Some(1.0), "{}", kernel.name());
            assert_eq!(kernel.run_mae(pairs), Some(1.0), "{}", kernel.name());
            let r2 = scores.r2.expect("the truth varies");
            assert!((r2 - (1.0 - 8.0 / 18.0)).abs() < 1e-6, "{}", kernel.name());
        }
        assert_eq!(
            Kernel::truth(pairs),
            Kernel::Exact(Isa::Portable).run(pairs)
        );
    }

    #[test]
    fn nothing_has_no_scores() {
        for kernel in Kernel::available() {
            assert_eq!(kernel.run(Paired::default()), Scores::default());
            assert_eq!(kernel.run_mae(Paired::default()), None);
        }
    }
}
