//! Indentation in progress.

use super::specimen::Mounted;
use crate::bench::Bench;
use crate::contact::{BoardStand, Contact, Indentation, Relaxation, Wear};

/// State of a gel from first touch until the tip leaves.
#[derive(Debug)]
pub(super) struct Touch {
    place_mm: [f64; 2],
    surface_mm: f64,
    stiffness: f64,
    deepest_mm: f64,
    wear: Wear,
    memory: Relaxation,
}

impl Touch {
    /// Creates the state of a tip about to touch the gel at `surface_mm`, with the `wear` of the point.
    pub(super) fn above(bench: &Bench, place_mm: [f64; 2], surface_mm: f64, wear: Wear) -> Touch {
        Touch {
            place_mm,
            surface_mm,
            stiffness: bench.unit().stiffness(place_mm),
            deepest_mm: 0.0,
            wear,
            memory: bench.solid().relaxation(),
        }
    }

    /// Maximum depth of the tip.
    pub(super) fn deepest_mm(&self) -> f64 {
        self.deepest_mm
    }

    /// Advances the state of the gel by `step_s`, to the tip position `tip_mm`. Returns true if the tip is in the gel.
    pub(super) fn follow(
        &mut self,
        bench: &Bench,
        mounted: Mounted,
        tip_mm: [f64; 3],
        step_s: f64,
    ) -> bool {
        let depth_mm = self.depth_mm(tip_mm);
        if depth_mm <= 0.0 {
            return false;
        }
        self.deepest_mm = self.deepest_mm.max(depth_mm);
        let elastic_n = match mounted {
            Mounted::Ball(ball) => {
                let indentation = self.indentation(bench, ball.radius_mm(), tip_mm);
                bench.solid().elastic_force_n(&indentation, depth_mm)
            }
            Mounted::Board(_) => {
                bench.solid().board(depth_mm).force_n * self.stiffness(bench, depth_mm)
            }
        };
        self.memory.step(elastic_n, self.memory.decay(step_s));
        true
    }

    /// Contact of a ball.
    pub(super) fn contact(&self, bench: &Bench, radius_mm: f64, tip_mm: [f64; 3]) -> Contact {
        let indentation = self.indentation(bench, radius_mm, tip_mm);
        let contact = bench.solid().contact_at(&indentation, self.memory.ratio());
        Contact {
            travel_mm: contact.depth_mm,
            ..contact
        }
    }

    /// State of a board in the gel.
    pub(super) fn board(&self, bench: &Bench, tip_mm: [f64; 3]) -> BoardStand {
        let travel_mm = self.depth_mm(tip_mm);
        let stand = bench.solid().board(travel_mm);
        let stiffness = self.stiffness(bench, travel_mm) * self.memory.ratio();
        BoardStand {
            force_n: self.memory.force_n(),
            young_modulus_mpa: stand.young_modulus_mpa * stiffness,
            ..stand
        }
    }

    fn depth_mm(&self, [.., z]: [f64; 3]) -> f64 {
        z - self.surface_mm
    }

    fn indentation(&self, bench: &Bench, radius_mm: f64, tip_mm: [f64; 3]) -> Indentation {
        let depth_mm = self.depth_mm(tip_mm);
        Indentation {
            place_mm: self.place_mm,
            depth_mm,
            deepest_mm: self.deepest_mm.max(depth_mm),
            shear_mm: [tip_mm[0] - self.place_mm[0], tip_mm[1] - self.place_mm[1]],
            indenter_radius_mm: radius_mm,
            stiffness: self.stiffness(bench, depth_mm),
        }
    }

    /// Relative stiffness of the gel at this point, after its wear.
    fn stiffness(&self, bench: &Bench, depth_mm: f64) -> f64 {
        self.stiffness * bench.conditioning().remaining(self.wear, depth_mm)
    }
}

/// Height of first touch, z into the gel, mm.
pub(super) fn surface_mm(bench: &Bench, mounted: Mounted, place_mm: [f64; 2]) -> f64 {
    match mounted {
        Mounted::Ball(ball) => {
            let ideal = bench.solid().touch_height_mm(place_mm, ball.radius_mm());
            -ideal - bench.unit().height_mm(place_mm)
        }
        // A board rests on the middle of the gel.
        Mounted::Board(_) => -bench.unit().height_mm([0.0; 2]),
    }
}
