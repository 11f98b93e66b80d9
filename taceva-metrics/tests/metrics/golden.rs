//! Golden values, bit for bit: in the given order, shuffled, in random chunks, in random merge trees, and on two threads.
//!
//! `TACEVA_GOLDEN` names a folder with another `pairs.json` of the same schema.

use std::path::PathBuf;

use crate::support::golden_pairs::{Case, read_cases};
use taceva_core::random::SplitMix64;
use taceva_core::{Batch, Channel, Channels, Column, FieldSet};
use taceva_metrics::{
    Evaluation, Evaluator, Isa, MetricPlan, PairSpec, PairSums, Paired, Stream, Streams,
    UndefinedReason, Value, catalogue,
};

fn cases() -> Vec<Case> {
    let folder = std::env::var_os("TACEVA_GOLDEN").map_or_else(
        || PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/golden")),
        PathBuf::from,
    );
    let file = folder.join("pairs.json");
    let text = std::fs::read_to_string(&file)
        .unwrap_or_else(|error| panic!("cannot read {}: {error}", file.display()));
    read_cases(&text)
}

/// Scores computed in two ways: from the sums alone, and by a whole evaluation.
struct Outcome {
    sums: PairSums,
    evaluator: Evaluator,
}

impl Outcome {
    fn new() -> Outcome {
        let channels = Channels::new([Channel::FZ]).expect("one channel");
        let plan = MetricPlan::new(&catalogue::ALL, channels, FieldSet::PAIRS);
        Outcome {
            sums: PairSums::new(PairSpec::new(Streams::ALL)),
            evaluator: Evaluator::new(&plan),
        }
    }

    fn of(truth: &[f64], prediction: &[f64]) -> Outcome {
        let mut outcome = Outcome::new();
        outcome.update(truth, prediction);
        outcome
    }

    fn update(&mut self, truth: &[f64], prediction: &[f64]) {
        let pairs = Paired::try_columns(prediction, truth).expect("one length");
        self.sums.update(pairs);
        let batch = Batch::from_columns(
            self.evaluator.plan().channels().clone(),
            vec![Column::full(truth.to_vec())],
            vec![Column::full(prediction.to_vec())],
            None,
        );
        self.evaluator.update(&batch).expect("the plan's channel");
    }

    fn merge(mut self, other: Outcome) -> Outcome {
        self.sums.try_merge(&other.sums).expect("one specification");
        self.evaluator.merge(other.evaluator).expect("one plan");
        self
    }

    fn check(self, case: &Case, how: &str) {
        let evaluation = self.evaluator.finish().expect("the plan's channel");
        assert_eq!(self.sums.n(), case.expected.n, "{}: n, {how}", case.name);
        for (key, expected) in &case.expected.canonical {
            let found = canonical(key, &self.sums, &evaluation, *expected);
            assert_eq!(
                found.map(f64::to_bits),
                expected.map(f64::to_bits),
                "{}: {key}, {how}: {found:?} is not {expected:?}",
                case.name
            );
        }
        for (metric, status) in &case.expected.status {
            let found = status_of(value(&evaluation, metric));
            assert_eq!(found, status, "{}: status of {metric}, {how}", case.name);
        }
        assert!(
            !case.expected.status.is_empty(),
            "{}: nothing expected",
            case.name
        );
    }
}

/// Value of `key` in the golden file.
fn canonical(
    key: &str,
    sums: &PairSums,
    evaluation: &Evaluation,
    expected: Option<f64>,
) -> Option<f64> {
    let sum = |stream| Some(sums.sum(stream).to_f64());
    let score = |metric| match value(evaluation, metric) {
        Value::Scalar(value) => Some(value),
        // Beyond binary64 the golden file has an infinity; the score has a reason.
        Value::Undefined(UndefinedReason::Overflow) => {
            expected.filter(|expected| expected.is_infinite())
        }
        _ => None,
    };
    match key {
        "mae" | "bias" | "r2" | "smape" => score(key),
        "sse" => sum(Stream::Squared),
        "sst" => Some(sums.total_sum_of_squares()),
        "rmse_sq" => {
            let squared = sums.mean_squared_error();
            // The root of the exact quotient is within one unit of the root of the rounded quotient. It may be in range even if the square
            // is not.
            let root = score("rmse").unwrap_or(f64::INFINITY);
            if squared.is_normal() {
                let apart = root.to_bits().abs_diff(squared.sqrt().to_bits());
                assert!(apart <= 1, "rmse: {root:e} of {squared:e}");
            }
            Some(squared)
        }
        "sum_abs" => sum(Stream::Absolute),
        "sum_y" => sum(Stream::Truth),
        "sum_yy" => sum(Stream::TruthSquared),
        "sum_t" => sum(Stream::Symmetric),
        "var_abs_ddof1" => sums.absolute_variance(),
        other => panic!("canonical value `{other}` is not known to this reader"),
    }
}

fn value(evaluation: &Evaluation, metric: &str) -> Value {
    let score = evaluation.score(metric, "Fz");
    score
        .unwrap_or_else(|| panic!("no score {metric}"))
        .value
        .clone()
}

fn status_of(value: Value) -> &'static str {
    match value {
        Value::Scalar(_) | Value::Undefined(UndefinedReason::Overflow) => "ok",
        Value::Undefined(UndefinedReason::Empty) => "empty",
        Value::Undefined(UndefinedReason::TooFew { .. }) => "too_few",
        Value::Undefined(UndefinedReason::ConstantTruth { perfect: false }) => "constant_truth",
        Value::Undefined(UndefinedReason::ConstantTruth { perfect: true }) => {
            "constant_truth_exact"
        }
        other => panic!("{other:?} has no golden status"),
    }
}

/// Outcomes for the rows of the case in another order, cut into random chunks.
fn shuffled_chunks(case: &Case, random: &mut SplitMix64) -> Vec<Outcome> {
    let mut rows: Vec<usize> = (0..case.truth.len()).collect();
    random.shuffle(&mut rows);
    let mut chunks = Vec::new();
    let mut rest = &rows[..];
    while !rest.is_empty() {
        let longest = rest.len().min(1 + case.truth.len() / 7);
        let (chunk, others) = rest.split_at(1 + random.below(longest));
        let pick = |column: &[f64]| -> Vec<f64> { chunk.iter().map(|&row| column[row]).collect() };
        chunks.push(Outcome::of(&pick(&case.truth), &pick(&case.prediction)));
        rest = others;
    }
    chunks
}

/// Runs the other test in a separate process for each instruction set, because a process selects its instruction set only once.
#[test]
fn every_golden_value_is_met_on_every_instruction_set_of_the_machine() {
    let program = std::env::current_exe().expect("this program");
    for isa in Isa::available() {
        let run = std::process::Command::new(&program)
            .args(["--exact", EVERY_VALUE, "--nocapture"])
            .env("TACEVA_ISA", isa.name())
            .output()
            .expect("this program starts");
        let printed = String::from_utf8_lossy(&run.stdout);
        assert!(run.status.success(), "{isa}: {printed}");
        let compared = format!("on {isa}: compared");
        assert!(printed.contains(&compared), "{isa}: {printed}");
    }
}

/// Name of the test below.
const EVERY_VALUE: &str = "golden::every_golden_value_is_met_bit_for_bit_however_the_samples_come";

#[test]
fn every_golden_value_is_met_bit_for_bit_however_the_samples_come() {
    let cases = cases();
    let mut values = 0;
    for case in &cases {
        let mut random = SplitMix64::new(case.truth.len() as u64);
        Outcome::of(&case.truth, &case.prediction).check(case, "in order");

        let chunks = shuffled_chunks(case, &mut random);
        let in_chunks = chunks.into_iter().fold(Outcome::new(), Outcome::merge);
        in_chunks.check(case, "shuffled in chunks");

        let mut trees = shuffled_chunks(case, &mut random);
        while trees.len() > 1 {
            let left = trees.swap_remove(random.below(trees.len()));
            let right = trees.swap_remove(random.below(trees.len()));
            trees.push(left.merge(right));
        }
        let tree = trees.pop().unwrap_or_else(Outcome::new);
        tree.check(case, "in a merge tree");

        let half = case.truth.len() / 2;
        let halves = std::thread::scope(|scope| {
            let (truth, prediction) = (&case.truth, &case.prediction);
            let left = scope.spawn(move || Outcome::of(&truth[..half], &prediction[..half]));
            let right = scope.spawn(move || Outcome::of(&truth[half..], &prediction[half..]));
            [right, left].map(|thread| thread.join().expect("no thread panics"))
        });
        let [right, left] = halves;
        right.merge(left).check(case, "on two threads");

        values += case.expected.canonical.len() + case.expected.status.len();
    }
    assert!(!cases.is_empty(), "no case was compared");
    println!(
        "on {}: compared {} golden cases, {values} values each in 4 ways",
        Isa::detect(),
        cases.len()
    );
}
