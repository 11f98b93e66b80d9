//! Relaxation of a gel: one term of a Prony series.
//!
//! F(t) = (1 − g) F₀(d(t)) + h(t), dh/dt = −h/τ + g dF₀/dt, with the force F₀ of a gel without relaxation at the depth d, the relaxing fraction g and
//! the time constant τ. A step with linear F₀ is exact at any length: h ← h e^(−Δt/τ) + g ΔF₀ (τ/Δt) (1 − e^(−Δt/τ)). The force is never below zero,
//! because a gel that recovers too slowly loses contact.
//!
//! # Reference
//! Standard linear solid; Lee and Radok (1960) for a growing contact. It is an approximation for unloading, where the contact shrinks.

/// Relaxation state of a gel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Relaxation {
    fraction: f64,
    time_s: f64,
    elastic_n: f64,
    fading_n: f64,
}

/// Decay of the relaxation state in one step. Steps of equal length share one value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Decay {
    kept: f64,
    gained: f64,
}

impl Relaxation {
    /// Creates a gel at rest. The `fraction` of its force relaxes with the time constant `time_s`.
    pub fn new(fraction: f64, time_s: f64) -> Relaxation {
        Relaxation {
            fraction,
            time_s,
            elastic_n: 0.0,
            fading_n: 0.0,
        }
    }

    /// True if the gel does not relax.
    pub fn is_elastic(&self) -> bool {
        self.fraction <= 0.0
    }

    /// Decay in a step of `step_s`.
    pub fn decay(&self, step_s: f64) -> Decay {
        let share = step_s / self.time_s;
        if share <= 0.0 {
            return Decay {
                kept: 1.0,
                gained: 1.0,
            };
        }
        let lost = -libm::expm1(-share);
        Decay {
            kept: 1.0 - lost,
            gained: lost / share,
        }
    }

    /// Advances one step. `elastic_n` is the force of a gel without relaxation at the same indentation.
    pub fn step(&mut self, elastic_n: f64, decay: Decay) {
        let grown = self.fraction * (elastic_n - self.elastic_n);
        self.fading_n = self.fading_n * decay.kept + grown * decay.gained;
        self.elastic_n = elastic_n;
    }

    /// Current force.
    pub fn force_n(&self) -> f64 {
        ((1.0 - self.fraction) * self.elastic_n + self.fading_n).max(0.0)
    }

    /// Ratio of the current force to the force of a gel without relaxation; 1 if the force without relaxation is zero.
    pub fn ratio(&self) -> f64 {
        if self.elastic_n > 0.0 {
            self.force_n() / self.elastic_n
        } else {
            1.0
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_gel_held_still_relaxes_by_its_fraction_and_no_more() {
        let mut gel = Relaxation::new(0.4, 2.0);
        gel.step(1.0, gel.decay(0.0));
        assert!((gel.force_n() - 1.0).abs() < 1e-12, "a jump finds it stiff");
        gel.step(1.0, gel.decay(2.0));
        let expected = 1.0 - 0.4 * (1.0 - (-1.0_f64).exp());
        assert!((gel.force_n() - expected).abs() < 1e-12);
        gel.step(1.0, gel.decay(1e6));
        assert!((gel.force_n() - 0.6).abs() < 1e-12);
    }

    #[test]
    fn one_long_step_equals_many_short_ones_where_the_force_grows_evenly() {
        let (mut once, mut often) = (Relaxation::new(0.4, 0.5), Relaxation::new(0.4, 0.5));
        once.step(1.0, once.decay(1.0));
        for step in 1..=100 {
            often.step(f64::from(step) / 100.0, often.decay(0.01));
        }
        assert!((once.force_n() - often.force_n()).abs() < 1e-12);
    }

    #[test]
    fn a_gel_pulled_back_faster_than_it_recovers_lets_go() {
        let mut gel = Relaxation::new(0.5, 0.1);
        gel.step(1.0, gel.decay(10.0));
        gel.step(0.0, gel.decay(0.0));
        assert!(gel.force_n().abs() < 1e-15);
    }
}
