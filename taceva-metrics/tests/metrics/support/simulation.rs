//! Simulated presses with known scores, to measure the coverage of intervals.

use std::f64::consts::FRAC_2_PI;
use std::ops::{AddAssign, Range};

use taceva_core::random::SplitMix64;
use taceva_core::{
    Channel, Channels, Field, FieldSet, Footprint, GratingKind, Nanometre, Readings, Sample,
    SampleSink,
};
use taceva_metrics::{
    Evaluator, IntervalMethod, MetricPlan, Paired, PoissonBootstrap, SensorFacts, catalogue,
};

/// Correlation of the magnitudes |d| of two errors at one location.
pub(crate) const CORRELATION: f64 = 0.3;
/// Scores with tested intervals, each with its label.
pub(crate) const METRICS: [(&str, &str); 9] = [
    ("mae", "Fz"),
    ("rmse", "Fz"),
    ("bias", "Fz"),
    ("r2", "Fz"),
    ("r2", "Px"),
    ("skill", "Px"),
    ("smape", "Fz"),
    ("sr", "line"),
    ("uniformity", "Fz"),
];
/// One number for each of [`METRICS`].
pub(crate) type Each<T> = [T; METRICS.len()];

/// Mean standard deviation of errors at a location, N.
const DEVIATION_N: f64 = 0.1;
/// Range of true forces, N.
const FORCES_N: Range<f64> = 0.5..2.0;
/// Spacing of the grating, nm, and error of its prediction, nm per newton of force error.
const SPACING_NM: i64 = 1_000_000;
const SPACING_ERROR_NM: f64 = 350_000.0;
/// Tolerance of a predicted spacing, nm: 0.05 mm.
const TOLERANCE_NM: f64 = 50_000.0;
/// Range of compliances of locations, mm/N.
const COMPLIANCES_MM_PER_N: Range<f64> = 0.2..0.4;
/// Half the range of places, mm. All presses of a location are at one place. A model underestimates places by a share. Its constant differs
/// from their mean.
const HALF_SPAN_MM: f64 = 3.0;
const SHORT_BY: f64 = 0.35;
const PLACE_ERROR_MM_PER_N: f64 = 5.0;
const CONSTANT_MM: f64 = 0.3;
/// Cells along each side of the surface, 1 mm wide; each location has its own cell.
const CELLS: u32 = 20;

/// Numbers of locations, and of presses at each location.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Design {
    pub(crate) locations: u32,
    pub(crate) presses: u32,
}

/// Method for an interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Method {
    Jackknife,
    /// Jackknife with every press as its own location.
    JackknifeBySample,
    Bootstrap(PoissonBootstrap),
}

impl Method {
    /// Plans for the scores of forces, of places and of the surface.
    fn plans(self) -> [(Kind, MetricPlan); 3] {
        let place = Channels::new([Channel::PX]).expect("one channel");
        let force = Channels::new([Channel::FZ]).expect("one channel");
        let press = [Channel::PX, Channel::PY, Channel::PZ, Channel::FZ];
        let press = Channels::new(press).expect("four channels");
        let half_mm = f64::from(CELLS) / 2.0;
        let facts = SensorFacts::default().with_footprint(Some(
            Footprint::rectangle(half_mm, half_mm, None).expect("lengths"),
        ));
        let fields: FieldSet = Field::ALL.into_iter().collect();
        let plan = |kind: Kind, channels| {
            let metrics = METRICS
                .into_iter()
                .filter(|metric| Kind::of(*metric) == kind);
            // A thousand replicates of four hundred cells would take an hour.
            let is_too_long = kind == Kind::Surface && matches!(self, Method::Bootstrap(_));
            let metrics = metrics.map(|(metric, _)| metric).filter(|_| !is_too_long);
            let metrics = catalogue::select(metrics).expect("metrics there are");
            let constants = [("Px".to_owned(), CONSTANT_MM)].into();
            let plan = MetricPlan::new(&metrics, channels, fields).with_facts(facts.clone());
            match kind {
                Kind::Place => plan.with_constants(constants).expect("of its channel"),
                _ => plan,
            }
        };
        let plans = [
            (Kind::Force, plan(Kind::Force, force)),
            (Kind::Place, plan(Kind::Place, place)),
            (Kind::Surface, plan(Kind::Surface, press)),
        ];
        plans.map(|(kind, plan)| {
            (
                kind,
                match self {
                    Method::Jackknife | Method::JackknifeBySample => plan,
                    Method::Bootstrap(bootstrap) => {
                        plan.with_interval_method(IntervalMethod::PoissonBootstrap(bootstrap))
                    }
                },
            )
        })
    }
}

/// Kind of a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Force,
    Place,
    Surface,
}

impl Kind {
    fn of((metric, label): (&str, &str)) -> Kind {
        match (metric, label) {
            (_, "Px") => Kind::Place,
            ("uniformity", _) => Kind::Surface,
            _ => Kind::Force,
        }
    }
}

/// Number of intervals, and of intervals that contain the expected score.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Coverage {
    pub(crate) intervals: u32,
    pub(crate) held: u32,
}

impl Coverage {
    /// Share of intervals that contain the expected score; 0 without intervals.
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

/// Coverage of each metric's interval, over the given runs of a design.
///
/// A run is a function of its number, so the sum over all runs is the same for any number of threads.
pub(crate) fn coverage(design: Design, method: Method, runs: Range<u32>) -> Each<Coverage> {
    let (plans, expected) = (method.plans(), expected());
    let mut coverage = Each::<Coverage>::default();
    for run in runs {
        let presses = design.presses(run, method == Method::JackknifeBySample);
        let evaluations = plans.each_ref().map(|(kind, plan)| {
            let mut evaluator = Evaluator::new(plan);
            for press in &presses {
                let sample = match kind {
                    Kind::Force => press.force(),
                    Kind::Place => press.place(),
                    Kind::Surface => press.surface(),
                };
                evaluator.accept(&sample).expect("the plan's channels");
            }
            evaluator.finish().expect("the plan's channels")
        });
        for ((&(metric, label), expected), coverage) in
            METRICS.iter().zip(expected).zip(&mut coverage)
        {
            let mut scores = evaluations.iter().filter_map(|of| of.score(metric, label));
            if let Some([low, high]) = scores.next().and_then(|score| score.interval.ends()) {
                coverage.intervals += 1;
                coverage.held += u32::from(low <= expected && expected <= high);
            }
        }
    }
    coverage
}

/// One press of a location.
struct Press {
    point: String,
    cell: u32,
    compliance_mm_per_n: f64,
    place_mm: f64,
    force_n: f64,
    error_n: f64,
}

impl Press {
    /// Sample with a force, its prediction, and the predicted spacing of a grating.
    fn force(&self) -> Sample {
        #[expect(clippy::cast_possible_truncation, reason = "a few millimetres")]
        let predicted = SPACING_NM + (self.error_n * SPACING_ERROR_NM).round() as i64;
        Sample::default()
            .with_point_id(self.point.clone())
            .with_kind(GratingKind::Line)
            .with_spacing(Nanometre(SPACING_NM))
            .with_predicted_spacing(Nanometre(predicted))
            .with_truth(Readings::from_values([self.force_n]))
            .with_prediction(Readings::from_values([self.force_n - self.error_n]))
    }

    /// Sample with a place and its prediction.
    fn place(&self) -> Sample {
        let error_mm = SHORT_BY * self.place_mm + PLACE_ERROR_MM_PER_N * self.error_n;
        Sample::default()
            .with_point_id(self.point.clone())
            .with_truth(Readings::from_values([self.place_mm]))
            .with_prediction(Readings::from_values([self.place_mm - error_mm]))
    }

    /// Sample with place, depth and force.
    fn surface(&self) -> Sample {
        let place = [self.cell % CELLS, self.cell / CELLS];
        let [x, y] = place.map(|at| f64::from(at) + 0.5 - f64::from(CELLS) / 2.0);
        let depth_mm = self.compliance_mm_per_n * self.force_n;
        Sample::default()
            .with_point_id(self.point.clone())
            .with_truth(Readings::from_values([x, y, depth_mm, self.force_n]))
    }
}

impl Design {
    /// Presses of one run, with Gaussian errors. Each location has its own spread and compliance.
    fn presses(self, run: u32, by_sample: bool) -> Vec<Press> {
        let mut random = Random::new(u64::from(run) << 32 | u64::from(self.locations));
        let mut presses = Vec::new();
        for location in 0..self.locations {
            let deviation_n = DEVIATION_N * relative_spread(random.unit());
            let compliance_mm_per_n = between(COMPLIANCES_MM_PER_N, random.unit());
            let place_mm = between(-HALF_SPAN_MM..HALF_SPAN_MM, random.unit());
            for press in 0..self.presses {
                let point = if by_sample {
                    format!("{location} {press}")
                } else {
                    location.to_string()
                };
                presses.push(Press {
                    point,
                    cell: location,
                    compliance_mm_per_n,
                    place_mm,
                    force_n: between(FORCES_N, random.unit()),
                    error_n: deviation_n * random.gaussian(),
                });
            }
        }
        presses
    }
}

/// Spread S of a location, uniform about 1. With E|e| = √(2/π) of Gaussian e, the magnitudes |S e| and |S e'| correlate by (2/π) Var S / (1
/// + Var S − 2/π).
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

/// Scores of infinitely many samples, in the order of [`METRICS`]: σ √(2/π), σ √(1 + Var S), 0 and 1 − σ² (1 + Var S) / (width² / 12). The
/// skill of places is relative to their mean and to the constant. sMAPE's terms and hits are means by the midpoint rule over forces,
/// spreads and errors up to 8 σ. The uniformity is 1 / (1 + σ/μ) of the compliances.
pub(crate) fn expected() -> Each<f64> {
    let midpoints = |count: u32| (0..count).map(move |at| (f64::from(at) + 0.5) / f64::from(count));
    let (mut terms, mut hits, mut weights) = (0.0, 0.0, 0.0);
    for error in midpoints(1600).map(|uniform| between(-8.0..8.0, uniform)) {
        let weight = (-error * error / 2.0).exp();
        for spread in midpoints(80).map(relative_spread) {
            let residual = DEVIATION_N * spread * error;
            if (residual * SPACING_ERROR_NM).abs() <= TOLERANCE_NM {
                hits += weight * 20.0;
            }
            for truth in midpoints(20).map(|uniform| between(FORCES_N, uniform)) {
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
    let spread = HALF_SPAN_MM * HALF_SPAN_MM / 3.0;
    let of_places =
        SHORT_BY * SHORT_BY * spread + PLACE_ERROR_MM_PER_N * PLACE_ERROR_MM_PER_N * mean_square;
    let Range { start, end } = COMPLIANCES_MM_PER_N;
    let variation = (end - start) / 12.0_f64.sqrt() / f64::midpoint(start, end);
    [
        DEVIATION_N * FRAC_2_PI.sqrt(),
        mean_square.sqrt(),
        0.0,
        1.0 - mean_square * 12.0 / (width_n * width_n),
        1.0 - of_places / spread,
        1.0 - of_places / (spread + CONSTANT_MM * CONSTANT_MM),
        terms / weights,
        hits / weights,
        1.0 / (1.0 + variation),
    ]
}

/// Random numbers of one simulation.
struct Random(SplitMix64);

impl Random {
    fn new(seed: u64) -> Random {
        Random(SplitMix64::new(seed))
    }

    /// Uniform number in 0..1, both ends excluded.
    fn unit(&mut self) -> f64 {
        let high = u32::try_from(self.0.next_u64() >> 32).expect("32 bits are left");
        (f64::from(high) + 0.5) / 4_294_967_296.0
    }

    /// Normal number of mean 0 and variance 1 (Box and Muller 1958).
    fn gaussian(&mut self) -> f64 {
        let radius = (-2.0 * self.unit().ln()).sqrt();
        radius * (std::f64::consts::TAU * self.unit()).cos()
    }
}
