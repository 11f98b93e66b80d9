//! Coverage of the 95 % interval of every metric in simulated studies. Expected scores come from a study of 20,000 contact points.

#![expect(clippy::print_stdout, reason = "an example shows its result")]

use std::collections::BTreeMap;
use std::ops::Range;
use std::thread;

use taceva_core::random::SplitMix64;
use taceva_core::{
    Channel, Channels, Field, FieldSet, Footprint, GratingKind, Nanometre, Phase, Readings, Sample,
    SampleSink, Stamp,
};
use taceva_metrics::{Evaluation, Evaluator, Interval, MetricPlan, SensorFacts, catalogue};

/// Numbers of contact points of the studies.
const POINTS: [u32; 2] = [20, 46];
/// Number of contact points of the study with the expected scores.
const POINTS_OF_TRUTH: u32 = 20_000;
const RUNS: u32 = 1000;
const RADIUS_MM: f64 = 9.0;
const DEPTHS: u32 = 4;
const REPEATS: u32 = 2;
/// Number of frames without contact in each study.
const IDLE: u32 = 60;
/// Metrics of frames without contact.
const IDLE_METRICS: [&str; 2] = ["noise_equivalent_force", "zero_error"];
/// Number of places for light presses in each study, with one press each.
const LIGHT: u32 = 30;
/// Metric of light presses.
const LIGHT_METRIC: &str = "detection_limit";
/// Metric whose value decreases with the number of contact points by definition. A larger study cannot give its expected score.
const FALLING: &str = "tolerance_interval";
/// Number of studies whose mean is the expected score of light presses.
const LIGHT_STUDIES: u32 = 4000;
/// Channels in the table.
const LABELS: [&str; 4] = ["Fz", "Pz", "Pxy", "line"];

fn main() {
    let threads = u32::try_from(thread::available_parallelism().map_or(1, |threads| threads.get()))
        .unwrap_or(1);
    println!("Simulated studies, not measurements: {RUNS} runs per column.");
    let mut expected: BTreeMap<Name, f64> = evaluated(POINTS_OF_TRUTH, u64::MAX)
        .into_iter()
        .map(|(name, (value, _))| (name, value))
        .collect();
    expected.extend(light_means());
    let columns = POINTS.map(|points| in_parallel(threads, points, &expected));
    println!(
        "| score | expected | {} |",
        POINTS.map(|points| format!("{points} points")).join(" | ")
    );
    println!("|---|---|{}", "---|".repeat(POINTS.len()));
    for (name, value) in &expected {
        let cells = columns.each_ref().map(|column| match column.get(name) {
            Some(found) if found.intervals > 0 => found.cell(),
            _ => "–".to_owned(),
        });
        if cells.iter().any(|cell| cell != "–") {
            println!("| {name} | {value:.4} | {} |", cells.join(" | "));
        }
    }
}

/// Metric, label and variant of a score.
type Name = String;

/// Number of intervals, and of intervals that contain the expected score.
#[derive(Clone, Copy, Debug, Default)]
struct Coverage {
    intervals: u32,
    held: u32,
}

impl Coverage {
    fn cell(self) -> String {
        let share = f64::from(self.held) / f64::from(self.intervals);
        match RUNS - self.intervals {
            0 => format!("{share:.3}"),
            without => format!("{share:.3} ({without} without an interval)"),
        }
    }
}

/// Coverage over all runs, independent of the number of threads.
fn in_parallel(
    threads: u32,
    points: u32,
    expected: &BTreeMap<Name, f64>,
) -> BTreeMap<Name, Coverage> {
    let share = RUNS.div_ceil(threads.max(1));
    thread::scope(|scope| {
        let parts: Vec<_> = (0..RUNS)
            .step_by(share as usize)
            .map(|start| {
                let runs = start..(start + share).min(RUNS);
                scope.spawn(move || coverage(points, runs, expected))
            })
            .collect();
        let mut sums = BTreeMap::<Name, Coverage>::new();
        for part in parts {
            for (name, found) in part.join().expect("a run does not panic") {
                let sum = sums.entry(name).or_default();
                sum.intervals += found.intervals;
                sum.held += found.held;
            }
        }
        sums
    })
}

fn coverage(
    points: u32,
    runs: Range<u32>,
    expected: &BTreeMap<Name, f64>,
) -> BTreeMap<Name, Coverage> {
    let mut sums = BTreeMap::<Name, Coverage>::new();
    for run in runs {
        for (name, (_, interval)) in evaluated(points, u64::from(run)) {
            let (Some([low, high]), Some(truth)) = (interval, expected.get(&name)) else {
                continue;
            };
            let sum = sums.entry(name).or_default();
            sum.intervals += 1;
            sum.held += u32::from(low <= *truth && *truth <= high);
        }
    }
    sums
}

/// Value and ends of the interval of every score of a study, by name.
///
/// Frames without contact and light presses form separate recordings, because in one recording they would count as more contact points.
fn evaluated(points: u32, seed: u64) -> BTreeMap<Name, (f64, Option<[f64; 2]>)> {
    let mut study = Study::new(points, seed);
    let mut presses = evaluator();
    study.presses(&mut presses);
    let mut idle = evaluator();
    study.idle(&mut idle);
    let mut found = scores(&presses.finish().expect("the plan's channels"));
    let idle = scores(&idle.finish().expect("the plan's channels"));
    found.extend(
        idle.into_iter()
            .filter(|(name, _)| IDLE_METRICS.iter().any(|metric| name.starts_with(metric))),
    );
    found.extend(of_light(&mut study));
    found
}

/// Scores of the light presses of `study`.
fn of_light(study: &mut Study) -> BTreeMap<Name, (f64, Option<[f64; 2]>)> {
    let mut light = evaluator();
    study.light(&mut light);
    let mut found = scores(&light.finish().expect("the plan's channels"));
    found.retain(|name, _| name.starts_with(LIGHT_METRIC));
    found
}

/// Mean scores of light presses over many studies of the same size. The limit increases for few places by definition, because their line
/// is less certain.
fn light_means() -> BTreeMap<Name, f64> {
    let mut means = BTreeMap::<Name, f64>::new();
    for run in 0..LIGHT_STUDIES {
        let mut study = Study::new(POINTS_OF_TRUTH, u64::from(run));
        for (name, (value, _)) in of_light(&mut study) {
            *means.entry(name).or_default() += value / f64::from(LIGHT_STUDIES);
        }
    }
    means
}

fn scores(evaluation: &Evaluation) -> BTreeMap<Name, (f64, Option<[f64; 2]>)> {
    let ends = |interval: Option<Interval>| interval.and_then(|interval| interval.ends());
    let mut found = BTreeMap::new();
    let shown = |label: &str| LABELS.contains(&label);
    let scores = evaluation.scores();
    let scores = scores.filter(|(metric, label, _)| shown(label) && metric.id != FALLING);
    for (metric, label, score) in scores {
        let name = format!("{} {label}", metric.id);
        if let Some(value) = score.value.scalar() {
            found.insert(name.clone(), (value, ends(Some(score.interval))));
        }
        for variant in &score.variants {
            if let Some(value) = variant.value.scalar() {
                let name = format!("{name} {}", variant.name);
                found.insert(name, (value, ends(variant.interval)));
            }
        }
    }
    found
}

fn evaluator() -> Evaluator {
    let channels = Channels::new(Channel::SIX).expect("distinct");
    let fields: FieldSet = Field::ALL.into_iter().collect();
    let footprint = Footprint::disc(RADIUS_MM + 1.0, Some(1.5)).expect("lengths");
    let facts = SensorFacts::default().with_footprint(Some(footprint));
    let constants = [
        ("Px", 0.3),
        ("Py", -0.2),
        ("Pz", 0.7),
        ("Fx", 0.0),
        ("Fy", 0.0),
        ("Fz", 2.0),
    ];
    let constants = constants.map(|(channel, value)| (channel.to_owned(), value));
    let plan = MetricPlan::new(&catalogue::ALL, channels, fields)
        .with_facts(facts)
        .with_constants(constants.into())
        .expect("constants of its channels");
    Evaluator::new(&plan)
}

/// Simulated study of one sensor: presses at random places, each with its own compliance, hysteresis, mean error and spread.
struct Study {
    points: u32,
    random: SplitMix64,
    clock_s: f64,
}

impl Study {
    fn new(points: u32, seed: u64) -> Study {
        Study {
            points,
            random: SplitMix64::new(seed ^ u64::from(points) << 40),
            clock_s: 0.0,
        }
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.random.unit()
    }

    /// Normal number with mean 0 and variance 1 (Box and Muller 1958).
    fn gaussian(&mut self) -> f64 {
        let radius = (-2.0 * (1.0 - self.random.unit()).ln()).sqrt();
        radius * (std::f64::consts::TAU * self.random.unit()).cos()
    }

    fn presses(&mut self, sink: &mut Evaluator) {
        for point in 0..self.points {
            self.place(point, sink);
        }
    }

    fn idle(&mut self, sink: &mut Evaluator) {
        let frames = match self.points {
            POINTS_OF_TRUTH => 100 * IDLE,
            _ => IDLE,
        };
        for frame in 0..frames {
            self.clock_s += 0.1;
            let idle = [0.0; 6];
            let prediction = idle.map(|_| 0.01 + 0.02 * self.gaussian());
            let sample = Sample::default()
                .with_point_id(frame.to_string())
                .with_scene_id(SensorFacts::REFERENCE_SCENE.to_owned())
                .with_truth(Readings::from_values(idle))
                .with_prediction(Readings::from_values(prediction));
            sink.accept(&sample).expect("the plan's channels");
        }
    }

    /// Adds light presses, each at its own place.
    fn light(&mut self, sink: &mut Evaluator) {
        for place in 0..LIGHT {
            let force_n = self.between(0.02, 0.2);
            let truth = [0.0, 0.0, 0.1, 0.0, 0.0, force_n];
            let gain = self.between(0.98, 1.02);
            let prediction = truth.map(|truth| gain * truth + 0.02 * self.gaussian());
            let sample = Sample::default()
                .with_point_id(place.to_string())
                .with_scene_id(SensorFacts::REFERENCE_SCENE.to_owned())
                .with_truth(Readings::from_values(truth))
                .with_prediction(Readings::from_values(prediction));
            sink.accept(&sample).expect("the plan's channels");
        }
    }

    /// Adds every press at one place, in normal and in brighter light, and presses on gratings.
    fn place(&mut self, point: u32, sink: &mut Evaluator) {
        let radius = RADIUS_MM * self.random.unit().sqrt();
        let turn = self.between(0.0, std::f64::consts::TAU);
        let place = [radius * turn.cos(), radius * turn.sin()];
        let compliance_mm_per_n = 0.25 + 0.1 * radius / RADIUS_MM;
        let hysteresis = self.between(0.02, 0.12);
        let spread = 0.03 + 0.06 * radius / RADIUS_MM;
        let offset: [f64; 6] = std::array::from_fn(|_| 0.02 * self.gaussian());
        let gain = self.between(0.98, 1.02);
        for (scene, intensity, growth) in [
            (SensorFacts::REFERENCE_SCENE, 100.0, 1.0),
            ("bright", 140.0, 1.5),
        ] {
            for repeat in 0..REPEATS {
                let shear: [f64; 2] = std::array::from_fn(|_| self.between(-0.5, 0.5));
                for phase in [Phase::Load, Phase::Unload] {
                    for step in 0..DEPTHS {
                        self.clock_s += 0.2;
                        let depth_mm = 0.3 * f64::from(step + 1);
                        let kept = match phase {
                            Phase::Unload => 1.0 - hysteresis,
                            _ => 1.0,
                        };
                        let force_n =
                            depth_mm / compliance_mm_per_n * kept * (1.0 + 0.01 * self.gaussian());
                        let truth = [place[0], place[1], depth_mm, shear[0], shear[1], force_n];
                        let prediction: [f64; 6] = std::array::from_fn(|channel| {
                            gain * truth[channel]
                                + growth * (offset[channel] + spread * self.gaussian())
                        });
                        let error_nm =
                            40_000.0 * growth * (offset[0] + spread * self.gaussian()) / 0.05;
                        #[expect(clippy::cast_possible_truncation, reason = "a few millimetres")]
                        let predicted = Nanometre(1_000_000 + error_nm.round() as i64);
                        let sample = Sample::default()
                            .with_point_id(point.to_string())
                            .with_scene_id(scene.to_owned())
                            .with_intensity(intensity + self.gaussian())
                            .with_stamp(Stamp {
                                valid_s: self.clock_s,
                                received_s: None,
                            })
                            .with_phase(phase)
                            .with_depth_step(step)
                            .with_repeat(repeat)
                            .with_kind(GratingKind::Line)
                            .with_spacing(Nanometre(1_000_000))
                            .with_predicted_spacing(predicted)
                            .with_truth(Readings::from_values(truth))
                            .with_prediction(Readings::from_values(prediction));
                        sink.accept(&sample).expect("the plan's channels");
                    }
                }
            }
        }
    }
}
