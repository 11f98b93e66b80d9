//! The clock of a rig.

use std::time::Duration;

/// A time or a span of 2⁻²⁰ s each: about a microsecond, and exact in binary64 for 200 years.
///
/// So a span is the same to the bit whenever it begins, and a run that is resumed at another hour records what it would have recorded.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Ticks(u64);

const PER_SECOND: u64 = 1 << 20;
const NANOSECONDS: u64 = 1_000_000_000;

impl Ticks {
    /// A span, to the nearest tick.
    pub(super) fn of(span: Duration) -> Ticks {
        let part = u64::from(span.subsec_nanos()) * PER_SECOND + NANOSECONDS / 2;
        let whole = span.as_secs().saturating_mul(PER_SECOND);
        Ticks(whole.saturating_add(part / NANOSECONDS))
    }

    pub(super) fn duration(self) -> Duration {
        let part = (self.0 % PER_SECOND) * NANOSECONDS + PER_SECOND / 2;
        Duration::from_secs(self.0 / PER_SECOND) + Duration::from_nanos(part / PER_SECOND)
    }

    pub(super) fn seconds(self) -> f64 {
        #[expect(
            clippy::cast_precision_loss,
            reason = "exact for 200 years, and no run lasts longer"
        )]
        let ticks = self.0 as f64;
        ticks / PER_SECOND as f64
    }

    /// The time a span after this one.
    pub(super) fn after(self, span: Ticks) -> Ticks {
        Ticks(self.0.saturating_add(span.0))
    }

    /// The span since a time before this one.
    pub(super) fn since(self, then: Ticks) -> Ticks {
        Ticks(self.0.saturating_sub(then.0))
    }

    /// How long it is to the next whole number of periods: never nothing.
    pub(super) fn to_next(self, period: Ticks) -> Ticks {
        let period = period.0.max(1);
        Ticks(period - self.0 % period)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_survive_the_way_through_a_duration() {
        for ticks in [0, 1, 2, 999, PER_SECOND - 1, PER_SECOND, 7 * PER_SECOND + 5] {
            assert_eq!(Ticks::of(Ticks(ticks).duration()), Ticks(ticks));
        }
    }

    #[test]
    fn a_span_is_the_same_to_the_bit_whenever_it_begins() {
        let span = Ticks::of(Duration::from_millis(15));
        for hours in [0, 1, 1_000] {
            let start = Ticks::of(Duration::from_secs(3_600 * hours));
            let found = start.after(span).seconds() - start.seconds();
            assert_eq!(found.to_bits(), span.seconds().to_bits());
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
