//! Simulated strokes, whose labels and scores are correlated within a stroke.

use taceva_core::random::SplitMix64;
use taceva_metrics::distributions::normal;
use taceva_tasks::{Classes, Ranking, TaskScore};

/// Share of the variance of labels and of scores that the frames of a stroke have in common.
const COMMON: f64 = 0.3;
/// Distance between the mean scores of both classes, in standard deviations.
const DISTANCE: f64 = 1.6;
/// Score above which slip is predicted.
const THRESHOLD: f64 = 1.0;
/// Number of frames of a stroke.
const FRAMES: u32 = 25;

/// Parameters of the strokes of a simulated recording.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Strokes {
    /// Share of frames that slip.
    pub(crate) rate: f64,
    /// Number of strokes.
    pub(crate) strokes: u32,
}

/// Samples that the jackknife of an interval leaves out together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Cluster {
    /// Whole strokes.
    Stroke,
    /// Single frames, as if they were independent.
    Frame,
}

/// Scores whose intervals are examined.
pub(crate) const METRICS: [&str; 3] = ["f1", "balanced_accuracy", "average_precision"];

/// Number of runs in which an interval contained the expected score.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Held {
    /// Number of runs whose interval contained the expected score.
    pub(crate) held: u32,
    /// Number of runs with an interval.
    pub(crate) intervals: u32,
}

impl Held {
    /// Share of intervals that contained the expected score.
    pub(crate) fn share(self) -> f64 {
        f64::from(self.held) / f64::from(self.intervals)
    }
}

/// Draws a standard normal number by inverting its distribution.
fn normal_number(random: &mut SplitMix64) -> f64 {
    // In the middle of a step of 2⁻⁵³, so never 0.
    normal::quantile(random.unit() + 0.5_f64.powi(54))
}

/// A frame: its class and its score.
struct Frame {
    slips: bool,
    score: f64,
}

impl Strokes {
    /// Scores of infinitely many strokes, in the order of [`METRICS`].
    pub(crate) fn expected(self) -> [f64; 3] {
        /// Step of the sum over thresholds, in standard deviations.
        const STEP: f64 = 1e-3;
        let [hits, alarms] = [
            normal::below(DISTANCE - THRESHOLD),
            normal::below(-THRESHOLD),
        ];
        let true_positive = self.rate * hits;
        let false_positive = (1.0 - self.rate) * alarms;
        let false_negative = self.rate * (1.0 - hits);
        let f1 = 2.0 * true_positive / (2.0 * true_positive + false_positive + false_negative);
        let balanced = (hits + 1.0 - alarms) / 2.0;
        let steps = (-8000..10_000_i32).map(|step| (f64::from(step) + 0.5) * STEP);
        let precision = steps.map(|threshold| {
            let above = self.rate * normal::above(threshold - DISTANCE);
            let precision = above / (above + (1.0 - self.rate) * normal::above(threshold));
            precision * normal::density(threshold - DISTANCE) * STEP
        });
        [f1, balanced, precision.sum()]
    }

    /// Frames of one stroke.
    fn frames(self, random: &mut SplitMix64) -> Vec<Frame> {
        let [common, own] = [COMMON.sqrt(), (1.0 - COMMON).sqrt()];
        let [label, score] = [normal_number(random), normal_number(random)];
        let limit = normal::quantile(self.rate);
        let frame = |_| {
            let slips = common * label + own * normal_number(random) < limit;
            let mean = if slips { DISTANCE } else { 0.0 };
            Frame {
                slips,
                score: mean + common * score + own * normal_number(random),
            }
        };
        (0..FRAMES).map(frame).collect()
    }

    /// Scores of one recording, simulated with `seed`. Single frames as clusters give no ranking, which would take too long.
    fn scores(self, cluster: Cluster, seed: u64) -> Vec<TaskScore> {
        let mut random = SplitMix64::new(seed);
        let mut classes = Classes::new(["no_slip", "slip"], Some("slip")).expect("names");
        let mut ranking = Ranking::default();
        for stroke in 0..self.strokes {
            for (frame, Frame { slips, score }) in self.frames(&mut random).iter().enumerate() {
                let name = match cluster {
                    Cluster::Stroke => stroke.to_string(),
                    Cluster::Frame => format!("{stroke} {frame}"),
                };
                let predicted = u32::from(*score > THRESHOLD);
                let pushed = classes.push_positions(&name, &[u32::from(*slips)], &[predicted]);
                pushed.expect("positions");
                if cluster == Cluster::Stroke {
                    ranking.push(&name, *score, *slips).expect("a score");
                }
            }
        }
        [classes.scores(), ranking.scores()].concat()
    }

    /// Counts of intervals that hold the expected scores in `runs` recordings, in the order of [`METRICS`].
    pub(crate) fn held(self, cluster: Cluster, runs: u32) -> [Held; 3] {
        let expected = self.expected();
        let mut held = [Held::default(); 3];
        for run in 0..runs {
            let scores = self.scores(cluster, u64::from(run) + 1);
            for ((metric, expected), held) in METRICS.iter().zip(expected).zip(&mut held) {
                let found = scores
                    .iter()
                    .find(|score| score.metric == *metric && score.variant.is_none());
                if let Some([low, high]) = found.and_then(|score| score.estimate.interval.ends()) {
                    held.intervals += 1;
                    held.held += u32::from((low..=high).contains(&expected));
                }
            }
        }
        held
    }
}
