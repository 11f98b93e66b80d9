//! Options of the bench.

use taceva_sim::{Model, ParameterError, Parameters};

/// Sensor of the bench, and the size of its errors.
#[derive(Clone, Debug, PartialEq)]
pub struct BenchOptions {
    /// The sensor.
    pub model: Model,
    /// Seed of all random errors.
    pub seed: u64,
    /// True for no errors, drift or relaxation, as with the argument `quiet` of the simulated sensors. A study over sockets can then be
    /// compared with one simulated in the program.
    pub is_quiet: bool,
    /// Camera pixels per frame pixel, along x and y.
    pub reduction: u32,
}

impl BenchOptions {
    /// A GelSight with the errors of the simulated bench.
    pub fn noisy(seed: u64) -> BenchOptions {
        BenchOptions {
            model: Model::GelSight,
            seed,
            is_quiet: false,
            reduction: 20,
        }
    }

    /// A GelSight without errors.
    pub fn quiet(seed: u64) -> BenchOptions {
        BenchOptions {
            is_quiet: true,
            ..BenchOptions::noisy(seed)
        }
    }

    /// Parameters of this bench.
    pub(crate) fn parameters(&self) -> Result<Parameters, ParameterError> {
        match self.is_quiet {
            true => Parameters::parse_quiet(self.model.table()),
            false => Ok(self.model.parameters()),
        }
    }
}
