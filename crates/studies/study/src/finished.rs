//! Finished studies of a run.

use taceva_dataset::Dataset;
use taceva_evaluate::Target;
use taceva_models::Model;
use taceva_results::EvaluationReport;

/// A finished study: the report, and recording and model for further tests. A run creates it, and callers only read it.
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
    /// Report of the study.
    pub report: EvaluationReport,
    /// Recording of the study.
    pub dataset: Dataset,
    /// Model of the study, fitted or read from a file; `None` if no metric of the study reads predictions.
    pub fitted: Option<FittedStudy>,
}

/// Model of a finished study.
#[derive(Debug)]
#[non_exhaustive]
pub struct FittedStudy {
    /// Model of the study, or that of the first seed if the study is fitted with several seeds.
    pub model: Model,
    /// Calibration samples with a frame that were not used to fit the model.
    pub unseen: Target,
}
