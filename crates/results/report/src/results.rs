//! Results in the form for pages and tables.

mod fact;
mod model_bench;
mod provenance;
mod standing;

pub use fact::Fact;
pub use model_bench::{
    BENCH_SCHEMA, BenchMachine, BenchRecording, ChannelError, ModelBench, ModelRow,
};
pub(crate) use standing::by_published_r2;

use taceva_metrics::{Standing, TrainingSpread, catalogue};
use taceva_results::{
    DominantSample, EvaluationReport, OverSeeds, Provenance, ResultsError, Samples, Score, Skip,
};

/// Definition of numbers that were published without one.
pub(crate) const PUBLISHED: &str = "published";

/// Results of one sensor, from an [`EvaluationReport`] or from published numbers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Study {
    /// Sensor model.
    pub sensor: String,
    /// Serial number of the unit, or `unknown`.
    pub serial: String,
    /// Id of the gel, or `unknown`.
    pub gel: String,
    /// Origin of the samples: `recorded`, `simulated`, `synthetic`, `published`, `unknown` or `several`.
    pub source: String,
    /// Scores in report order.
    pub scores: Vec<Score>,
    /// Published properties other than scores.
    pub facts: Vec<Fact>,
    /// Skipped metrics with the reasons.
    pub skipped: Vec<Skip>,
    /// Provenance as names and texts, in file order.
    pub provenance: Vec<(String, String)>,
    /// Provenance entries that the methods paragraph uses individually.
    pub made: Made,
    /// Notes for readers.
    pub notes: Vec<String>,
    /// Scores for other training seeds, if the model was fitted with several.
    pub over_seeds: Option<OverSeeds>,
    /// Samples, if available; figures that need them are otherwise omitted.
    pub samples: Option<Samples>,
}

/// Model, samples and presses behind a result.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Made {
    /// Name of the model: `ridge`.
    pub model: Option<String>,
    /// Settings of the model by name, including chosen ones.
    pub settings: Vec<(String, String)>,
    /// Setting that the fit chose, and how: `strength on the validation part`.
    pub chosen_by: Option<String>,
    /// Number of samples by part of the split: `train`, `validation`, `test`.
    pub samples: Vec<(String, u64)>,
    /// Number of presses in the recording, whatever their outcome; 0 if the result states none.
    pub presses: u64,
    /// Digest of the truth table, if two tables were scored.
    pub truth: Option<String>,
    /// Scored part, if the model was fitted on it or its settings were chosen on it.
    pub seen_part: Option<String>,
    /// Scored part: `test`, `all`; `None` without a split.
    pub part: Option<String>,
    /// Number of joined recordings; 0 for a single one.
    pub recordings: usize,
    /// Cross-validation in words, if each sample was held out once: `5-fold cross-validation by point`.
    pub folds: Option<String>,
}

impl From<EvaluationReport> for Study {
    fn from(report: EvaluationReport) -> Study {
        let provenance = provenance::entries(&report.provenance);
        let presses = report.provenance.press_counts();
        let seen_part = seen_part(&report.provenance);
        let folds = report.provenance.cross_validation();
        let samples = report.provenance.samples.into_iter();
        let made = Made {
            folds,
            presses: presses.values().sum(),
            samples: samples.map(|(part, count)| (part, count as u64)).collect(),
            truth: report.provenance.tables.get("truth").cloned(),
            seen_part,
            part: report.provenance.part.clone(),
            recordings: report.provenance.recordings.len(),
            ..match report.provenance.model {
                Some(model) => Made {
                    model: Some(model.name),
                    settings: model.settings.into_iter().collect(),
                    chosen_by: model.chosen_by,
                    ..Made::default()
                },
                None => Made::default(),
            }
        };
        Study {
            sensor: report.subject.sensor,
            serial: report.subject.serial,
            gel: report.subject.gel,
            source: report.subject.source,
            scores: report.scores,
            facts: Vec::new(),
            skipped: report.skipped,
            provenance,
            made,
            notes: report.provenance.notes,
            over_seeds: report.over_seeds,
            samples: report.samples,
        }
    }
}

/// Scored part, if the model has seen it.
fn seen_part(provenance: &Provenance) -> Option<String> {
    let model = provenance.model.as_ref()?;
    let is_own = provenance.dataset.as_ref() == Some(&model.fitted_on);
    let part = provenance.part.as_ref().filter(|part| *part != "test");
    part.filter(|_| is_own).cloned()
}

impl Study {
    /// Parses the evaluations in `text`, the JSON of `evaluate`, `score` or `run`.
    ///
    /// # Errors
    /// Errors of [`taceva_results::read`].
    pub fn read(text: &str) -> Result<Vec<Study>, ResultsError> {
        let reports = taceva_results::read(text)?;
        Ok(reports.into_iter().map(Study::from).collect())
    }

    /// Score of a metric and a channel or plane.
    pub fn score(&self, metric: &str, channel: &str) -> Option<&Score> {
        let mut scores = self.scores.iter();
        scores.find(|score| score.metric == metric && score.channel == channel)
    }

    /// The study for verdicts: each score has the value and interval of the variant that verdicts use.
    pub(crate) fn deciding(&self) -> Study {
        Study {
            scores: self.scores.iter().map(Score::deciding).collect(),
            ..self.clone()
        }
    }

    /// Sample that makes a great part of the squared error behind `score`, if no skill is shown.
    pub(crate) fn dominant(&self, score: &Score) -> Option<DominantSample> {
        let samples = self.samples.as_ref();
        let samples = samples.filter(|_| score.standing == Standing::NoSkill)?;
        samples.dominant(&score.channel)
    }

    /// Scores of one metric.
    pub fn of_metric<'a>(&'a self, metric: &'a str) -> impl Iterator<Item = &'a Score> {
        let scores = self.scores.iter();
        scores.filter(move |score| score.metric == metric)
    }

    /// Spread of `score`, one of [`deciding`](Study::deciding), between the trainings of its model; `None` with fewer than two values.
    pub(crate) fn trainings(&self, score: &Score) -> Option<TrainingSpread> {
        let name = match score.decided_by() {
            Some(variant) => format!("{}.{}", score.metric, variant.name),
            None => score.metric.clone(),
        };
        let mut scores = self.over_seeds.as_ref()?.scores.iter();
        let found = scores.find(|of| of.metric == name && of.channel == score.channel)?;
        let known: Vec<f64> = found.values.iter().copied().flatten().collect();
        TrainingSpread::of_one(&known)
    }

    /// True if `score` depends on a single training of a model with a random seed.
    pub(crate) fn is_one_training(&self, score: &Score) -> bool {
        let reads = catalogue::find(&score.metric).is_some_and(|metric| metric.reads_predictions());
        let draws = self.made.settings.iter().any(|(key, _)| key == "seed");
        reads && draws && self.trainings(score).is_none()
    }

    /// True if its samples are simulated or synthetic, without a real sensor.
    pub fn is_simulated(&self) -> bool {
        matches!(self.source.as_str(), "simulated" | "synthetic")
    }
}

/// Seals `text` and parses its studies.
#[cfg(test)]
pub(crate) fn unsealed(text: &str) -> Result<Vec<Study>, ResultsError> {
    let sealed = taceva_files::seal::json::seal(text).expect("an object");
    Study::read(&sealed)
}
