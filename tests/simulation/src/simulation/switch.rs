//! Enabling switch of the simulated world: its state, and invariants while nobody holds the switch.

use super::fault::FaultKind;
use super::oracle::{HALT_WITHIN_S, UNHELD};
use super::world::{Sabotage, World};
use taceva_protocol::Enabling;

impl World {
    /// State of the enabling switch, as its monitoring thread reads it.
    pub(super) fn feel(&mut self, now_s: f64) -> Enabling {
        let said = [
            (FaultKind::Unplugged, Enabling::Lost),
            (FaultKind::Released, Enabling::Released),
        ];
        let mut said = said.into_iter();
        let said = said.find(|(kind, _)| self.faults.strike(*kind, now_s));
        let said = said.filter(|_| self.sabotage != Sabotage::UnheededSwitch);
        said.map_or(Enabling::Held, |(_, enabling)| enabling)
    }

    /// True if the enabling switch is unplugged.
    pub(super) fn is_unplugged(&self) -> bool {
        let unheld = self.faults.unheld(self.now_s);
        unheld.is_some_and(|(kind, _)| kind == FaultKind::Unplugged)
    }

    /// Checks a robot that moves now and started at `began_s`, s. While nobody holds the switch, no motion may start, and a motion in progress must
    /// be halted.
    pub(super) fn is_let_move(&mut self, began_s: f64) {
        let Some((_, since_s)) = self.faults.unheld(self.now_s) else {
            self.oracle.is_held();
            return;
        };
        if began_s - since_s > HALT_WITHIN_S {
            self.oracle
                .defied("a motion while nobody holds the enabling switch");
        } else {
            self.hazard(UNHELD, since_s.max(began_s));
        }
    }
}
