//! The enabling switch that somebody holds while the robot may move.

use taceva_core::Pose;

use super::Supervisor;
use crate::run::halt_reason::Trip;

/// What is known of an enabling switch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Enabling {
    /// It is held, or the rig has none.
    Held,
    /// Nobody holds it.
    Released,
    /// It cannot be read any more.
    Lost,
}

impl Supervisor {
    /// Learns what the enabling switch says now; a motion that goes on while it is not held is halted before this returns. A supervisor that
    /// gets no such call is that of a rig without a switch.
    pub fn enabling(&mut self, enabling: Enabling) {
        self.enabling = enabling;
        if let Some(trip) = self.withheld()
            && self.is_under_way()
        {
            self.trip(trip);
        }
    }

    /// Why no motion may begin, if none may: the enabling switch is not held.
    pub fn withheld(&self) -> Option<Trip> {
        match self.enabling {
            Enabling::Held => None,
            Enabling::Released => Some(Trip::Released),
            Enabling::Lost => Some(Trip::SwitchLost),
        }
    }

    /// Learns that the tip is sent along a straight way, before it is.
    ///
    /// # Errors
    /// [`Supervisor::withheld`], or what it halted for since the last halt was ended: then it must not be sent.
    pub fn sent(&mut self, from: Pose, to: Pose) -> Result<(), Trip> {
        if let Some(trip) = self.withheld().or(self.tripped) {
            return Err(self.trip(trip));
        }
        self.way = Some([from, to]);
        Ok(())
    }
}
