//! The machine of a benchmark, without which its numbers cannot be compared.

use serde::Serialize;

/// The machine a benchmark ran on.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Machine {
    /// The name of the processor, or `unknown`.
    pub cpu: String,
    /// Cores that this process may use.
    pub cores: usize,
    /// Threads that the benchmark used.
    pub threads: usize,
    /// Instruction sets with their own code path, the widest first.
    pub isa: Vec<String>,
    /// Mean number of runnable processes in the last minute, per core; `None` if the system does not report it.
    pub load: Option<f64>,
}

impl Machine {
    /// This machine, for a benchmark on `threads` threads.
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

/// The processor name from Linux.
fn cpu_name() -> Option<String> {
    let text = std::fs::read_to_string("/proc/cpuinfo").ok()?;
    let line = text.lines().find(|line| line.starts_with("model name"))?;
    Some(line.split_once(':')?.1.trim().to_owned())
}

fn load_of_last_minute() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/loadavg").ok()?;
    text.split_whitespace().next()?.parse().ok()
}
