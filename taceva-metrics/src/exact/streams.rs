//! Streams: quantities of a pair of truth and prediction. The sums of streams determine scores.

use std::fmt;
use std::ops::BitOr;

/// One summed quantity of a pair, with d = RN(y − ŷ), y the truth and ŷ the prediction. RN(x) is the binary64 nearest to x.
///
/// ```
/// use taceva_metrics::Stream;
/// assert_eq!(Stream::Absolute.name(), "abs_d");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(u8)]
#[non_exhaustive]
pub enum Stream {
    /// Absolute residual, |d|.
    Absolute,
    /// Residual d, truth − prediction.
    Residual,
    /// Exact square of the residual, d².
    Squared,
    /// Truth, y.
    Truth,
    /// Exact square of the truth, y².
    TruthSquared,
    /// Term of sMAPE, t = RN(|d| / RN(RN(RN(|y| + |ŷ|) × 0.5) + ε)), with ε = 10⁻⁸.
    Symmetric,
}

impl Stream {
    /// Every stream.
    pub const ALL: [Stream; 6] = [
        Stream::Absolute,
        Stream::Residual,
        Stream::Squared,
        Stream::Truth,
        Stream::TruthSquared,
        Stream::Symmetric,
    ];

    /// Name of the stream in states.
    pub const fn name(self) -> &'static str {
        match self {
            Stream::Absolute => "abs_d",
            Stream::Residual => "d",
            Stream::Squared => "dd",
            Stream::Truth => "y",
            Stream::TruthSquared => "yy",
            Stream::Symmetric => "t",
        }
    }
}

/// A set of streams.
///
/// ```
/// use taceva_metrics::{Stream, Streams};
/// let streams = Streams::of(&[Stream::Absolute]) | Streams::of(&[Stream::Truth]);
/// assert!(streams.contains(Stream::Truth) && !streams.contains(Stream::Squared));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Streams {
    bits: u8,
}

impl Streams {
    /// No stream.
    pub const NONE: Streams = Streams { bits: 0 };
    /// Every stream.
    pub const ALL: Streams = Streams::of(&Stream::ALL);

    /// The given streams.
    pub const fn of(streams: &[Stream]) -> Streams {
        let mut bits = 0;
        let mut position = 0;
        while position < streams.len() {
            bits |= 1 << streams[position] as u8;
            position += 1;
        }
        Streams { bits }
    }

    /// True if `stream` is in the set.
    pub const fn contains(self, stream: Stream) -> bool {
        self.bits & 1 << stream as u8 != 0
    }

    /// True if a stream is in both sets.
    pub(crate) const fn intersects(self, other: Streams) -> bool {
        self.bits & other.bits != 0
    }

    /// One bit per stream, in the order of [`Stream::ALL`].
    pub(crate) const fn bits(self) -> u8 {
        self.bits
    }

    /// Streams of the set, in the order of [`Stream::ALL`].
    pub fn iter(self) -> impl Iterator<Item = Stream> {
        Stream::ALL
            .into_iter()
            .filter(move |stream| self.contains(*stream))
    }
}

impl BitOr for Streams {
    type Output = Streams;
    fn bitor(self, other: Streams) -> Streams {
        Streams {
            bits: self.bits | other.bits,
        }
    }
}

impl fmt::Display for Streams {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (position, stream) in self.iter().enumerate() {
            let separator = if position == 0 { "" } else { " " };
            write!(f, "{separator}{}", stream.name())?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_set_holds_what_was_put_in_and_says_so() {
        let set = Streams::of(&[Stream::TruthSquared]) | Streams::of(&[Stream::Absolute]);
        assert!(set.contains(Stream::Absolute) && !set.contains(Stream::Truth));
        assert_eq!(set.to_string(), "abs_d yy");
        assert_eq!(Streams::ALL.iter().count(), Stream::ALL.len());
    }
}
