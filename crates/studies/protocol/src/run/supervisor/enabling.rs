//! Enabling switch, which the operator holds while the robot may move.

use taceva_core::Pose;

use super::Supervisor;
use crate::run::halt_reason::Trip;

/// State of an enabling switch, which a person holds while the robot may move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Enabling {
    /// The switch is held, or the rig has no switch.
    Held,
    /// The switch is not held.
    Released,
    /// The switch cannot be read.
    Lost,
}

impl Supervisor {
    /// Sets the state of the enabling switch; halts a motion in progress if the switch is not held. Never called on a rig without a switch.
    pub fn enabling(&mut self, enabling: Enabling) {
        self.enabling = enabling;
        if let Some(trip) = self.withheld()
            && self.is_under_way()
        {
            self.trip(trip);
        }
    }

    /// Reason why no motion is allowed; `None` while the switch is held.
    pub fn withheld(&self) -> Option<Trip> {
        match self.enabling {
            Enabling::Held => None,
            Enabling::Released => Some(Trip::Released),
            Enabling::Lost => Some(Trip::SwitchLost),
        }
    }

    /// Announces a straight motion before it is sent.
    ///
    /// # Errors The reason of [`Supervisor::withheld`], or the trip since the last release. The caller must not send the motion then.
    pub fn sent(&mut self, from: Pose, to: Pose) -> Result<(), Trip> {
        if let Some(trip) = self.withheld().or(self.tripped) {
            return Err(self.trip(trip));
        }
        self.way = Some([from, to]);
        Ok(())
    }
}
