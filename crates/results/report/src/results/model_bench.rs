//! Run time against error of models: results of `taceva bench models`, for figures.

use serde::{Deserialize, Serialize};
use taceva_core::{Unit, distinct, shown};

use taceva_results::ResultsError;

/// Schema of all benchmarks as JSON. Benchmarks of models have the subject `models`.
pub const BENCH_SCHEMA: &str = "taceva.bench/1";
const SUBJECT: &str = "models";

/// Models fitted on one training part and scored on one test part, with their times.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ModelBench {
    /// Schema of the JSON form: [`BENCH_SCHEMA`].
    pub schema: String,
    /// Subject of the benchmark: `models`.
    pub subject: String,
    /// Machine of the benchmark.
    pub machine: BenchMachine,
    /// Recording for training and test.
    pub recording: BenchRecording,
    /// One row for each model, in benchmark order.
    pub rows: Vec<ModelRow>,
}

/// Machine that ran the benchmark, needed to interpret times.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BenchMachine {
    /// Name of the processor, or `unknown`.
    pub cpu: String,
    /// Number of cores available to the process.
    pub cores: usize,
    /// Number of threads used.
    pub threads: usize,
    /// Instruction sets for which the program has dedicated code, the widest first.
    pub isa: Vec<String>,
    /// Load per core over the preceding minute; `None` if the system does not report it.
    pub load: Option<f64>,
}

/// Training recording, with its split.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BenchRecording {
    /// Name of the recording.
    pub name: String,
    /// Sensor model.
    pub sensor: String,
    /// Origin of the samples: `recorded`, `simulated`, `synthetic` or `unknown`.
    pub source: String,
    /// Split: `by-point 70/20/10, seed 0`.
    pub split: String,
    /// Number of training samples.
    pub train: u64,
    /// Number of scored samples.
    pub test: u64,
}

/// One model with its times and errors.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ModelRow {
    /// Name in the registry: `ridge`.
    pub model: String,
    /// Settings as text; empty for the defaults.
    #[serde(default)]
    pub settings: String,
    /// Time to fit, including features, in s.
    pub fit_s: f64,
    /// Processor time to fit, including features, in s; `None` in older files, or if the system does not report it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fit_cpu_s: Option<f64>,
    /// Time to predict the whole test part, including features, in s.
    pub predict_s: f64,
    /// Median time from one frame to its prediction, frame by frame, in s.
    pub latency_s: f64,
    /// Error of each channel on the test part; empty if the model could not be fitted.
    pub errors: Vec<ChannelError>,
    /// Reason why the model could not be fitted or scored; `None` for a scored model.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub failed: Option<String>,
}

/// Mean absolute error of one channel.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ChannelError {
    /// Name of the channel.
    pub channel: String,
    /// Unit of error and interval.
    pub unit: Unit,
    /// Mean absolute error, in `unit`.
    pub mae: f64,
    /// 95 % interval by contact point, in `unit`; `None` with too few points.
    pub ci95: Option<[f64; 2]>,
    /// Number of samples.
    pub n: u64,
    /// Models that need less processor time to fit, and whose errors are not shown to be larger.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub beaten_by: Vec<String>,
}

impl ModelBench {
    /// Creates a benchmark without models.
    pub fn new(machine: BenchMachine, recording: BenchRecording) -> ModelBench {
        ModelBench {
            schema: BENCH_SCHEMA.to_owned(),
            subject: SUBJECT.to_owned(),
            machine,
            recording,
            rows: Vec::new(),
        }
    }

    /// Parses the benchmark in `text`.
    ///
    /// # Errors
    /// [`ResultsError`] for invalid JSON, another schema or subject, or a negative time or error.
    pub fn read(text: &str) -> Result<ModelBench, ResultsError> {
        let bench: ModelBench = serde_json::from_str(text)?;
        if (bench.schema.as_str(), bench.subject.as_str()) != (BENCH_SCHEMA, SUBJECT) {
            return Err(ResultsError::Place {
                place: "schema and subject".to_owned(),
                problem: format!(
                    "expected `taceva.bench/1` of `models`, found `{}` of `{}`",
                    shown(&bench.schema),
                    shown(&bench.subject)
                ),
            });
        }
        for (at, row) in bench.rows.iter().enumerate() {
            row.check(at)?;
        }
        Ok(bench)
    }

    /// JSON for [`ModelBench::read`].
    pub fn json(&self) -> String {
        let text = serde_json::to_string_pretty(self).expect("names are texts and numbers finite");
        text + "\n"
    }

    /// True if the samples of the benchmark are simulated or synthetic, without a real sensor.
    pub fn is_simulated(&self) -> bool {
        is_simulated(&self.recording.source)
    }

    /// Channels in order of first appearance.
    pub fn channels(&self) -> Vec<&str> {
        let errors = self.rows.iter().flat_map(|row| &row.errors);
        distinct(errors.map(|error| error.channel.as_str()))
    }
}

/// True if samples of this `source` involve no real sensor.
pub(super) fn is_simulated(source: &str) -> bool {
    matches!(source, "simulated" | "synthetic")
}

impl ModelRow {
    /// Error of one channel; `None` for an unknown channel.
    pub fn error(&self, channel: &str) -> Option<&ChannelError> {
        self.errors.iter().find(|error| error.channel == channel)
    }

    /// Channels for which this model is on the Pareto front: the error of every faster fit is shown to be larger. `None` if no time is known.
    pub fn front_of(&self) -> Option<Vec<&str>> {
        self.fit_cpu_s?;
        let errors = self.errors.iter();
        let unbeaten = errors.filter(|error| error.beaten_by.is_empty());
        Some(unbeaten.map(|error| error.channel.as_str()).collect())
    }

    fn check(&self, at: usize) -> Result<(), ResultsError> {
        let times = [
            ("fit_s", self.fit_s),
            ("fit_cpu_s", self.fit_cpu_s.unwrap_or(0.0)),
            ("predict_s", self.predict_s),
            ("latency_s", self.latency_s),
        ];
        let errors = self.errors.iter();
        let errors = errors.map(|error| (error.channel.as_str(), error.mae));
        let below = times
            .into_iter()
            .chain(errors)
            .find(|(_, number)| *number < 0.0);
        match below {
            None => Ok(()),
            Some((name, number)) => Err(ResultsError::Place {
                place: format!("rows[{at}].{}", shown(name)),
                problem: format!("expected a number from 0, found {number}"),
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read() {
        let mut bench = ModelBench::new(BenchMachine::default(), BenchRecording::default());
        bench.rows.push(ModelRow {
            model: "ridge".to_owned(),
            fit_s: 0.5,
            errors: vec![ChannelError {
                channel: "Fz".to_owned(),
                unit: Unit::Newton,
                mae: 0.25,
                ci95: Some([0.125, 0.375]),
                n: 40,
                beaten_by: Vec::new(),
            }],
            ..ModelRow::default()
        });
        assert_eq!(ModelBench::read(&bench.json()).expect("its own"), bench);
        assert_eq!(bench.channels(), ["Fz"]);
    }

    #[test]
    fn a_benchmark_of_something_else_and_a_time_below_zero_are_refused() {
        let mut bench = ModelBench::new(BenchMachine::default(), BenchRecording::default());
        bench.subject = "kernels".to_owned();
        let error = ModelBench::read(&bench.json()).expect_err("another subject");
        assert!(
            error
                .to_string()
                .ends_with("found `taceva.bench/1` of `kernels`")
        );
        bench.subject = SUBJECT.to_owned();
        bench.rows.push(ModelRow {
            latency_s: -1.0,
            ..ModelRow::default()
        });
        let error = ModelBench::read(&bench.json()).expect_err("no time");
        assert_eq!(
            error.to_string(),
            "rows[0].latency_s: expected a number from 0, found -1"
        );
    }
}
