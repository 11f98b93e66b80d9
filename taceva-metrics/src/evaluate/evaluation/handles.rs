//! Methods for single scores of a channel, such as `mae`.

use std::borrow::Borrow;

use taceva_core::Channel;

use super::Evaluation;
use crate::score::Score;

/// Generates one method per metric from its name and meaning.
macro_rules! handles {
    ($($metric:ident: $says:literal),+ $(,)?) => {
        /// Methods that return one score of a channel. They return `None` if the plan [skipped](Evaluation::skipped) the metric or lacks the
        /// channel. An undefined score is present, and its value is the reason. For planes and other metrics use [`score`](Evaluation::score).
        impl Evaluation {
            $(
                #[doc = concat!("The score `", stringify!($metric), "` of `channel`: ", $says, ".")]
                ///
                /// ```
                /// use taceva_metrics::{Channel, Evaluator};
                /// let mut evaluator = Evaluator::of_channels([Channel::FZ])?;
                /// evaluator.update_pairs(Channel::FZ, &[0.5, 1.0, 2.0], &[0.5, 1.25, 1.75])?;
                /// let scores = evaluator.finish()?;
                #[doc = concat!("assert!(scores.", stringify!($metric), "(Channel::FZ).is_some_and(|score| score.value.scalar().is_some()));")]
                /// # Ok::<(), Box<dyn std::error::Error>>(())
                /// ```
                pub fn $metric(&self, channel: impl Borrow<Channel>) -> Option<&Score> {
                    self.score(stringify!($metric), channel.borrow().name())
                }
            )+
        }
    };
}

handles! {
    mae: "the mean absolute error, in the unit of the channel",
    rmse: "the root mean square error, in the unit of the channel",
    bias: "the mean of truth − prediction, in the unit of the channel",
    r2: "the coefficient of determination, the share of the variance of the truth that is explained, without unit",
    skill: "the share by which the squared error is less than that of a constant prediction, without unit",
    smape: "the symmetric relative error as a fraction, without unit",
    smape_gated: "the symmetric relative error of samples in contact, without unit",
    tolerance: "the share of predictions within 0.05 mm or 0.05 N of the truth",
}
