//! Detects a frozen force signal: readings that repeat although the tip moved.

use taceva_core::Wrench;

/// Count of consecutive force readings that equal the reading before, although the tip moved in between.
///
/// Compares raw readings, so that a new stage, or a zero set by the host, does not reset the count.
#[derive(Default)]
pub(super) struct Repeats {
    last: Option<Wrench>,
    /// Sequence number of the last reading, if readings are numbered.
    number: Option<u64>,
    count: u32,
    moved: bool,
}

impl Repeats {
    /// Records a motion of the tip. At rest, equal readings are normal.
    pub(super) fn moved(&mut self) {
        self.moved = true;
    }

    /// Counts a reading. `equality_is_frozen` is true for a transducer that hardly ever repeats a reading.
    pub(super) fn take(&mut self, wrench: &Wrench, number: Option<u64>, equality_is_frozen: bool) {
        let before = self.last.replace(*wrench);
        let is_equal = match (std::mem::replace(&mut self.number, number), number) {
            (Some(last), Some(number)) if last == number => true,
            // An amplifier may increment its sequence number although its signal is frozen.
            _ if !equality_is_frozen => false,
            _ => before.is_some_and(|last| last == *wrench),
        };
        self.count = match (is_equal, std::mem::take(&mut self.moved)) {
            (true, true) => self.count + 1,
            (true, false) => self.count,
            (false, _) => 0,
        };
    }

    /// Number of consecutive readings that equal the reading before, although the tip moved in between.
    pub(super) fn count(&self) -> u32 {
        self.count
    }

    /// Resets the count, because the transducer sets its own zero and its readings change.
    pub(super) fn forget(&mut self) {
        *self = Repeats::default();
    }
}
