//! Order, division and merges do not matter for poses, depth maps, clouds of points and sequences of frames.

use proptest::prelude::*;
use taceva_tasks::depth::{DepthMap, DepthState, DepthTask};
use taceva_tasks::events::{EventRule, EventState, Frame};
use taceva_tasks::pose::{Pose, PoseState, PoseTask, Rotation, Thresholds};
use taceva_tasks::shape::{ShapeState, ShapeTask};

use super::{Row, State, hold, rows};

/// Map of one row with these depths. The pixel at index `invalid` is NaN.
fn map(depths: [f64; 3], invalid: usize) -> DepthMap {
    let mut mm = depths.to_vec();
    mm[invalid] = f64::NAN;
    DepthMap::new(1, 3, mm).expect("three depths")
}

/// Pose with the scores of a row as translation and as the axis of a rotation.
fn pose(scores: [f64; 3]) -> Pose {
    let [x, y, z] = scores;
    let norm = (x * x + y * y + z * z + 1.0).sqrt();
    let quaternion = [x, y, z, 1.0].map(|part| part / norm);
    let rotation = Rotation::of_quaternion(1, quaternion).expect("norm 1");
    Pose::new(1, scores, rotation).expect("finite")
}

impl State for PoseState {
    fn empty() -> PoseState {
        let thresholds = Thresholds::new(&["0.125", "0.5"], &["10", "30"]).expect("decimals");
        let task = PoseTask::default().with_thresholds(thresholds);
        let task = task.with_points(vec![[0.0, 0.0, 1.0], [0.5, 0.25, 0.0]]);
        PoseState::new(task.expect("finite points"))
    }
    fn add(&mut self, row: &Row) {
        let mut predicted = row.scores();
        predicted.rotate_left(row.predicted);
        self.push(&row.cluster, &pose(row.scores()), &pose(predicted));
    }
    fn join(self, other: PoseState) -> PoseState {
        self.merge(other).expect("the same task")
    }
    fn all_scores(&self) -> String {
        format!("{:?}", self.scores())
    }
}

impl State for DepthState {
    fn empty() -> DepthState {
        let constant = DepthMap::new(1, 3, vec![0.25, f64::NAN, 0.5]).expect("three depths");
        DepthState::new(DepthTask::default().with_constant(constant))
    }
    fn add(&mut self, row: &Row) {
        let mut predicted = row.scores();
        predicted.reverse();
        let [truth, predicted] = [map(row.scores(), row.truth), map(predicted, row.predicted)];
        let pushed = self.push(&row.cluster, 1, &truth, &predicted);
        pushed.expect("maps of one size");
    }
    fn join(self, other: DepthState) -> DepthState {
        self.merge(other).expect("the same task")
    }
    fn all_scores(&self) -> String {
        format!("{:?}", self.scores())
    }
}

impl State for ShapeState {
    fn empty() -> ShapeState {
        let task = ShapeTask::default().with_tau_mm(0.25).expect("tau");
        ShapeState::new(task)
    }
    fn add(&mut self, row: &Row) {
        let mut predicted = row.scores();
        predicted.rotate_left(row.predicted);
        let pushed = self.push(&row.cluster, 1, &[row.scores()], &[predicted, [0.5; 3]]);
        pushed.expect("finite points");
    }
    fn join(self, other: ShapeState) -> ShapeState {
        self.merge(other).expect("the same task")
    }
    fn all_scores(&self) -> String {
        format!("{:?}", self.scores())
    }
}

impl State for EventState {
    fn empty() -> EventState {
        EventState::new(EventRule::default())
    }
    fn add(&mut self, row: &Row) {
        let mut truth = row.scores();
        truth.rotate_left(row.truth);
        let frame = |at: usize| {
            let time_s = Some(0.15 * at as f64);
            Frame::new(at as u64, time_s, truth[at] > 0.5, row.scores()[at])
        };
        let pushed = self.push(&row.cluster, &[frame(0), frame(1), frame(2)]);
        pushed.expect("three frames");
    }
    fn join(self, other: EventState) -> EventState {
        self.merge(other).expect("the same rule")
    }
    fn all_scores(&self) -> String {
        format!("{:?}", self.scores())
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_order_and_any_merge_give_the_same_measured_states_and_scores(rows in rows(), seed in any::<u64>()) {
        hold::<PoseState>(&rows, seed);
        hold::<DepthState>(&rows, seed);
        hold::<ShapeState>(&rows, seed);
        hold::<EventState>(&rows, seed);
    }
}
