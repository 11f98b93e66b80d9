//! Tangential loading of a round contact.
//!
//! # Reference
//! Cattaneo (1938), Mindlin (1949) for the first loading; Mindlin and Deresiewicz (1953) for its reversal at constant normal force.

/// Tangential resistance of a contact: initial stiffness k₀, and maximum force μF.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Friction {
    /// μF, the force at which the whole contact slides.
    pub limit_n: f64,
    /// k₀, the stiffness before any sliding; above 0.
    pub stiffness_n_per_mm: f64,
}

impl Friction {
    /// Displacement at which the whole contact slides: 3 μF / (2 k₀), with the sliding force μF and the initial stiffness k₀.
    pub fn sliding_begins_mm(&self) -> f64 {
        1.5 * self.limit_n / self.stiffness_n_per_mm
    }

    /// Force at the displacement s of a first loading with the sliding force μF: Q(s) = μF [1 − (1 − s/s_max)^(3/2)], where s_max is
    /// [`sliding_begins_mm`](Friction::sliding_begins_mm). The force is μF beyond s_max.
    pub fn load(&self, displacement_mm: f64) -> f64 {
        self.resist(displacement_mm / self.sliding_begins_mm())
    }

    /// Force at the displacement s after the reversal at s* = `turned_mm`: Q(s) = Q(s*) − 2 μF [1 − (1 − (s* − s)/(2 s_max))^(3/2)], at least −μF.
    /// The force μF is the sliding force, and s_max is [`sliding_begins_mm`](Friction::sliding_begins_mm).
    pub fn unload(&self, turned_mm: f64, displacement_mm: f64) -> f64 {
        let back = (turned_mm - displacement_mm) / (2.0 * self.sliding_begins_mm());
        (self.load(turned_mm) - 2.0 * self.resist(back)).max(-self.limit_n)
    }

    /// Stick radius divided by the contact radius at the force Q: (1 − |Q|/μF)^(1/3), with the sliding force μF.
    pub fn stick_ratio(&self, force_n: f64) -> f64 {
        libm::cbrt((1.0 - force_n.abs() / self.limit_n).max(0.0))
    }

    /// Force at `share`, the displacement divided by the displacement of full sliding.
    fn resist(&self, share: f64) -> f64 {
        let rest = (1.0 - share).max(0.0);
        self.limit_n * (1.0 - rest * rest.sqrt())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CONTACT: Friction = Friction {
        limit_n: 0.8,
        stiffness_n_per_mm: 2.0,
    };

    #[test]
    fn a_contact_dragged_there_and_back_resists_on_the_way_back() {
        let turned = 0.4;
        assert!((CONTACT.unload(turned, turned) - CONTACT.load(turned)).abs() < 1e-12);
        assert!(CONTACT.unload(turned, 0.0) < 0.0);
        let far_back = CONTACT.unload(turned, turned - 4.0 * CONTACT.sliding_begins_mm());
        assert!((far_back + CONTACT.limit_n).abs() < 1e-12);
    }

    #[test]
    fn the_sticking_disc_shrinks_to_nothing() {
        assert!((CONTACT.stick_ratio(0.0) - 1.0).abs() < 1e-12);
        assert!(CONTACT.stick_ratio(CONTACT.limit_n).abs() < 1e-12);
    }

    #[test]
    fn a_contact_without_friction_does_not_resist() {
        let smooth = Friction {
            limit_n: 0.0,
            ..CONTACT
        };
        assert!(smooth.load(0.3).abs() < 1e-15);
    }
}
