//! What earlier presses did to a gel: conditioning, also called the Mullins effect.
//!
//! Below a depth to which it was pressed before, a gel presses back with 1 − m (1 − e^(−n/n₀)) of its force after n presses. The
//! history is a function of the set of finished presses, not of their order: a run that was interrupted meets the same gel.

use std::collections::BTreeMap;

use crate::parameters::Material;

/// How a gel is conditioned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conditioning {
    fraction: f64,
    presses: f64,
}

/// What one place has gone through.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wear {
    /// How often it was pressed.
    pub presses: u32,
    /// How deep at most.
    pub deepest_mm: f64,
}

impl Conditioning {
    /// As the material says.
    pub fn new(material: &Material) -> Conditioning {
        Conditioning {
            fraction: material.conditioning_fraction,
            presses: material.conditioning_presses,
        }
    }

    /// What is left of the force at `depth_mm` of a place with this wear.
    pub fn remaining(&self, wear: Wear, depth_mm: f64) -> f64 {
        if wear.presses == 0 || depth_mm >= wear.deepest_mm {
            return 1.0;
        }
        let settled = -libm::expm1(-f64::from(wear.presses) / self.presses);
        1.0 - self.fraction * settled
    }
}

/// The finished presses of a run, as far as the gel remembers them: by point.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct History {
    points: BTreeMap<u64, Wear>,
}

impl History {
    /// A gel that nobody has pressed.
    pub fn new() -> History {
        History::default()
    }

    /// Notes a press to `depth_mm` at `point`.
    pub fn finish(&mut self, point: u64, depth_mm: f64) {
        let wear = self.points.entry(point).or_default();
        wear.presses = wear.presses.saturating_add(1);
        wear.deepest_mm = wear.deepest_mm.max(depth_mm);
    }

    /// What `point` has gone through.
    pub fn wear(&self, point: u64) -> Wear {
        self.points.get(&point).copied().unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SILICONE: Conditioning = Conditioning {
        fraction: 0.02,
        presses: 3.0,
    };

    #[test]
    fn a_gel_softens_only_where_it_was_pressed_before() {
        let wear = Wear {
            presses: 300,
            deepest_mm: 0.5,
        };
        assert!((SILICONE.remaining(wear, 0.4) - 0.98).abs() < 1e-9);
        assert!((SILICONE.remaining(wear, 0.5) - 1.0).abs() < 1e-15);
        assert!((SILICONE.remaining(Wear::default(), 0.1) - 1.0).abs() < 1e-15);
    }

    #[test]
    fn the_history_does_not_depend_on_the_order_of_presses() {
        let presses = [(1, 0.5), (2, 0.2), (1, 0.8), (1, 0.1)];
        let (mut forward, mut backward) = (History::new(), History::new());
        for (point, depth) in presses {
            forward.finish(point, depth);
        }
        for (point, depth) in presses.into_iter().rev() {
            backward.finish(point, depth);
        }
        assert_eq!(forward, backward);
        assert_eq!(forward.wear(1).presses, 3);
    }
}
