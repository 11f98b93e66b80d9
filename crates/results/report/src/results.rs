//! Results in the form for pages and tables.

mod fact;
mod model_bench;
mod provenance;
mod standing_by_r2;
mod statement;
mod test_part;
mod traceability;

pub use fact::Fact;
pub use model_bench::{
    BENCH_SCHEMA, BenchMachine, BenchRecording, ChannelError, ModelBench, ModelRow,
};
pub(crate) use standing_by_r2::by_published_r2;
pub use statement::Statement;
pub(crate) use statement::UNSTATED;

use std::collections::BTreeMap;

use taceva_core::{Traceability, Unit};
use taceva_metrics::{Standing, TrainingSpread, catalogue};
use taceva_results::{
    DominantSample, EvaluationReport, Interval, OverSeeds, Provenance, ResultsError, Samples,
    Score, Skip, StudyTask, full_name,
};

use crate::faults::FaultResult;

/// Text in the method of an interval by groups of the split.
pub(crate) const BY_GROUP: &str = " by group";
/// Text in the method of an interval by contact points, or by clusters of many contact points.
pub(crate) const BY_POINT: &str = " by point_id";
/// Definition of published numbers whose source states no definition.
pub(crate) const PUBLISHED: &str = "published";

/// Results of one sensor, from an [`EvaluationReport`] or from published numbers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Study {
    /// Sensor model.
    pub sensor: String,
    /// Serial number of the sensor unit, or `unknown`.
    pub serial: String,
    /// Id of the gel, or `unknown`.
    pub gel: String,
    /// Origin of the samples: `recorded`, `simulated`, `synthetic`, `published`, `unknown` or `several`.
    pub source: String,
    /// Scores in report order.
    pub scores: Vec<Score>,
    /// Published properties other than scores.
    pub facts: Vec<Fact>,
    /// Sources and definitions of the published numbers.
    pub statements: Vec<Statement>,
    /// Skipped metrics, each with the reason.
    pub skipped: Vec<Skip>,
    /// Provenance as names and texts, in file order.
    pub provenance: Vec<(String, String)>,
    /// Provenance entries that the methods paragraph uses individually.
    pub made: Made,
    /// Instruments that measured the labels, with their certificates.
    pub references: Vec<Traceability>,
    /// Accepted manual edits of the result and of its inputs: file, date, reason and digests.
    pub edits: Vec<String>,
    /// Notes for readers.
    pub notes: Vec<String>,
    /// Scores for other training seeds; `None` if the model was fitted once.
    pub over_seeds: Option<OverSeeds>,
    /// Scores of tasks, such as slip.
    pub tasks: Vec<StudyTask>,
    /// Samples of the result; `None` if unavailable, and figures of samples are then omitted.
    pub samples: Option<Samples>,
    /// Errors with faults of the pictures or signals; `None` if no fault was tested.
    pub faults: Option<FaultResult>,
}

/// Model, samples and presses behind a result.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Made {
    /// Name of the model: `ridge`; `None` without a model.
    pub model: Option<String>,
    /// Settings of the model by name, including settings that the fit chose.
    pub settings: Vec<(String, String)>,
    /// Setting that the fit chose, and the criterion: `strength on the validation part`; `None` if no setting was chosen.
    pub chosen_by: Option<String>,
    /// Number of samples by part of the split: `train`, `validation`, `test`.
    pub samples: Vec<(String, u64)>,
    /// Number of presses in the recording, including failed presses; 0 if unknown.
    pub presses: u64,
    /// Digest of the truth table, if two tables were compared.
    pub truth: Option<String>,
    /// Scored part of the split, if the model used it for a fit or for the choice of settings.
    pub seen_part: Option<String>,
    /// Scored part of the split: `test` or `all`; `None` without a split.
    pub part: Option<String>,
    /// Number of joined recordings; 0 for a single recording.
    pub recordings: usize,
    /// Cross-validation as text, if each sample was held out once: `5-fold cross-validation by point`.
    pub folds: Option<String>,
    /// Groups that the split does not divide: the column `object`, or `block of time`; `None` for contact points.
    pub group: Option<String>,
    /// Settings of the devices that made the recording, by name: `force_rate_hz`.
    pub devices: BTreeMap<String, String>,
    /// Digest of the samples, for values from a bundle in a catalogue.
    pub samples_digest: Option<String>,
}

impl From<EvaluationReport> for Study {
    fn from(report: EvaluationReport) -> Study {
        let provenance = provenance::entries(&report.provenance);
        let presses = report.provenance.press_counts();
        let seen_part = seen_part(&report.provenance);
        let folds = report.provenance.cross_validation();
        let group = report.provenance.group().map(str::to_owned);
        let samples = report.provenance.samples.into_iter();
        let made = Made {
            folds,
            group,
            presses: presses.values().sum(),
            samples: samples.map(|(part, count)| (part, count as u64)).collect(),
            truth: report.provenance.tables.get("truth").cloned(),
            seen_part,
            part: report.provenance.part.clone(),
            recordings: report.provenance.recordings.len(),
            devices: report.provenance.devices,
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
            statements: Vec::new(),
            skipped: report.skipped,
            provenance,
            made,
            references: report.provenance.traceability,
            edits: report.provenance.edits,
            notes: report.provenance.notes,
            over_seeds: report.over_seeds,
            tasks: report.tasks,
            samples: report.samples,
            faults: None,
        }
    }
}

/// Scored part of the split, if the model used it for a fit or for the choice of settings.
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

    /// Study without scores, for a single result of `taceva stress`.
    pub fn of_faults(faults: FaultResult) -> Study {
        let subject = faults.subject.clone();
        Study {
            sensor: subject.sensor,
            serial: subject.serial,
            gel: subject.gel,
            source: subject.source,
            faults: Some(faults),
            ..Study::default()
        }
    }

    /// Score of a metric and a channel or plane; `None` if there is no such score.
    pub fn score(&self, metric: &str, channel: &str) -> Option<&Score> {
        let mut scores = self.scores.iter();
        scores.find(|score| score.metric == metric && score.channel == channel)
    }

    /// Study with the scores for verdicts: each has the value and interval of the variant that verdicts use.
    pub(crate) fn deciding(&self) -> Study {
        Study {
            scores: self.scores.iter().map(Score::deciding).collect(),
            ..self.clone()
        }
    }

    /// Sample that makes a quarter or more of the squared error of `score`, if the model is not shown to have skill. `None` for angles, whose
    /// errors may wrap.
    pub(crate) fn dominant(&self, score: &Score) -> Option<DominantSample> {
        let mae = self.score("mae", &score.channel);
        let is_angle = mae.is_some_and(|mae| matches!(mae.unit, Unit::Degree | Unit::Radian));
        let samples = self.samples.as_ref();
        let is_named = score.standing == Standing::NoSkill && !is_angle;
        let samples = samples.filter(|_| is_named)?;
        samples.dominant(&score.channel)
    }

    /// Provenance text with the key `key`; `None` for an unknown key.
    pub(crate) fn stated(&self, key: &str) -> Option<&str> {
        let found = self.provenance.iter().find(|(name, _)| name == key);
        found.map(|(_, text)| text.as_str())
    }

    /// Sentence on the certificates behind the labels; `None` if nothing was measured, or the origin is unknown.
    pub(crate) fn traceability(&self) -> Option<&str> {
        let line = self.stated("traceability");
        (self.source == "recorded").then(|| line.unwrap_or(traceability::NOT_TRACEABLE))
    }

    /// Scores of one metric.
    pub fn of_metric<'a>(&'a self, metric: &'a str) -> impl Iterator<Item = &'a Score> {
        let scores = self.scores.iter();
        scores.filter(move |score| score.metric == metric)
    }

    /// Spread of `score` between trainings of the model. `score` is a score of [`deciding`](Study::deciding). `None` for fewer than two values.
    pub(crate) fn trainings(&self, score: &Score) -> Option<TrainingSpread> {
        let variant = score.decided_by().map(|variant| variant.name.as_str());
        let values = self.values_of_trainings(&score.metric, variant, &score.channel);
        TrainingSpread::of_one(&values)
    }

    /// Values of a metric or its variant for each training of the model; empty for a single training.
    pub(crate) fn values_of_trainings(
        &self,
        metric: &str,
        variant: Option<&str>,
        channel: &str,
    ) -> Vec<f64> {
        let name = full_name(metric, variant);
        let mut scores = self.over_seeds.iter().flat_map(|over| &over.scores);
        let found = scores.find(|of| of.metric == name && of.channel == channel);
        let values = found.map(|found| found.values.iter().copied().flatten());
        values.into_iter().flatten().collect()
    }

    /// True if `score` depends on a single training of a model with a random seed.
    pub(crate) fn is_one_training(&self, score: &Score) -> bool {
        let reads = catalogue::find(&score.metric).is_some_and(|metric| metric.reads_predictions());
        let draws = self.made.settings.iter().any(|(key, _)| key == "seed");
        reads && draws && self.trainings(score).is_none()
    }

    /// Column or kind of the groups by which intervals are computed; `None` for intervals by contact point or by sample.
    pub(crate) fn clustered_by(&self) -> Option<&str> {
        let methods = self
            .scores
            .iter()
            .filter_map(|score| score.interval.as_ref());
        let mut methods = methods.filter_map(Interval::method);
        let group = self.made.group.as_deref()?;
        methods
            .any(|method| method.contains(BY_GROUP))
            .then_some(group)
    }

    /// Method of an interval, with the name of the groups: `jackknife by object, G=5`.
    pub(crate) fn method_named(&self, method: &str) -> String {
        match &self.made.group {
            Some(group) => method.replace(BY_GROUP, &format!(" by {group}")),
            None => method.to_owned(),
        }
    }

    /// True if the samples of the study are simulated or synthetic, without a real sensor.
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
