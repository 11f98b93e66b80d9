//! Arrays of `ndarray` as input. A single column needs no conversion, because a one-dimensional view is an iterator.

use ndarray::ArrayView2;
use taceva_core::Channel;

use crate::error::MetricError;
use crate::evaluate::number::Number;
use crate::evaluate::rows::Rows;

impl Rows {
    /// Adds matrices of truth and prediction, with values of `f32` or `f64`. Column i belongs to `channels[i]`. Values are copied once.
    ///
    /// # Shapes
    /// `truth`, `prediction`: samples × channels.
    /// # Errors
    /// [`MetricError::Columns`] if the number of columns of a matrix differs from the number of channels.
    ///
    /// ```
    /// use ndarray::array;
    /// use taceva_metrics::{Channel, Evaluator, Rows};
    /// let truth = array![[0.0, 1.0], [0.5, 2.0]];
    /// let prediction = array![[0.0_f32, 1.0], [0.25, 2.0]];
    /// let mut evaluator = Evaluator::of_channels([Channel::FX, Channel::FZ])?;
    /// evaluator.update_rows(Rows::new().matrices(&[Channel::FX, Channel::FZ], truth.view(), prediction.view())?)?;
    /// evaluator.update_pairs(Channel::FZ, truth.column(1), prediction.column(1))?;
    /// assert_eq!(evaluator.score()?.mae(Channel::FX).and_then(|score| score.value.scalar()), Some(0.125));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn matrices<T: Number, P: Number>(
        self,
        channels: &[Channel],
        truth: ArrayView2<'_, T>,
        prediction: ArrayView2<'_, P>,
    ) -> Result<Rows, MetricError> {
        for (what, found) in [("truth", truth.ncols()), ("prediction", prediction.ncols())] {
            if found != channels.len() {
                return Err(MetricError::Columns {
                    what,
                    expected: channels.len(),
                    found,
                });
            }
        }
        let columns = truth.columns().into_iter().zip(prediction.columns());
        let columns = channels.iter().zip(columns);
        Ok(columns.fold(self, |rows, (channel, (truth, prediction))| {
            rows.pairs(*channel, truth, prediction)
        }))
    }
}
