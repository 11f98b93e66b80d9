//! Finished studies of a run.

use taceva_dataset::Dataset;
use taceva_evaluate::Target;
use taceva_models::Model;
use taceva_results::EvaluationReport;

/// A finished study: its report, and its recording and model for further tests. Callers only read it; the run makes it.
///
/// ```no_run
/// # fn of_run(studies: Vec<taceva_study::FinishedStudy>) {
/// for study in studies {
///     let unseen = study.fitted.map_or(0, |fitted| fitted.unseen.rows.len());
///     println!("{}: {unseen} samples for further tests", study.report.subject.sensor);
/// }
/// # }
/// ```
#[derive(Debug)]
#[non_exhaustive]
pub struct FinishedStudy {
    /// The report.
    pub report: EvaluationReport,
    /// The recording.
    pub dataset: Dataset,
    /// The fitted or opened model; `None` if no metric of the study reads predictions.
    pub fitted: Option<FittedStudy>,
}

/// Model of a finished study.
#[derive(Debug)]
#[non_exhaustive]
pub struct FittedStudy {
    /// The model, or the model of the first seed if the study has several.
    pub model: Model,
    /// Calibration samples with a picture that the model has not seen.
    pub unseen: Target,
}
