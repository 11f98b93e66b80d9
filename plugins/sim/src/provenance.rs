//! Provenance of simulated numbers, which identifies them as not measured.

use std::fmt;

use crate::parameters::ParameterDigest;

/// Version of the physical model. The version increases if the same parameters and seed give different numbers.
pub const MODEL_VERSION: u32 = 2;

/// Provenance of a product of the bench.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Provenance {
    /// Name of the simulated sensor.
    pub sensor: String,
    /// Number of the unit.
    pub unit: u32,
    /// Seed of the run.
    pub seed: u64,
    /// Digest of the parameters.
    pub parameters: ParameterDigest,
}

impl Provenance {
    /// Value of `source`, in place of a measurement method.
    pub const SOURCE: &'static str = "simulated";

    /// Names and values of the provenance in a fixed order, for files and reports.
    pub fn facts(&self) -> [(&'static str, String); 6] {
        [
            ("source", Provenance::SOURCE.to_owned()),
            ("model_version", MODEL_VERSION.to_string()),
            ("sensor", self.sensor.clone()),
            ("unit", self.unit.to_string()),
            ("seed", self.seed.to_string()),
            ("parameters", self.parameters.to_string()),
        ]
    }
}

impl fmt::Display for Provenance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (position, (name, value)) in self.facts().into_iter().enumerate() {
            let separator = if position == 0 { "" } else { ", " };
            write!(f, "{separator}{name} = {value}")?;
        }
        Ok(())
    }
}
