//! Table of predictions, written next to a recording.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use taceva_core::Channels;
use taceva_dataset::Table;

use super::prediction::Prediction;

/// Predictions in the order in which they were computed.
#[derive(Debug)]
pub(super) struct PredictionTable {
    names: Vec<String>,
    predictions: Vec<Prediction>,
}

impl PredictionTable {
    pub(super) fn new(channels: &Channels) -> PredictionTable {
        PredictionTable {
            names: channels
                .iter()
                .map(|channel| channel.name().to_owned())
                .collect(),
            predictions: Vec::new(),
        }
    }

    pub(super) fn push(&mut self, prediction: Prediction) {
        self.predictions.push(prediction);
    }

    /// CSV text of the predictions of recorded frames, matched by time stamp. Columns are `sample`, `t_s`, `distance`, and one column for each
    /// channel.
    pub(super) fn csv(&self, recorded: &Table) -> Vec<u8> {
        let rows = recorded.t_s().iter().zip(recorded.samples());
        let samples: BTreeMap<u64, &String> = rows
            .filter_map(|(stamp_s, sample)| Some(((*stamp_s)?.to_bits(), sample)))
            .collect();
        let mut text = "sample,t_s,distance".to_owned();
        for name in &self.names {
            text.push(',');
            text.push_str(&cell(name));
        }
        text.push('\n');
        for prediction in &self.predictions {
            let Some(sample) = samples.get(&prediction.stamp_s.to_bits()) else {
                continue;
            };
            text.push_str(&cell(sample));
            let _ = write!(text, ",{:?},", prediction.stamp_s);
            if let Some(distance) = prediction.distance {
                let _ = write!(text, "{distance:?}");
            }
            for value in &prediction.values {
                let _ = write!(text, ",{value:?}");
            }
            text.push('\n');
        }
        text.into_bytes()
    }
}

/// Formats a CSV cell, with quotes if necessary.
fn cell(text: &str) -> String {
    match text.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", text.replace('"', "\"\"")),
        false => text.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use taceva_core::{Channel, Readings, Sample, Stamp, Unit};
    use taceva_dataset::{Recorder, RecordingFacts, RecordingSpec, SensorFacts, Source};

    use super::*;

    #[test]
    fn predictions_find_their_samples_by_stamp_whatever_the_order_and_what_was_not_recorded_is_left_out()
     {
        let folder = tempfile::tempdir().expect("a folder");
        let facts = RecordingFacts::new(
            Source::Synthetic,
            taceva_core::Clock::Monotonic,
            SensorFacts::new("gel"),
        );
        let spec = RecordingSpec::new(facts, Channels::new([Channel::FZ]).expect("one"));
        let mut recorder = Recorder::create(&folder.path().join("r"), &spec).expect("begun");
        for (name, stamp_s) in [("frame-1", 0.1), ("frame-2", 0.2), ("frame-3", 0.3)] {
            let stamp = Stamp {
                valid_s: stamp_s,
                received_s: None,
            };
            let sample = Sample::new(name).with_stamp(stamp);
            let sample = sample.with_truth(Readings::from_values([9.0]));
            recorder.append(&sample).expect("recorded");
        }
        let shear = Channel::named("shear_x", Unit::Newton).expect("a name");
        let mut table = PredictionTable::new(&Channels::new([shear]).expect("one"));
        table.push(Prediction::new(0.3, vec![1.5]).with_distance(0.25));
        table.push(Prediction::new(0.25, vec![7.0]));
        table.push(Prediction::new(0.1, vec![-0.5]));
        let text = String::from_utf8(table.csv(recorder.table())).expect("text");
        assert_eq!(
            text,
            "sample,t_s,distance,shear_x\nframe-3,0.3,0.25,1.5\nframe-1,0.1,,-0.5\n"
        );
        assert_eq!(cell("a,\"b\""), "\"a,\"\"b\"\"\"");
    }
}
