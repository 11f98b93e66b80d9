//! Ageing of a gel by presses: stiffness and surface change with the sum of their forces.

use super::sections::GelWear;
use super::{Body, ParameterError, Parameters};

/// Section with the default rates, for a gel without rates of its own.
const USUAL: &str = include_str!("../../parameters/ageing.toml");

impl Parameters {
    /// Returns the table `text` for a gel that ages. A table without a section `ageing` gets the default rates of the simulation.
    ///
    /// # Errors
    /// As [`Parameters::parse`].
    pub fn ageing_table(text: &str) -> Result<String, ParameterError> {
        Ok(match Parameters::parse(text)?.ageing {
            Some(_) => text.to_owned(),
            None => format!("{text}\n{USUAL}"),
        })
    }

    /// The sensor after presses whose forces add up to L = `load_kn`. Without a section `ageing` nothing changes.
    ///
    /// With the rates s and p, stiffness is multiplied by e^(−s L) and friction by e^(−p L). The gloss grows by 1 − e^(−p L).
    /// Entries and digest do not change, because the gel is the same at another age.
    ///
    /// ```
    /// use taceva_sim::{Model, Parameters};
    /// let new = Parameters::parse(&Parameters::ageing_table(Model::GelSight.table())?)?;
    /// let old = new.clone().aged(10.0);
    /// assert!(old.surface.friction < 0.82 * new.surface.friction);
    /// assert_eq!(old.digest(), new.digest());
    /// assert_eq!(new.clone().aged(0.0), new);
    /// # Ok::<(), taceva_sim::ParameterError>(())
    /// ```
    #[must_use]
    pub fn aged(mut self, load_kn: f64) -> Parameters {
        let Some(ageing) = self.ageing.filter(|_| load_kn > 0.0) else {
            return self;
        };
        let softer = libm::exp(-ageing.softening_per_kn * load_kn);
        let polished = -libm::expm1(-ageing.polishing_per_kn * load_kn);
        match &mut self.body {
            Body::Layer(layer) => layer.young_modulus_mpa *= softer,
            Body::Dome(dome) => {
                dome.skin_n_per_mm *= softer;
                dome.gel_n_per_mm_3_2 *= softer;
            }
        }
        self.surface.friction *= 1.0 - polished;
        if polished > 0.0 {
            self.wear.get_or_insert(GelWear::NONE).gloss += polished;
        }
        self
    }
}
