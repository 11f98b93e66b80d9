//! NIST's univariate reference datasets, for which deviations from rounded sums lose up to all digits.

use serde_json::Value;
use taceva_core::{Batch, Channel, Channels, Column, FieldSet};
use taceva_metrics::bench::{Kernel, digits};
use taceva_metrics::{
    Evaluator, ExactSum, Isa, MetricPlan, PairSpec, PairSums, Paired, Stream, Streams, catalogue,
};

/// Required number of correct digits: the greatest number in binary64, minus the rounding of a root.
const DIGITS: f64 = 15.8;

struct Dataset {
    name: String,
    values: Vec<f64>,
    mean: f64,
    deviation: f64,
}

fn datasets() -> Vec<Dataset> {
    let text = include_str!("../golden/strd.json");
    let file: Value = serde_json::from_str(text).expect("golden files are JSON");
    assert_eq!(file["schema"], "taceva-golden-strd/1");
    let number = |value: &Value| -> f64 {
        let text = value.as_str().expect("numbers stand as texts");
        text.parse().expect("a number")
    };
    let sets = file["sets"].as_object().expect("sets by name").iter();
    sets.map(|(name, set)| Dataset {
        name: name.clone(),
        values: set["data"]
            .as_array()
            .expect("a list")
            .iter()
            .map(number)
            .collect(),
        mean: number(&set["mean"]),
        deviation: number(&set["sd"]),
    })
    .collect()
}

/// Sums with the values as truths and their minimum as the estimate. All differences are exact and at least 0, so the variance of
/// the errors equals the variance of the values.
fn sums(values: &[f64], isa: Isa) -> PairSums {
    let spec = PairSpec::new(Streams::ALL);
    let mut sums = PairSums::with_isa(spec, isa).expect("it is available");
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    let estimate = vec![least; values.len()];
    sums.update(Paired::try_columns(&estimate, values).expect("one length"));
    sums
}

/// Mean of the values, computed as the bias of predictions of 0.
fn mean_of(values: &[f64]) -> f64 {
    let channels = Channels::new([Channel::FZ]).expect("one channel");
    let plan = MetricPlan::new(&catalogue::ALL, channels.clone(), FieldSet::PAIRS);
    let mut evaluator = Evaluator::new(&plan);
    let truth = vec![Column::full(values.to_vec())];
    let prediction = vec![Column::full(vec![0.0; values.len()])];
    let batch = Batch::from_columns(channels, truth, prediction, None);
    evaluator.update(&batch).expect("the plan's channel");
    let evaluation = evaluator.finish().expect("the plan's channel");
    let bias = evaluation
        .score("bias", "Fz")
        .and_then(|score| score.value.scalar());
    bias.expect("there are values")
}

#[test]
fn means_and_deviations_have_all_digits_on_every_instruction_set() {
    let datasets = datasets();
    assert_eq!(datasets.len(), 9);
    for Dataset {
        name,
        values,
        mean,
        deviation,
    } in &datasets
    {
        let alone: ExactSum = values.iter().copied().collect();
        let found = mean_of(values);
        assert!(digits(found, *mean) >= DIGITS, "{name}: mean {found}");
        for isa in Isa::available() {
            let sums = sums(values, isa);
            assert_eq!(sums.sum(Stream::Truth), alone, "{name} {isa}");
            let variance = sums.absolute_variance().expect("several values");
            let found = variance.sqrt();
            let right = digits(found, *deviation);
            assert!(
                right >= DIGITS,
                "{name} {isa}: {right} digits of deviation {found}"
            );
        }
    }
}

#[test]
fn the_sets_distinguish_ways_to_sum() {
    let hardest = datasets().into_iter().find(|set| set.name == "NumAcc4");
    let values = hardest.expect("it is one of them").values;
    // Errors of 1 % of the truth's spread, so that the spread alone decides R².
    let estimate: Vec<f64> = values.iter().map(|value| value + 0.001).collect();
    let pairs = Paired::try_columns(&estimate, &values).expect("one length");
    let truth = Kernel::truth(pairs).r2.expect("the truth varies");
    let right = |kernel: Kernel| digits(kernel.run(pairs).r2.unwrap_or(0.0), truth);
    assert!(right(Kernel::Naive) < 4.0, "{}", right(Kernel::Naive));
    assert!(right(Kernel::TwoPass) > 10.0);
    for isa in Isa::available() {
        assert!(right(Kernel::Exact(isa)) > 17.0);
    }
}
