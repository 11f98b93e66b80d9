//! Clock of a rig.

use std::time::Duration;

/// A time or a span in whole nanoseconds, like the stamps of the bench.
///
/// A span is therefore independent of its start time, so that a resumed run records the same values.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Ticks(u64);

impl Ticks {
    /// Converts a span. Longer spans than 584 years become the greatest value.
    pub(super) fn of(span: Duration) -> Ticks {
        Ticks(u64::try_from(span.as_nanos()).unwrap_or(u64::MAX))
    }

    pub(super) fn duration(self) -> Duration {
        Duration::from_nanos(self.0)
    }

    pub(super) fn seconds(self) -> f64 {
        self.duration().as_secs_f64()
    }

    /// Time `span` after this time.
    pub(super) fn after(self, span: Ticks) -> Ticks {
        Ticks(self.0.saturating_add(span.0))
    }

    /// Span since the time `then`; 0 if `then` is later.
    pub(super) fn since(self, then: Ticks) -> Ticks {
        Ticks(self.0.saturating_sub(then.0))
    }

    /// Time to the next multiple of `period`, from 1 ns to `period`.
    pub(super) fn to_next(self, period: Ticks) -> Ticks {
        let period = period.0.max(1);
        Ticks(period - self.0 % period)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_span_is_the_same_to_the_bit_whenever_it_begins() {
        let span = Ticks::of(Duration::from_nanos(15_000_001));
        for hours in [0, 1, 1_000] {
            let start = Ticks::of(Duration::from_secs(3_600 * hours));
            let found = start.after(span).since(start);
            assert_eq!(found.seconds().to_bits(), span.seconds().to_bits());
        }
    }

    #[test]
    fn beats_come_a_period_apart_and_never_at_once() {
        let period = Ticks(10);
        assert_eq!(Ticks(20).to_next(period), Ticks(10));
        assert_eq!(Ticks(21).to_next(period), Ticks(9));
        assert_eq!(Ticks(29).to_next(period), Ticks(1));
        assert_eq!(Ticks(5).to_next(Ticks(0)), Ticks(1));
    }
}
