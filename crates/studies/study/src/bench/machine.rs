//! Machine that ran a benchmark. Times of different machines cannot be compared.

use serde::Serialize;

/// Machine that ran a benchmark.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Machine {
    /// Name of the processor, or `unknown`.
    pub cpu: String,
    /// Number of cores that this process may use.
    pub cores: usize,
    /// Number of threads of the benchmark.
    pub threads: usize,
    /// Instruction sets for which the program has its own code, the widest vectors first.
    pub isa: Vec<String>,
    /// Mean number of runnable processes per core in the last minute; `None` if the system does not report it.
    pub load: Option<f64>,
}

impl Machine {
    /// Describes this machine, for a benchmark on `threads` threads.
    pub fn here(threads: usize, isa: Vec<String>) -> Machine {
        let cores = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
        Machine {
            cpu: cpu_name().unwrap_or_else(|| "unknown".to_owned()),
            cores,
            threads,
            isa,
            load: load_of_last_minute().map(|load| load / cores as f64),
        }
    }
}

/// Name of the processor as Linux reports it; `None` if unknown.
fn cpu_name() -> Option<String> {
    let text = std::fs::read_to_string("/proc/cpuinfo").ok()?;
    let line = text.lines().find(|line| line.starts_with("model name"))?;
    Some(line.split_once(':')?.1.trim().to_owned())
}

fn load_of_last_minute() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/loadavg").ok()?;
    text.split_whitespace().next()?.parse().ok()
}
