//! Readings of force that repeat the one before though the tip was seen elsewhere: a signal that is frozen.

use taceva_core::Wrench;

/// How often readings in a row were equal to the one before them, each after a motion.
///
/// What the transducer says is compared, and not what presses by its zero: another stage of a press, or a zero that the host calls, ends no count.
#[derive(Default)]
pub(super) struct Repeats {
    last: Option<Wrench>,
    /// The number of the last reading, if it has one.
    number: Option<u64>,
    count: u32,
    moved: bool,
}

impl Repeats {
    /// Learns that the tip was seen elsewhere: at rest, equal readings are news from a quiet gel.
    pub(super) fn moved(&mut self) {
        self.moved = true;
    }

    /// Takes a reading, of a transducer whose readings are hardly ever equal where `equality_is_frozen`.
    pub(super) fn take(&mut self, wrench: &Wrench, number: Option<u64>, equality_is_frozen: bool) {
        let before = self.last.replace(*wrench);
        let is_equal = match (std::mem::replace(&mut self.number, number), number) {
            (Some(last), Some(number)) if last == number => true,
            // A box may count on while what it counts has stopped.
            _ if !equality_is_frozen => false,
            _ => before.is_some_and(|last| last == *wrench),
        };
        self.count = match (is_equal, std::mem::take(&mut self.moved)) {
            (true, true) => self.count + 1,
            (true, false) => self.count,
            (false, _) => 0,
        };
    }

    /// Readings in a row that were equal to the one before, each after a motion.
    pub(super) fn count(&self) -> u32 {
        self.count
    }

    /// Begins anew: the transducer sets its own zero.
    pub(super) fn forget(&mut self) {
        *self = Repeats::default();
    }
}
