//! Conditioning of a gel by earlier presses, also called the Mullins effect.
//!
//! Below the depth of earlier presses, a gel has 1 − m (1 − e^(−n/n₀)) of its force after n presses, with the greatest loss m and the constant n₀ of
//! its material. The history depends on the set of finished presses, not on their order. An interrupted run therefore has the same gel.

use std::collections::BTreeMap;

use crate::parameters::Material;

/// Conditioning law of a gel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conditioning {
    fraction: f64,
    presses: f64,
}

/// Wear of one point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wear {
    /// Number of presses.
    pub presses: u32,
    /// Maximum depth, mm.
    pub deepest_mm: f64,
}

impl Conditioning {
    /// Reads the law from the material.
    pub fn new(material: &Material) -> Conditioning {
        Conditioning {
            fraction: material.conditioning_fraction,
            presses: material.conditioning_presses,
        }
    }

    /// Remaining share of the force at `depth_mm` for a point with this wear.
    pub fn remaining(&self, wear: Wear, depth_mm: f64) -> f64 {
        if wear.presses == 0 || depth_mm >= wear.deepest_mm {
            return 1.0;
        }
        let settled = -libm::expm1(-f64::from(wear.presses) / self.presses);
        1.0 - self.fraction * settled
    }
}

/// Wear of a gel from the finished presses of a run, by point.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct History {
    points: BTreeMap<u64, Wear>,
}

impl History {
    /// Creates the history of a new gel.
    pub fn new() -> History {
        History::default()
    }

    /// Adds a press to `depth_mm` at `point`.
    pub fn finish(&mut self, point: u64, depth_mm: f64) {
        let wear = self.points.entry(point).or_default();
        wear.presses = wear.presses.saturating_add(1);
        wear.deepest_mm = wear.deepest_mm.max(depth_mm);
    }

    /// Wear of `point`.
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
