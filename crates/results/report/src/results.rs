//! Results as they are read back from what `evaluate`, `score` and `run` write.

mod error;
mod made;
mod model_bench;
mod over_seeds;
mod read;
mod score;
mod standing;

pub use error::ResultsError;
pub use made::Made;
pub use model_bench::{
    BENCH_SCHEMA, BenchMachine, BenchRecording, ChannelError, ModelBench, ModelRow,
};
pub use over_seeds::{OverSeeds, SeedScore};
pub use score::{Interval, Score, Value, Variant};
pub(crate) use standing::by_published_r2;

use crate::samples::Samples;

/// The schema of one evaluation. A minor version only adds keys, so every `taceva.evaluation/1.N` is read.
/// Since 1.2 they are sealed.
pub const EVALUATION_SCHEMA: &str = "taceva.evaluation/1.2";
/// The schema of the evaluations of a scene, in versions as [`EVALUATION_SCHEMA`].
pub const RUN_SCHEMA: &str = "taceva.run/1.3";

/// The results of one sensor: what was evaluated, every score, what was left out, and where it all comes from.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Study {
    /// The sensor model.
    pub sensor: String,
    /// The serial number of the unit, or `unknown`.
    pub serial: String,
    /// The id of the gel, or `unknown`.
    pub gel: String,
    /// Where the samples come from: `recorded`, `simulated`, `synthetic`, `published`, `unknown` or `several`.
    pub source: String,
    /// Every score, in the order of reports.
    pub scores: Vec<Score>,
    /// What was left out, and why.
    pub skipped: Vec<Skip>,
    /// From what, and how: names and texts, in the order they were written.
    pub provenance: Vec<(String, String)>,
    /// Those entries of the provenance that the paragraph on methods needs one by one.
    pub made: Made,
    /// What a reader should know.
    pub notes: Vec<String>,
    /// The scores with other seeds of the training, where the model was fitted with several.
    pub over_seeds: Option<OverSeeds>,
    /// The samples themselves, where they are at hand; figures that need them are left out otherwise.
    pub samples: Option<Samples>,
}

/// Something that was left out.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Skip {
    /// What: `metric:r_light`.
    pub what: String,
    /// Why.
    pub reason: String,
}

impl Study {
    /// The evaluations in `text`, of the schema `taceva.evaluation/1` or `taceva.run/1` in any minor version.
    ///
    /// ```
    /// use taceva_report::Study;
    /// let studies = Study::read(r#"{
    ///     "schema": "taceva.evaluation/1.1",
    ///     "subject": {"sensor": "TacTip", "serial": "unknown", "gel": "unknown", "source": "recorded"},
    ///     "metrics": {"mae": {"Fz": {"value": 0.0361, "unit": "N", "n": 460, "n_invalid": 0,
    ///                 "ci95": [0.034, 0.038], "method": "jackknife by point_id, G=32", "definition": "mae/1"}}},
    ///     "skipped": [], "provenance": {"taceva": "0.1.0"}
    /// }"#)?;
    /// assert_eq!(studies[0].score("mae", "Fz").and_then(|score| score.value.number()), Some(0.0361));
    /// let error = Study::read(r#"{"schema": "taceva.evaluation/9"}"#).unwrap_err();
    /// assert_eq!(error.to_string(), "schema `taceva.evaluation/9`: expected `taceva.evaluation/1` or `taceva.run/1`");
    /// # Ok::<(), taceva_report::ResultsError>(())
    /// ```
    ///
    /// # Errors
    /// [`ResultsError`] if it is no JSON, of another schema, or has something else than expected in some place, which is named.
    pub fn read(text: &str) -> Result<Vec<Study>, ResultsError> {
        read::studies(text)
    }

    /// The score of one metric and channel or plane.
    pub fn score(&self, metric: &str, channel: &str) -> Option<&Score> {
        let mut scores = self.scores.iter();
        scores.find(|score| score.metric == metric && score.channel == channel)
    }

    /// The scores of one metric.
    pub fn of_metric<'a>(&'a self, metric: &'a str) -> impl Iterator<Item = &'a Score> {
        let scores = self.scores.iter();
        scores.filter(move |score| score.metric == metric)
    }

    /// Whether its samples are simulated or synthetic, so that no real sensor was pressed.
    pub fn is_simulated(&self) -> bool {
        matches!(self.source.as_str(), "simulated" | "synthetic")
    }
}
