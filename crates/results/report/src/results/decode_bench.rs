//! Decode time against error, as `taceva bench decode` writes it and figures read it.

use serde::{Deserialize, Serialize};
use taceva_core::shown;

use super::model_bench::is_simulated;
use super::{BENCH_SCHEMA, BenchMachine, BenchRecording, ChannelError, ResultsError};

const SUBJECT: &str = "decode";

/// One model, fitted and scored on frames that were decoded at several fractions of their size.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DecodeBench {
    /// [`BENCH_SCHEMA`].
    pub schema: String,
    /// `decode`.
    pub subject: String,
    /// Where it ran.
    pub machine: BenchMachine,
    /// What the model learned from.
    pub recording: BenchRecording,
    /// What was done to the frames before they were decoded; empty where they are as they were recorded.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub note: String,
    /// The name of the model in the registry: `ridge`.
    pub model: String,
    /// Its settings in words; empty for its defaults.
    #[serde(default)]
    pub settings: String,
    /// One row for each scale, the largest first.
    pub rows: Vec<DecodeRow>,
}

/// One scale: the time to decode a frame, and the error of the model.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DecodeRow {
    /// How many pixels along a side become one: 1, 2, 4 or 8.
    pub denominator: u32,
    /// Columns of a decoded frame.
    pub width: u32,
    /// Rows of a decoded frame.
    pub height: u32,
    /// Seconds to read, verify and decode one frame on one thread, the median over frames.
    pub decode_s: f64,
    /// The error of each channel on the test part; empty if the model could not be fitted.
    pub errors: Vec<ScaledError>,
    /// Why the model could not be fitted or scored.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub failed: Option<String>,
}

/// The error of one channel, and its difference from that at full size.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ScaledError {
    /// The error.
    #[serde(flatten)]
    pub error: ChannelError,
    /// This error less that at full size, on the same samples, in the same unit; `None` at full size, or where that could not be scored.
    pub change: Option<f64>,
    /// Its 95 % interval by contact point; `None` if there are too few points.
    pub change_ci95: Option<[f64; 2]>,
}

impl DecodeBench {
    /// A benchmark of `model` without a scale.
    pub fn new(machine: BenchMachine, recording: BenchRecording, model: String) -> DecodeBench {
        DecodeBench {
            schema: BENCH_SCHEMA.to_owned(),
            subject: SUBJECT.to_owned(),
            machine,
            recording,
            note: String::new(),
            model,
            settings: String::new(),
            rows: Vec::new(),
        }
    }

    /// The benchmark in `text`.
    ///
    /// # Errors
    /// [`ResultsError`] if it is no JSON, or of another schema or subject.
    pub fn read(text: &str) -> Result<DecodeBench, ResultsError> {
        let bench: DecodeBench = serde_json::from_str(text)?;
        if (bench.schema.as_str(), bench.subject.as_str()) == (BENCH_SCHEMA, SUBJECT) {
            return Ok(bench);
        }
        Err(ResultsError::Place {
            place: "schema and subject".to_owned(),
            expected: "`taceva.bench/1` of `decode`",
            found: format!("`{}` of `{}`", shown(&bench.schema), shown(&bench.subject)),
        })
    }

    /// As JSON that [`DecodeBench::read`] reads.
    pub fn json(&self) -> String {
        let text = serde_json::to_string_pretty(self).expect("names are texts and numbers finite");
        text + "\n"
    }

    /// Whether its samples are simulated or synthetic, so that no real sensor was pressed.
    pub fn is_simulated(&self) -> bool {
        is_simulated(&self.recording.source)
    }
}

impl DecodeRow {
    /// How the scale is written: `1`, `1/2`, `1/4`, `1/8`.
    pub fn scale(&self) -> String {
        match self.denominator {
            1 => "1".to_owned(),
            denominator => format!("1/{denominator}"),
        }
    }

    /// The error of one channel.
    pub fn error(&self, channel: &str) -> Option<&ScaledError> {
        let mut errors = self.errors.iter();
        errors.find(|own| own.error.channel == channel)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use taceva_core::Unit;

    #[test]
    fn what_is_written_is_read_and_another_subject_is_refused() {
        let recording = BenchRecording::default();
        let mut bench = DecodeBench::new(BenchMachine::default(), recording, "ridge".to_owned());
        bench.rows.push(DecodeRow {
            denominator: 2,
            errors: vec![ScaledError {
                error: ChannelError {
                    channel: "Fz".to_owned(),
                    unit: Unit::Newton,
                    mae: 0.25,
                    ci95: Some([0.125, 0.375]),
                    n: 40,
                    beaten_by: Vec::new(),
                },
                change: Some(0.0625),
                change_ci95: None,
            }],
            ..DecodeRow::default()
        });
        assert_eq!(DecodeBench::read(&bench.json()).expect("its own"), bench);
        assert_eq!(bench.rows[0].scale(), "1/2");
        bench.subject = "models".to_owned();
        let error = DecodeBench::read(&bench.json()).expect_err("another subject");
        assert!(
            error
                .to_string()
                .ends_with("found `taceva.bench/1` of `models`")
        );
    }
}
