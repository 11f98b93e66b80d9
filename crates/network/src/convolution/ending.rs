//! Start values of sums, and operations on finished sums.

use std::ops::Range;

/// Bias and operations applied to the sums of whole batches.
#[derive(Clone, Copy)]
pub(crate) enum Epilogue<'a> {
    /// Sums without bias or operation.
    Raw,
    /// Adds the bias, then applies ReLU.
    BiasRelu(&'a [f32]),
    /// Adds the bias, adds pictures with the layout of the output, then applies ReLU.
    BiasAddRelu(&'a [f32], &'a [f32]),
    /// Adds the bias only.
    Bias(&'a [f32]),
}

/// Mode of writing a gradient.
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
    /// The values already in the output.
    Output,
    /// One bias value per channel.
    Bias(&'a [f32]),
}

/// Start value of sums, and operation on finished sums.
#[derive(Clone, Copy, Debug)]
pub(super) struct SumRule<'a> {
    pub(super) start: Start<'a>,
    pub(super) finish: Finish<'a>,
}

/// Operation on finished sums.
#[derive(Clone, Copy, Debug)]
pub(super) enum Finish<'a> {
    /// Keeps the sums unchanged.
    Keep,
    /// Applies ReLU.
    Relu,
    /// Adds a tensor with the layout of the output, then applies ReLU.
    AddThenRelu(&'a [f32]),
}

impl SumRule<'_> {
    /// Rule for the part of the output whose first channel is `channel`. Keeps the start values of this part, and leaves finished sums unchanged.
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
    /// Start values of sums and operation on finished sums, for the output values in `range`.
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
    /// Rule that begins with this start value, and does not change finished sums.
    pub(super) fn rule(self) -> SumRule<'static> {
        let start = match self {
            Onto::Nothing => Start::Zero,
            Onto::Sum => Start::Output,
        };
        let finish = Finish::Keep;
        SumRule { start, finish }
    }
}
