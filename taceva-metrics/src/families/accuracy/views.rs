//! Sums of pairs read from two views of `ndarray`.

use ndarray::ArrayView1;

use crate::error::MetricError;
use crate::evaluate::number::Number;
use crate::families::accuracy::pair_sums::PairSums;
use crate::pair::Paired;

/// Number of pairs copied at a time from views that are not contiguous or not `f64`.
const BLOCK: usize = 1024;

impl PairSums {
    /// Adds the pairs of two views of `f32` or `f64`, as [`update`](PairSums::update) does. Contiguous views of `f64` are summed without a copy;
    /// other views are copied 1,024 pairs at a time.
    ///
    /// # Errors
    /// [`MetricError::Lengths`] if the views differ in length; no pair is added. [`MetricError::Absent`] if an `Option` has no value; earlier
    /// blocks of 1,024 pairs remain added.
    ///
    /// ```
    /// use ndarray::array;
    /// use taceva_metrics::{PairSpec, PairSums, Stream, Streams};
    /// let mut sums = PairSums::new(PairSpec::new(Streams::ALL));
    /// let matrix = array![[1.5, 1.0], [1.5, 2.0]];
    /// sums.update_views(matrix.column(0), matrix.column(1))?;
    /// sums.update_views(array![0.5_f32].view(), array![0.25].view())?;
    /// assert_eq!((sums.n(), sums.sum(Stream::Absolute).to_f64()), (3, 1.25));
    /// # Ok::<(), taceva_metrics::MetricError>(())
    /// ```
    pub fn update_views<P: Number, T: Number>(
        &mut self,
        estimate: ArrayView1<'_, P>,
        reference: ArrayView1<'_, T>,
    ) -> Result<(), MetricError> {
        if estimate.len() != reference.len() {
            return Err(MetricError::Lengths {
                estimate: estimate.len(),
                reference: reference.len(),
            });
        }
        let estimates = estimate.to_slice().and_then(P::doubles);
        let references = reference.to_slice().and_then(T::doubles);
        if let (Some(estimate), Some(reference)) = (estimates, references) {
            self.update(Paired {
                estimate,
                reference,
            });
            return Ok(());
        }
        let mut block = Paired::<Vec<f64>>::default();
        for (row, (estimate, reference)) in estimate.iter().zip(reference).enumerate() {
            let absent = || MetricError::Absent { row };
            block.estimate.push(estimate.number().ok_or_else(absent)?);
            block.reference.push(reference.number().ok_or_else(absent)?);
            if block.estimate.len() == BLOCK {
                self.update(block.as_slices());
                block.estimate.clear();
                block.reference.clear();
            }
        }
        self.update(block.as_slices());
        Ok(())
    }
}
