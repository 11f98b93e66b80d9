//! Any order of samples, any division and any merge give the same state and the same scores.

mod measured;

use std::fmt::Debug;

use proptest::prelude::*;
use serde::Serialize;
use serde::de::DeserializeOwned;
use taceva_core::random::SplitMix64;
use taceva_tasks::{Classes, Probabilities, Ranking, TopK};

const NAMES: [&str; 3] = ["a", "b", "c"];

/// A sample with scores in eighths, so that many are equal.
#[derive(Clone, Debug)]
struct Row {
    cluster: String,
    truth: usize,
    predicted: usize,
    eighths: [u32; 3],
}

impl Row {
    fn scores(&self) -> [f64; 3] {
        self.eighths.map(|eighths| f64::from(eighths) / 8.0)
    }

    /// Probabilities with ties. Scores that are all 0 give numbers that are not probabilities.
    fn probabilities(&self) -> [f64; 3] {
        let sum: u32 = self.eighths.iter().sum();
        match sum {
            0 => [0.25; 3],
            sum => self
                .eighths
                .map(|eighths| f64::from(eighths) / f64::from(sum)),
        }
    }
}

/// A state that is filled row by row and merged.
trait State: Clone + Debug + PartialEq + Serialize + DeserializeOwned {
    fn empty() -> Self;
    fn add(&mut self, row: &Row);
    fn join(self, other: Self) -> Self;
    fn all_scores(&self) -> String;
}

impl State for Classes {
    fn empty() -> Classes {
        Classes::new(NAMES, Some("b")).expect("names")
    }
    fn add(&mut self, row: &Row) {
        let pushed = self.push(&row.cluster, NAMES[row.truth], NAMES[row.predicted]);
        pushed.expect("names");
    }
    fn join(self, other: Classes) -> Classes {
        self.merge(other).expect("the same names")
    }
    fn all_scores(&self) -> String {
        format!("{:?}", self.scores())
    }
}

impl State for Ranking {
    fn empty() -> Ranking {
        Ranking::default()
    }
    fn add(&mut self, row: &Row) {
        let pushed = self.push(&row.cluster, row.scores()[0], row.truth == 1);
        pushed.expect("a score");
    }
    fn join(self, other: Ranking) -> Ranking {
        self.merge(other)
    }
    fn all_scores(&self) -> String {
        format!("{:?}", self.scores())
    }
}

impl State for TopK {
    fn empty() -> TopK {
        TopK::new(NAMES).expect("names")
    }
    fn add(&mut self, row: &Row) {
        let pushed = self.push(&row.cluster, NAMES[row.truth], &row.scores());
        pushed.expect("three scores");
    }
    fn join(self, other: TopK) -> TopK {
        self.merge(other).expect("the same names")
    }
    fn all_scores(&self) -> String {
        format!("{:?}", self.scores(2))
    }
}

impl State for Probabilities {
    fn empty() -> Probabilities {
        Probabilities::new(NAMES, Some("b")).expect("names")
    }
    fn add(&mut self, row: &Row) {
        let pushed = self.push(&row.cluster, NAMES[row.truth], &row.probabilities());
        pushed.expect("three numbers");
    }
    fn join(self, other: Probabilities) -> Probabilities {
        self.merge(other).expect("the same names")
    }
    fn all_scores(&self) -> String {
        format!("{:?}", self.scores())
    }
}

fn of<S: State>(rows: &[Row]) -> S {
    let mut state = S::empty();
    for row in rows {
        state.add(row);
    }
    state
}

/// Fails unless shuffled rows, divided at random into states and merged in random order, give the same state and scores.
fn hold<S: State>(rows: &[Row], seed: u64) {
    let expected: S = of(rows);
    let mut random = SplitMix64::new(seed);
    let mut shuffled = rows.to_vec();
    random.shuffle(&mut shuffled);
    let mut parts: Vec<S> = Vec::new();
    let mut rest: &[Row] = &shuffled;
    while !rest.is_empty() {
        let (part, others) = rest.split_at(1 + random.below(rest.len()));
        parts.push(of(part));
        rest = others;
    }
    parts.push(S::empty());
    while parts.len() > 1 {
        let one = parts.swap_remove(random.below(parts.len()));
        let at = random.below(parts.len());
        let other = parts.swap_remove(at);
        parts.push(one.join(other));
    }
    let found = parts.pop().expect("one part");
    assert_eq!(found, expected);
    let [written, expected_text] =
        [&found, &expected].map(|state| serde_json::to_string(state).expect("JSON"));
    assert_eq!(written, expected_text);
    let read: S = serde_json::from_str(&written).expect("a state");
    assert_eq!(read, expected);
    assert_eq!(found.all_scores(), expected.all_scores());
}

fn rows() -> impl Strategy<Value = Vec<Row>> {
    let row = (
        0..7_u32,
        0..3_usize,
        0..3_usize,
        [0..8_u32, 0..8_u32, 0..8_u32],
    );
    let row = row.prop_map(|(cluster, truth, predicted, eighths)| Row {
        cluster: cluster.to_string(),
        truth,
        predicted,
        eighths,
    });
    proptest::collection::vec(row, 0..60)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_order_and_any_merge_give_the_same_states_and_scores(rows in rows(), seed in any::<u64>()) {
        hold::<Classes>(&rows, seed);
        hold::<Ranking>(&rows, seed);
        hold::<TopK>(&rows, seed);
        hold::<Probabilities>(&rows, seed);
    }
}
