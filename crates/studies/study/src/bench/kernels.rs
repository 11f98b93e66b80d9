//! Race of summation kernels on the same columns: time per pair of values, and number of correct digits.

use serde::Serialize;
use taceva_core::Progress;
use taceva_metrics::bench::{
    ALL_DIGITS, Case, Kernel, Kind, Order, Scores, digits, nasty_inputs, shuffled, stream_sum,
};
use taceva_metrics::{Isa, Paired};

use super::{BENCH_SCHEMA, Machine, Spread, Stopwatch};
use taceva_evaluate::EvaluateError;

/// Number of channels of the timed columns: the six contact channels Px, Py, Pz, Fx, Fy and Fz.
const CHANNELS: usize = 6;
/// Kind of values for the columns, typical of a laboratory: positions in mm with errors of about 0.3 mm.
const LAB: Kind = Kind::Lab {
    low: -12.5,
    high: 12.5,
    noise: 0.3,
};
/// Number of shuffles of the rows for the test of an order-free kernel.
const SHUFFLES: u64 = 3;

/// Request of a race of summation kernels.
#[derive(Clone, Copy, Debug)]
pub struct KernelRequest {
    /// Number of timed rows in each of the six contact channels.
    pub rows: usize,
    /// Number of timed runs of each kernel.
    pub rounds: usize,
    /// Seed of the random columns and of their shuffles.
    pub seed: u64,
}

impl Default for KernelRequest {
    /// A million rows, fifteen rounds, seed 0.
    fn default() -> KernelRequest {
        KernelRequest {
            rows: 1_000_000,
            rounds: 15,
            seed: 0,
        }
    }
}

/// Run time and error of every summation kernel, with the schema [`BENCH_SCHEMA`].
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct KernelBench {
    /// Always [`BENCH_SCHEMA`].
    pub schema: &'static str,
    /// Always `kernels`.
    pub subject: &'static str,
    /// Machine that ran the benchmark.
    pub machine: Machine,
    /// Number of timed rows in each of the six contact channels.
    pub rows_timed: usize,
    /// Number of timed runs of each kernel.
    pub rounds: usize,
    /// Time to sum the columns once, which is the lower limit for any kernel.
    pub floor: Floor,
    /// Rows of the kernels, in the order of the race. A kernel has one row for all scores, and one for the mean absolute error alone.
    pub rows: Vec<KernelRow>,
}

/// Time to sum the columns of truth and prediction once: the lower limit for any kernel.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Floor {
    /// Always `stream sum`.
    pub name: &'static str,
    /// Wall time for each pair of values, in nanoseconds.
    pub ns_per_pair: Spread,
    /// Processor time of the thread for each pair of values, in nanoseconds; `None` if the system does not report it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub thread_ns_per_pair: Option<Spread>,
    /// Throughput of the shortest run, in GB/s.
    pub gb_per_s: f64,
}

/// Time and accuracy of one summation kernel.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct KernelRow {
    /// Name of the kernel.
    pub name: String,
    /// Instruction set that the kernel was compiled for, if any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub isa: Option<String>,
    /// Scores that the kernel computes: `mae r2 smape`, or `mae`.
    pub scores: &'static str,
    /// Wall time for each pair of values, in nanoseconds.
    pub ns_per_pair: Spread,
    /// Processor time of the thread for each pair of values, in nanoseconds; `None` if the system does not report it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub thread_ns_per_pair: Option<Spread>,
    /// Shortest wall time divided by the shortest wall time of [`Floor`], which only sums the columns.
    pub times_floor: f64,
    /// Least number of correct decimal digits, over all scores of the kernel and all inputs.
    pub digits_min: f64,
    /// Least number of correct decimal digits over the scores of the kernel, for each input.
    pub digits: Vec<InputDigits>,
    /// True if the scores have the same bits for any order of rows.
    pub order_free: bool,
    /// True if no other kernel for the same scores is faster with at least as many correct digits.
    pub pareto: bool,
}

/// Accuracy of a kernel on one input.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct InputDigits {
    /// Name of the input: a kind of columns that is difficult to sum.
    pub input: &'static str,
    /// Least number of correct decimal digits over the scores of the kernel.
    pub digits: f64,
}

/// One kernel of the race, for all scores or for the mean absolute error alone.
#[derive(Clone, Copy)]
struct Candidate {
    kernel: Kernel,
    mae_only: bool,
}

impl Candidate {
    fn run(self, pairs: Paired<&[f64]>) -> Scores {
        if self.mae_only {
            Scores {
                mae: self.kernel.run_mae(pairs),
                ..Scores::default()
            }
        } else {
            self.kernel.run(pairs)
        }
    }

    /// Least number of correct decimal digits among the scores for which `truth` has a value.
    fn digits(self, pairs: Paired<&[f64]>, truth: &Scores) -> f64 {
        let found = self.run(pairs);
        let scores = [
            (found.mae, truth.mae),
            (found.r2, truth.r2),
            (found.smape, truth.smape),
        ];
        let kept = if self.mae_only { &scores[..1] } else { &scores };
        let right = kept.iter().filter_map(|&(found, truth)| {
            let truth = truth?;
            Some(digits(found.unwrap_or(f64::NAN), truth))
        });
        right.fold(ALL_DIGITS, f64::min)
    }
}

/// Races all summation kernels.
///
/// # Errors
/// [`EvaluateError::Request`] without rows or rounds, or for an unavailable instruction set; [`EvaluateError::Dataset`] if `progress` cancels.
pub fn kernels(
    request: &KernelRequest,
    progress: &dyn Progress,
) -> Result<KernelBench, EvaluateError> {
    if request.rows == 0 || request.rounds == 0 {
        return Err(EvaluateError::Request(
            "a benchmark needs at least one row and one round".to_owned(),
        ));
    }
    Isa::requested().map_err(|error| EvaluateError::Request(error.to_string()))?;
    let candidates = candidates();
    let columns = columns(request);
    let watch = race(request, &candidates, &columns, progress)?;
    let pairs = (request.rows * CHANNELS) as f64;
    let per_pair = 1e9 / pairs;
    let floor = Floor {
        name: "stream sum",
        ns_per_pair: finished(watch.wall(0))?.times(per_pair),
        thread_ns_per_pair: watch.thread(0).map(|time| time.times(per_pair)),
        gb_per_s: pairs * 16.0 / finished(watch.wall(0))?.best / 1e9,
    };
    progress.begin("count digits", Some(candidates.len() as u64));
    let mut rows = Vec::new();
    for (position, candidate) in candidates.iter().enumerate() {
        let time = finished(watch.wall(position + 1))?.times(per_pair);
        let digits = on_every_input(*candidate);
        rows.push(KernelRow {
            name: candidate.kernel.name(),
            isa: isa(candidate.kernel),
            scores: if candidate.mae_only {
                "mae"
            } else {
                "mae r2 smape"
            },
            ns_per_pair: time,
            thread_ns_per_pair: watch.thread(position + 1).map(|time| time.times(per_pair)),
            times_floor: time.best / floor.ns_per_pair.best,
            digits_min: digits
                .iter()
                .map(|input| input.digits)
                .fold(f64::INFINITY, f64::min),
            digits,
            order_free: candidate.kernel.is_order_free()
                && survives_shuffling(*candidate, request.seed),
            pareto: false,
        });
        progress.advance(1);
    }
    progress.end();
    mark_pareto(&mut rows);
    Ok(KernelBench {
        schema: BENCH_SCHEMA,
        subject: "kernels",
        machine: Machine::here(
            1,
            Isa::available()
                .iter()
                .map(|isa| isa.name().to_owned())
                .collect(),
        ),
        rows_timed: request.rows,
        rounds: request.rounds,
        floor,
        rows,
    })
}

fn candidates() -> Vec<Candidate> {
    let all = Kernel::available();
    let full = all.iter().map(|kernel| Candidate {
        kernel: *kernel,
        mae_only: false,
    });
    let mae = all.iter().map(|kernel| Candidate {
        kernel: *kernel,
        mae_only: true,
    });
    full.chain(mae).collect()
}

/// Truth and prediction of six channels, with values typical of a laboratory.
fn columns(request: &KernelRequest) -> Vec<Paired<Vec<f64>>> {
    (0..CHANNELS as u64)
        .map(|channel| {
            let case = Case {
                kind: LAB,
                rows: request.rows,
                seed: request.seed.wrapping_add(channel),
                order: Order::AsMade,
            };
            case.columns()
        })
        .collect()
}

fn race(
    request: &KernelRequest,
    candidates: &[Candidate],
    columns: &[Paired<Vec<f64>>],
    progress: &dyn Progress,
) -> Result<Stopwatch, EvaluateError> {
    let turns = (request.rounds + 1) * (candidates.len() + 1);
    progress.begin("race", Some(turns as u64));
    let watch = Stopwatch::race(
        candidates.len() + 1,
        request.rounds,
        |position| {
            for pairs in columns.iter().map(as_slices) {
                match position.checked_sub(1) {
                    None => drop(std::hint::black_box(stream_sum(std::hint::black_box(
                        pairs,
                    )))),
                    Some(candidate) => drop(std::hint::black_box(
                        candidates[candidate].run(std::hint::black_box(pairs)),
                    )),
                }
            }
        },
        || {
            progress.advance(1);
            !progress.is_cancelled()
        },
    );
    progress.end();
    if progress.is_cancelled() {
        return Err(taceva_dataset::DatasetError::Cancelled.into());
    }
    Ok(watch)
}

fn finished(time: Option<Spread>) -> Result<Spread, EvaluateError> {
    time.ok_or_else(|| EvaluateError::Request("no measurement was made".to_owned()))
}

fn on_every_input(candidate: Candidate) -> Vec<InputDigits> {
    nasty_inputs()
        .map(|(input, case)| {
            let columns = case.columns();
            let truth = Kernel::truth(as_slices(&columns));
            InputDigits {
                input,
                digits: candidate.digits(as_slices(&columns), &truth),
            }
        })
        .collect()
}

fn survives_shuffling(candidate: Candidate, seed: u64) -> bool {
    nasty_inputs().all(|(_, case)| {
        let columns = case.columns();
        let first = candidate.run(as_slices(&columns));
        (0..SHUFFLES).all(|shuffle| {
            let other = shuffled(&columns, seed.wrapping_add(shuffle));
            bits(&candidate.run(as_slices(&other))) == bits(&first)
        })
    })
}

/// Instruction set that a kernel was compiled for, if any.
fn isa(kernel: Kernel) -> Option<String> {
    match kernel {
        Kernel::Exact(isa) => Some(isa.name().to_owned()),
        _ => None,
    }
}

fn bits(scores: &Scores) -> [Option<u64>; 3] {
    [scores.mae, scores.r2, scores.smape].map(|score| score.map(f64::to_bits))
}

fn as_slices(columns: &Paired<Vec<f64>>) -> Paired<&[f64]> {
    columns.as_slices()
}

/// Marks the kernels on the Pareto front: no other kernel for the same scores is faster with at least as many digits.
fn mark_pareto(rows: &mut [KernelRow]) {
    let beaten: Vec<bool> = rows
        .iter()
        .map(|row| {
            rows.iter().any(|other| {
                other.scores == row.scores
                    && other.ns_per_pair.best < row.ns_per_pair.best
                    && other.digits_min >= row.digits_min
            })
        })
        .collect();
    for (row, beaten) in rows.iter_mut().zip(beaten) {
        row.pareto = !beaten;
    }
}
