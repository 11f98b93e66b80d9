//! Sums of the pairs of one channel, which determine every accuracy score.

use taceva_core::{Isa, IsaError};

use crate::error::MetricError;
use crate::exact::merge::Merge;
use crate::exact::streams::{Stream, Streams};
use crate::exact::{BlockSums, Counts, Dyadic, ExactSum, Machine, Sums};
use crate::pair::Paired;

/// Specification of the sums of pairs: streams to sum, and the gate of the gated sum.
///
/// ```
/// use taceva_metrics::{PairSpec, Streams};
/// let spec = PairSpec::new(Streams::ALL).with_gate(0.1);
/// assert_eq!(spec.gate, Some(0.1));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct PairSpec {
    /// Streams to sum.
    pub streams: Streams,
    /// Least magnitude of the truth of a sample in the gated sMAPE, in the channel's unit; `None` without a gated sum.
    pub gate: Option<f64>,
}

impl PairSpec {
    /// Specification of sums of `streams`, without a gated sum.
    pub const fn new(streams: Streams) -> PairSpec {
        PairSpec {
            streams,
            gate: None,
        }
    }

    /// The same specification with a gated sum over samples whose truth has a magnitude of at least `gate`.
    #[must_use]
    pub fn with_gate(self, gate: impl Into<Option<f64>>) -> PairSpec {
        PairSpec {
            gate: gate.into(),
            ..self
        }
    }
}

/// Counts and exact sums of the pairs of one channel.
///
/// The result depends only on the set of pairs, for any number of updates and merges in any order.
///
/// ```
/// use taceva_metrics::{PairSpec, PairSums, Paired, Stream, Streams};
/// let mut sums = PairSums::new(PairSpec::new(Streams::ALL));
/// sums.update(Paired::try_columns(&[1.5, 1.5], &[1.0, 2.0])?);
/// assert_eq!((sums.n(), sums.sum(Stream::Absolute).to_f64()), (2, 1.0));
/// # Ok::<(), taceva_metrics::MetricError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct PairSums {
    spec: PairSpec,
    kept: BlockSums,
}

impl PairSums {
    /// Empty sums, computed with the instruction set of [`Isa::detect`].
    pub fn new(spec: PairSpec) -> PairSums {
        PairSums::with_machine(spec, Machine::detect())
    }

    /// Empty sums, computed with the instruction set `isa`. The choice affects the run time but not the result.
    ///
    /// # Errors
    /// [`IsaError::Unavailable`] if this machine lacks the instruction set.
    pub fn with_isa(spec: PairSpec, isa: Isa) -> Result<PairSums, IsaError> {
        let machine = Machine::with(isa).ok_or(IsaError::Unavailable { isa })?;
        Ok(PairSums::with_machine(spec, machine))
    }

    pub(crate) fn with_machine(spec: PairSpec, machine: Machine) -> PairSums {
        PairSums {
            spec,
            kept: BlockSums::new(machine, spec.streams, gate(spec)),
        }
    }

    /// Replaces counts and sums by saved counts and sums with the same specification.
    pub(crate) fn set(&mut self, counts: Counts, sums: Sums) {
        self.kept.set(counts, sums);
    }

    /// Adds pairs. A pair with a NaN, an infinity or a magnitude above 2¹⁰²¹ is skipped and counted in [`n_invalid`](PairSums::n_invalid).
    pub fn update(&mut self, pairs: Paired<&[f64]>) {
        self.kept.update(pairs);
    }

    /// Number of summed pairs.
    pub fn n(&self) -> u64 {
        self.kept.counts.valid
    }

    /// Number of pairs skipped for a NaN or a magnitude above 2¹⁰²¹.
    pub fn n_invalid(&self) -> u64 {
        self.kept.counts.invalid
    }

    /// Number of pairs whose truth has at least the magnitude of the gate.
    pub fn n_gated(&self) -> u64 {
        self.kept.counts.gated
    }

    /// Sum of `stream`; zero for a stream that is not summed.
    pub fn sum(&self, stream: Stream) -> ExactSum {
        self.kept.sum(stream)
    }

    /// Sum of the sMAPE terms of pairs whose truth has at least the magnitude of the gate.
    pub fn gated_sum(&self) -> ExactSum {
        self.kept.gated_sum()
    }

    /// Least magnitude of the truth of a pair in the gated sum; `None` without a gated sum.
    pub fn gate(&self) -> Option<f64> {
        gate(self.spec)
    }

    /// Specification of the sums.
    pub fn spec(&self) -> PairSpec {
        self.spec
    }

    /// Sum of squares of the truth about its mean, rounded once; 0 without pairs.
    pub fn total_sum_of_squares(&self) -> f64 {
        self.over_n(&self.scaled_spread(), 1)
    }

    /// Mean squared residual, rounded once; 0 without pairs.
    pub fn mean_squared_error(&self) -> f64 {
        self.mean(Stream::Squared)
    }

    /// Sample variance of the absolute residuals, rounded once; `None` for fewer than two pairs.
    pub fn absolute_variance(&self) -> Option<f64> {
        let (absolute, squared) = (Stream::Absolute, Stream::Squared);
        let n = self.n();
        (n >= 2).then(|| self.over_n(&self.scaled_variance(absolute, squared), n - 1))
    }

    /// Mean of one stream, rounded once; 0 without pairs.
    pub(crate) fn mean(&self, stream: Stream) -> f64 {
        self.over_n(&self.sum(stream).to_dyadic(), 1)
    }

    /// Root of the mean of one stream, rounded once; 0 without pairs.
    pub(crate) fn root_mean_square(&self, stream: Stream) -> f64 {
        match self.n() {
            0 => 0.0,
            n => self.sum(stream).to_dyadic().root_over(&Dyadic::from(n)),
        }
    }

    /// n Σ y² − (Σ y)² of the n truths y, exactly; zero only if all truths are equal.
    pub(crate) fn scaled_spread(&self) -> Dyadic {
        self.scaled_variance(Stream::Truth, Stream::TruthSquared)
    }

    fn scaled_variance(&self, values: Stream, squares: Stream) -> Dyadic {
        let values = self.sum(values).to_dyadic();
        let squares = self.sum(squares).to_dyadic();
        &(&Dyadic::from(self.n()) * &squares) - &(&values * &values)
    }

    fn over_n(&self, numerator: &Dyadic, factor: u64) -> f64 {
        if self.n() == 0 {
            return 0.0;
        }
        numerator.over(&(&Dyadic::from(self.n()) * &Dyadic::from(factor)))
    }

    /// Merges sums of the same specification.
    ///
    /// # Errors
    /// [`MetricError::Parameter`] if both sums have different streams or gates.
    pub fn try_merge(&mut self, other: &PairSums) -> Result<(), MetricError> {
        if self.spec != other.spec {
            return Err(MetricError::Parameter {
                name: "spec",
                expected: format!("{:?}", self.spec),
                found: format!("{:?}", other.spec),
            });
        }
        self.merge(other);
        Ok(())
    }
}

impl Merge for PairSums {
    fn merge(&mut self, other: &PairSums) {
        self.kept.merge(&other.kept);
    }
}

/// Gate of the specification; `None` if the sMAPE terms are not summed.
fn gate(spec: PairSpec) -> Option<f64> {
    let wanted = spec.streams.contains(Stream::Symmetric);
    spec.gate.filter(|_| wanted)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_number_is_counted_and_left_out() {
        let mut sums = PairSums::new(PairSpec {
            streams: Streams::ALL,
            gate: Some(0.5),
        });
        sums.update(Paired {
            estimate: &[1.0, f64::NAN, 2.0, 0.0],
            reference: &[2.0, 1.0, f64::INFINITY, 0.25],
        });
        assert_eq!((sums.n(), sums.n_invalid(), sums.n_gated()), (2, 2, 1));
        assert_eq!(
            sums.sum(Stream::Truth).to_f64().to_bits(),
            2.25_f64.to_bits()
        );
    }

    #[test]
    fn a_channel_of_lab_values_is_kept_in_about_a_hundred_bytes() {
        let truth: Vec<f64> = (0..1600).map(|row| f64::from(row) / 91.3 - 8.7).collect();
        let prediction: Vec<f64> = truth.iter().map(|y| y * 0.98 + 0.013).collect();
        let mut sums = PairSums::new(PairSpec::new(Streams::ALL));
        sums.update(Paired::try_columns(&prediction, &truth).expect("one length"));
        let digits: usize = Stream::ALL
            .iter()
            .map(|stream| sums.sum(*stream).to_canonical().digits().len())
            .sum();
        // Four bytes a digit, two for sign and place of each sum, sixteen for the counts.
        let bytes = 4 * digits + 2 * Stream::ALL.len() + 16;
        assert!(bytes <= 128, "{bytes} bytes");
    }

    #[test]
    fn sums_of_other_streams_do_not_merge() {
        let spec = |streams| PairSpec {
            streams,
            gate: None,
        };
        let mut all = PairSums::new(spec(Streams::ALL));
        let none = PairSums::new(spec(Streams::NONE));
        assert!(all.try_merge(&none).is_err());
    }
}
