//! Options of the simulated gel.

use taceva_sim::{Model, ParameterError, Parameters};

/// Sensor type of the simulated gel, and the size of its errors.
#[derive(Clone, Debug, PartialEq)]
pub struct BenchOptions {
    /// Model of the sensor.
    pub model: Model,
    /// Seed of all random errors.
    pub seed: u64,
    /// True to simulate no errors, drift or relaxation, like the argument `quiet` of simulated sensors. Studies over sockets and in the program can
    /// then be compared.
    pub is_quiet: bool,
    /// Camera pixels per frame pixel, along x and y.
    pub reduction: u32,
}

impl BenchOptions {
    /// Options for a GelSight with the errors of the simulated bench.
    pub fn noisy(seed: u64) -> BenchOptions {
        BenchOptions {
            model: Model::GelSight,
            seed,
            is_quiet: false,
            reduction: 20,
        }
    }

    /// Options for a GelSight without errors.
    pub fn quiet(seed: u64) -> BenchOptions {
        BenchOptions {
            is_quiet: true,
            ..BenchOptions::noisy(seed)
        }
    }

    /// Parameters of the simulated gel with these options.
    pub(crate) fn parameters(&self) -> Result<Parameters, ParameterError> {
        match self.is_quiet {
            true => Parameters::parse_quiet(self.model.table()),
            false => Ok(self.model.parameters()),
        }
    }
}
