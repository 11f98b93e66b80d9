//! What sums of a pass begin with, and what is done with them once they are finished.

use std::ops::Range;

/// What is added to sums and done with them, for whole batches.
#[derive(Clone, Copy)]
pub(crate) enum Epilogue<'a> {
    /// Nothing.
    Raw,
    /// A bias, and zero below zero.
    BiasRelu(&'a [f32]),
    /// A bias, as many pictures that lie as the output does, and zero below zero.
    BiasAddRelu(&'a [f32], &'a [f32]),
    /// A bias alone.
    Bias(&'a [f32]),
}

/// What a gradient is written onto.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Onto {
    /// In place of what was there.
    Nothing,
    /// Added to what is there.
    Sum,
}

/// What sums begin with.
#[derive(Clone, Copy, Debug)]
pub(super) enum Start<'a> {
    /// Nothing.
    Zero,
    /// What the output holds.
    Output,
    /// One number per channel.
    Bias(&'a [f32]),
}

/// What is done with finished sums.
#[derive(Clone, Copy, Debug)]
pub(super) enum Finish<'a> {
    /// They are kept.
    Keep,
    /// Those below zero become zero.
    Relu,
    /// A tensor that lies as the output does is added, then those below zero become zero.
    AddThenRelu(&'a [f32]),
}

impl Start<'_> {
    /// The same for the channels from `channel` on.
    pub(super) fn from(self, channel: usize) -> Self {
        match self {
            Start::Bias(bias) => Start::Bias(&bias[channel..]),
            Start::Zero | Start::Output => self,
        }
    }
}

impl<'a> Epilogue<'a> {
    /// The same for those numbers of the output that lie in `range`.
    pub(super) fn within(self, range: Range<usize>) -> (Start<'a>, Finish<'a>) {
        match self {
            Epilogue::Raw => (Start::Zero, Finish::Keep),
            Epilogue::Bias(bias) => (Start::Bias(bias), Finish::Keep),
            Epilogue::BiasRelu(bias) => (Start::Bias(bias), Finish::Relu),
            Epilogue::BiasAddRelu(bias, other) => {
                (Start::Bias(bias), Finish::AddThenRelu(&other[range]))
            }
        }
    }
}

impl Onto {
    /// What sums begin with.
    pub(super) fn start(self) -> Start<'static> {
        match self {
            Onto::Nothing => Start::Zero,
            Onto::Sum => Start::Output,
        }
    }
}
