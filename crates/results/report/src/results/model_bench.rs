//! Run time against error of models, as `taceva bench models` writes it and figures read it.

use serde::{Deserialize, Serialize};
use taceva_core::Unit;
use taceva_core::shown;

use taceva_results::ResultsError;

/// The schema of every benchmark as JSON; of this one the subject is `models`.
pub const BENCH_SCHEMA: &str = "taceva.bench/1";
const SUBJECT: &str = "models";

/// Models that were fitted on one training part and scored on one test part, each with the time it took.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ModelBench {
    /// [`BENCH_SCHEMA`].
    pub schema: String,
    /// `models`.
    pub subject: String,
    /// Where it ran.
    pub machine: BenchMachine,
    /// What the models learned from.
    pub recording: BenchRecording,
    /// One row for each model, in the order of the benchmark.
    pub rows: Vec<ModelRow>,
}

/// The machine that models ran on: times without it mean nothing.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BenchMachine {
    /// The name of the processor, or `unknown`.
    pub cpu: String,
    /// Cores that the process may use.
    pub cores: usize,
    /// Threads that the benchmark used.
    pub threads: usize,
    /// Instruction sets of the processor for which the program has code of its own, the widest first.
    pub isa: Vec<String>,
    /// Programs that wanted a core in the minute before, per core; `None` where the system does not say.
    pub load: Option<f64>,
}

/// The recording that models learned from, and how it was divided.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BenchRecording {
    /// Its name.
    pub name: String,
    /// The sensor model.
    pub sensor: String,
    /// Where the samples come from: `recorded`, `simulated`, `synthetic` or `unknown`.
    pub source: String,
    /// How it was divided: `by-point 70/20/10, seed 0`.
    pub split: String,
    /// Samples of the training part.
    pub train: u64,
    /// Samples of the part that is scored.
    pub test: u64,
}

/// One model: its times and its errors.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ModelRow {
    /// Its name in the registry: `ridge`.
    pub model: String,
    /// Its settings in words; empty for its defaults.
    #[serde(default)]
    pub settings: String,
    /// Seconds to fit it, features included.
    pub fit_s: f64,
    /// Processor seconds to fit it, features included; `None` where the system does not say, or an older program wrote it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fit_cpu_s: Option<f64>,
    /// Seconds to predict the whole test part, features included.
    pub predict_s: f64,
    /// Seconds from one frame to its prediction, the median over frames taken one by one.
    pub latency_s: f64,
    /// The error of each channel on the test part; empty if the model could not be fitted.
    pub errors: Vec<ChannelError>,
    /// Why the model could not be fitted or scored.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub failed: Option<String>,
}

/// The mean absolute error of one channel.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ChannelError {
    /// The channel.
    pub channel: String,
    /// The unit of error and interval.
    pub unit: Unit,
    /// The mean absolute error.
    pub mae: f64,
    /// Its 95 % interval by contact point; `None` if there are too few points.
    pub ci95: Option<[f64; 2]>,
    /// How many samples it is computed from.
    pub n: u64,
    /// Models that take less processor time to fit, and than whose errors that of this one is not shown to be smaller.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub beaten_by: Vec<String>,
}

impl ModelBench {
    /// A benchmark without a model.
    pub fn new(machine: BenchMachine, recording: BenchRecording) -> ModelBench {
        ModelBench {
            schema: BENCH_SCHEMA.to_owned(),
            subject: SUBJECT.to_owned(),
            machine,
            recording,
            rows: Vec::new(),
        }
    }

    /// The benchmark in `text`.
    ///
    /// # Errors
    /// [`ResultsError`] if it is no JSON, of another schema or subject, or holds a time or an error below 0.
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

    /// As JSON that [`ModelBench::read`] reads.
    pub fn json(&self) -> String {
        let text = serde_json::to_string_pretty(self).expect("names are texts and numbers finite");
        text + "\n"
    }

    /// Whether its samples are simulated or synthetic, so that no real sensor was pressed.
    pub fn is_simulated(&self) -> bool {
        is_simulated(&self.recording.source)
    }

    /// The channels, each once, in the order of the first model that has them.
    pub fn channels(&self) -> Vec<&str> {
        let mut channels: Vec<&str> = Vec::new();
        for error in self.rows.iter().flat_map(|row| &row.errors) {
            if !channels.contains(&error.channel.as_str()) {
                channels.push(&error.channel);
            }
        }
        channels
    }
}

/// Whether no sensor was pressed for samples of this `source`.
pub(super) fn is_simulated(source: &str) -> bool {
    matches!(source, "simulated" | "synthetic")
}

impl ModelRow {
    /// The error of one channel.
    pub fn error(&self, channel: &str) -> Option<&ChannelError> {
        self.errors.iter().find(|error| error.channel == channel)
    }

    /// The channels on whose Pareto front it is: nobody takes less processor time to fit and is, as far as intervals say, as near. `None`
    /// where no time is known.
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
