//! What kind of bench it is.

use taceva_sim::{Model, ParameterError, Parameters};

/// Which gel is on the bench, and how much everything errs.
#[derive(Clone, Debug, PartialEq)]
pub struct BenchOptions {
    /// The sensor.
    pub model: Model,
    /// The seed of every random error.
    pub seed: u64,
    /// Whether nothing errs, drifts or relaxes, as with the argument `quiet` of the simulated sensors: a study over sockets can then be
    /// compared with one that is simulated in the program.
    pub is_quiet: bool,
    /// Pixels of the camera, along x and along y, that make one of a frame.
    pub reduction: u32,
}

impl BenchOptions {
    /// A GelSight that errs as the simulated bench does.
    pub fn noisy(seed: u64) -> BenchOptions {
        BenchOptions {
            model: Model::GelSight,
            seed,
            is_quiet: false,
            reduction: 20,
        }
    }

    /// A GelSight on a bench that errs nowhere.
    pub fn quiet(seed: u64) -> BenchOptions {
        BenchOptions {
            is_quiet: true,
            ..BenchOptions::noisy(seed)
        }
    }

    /// The parameters of this bench.
    pub(crate) fn parameters(&self) -> Result<Parameters, ParameterError> {
        match self.is_quiet {
            true => Parameters::parse_quiet(self.model.table()),
            false => Ok(self.model.parameters()),
        }
    }
}
