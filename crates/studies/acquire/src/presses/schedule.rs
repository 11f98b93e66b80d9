//! Start time of each press of a unit. It depends only on the number of the press.

use std::time::Duration;

use taceva_protocol::Plan;

/// Equal time slots, each long enough for the longest press of a plan.
#[derive(Clone, Copy, Debug)]
pub(super) struct Schedule {
    slot: Duration,
}

/// Time allowed for travel, the search for contact and the retreat.
const WAY: Duration = Duration::from_secs(240);
/// Time allowed for a waypoint: motion, rest and frame.
const WAYPOINT: Duration = Duration::from_secs(2);

impl Schedule {
    pub(super) fn of(plan: &Plan) -> Schedule {
        let samples = plan.presses.iter().map(|press| press.press.samples());
        let most = u32::try_from(samples.max().unwrap_or(0)).unwrap_or(u32::MAX);
        Schedule {
            slot: WAY.saturating_add(WAYPOINT.saturating_mul(most)),
        }
    }

    /// Start time of press `number`, counted from 1.
    pub(super) fn begins(&self, number: usize) -> Duration {
        let number = u32::try_from(number).unwrap_or(u32::MAX);
        self.slot.saturating_mul(number)
    }
}
