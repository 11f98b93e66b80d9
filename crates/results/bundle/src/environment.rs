//! The machine and the program that made a bundle.

use std::num::NonZeroUsize;

use serde::{Deserialize, Serialize};
use taceva_core::Isa;
use taceva_results::EvaluationReport;

/// Schema of `environment.json`.
pub(crate) const ENVIRONMENT_SCHEMA: &str = "taceva.environment/1";

/// Machine that `environment.json` describes.
const MACHINE: &str = "the machine on which `taceva bundle` computed the claims again; results do not state the machine that measured or scored";

/// Content of `environment.json`, without the names of host and user.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Environment {
    pub(crate) schema: String,
    /// Machine that the other keys describe, in words.
    #[serde(default)]
    pub(crate) machine: String,
    /// Version of the program.
    pub(crate) taceva: String,
    /// Operating system: `linux`.
    pub(crate) os: String,
    /// Processor: `x86_64`.
    pub(crate) arch: String,
    /// Instruction sets that the program can use on the machine, the fastest first.
    pub(crate) instruction_sets: Vec<String>,
    /// Number of threads, which affects no result.
    pub(crate) threads: usize,
    /// Plugins behind the results, as the results name them.
    pub(crate) plugins: Vec<String>,
}

impl Environment {
    /// This machine, and the plugins behind `reports`.
    pub(crate) fn here(reports: &[EvaluationReport], jobs: NonZeroUsize) -> Environment {
        let plugins = reports.iter().flat_map(|report| &report.provenance.plugins);
        let mut plugins: Vec<String> = plugins.cloned().collect();
        plugins.sort();
        plugins.dedup();
        Environment {
            schema: ENVIRONMENT_SCHEMA.to_owned(),
            machine: MACHINE.to_owned(),
            taceva: env!("CARGO_PKG_VERSION").to_owned(),
            os: std::env::consts::OS.to_owned(),
            arch: std::env::consts::ARCH.to_owned(),
            instruction_sets: instruction_sets(),
            threads: jobs.get(),
            plugins,
        }
    }

    /// True if this machine has the same instruction sets as the machine of this environment.
    pub(crate) fn has_same_sets(&self) -> bool {
        self.arch == std::env::consts::ARCH && self.instruction_sets == instruction_sets()
    }
}

/// Instruction sets that the program can use on this machine, the fastest first. `TACEVA_ISA` names a set and excludes all faster sets.
fn instruction_sets() -> Vec<String> {
    let used = Isa::detect();
    let sets = Isa::available().into_iter();
    let sets = sets.skip_while(|set| *set != used);
    sets.map(|set| set.name().to_owned()).collect()
}
