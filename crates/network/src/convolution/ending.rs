//! Start values of sums, and operations on finished sums.

use std::ops::Range;

/// Bias and operations for the sums of whole batches.
#[derive(Clone, Copy)]
pub(crate) enum Epilogue<'a> {
    /// Bare sums, without bias.
    Raw,
    /// Bias, then ReLU.
    BiasRelu(&'a [f32]),
    /// Bias, then pictures with the layout of the output, then ReLU.
    BiasAddRelu(&'a [f32], &'a [f32]),
    /// Bias only.
    Bias(&'a [f32]),
}

/// Write mode of a gradient.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Onto {
    /// Overwrites the target.
    Nothing,
    /// Adds to the target.
    Sum,
}

/// Start value of sums.
#[derive(Clone, Copy, Debug)]
pub(super) enum Start<'a> {
    Zero,
    /// Present values of the output.
    Output,
    /// One value per channel.
    Bias(&'a [f32]),
}

/// Start value and finish of sums.
#[derive(Clone, Copy, Debug)]
pub(super) struct SumRule<'a> {
    pub(super) start: Start<'a>,
    pub(super) finish: Finish<'a>,
}

/// Operation on finished sums.
#[derive(Clone, Copy, Debug)]
pub(super) enum Finish<'a> {
    /// Keeps the sums.
    Keep,
    /// ReLU.
    Relu,
    /// Adds a tensor with the layout of the output, then ReLU.
    AddThenRelu(&'a [f32]),
}

impl SumRule<'_> {
    /// Rule of a part that begins with `channel`: its start values, without the finish.
    pub(super) fn of_part(self, channel: usize) -> Self {
        let start = match self.start {
            Start::Bias(bias) => Start::Bias(&bias[channel..]),
            Start::Zero | Start::Output => self.start,
        };
        let finish = Finish::Keep;
        SumRule { start, finish }
    }
}

impl<'a> Epilogue<'a> {
    /// Start and finish for the output values in `range`.
    pub(super) fn within(self, range: Range<usize>) -> SumRule<'a> {
        let (start, finish) = match self {
            Epilogue::Raw => (Start::Zero, Finish::Keep),
            Epilogue::Bias(bias) => (Start::Bias(bias), Finish::Keep),
            Epilogue::BiasRelu(bias) => (Start::Bias(bias), Finish::Relu),
            Epilogue::BiasAddRelu(bias, other) => {
                (Start::Bias(bias), Finish::AddThenRelu(&other[range]))
            }
        };
        SumRule { start, finish }
    }
}

impl Onto {
    /// Start value of the sums, which are kept.
    pub(super) fn rule(self) -> SumRule<'static> {
        let start = match self {
            Onto::Nothing => Start::Zero,
            Onto::Sum => Start::Output,
        };
        let finish = Finish::Keep;
        SumRule { start, finish }
    }
}
