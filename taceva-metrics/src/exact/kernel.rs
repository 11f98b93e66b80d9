//! The inner loops: a stretch of pairs into the sums of its streams.
//!
//! Everything that touches each pair goes through [`deposit_pairs`]; a faster kernel replaces its body and nothing else,
//! because exact sums do not tell how they came about.

use super::sum::ExactSum;
use crate::paired::Paired;
use crate::streams::{Stream, Streams};

/// One exact sum a stream.
pub(crate) type StreamSums = [ExactSum; Stream::ALL.len()];

/// Adds pairs to the sums of the wanted streams.
///
/// # Shapes
/// `pairs.estimate`, `pairs.reference`: one length; every value finite and at most 2¹⁰²¹.
pub(crate) fn deposit_pairs(sums: &mut StreamSums, streams: Streams, pairs: Paired<&[f64]>) {
    let each = || pairs.iter();
    for stream in streams.iter() {
        let sum = &mut sums[stream as usize];
        match stream {
            Stream::Absolute => each().for_each(|pair| sum.deposit(pair.residual().abs())),
            Stream::Residual => each().for_each(|pair| sum.deposit(pair.residual())),
            Stream::Squared => each().for_each(|pair| sum.deposit_square(pair.residual())),
            Stream::Truth => each().for_each(|pair| sum.deposit(pair.reference)),
            Stream::TruthSquared => each().for_each(|pair| sum.deposit_square(pair.reference)),
            Stream::Symmetric => each().for_each(|pair| sum.deposit(pair.symmetric_term())),
        }
    }
}
