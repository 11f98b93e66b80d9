//! Difference of a study over sockets from the same study on the simulated bench.

use std::collections::{BTreeMap, BTreeSet};

use serde_json::Value;
use taceva_dataset::Dataset;

use super::OnTheWire;

/// Greatest differences between two recordings of the same presses, and between their scores.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Compared {
    /// Number of samples in each recording.
    pub samples: usize,
    /// Greatest difference of depths, mm.
    pub depth_mm: f64,
    /// Greatest difference of a force component, N.
    pub force_n: f64,
    /// Greatest difference of a pixel value, in 8-bit steps.
    pub shade: u8,
    /// Number of scores that both studies have.
    pub scores: usize,
    /// Scores that only one of the studies has. An example is R² of two labels, which is undefined if link noise does not make them differ.
    pub of_one_alone: BTreeSet<String>,
    /// Greatest relative difference of the errors `mae` and `smape`.
    pub error_part: f64,
    /// Greatest relative difference of √(1 − score) of the scores `r2` and `skill`. This root is proportional to the error of the predictions. The
    /// value has little meaning for few labels with a small spread.
    pub share_part: f64,
}

/// Compares the run with emulated devices to the simulated run.
///
/// # Panics
/// If a recording cannot be read or the presses differ, which ends the test.
pub fn compare(on: &OnTheWire, (one, other): (&str, &str)) -> Compared {
    let mut compared = Compared::default();
    let recordings = [one, other].map(|run| on.recording(run));
    compared.labels(&recordings);
    let scores = [one, other].map(|run| {
        let text = std::fs::read(on.results(run)).expect("results");
        scores(&serde_json::from_slice(&text).expect("JSON"))
    });
    compared.scores(&scores);
    compared
}

/// Scores of the first study, by metric and channel.
fn scores(results: &Value) -> BTreeMap<String, f64> {
    let metrics = results["studies"][0]["metrics"].as_object();
    let mut found = BTreeMap::new();
    for (metric, channels) in metrics.expect("metrics") {
        for (channel, score) in channels.as_object().expect("channels") {
            if let Some(value) = score["value"].as_f64() {
                found.insert(format!("{metric} {channel}"), value);
            }
        }
    }
    found
}

impl Compared {
    fn labels(&mut self, recordings: &[Dataset; 2]) {
        let [rows, others] = recordings.each_ref().map(|recording| {
            let samples = recording.table().samples().iter().cloned();
            samples.zip(0..).collect::<BTreeMap<String, usize>>()
        });
        assert!(rows.keys().eq(others.keys()), "they are of one plan");
        self.samples = rows.len();
        for (sample, row) in &rows {
            let at = [*row, others[sample]];
            let truth = |name: &str| {
                [0, 1].map(|which: usize| {
                    let table = recordings[which].table();
                    let channels = table.channels();
                    let position = channels.position(name).expect("it is measured");
                    table.truth(position).get(at[which]).expect("a label")
                })
            };
            let apart = |name: &str| {
                let [one, other] = truth(name);
                (one - other).abs()
            };
            self.depth_mm = self.depth_mm.max(apart("Pz"));
            for name in ["Fx", "Fy", "Fz"] {
                self.force_n = self.force_n.max(apart(name));
            }
            let [one, other] = [0, 1].map(|which: usize| {
                let frame = recordings[which].frame(at[which]);
                frame.expect("it is whole").expect("every sample has one")
            });
            assert_eq!(one.info(), other.info());
            for (one, other) in one.bytes().iter().zip(other.bytes()) {
                self.shade = self.shade.max(one.abs_diff(*other));
            }
        }
    }

    fn scores(&mut self, [one, other]: &[BTreeMap<String, f64>; 2]) {
        let names = [one, other].map(|scores| scores.keys().cloned().collect::<BTreeSet<_>>());
        self.of_one_alone = &names[0] ^ &names[1];
        let both = &names[0] & &names[1];
        self.scores = both.len();
        for name in &both {
            let [score, other] = [one[name], other[name]];
            let is_share = name.starts_with("r2") || name.starts_with("skill");
            let [error, other] = [score, other].map(|score| match is_share {
                true => (1.0 - score).sqrt(),
                false => score,
            });
            let part = (error - other).abs() / error.abs();
            let most = match is_share {
                true => &mut self.share_part,
                false => &mut self.error_part,
            };
            *most = most.max(part);
        }
    }
}
