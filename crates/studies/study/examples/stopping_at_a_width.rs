//! Bias of a mean absolute error, if the number of contact points depends on the width of its interval. The true error is simulated.

#![expect(clippy::print_stdout, reason = "an example shows its result")]

use std::f64::consts::{FRAC_2_PI, TAU};
use std::ops::Range;
use std::thread;

use taceva_core::random::{SplitMix64, open_unit};
use taceva_core::{Channel, Channels, FieldSet};
use taceva_metrics::{Evaluation, Evaluator, MetricPlan, Rows, catalogue};
use taceva_protocol::WantedWidth;
use taceva_results::{EvaluationReport, Samples};
use taceva_study::ScoredWidth;

/// Wanted widths of the interval, each with a fixed number of contact points for comparison.
const WANTED: [(f64, usize); 3] = [(0.6, 40), (0.3, 120), (0.2, 250)];
/// Number of contact points of a pilot, and before the first look at the width.
const PILOT: usize = 20;
/// Number of contact points between two looks.
const BATCH: usize = 10;
/// Greatest number of contact points of a study.
const MOST: usize = 640;
const PRESSES: usize = 4;
const RUNS: u32 = 1000;
/// Mean over contact points of the standard deviation of errors, in N.
const DEVIATION_N: f64 = 0.1;
/// Greatest difference of a point's deviation from the mean, as a share of the mean. Deviations are uniformly distributed.
const SPREAD: f64 = 0.9;

/// Rule by which a study chooses its number of contact points.
#[derive(Clone, Copy)]
enum Rule {
    /// A number fixed before the first press.
    Fixed(usize),
    /// A number predicted from a pilot, whose presses are kept.
    Pilot,
    /// The first number for which the interval is narrow enough, with a look at its width after each batch of points.
    Looks,
}

/// Outcome of one study.
#[derive(Clone, Copy)]
struct Outcome {
    points: usize,
    looks: u32,
    /// Mean absolute error divided by its true value.
    ratio: f64,
    width: f64,
    is_held: bool,
}

fn main() {
    println!(
        "Simulated presses, not measurements: {PRESSES} at each point, {RUNS} studies per row."
    );
    println!(
        "| wanted width | number of points | points | looks | reached widths, 5 % to 95 % of studies | width reached | MAE / true MAE | interval contains the truth |"
    );
    println!("|---|---|---|---|---|---|---|---|");
    for (width, fixed) in WANTED {
        for rule in [Rule::Fixed(fixed), Rule::Pilot, Rule::Looks] {
            let found = in_parallel(|runs| runs.map(|run| outcome(run, rule, width)).collect());
            println!(
                "| {:.0} % | {} | {} |",
                100.0 * width,
                rule.name(),
                cells(&found, width)
            );
        }
    }
}

/// Cells of one row of the printed table, for the studies `found` and the wanted `width`.
fn cells(found: &[Outcome], width: f64) -> String {
    let runs = f64::from(RUNS);
    let mean = |of: &dyn Fn(&Outcome) -> f64| found.iter().map(of).sum::<f64>() / runs;
    let mut widths: Vec<f64> = found.iter().map(|study| study.width).collect();
    widths.sort_by(f64::total_cmp);
    let at = |twentieths: usize| 100.0 * widths[(widths.len() - 1) * twentieths / 20];
    let bias = mean(&|study| study.ratio);
    let spread = mean(&|study| (study.ratio - bias) * (study.ratio - bias)).sqrt();
    format!(
        "{:.0} | {:.1} | {:.0} % to {:.0} % | {:.3} | {bias:.3} ± {:.3} | {:.3}",
        mean(&|study| study.points as f64),
        mean(&|study| f64::from(study.looks)),
        at(1),
        at(19),
        mean(&|study| f64::from(u8::from(study.width <= width))),
        2.0 * spread / runs.sqrt(),
        mean(&|study| f64::from(u8::from(study.is_held))),
    )
}

impl Rule {
    fn name(self) -> &'static str {
        match self {
            Rule::Fixed(_) => "fixed",
            Rule::Pilot => "predicted from a pilot of 20 points",
            Rule::Looks => "a look after each 10 points",
        }
    }
}

/// Simulates study number `run`, with the number of points that `rule` chooses for the wanted `width`.
fn outcome(run: u32, rule: Rule, width: f64) -> Outcome {
    let errors = errors(run);
    let (points, looks) = match rule {
        Rule::Fixed(points) => (points, 1),
        Rule::Pilot => (predicted(&errors[..PILOT], width), 2),
        Rule::Looks => {
            let mut looks = (PILOT..=MOST).step_by(BATCH).zip(1..);
            let reached = looks.find(|(points, _)| {
                let [low, high] = ends(&evaluated(&errors[..*points]));
                high / low - 1.0 <= width || *points == MOST
            });
            reached.unwrap_or((MOST, 1))
        }
    };
    let evaluation = evaluated(&errors[..points]);
    let [low, high] = ends(&evaluation);
    let score = evaluation.score("mae", "Fz").expect("scored");
    let truth = DEVIATION_N * FRAC_2_PI.sqrt();
    Outcome {
        points,
        looks,
        ratio: score.value.scalar().expect("a number") / truth,
        width: high / low - 1.0,
        is_held: low <= truth && truth <= high,
    }
}

/// Number of points that the pilot with `errors` predicts for an interval of `width`, at least the number of the pilot.
fn predicted(errors: &[[f64; PRESSES]], width: f64) -> usize {
    let mut report = EvaluationReport::of_arrays(&evaluated(errors));
    let mut table = "sample,point_id,Fz,Fz_predicted\n".to_owned();
    for (point, errors) in errors.iter().enumerate() {
        for (press, error) in errors.iter().enumerate() {
            table += &format!("{point}/{press},{point},1,{:?}\n", 1.0 - error);
        }
    }
    report.samples = Some(Samples::read(&table).expect("a table"));
    let wanted = WantedWidth {
        metric: "mae".to_owned(),
        channel: "Fz".to_owned(),
        width,
    };
    let scored = ScoredWidth::of(&report, &wanted).expect("a width");
    let needed = scored.needed(width, scored.tested().samples, MOST);
    needed.unwrap_or(MOST).max(PILOT)
}

/// Scores of contact points with `errors`, one row of presses for each point.
fn evaluated(errors: &[[f64; PRESSES]]) -> Evaluation {
    let metrics = catalogue::select(["mae"]).expect("a metric");
    let channels = Channels::new([Channel::FZ]).expect("one channel");
    let plan = MetricPlan::new(&metrics, channels, FieldSet::PAIRS);
    let count = errors.len() * PRESSES;
    let predictions = errors.iter().flatten().map(|error| 1.0 - error);
    let points = (0..count).map(|row| (row / PRESSES).to_string());
    let rows = Rows::new().pairs(Channel::FZ, vec![1.0; count], predictions);
    let mut evaluator = Evaluator::new(&plan);
    evaluator
        .update_rows(rows.points(points))
        .expect("rows of this channel");
    evaluator.finish().expect("scores")
}

/// Ends of the interval of the mean absolute error.
fn ends(evaluation: &Evaluation) -> [f64; 2] {
    let score = evaluation.score("mae", "Fz").expect("scored");
    score.interval.ends().expect("enough points")
}

/// Gaussian errors in N at all contact points that study `run` may press. Each point has its own standard deviation.
fn errors(run: u32) -> Vec<[f64; PRESSES]> {
    let mut random = SplitMix64::new(u64::from(run));
    let mut unit = || open_unit(random.next_u64());
    let mut point = || {
        let deviation_n = DEVIATION_N * (1.0 + SPREAD * (2.0 * unit() - 1.0));
        // Box and Muller 1958.
        [(); PRESSES].map(|()| {
            let radius = (-2.0 * unit().ln()).sqrt();
            deviation_n * radius * (TAU * unit()).cos()
        })
    };
    (0..MOST).map(|_| point()).collect()
}

/// Outcomes of all runs, in the order of the runs. The number of threads has no effect on them.
fn in_parallel(outcomes: impl Fn(Range<u32>) -> Vec<Outcome> + Sync) -> Vec<Outcome> {
    let threads = thread::available_parallelism().map_or(1, |threads| threads.get());
    let share = RUNS.div_ceil(u32::try_from(threads).unwrap_or(RUNS).max(1));
    let outcomes = &outcomes;
    thread::scope(|scope| {
        let starts = (0..RUNS).step_by(share as usize);
        let threads: Vec<_> = starts
            .map(|start| scope.spawn(move || outcomes(start..(start + share).min(RUNS))))
            .collect();
        let found = threads.into_iter();
        let found = found.flat_map(|thread| thread.join().expect("a study does not panic"));
        found.collect()
    })
}
