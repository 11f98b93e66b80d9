//! Simulated presses whose scores are known before they are made: how often does an interval hold them?

#![allow(
    dead_code,
    reason = "an example and a test share it and each uses some of it"
)]

use std::f64::consts::FRAC_2_PI;
use std::ops::{AddAssign, Range};

use taceva_core::{Batch, Channel, Channels, Column, FieldSet, Labels};
use taceva_metrics::{
    BootstrapEnds, Evaluator, IntervalMethod, MetricPlan, Paired, PoissonBootstrap, catalogue,
};

/// Correlation of the sizes |d| of two errors at one location.
pub(crate) const CORRELATION: f64 = 0.3;
/// The scores whose intervals are tried.
pub(crate) const METRICS: [&str; 3] = ["mae", "r2", "smape"];

/// The standard deviation of errors at a location of the mean spread.
const DEVIATION_N: f64 = 0.1;
/// Between which true forces lie.
const FORCES_N: Range<f64> = 0.5..2.0;

/// How many locations are pressed how often.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Design {
    pub(crate) locations: u32,
    pub(crate) presses: u32,
}

/// A way to an interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Method {
    Jackknife,
    /// As if every press were a location of its own.
    JackknifeBySample,
    Bootstrap(BootstrapEnds),
}

impl Method {
    pub(crate) const ALL: [Method; 4] = [
        Method::Jackknife,
        Method::JackknifeBySample,
        Method::Bootstrap(BootstrapEnds::Normal),
        Method::Bootstrap(BootstrapEnds::Percentile),
    ];

    fn plan(self) -> MetricPlan {
        let channels = Channels::new([Channel::FZ]).expect("one channel");
        let metrics = catalogue::select(METRICS).expect("metrics there are");
        let plan = MetricPlan::new(&metrics, channels, FieldSet::PAIRS);
        match self {
            Method::Jackknife | Method::JackknifeBySample => plan,
            Method::Bootstrap(ends) => {
                let bootstrap = PoissonBootstrap {
                    ends,
                    ..PoissonBootstrap::default()
                };
                plan.with_interval_method(IntervalMethod::PoissonBootstrap(bootstrap))
            }
        }
    }
}

/// How many intervals there were, and how many held the expected score.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Coverage {
    pub(crate) intervals: u32,
    pub(crate) held: u32,
}

impl Coverage {
    /// The share of intervals that held it; 0 of none.
    pub(crate) fn share(self) -> f64 {
        f64::from(self.held) / f64::from(self.intervals.max(1))
    }
}

impl AddAssign for Coverage {
    fn add_assign(&mut self, other: Coverage) {
        self.intervals += other.intervals;
        self.held += other.held;
    }
}

/// The coverage of each metric's interval, over the given runs of a design.
///
/// A run is a function of its number: whoever computes which of them, the sum over all is the same.
pub(crate) fn coverage(design: Design, method: Method, runs: Range<u32>) -> [Coverage; 3] {
    let (plan, expected) = (method.plan(), expected());
    let mut coverage = [Coverage::default(); 3];
    for run in runs {
        let mut evaluator = Evaluator::new(&plan);
        let batch = design.batch(run, method == Method::JackknifeBySample);
        evaluator.update(&batch).expect("the plan's channel");
        let evaluation = evaluator.finish().expect("the plan's channel");
        for ((metric, expected), coverage) in METRICS.iter().zip(expected).zip(&mut coverage) {
            let score = evaluation.score(metric, "Fz").expect("it is in the plan");
            if let Some([low, high]) = score.interval.ends() {
                coverage.intervals += 1;
                coverage.held += u32::from(low <= expected && expected <= high);
            }
        }
    }
    coverage
}

impl Design {
    /// Forces and predictions of one run: Gaussian errors, whose spread is a location's own.
    fn batch(self, run: u32, by_sample: bool) -> Batch {
        let mut random = Random(u64::from(run) << 32 | u64::from(self.locations));
        let (mut truth, mut prediction) = (Vec::new(), Vec::new());
        let mut points = Labels::default();
        for location in 0..self.locations {
            let deviation_n = DEVIATION_N * relative_spread(random.unit());
            for press in 0..self.presses {
                let force_n = between(FORCES_N, random.unit());
                truth.push(force_n);
                prediction.push(force_n - deviation_n * random.gaussian());
                let name = if by_sample {
                    format!("{location} {press}")
                } else {
                    location.to_string()
                };
                points.push(&name);
            }
        }
        let channels = Channels::new([Channel::FZ]).expect("one channel");
        let columns = |values| vec![Column::full(values)];
        Batch::from_columns(channels, columns(truth), columns(prediction), Some(points))
    }
}

/// The spread S of a location, uniform about 1: with E|e| = √(2/π) of Gaussian e the sizes |S e| and |S e'| correlate by
/// (2/π) Var S / (1 + Var S − 2/π).
fn relative_spread(uniform: f64) -> f64 {
    between(
        1.0 - (3.0 * spread_variance()).sqrt()..1.0 + (3.0 * spread_variance()).sqrt(),
        uniform,
    )
}

fn spread_variance() -> f64 {
    CORRELATION * (1.0 - FRAC_2_PI) / (FRAC_2_PI - CORRELATION)
}

fn between(range: Range<f64>, uniform: f64) -> f64 {
    range.start + (range.end - range.start) * uniform
}

/// The scores of infinitely many samples: σ √(2/π), 1 − σ² (1 + Var S) / (width² / 12), and the mean of sMAPE's terms by the
/// midpoint rule over forces, spreads, and errors up to 8 σ.
pub(crate) fn expected() -> [f64; 3] {
    let midpoints = |count: u32| (0..count).map(move |at| (f64::from(at) + 0.5) / f64::from(count));
    let (mut terms, mut weights) = (0.0, 0.0);
    for error in midpoints(400).map(|uniform| between(-8.0..8.0, uniform)) {
        let weight = (-error * error / 2.0).exp();
        for spread in midpoints(40).map(relative_spread) {
            let residual = DEVIATION_N * spread * error;
            for truth in midpoints(60).map(|uniform| between(FORCES_N, uniform)) {
                let pair = Paired {
                    estimate: truth - residual,
                    reference: truth,
                };
                terms += weight * pair.symmetric_term();
                weights += weight;
            }
        }
    }
    let width_n = FORCES_N.end - FORCES_N.start;
    let mean_square = DEVIATION_N * DEVIATION_N * (1.0 + spread_variance());
    [
        DEVIATION_N * FRAC_2_PI.sqrt(),
        1.0 - mean_square * 12.0 / (width_n * width_n),
        terms / weights,
    ]
}

/// SplitMix64 (Steele, Lea, Flood 2014).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut mixed = self.0;
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }

    /// In 0..1, neither end included.
    fn unit(&mut self) -> f64 {
        let high = u32::try_from(self.next() >> 32).expect("32 bits are left");
        (f64::from(high) + 0.5) / 4_294_967_296.0
    }

    /// Of mean 0 and variance 1 (Box and Muller 1958).
    fn gaussian(&mut self) -> f64 {
        let radius = (-2.0 * self.unit().ln()).sqrt();
        radius * (std::f64::consts::TAU * self.unit()).cos()
    }
}
