//! Scores of a study, computed again from its states and from its tables.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use taceva_core::shown;
use taceva_evaluate::{
    PredictionCheck, Recount, RowKey, Work, check_predictions, merge, recount_samples,
    recount_tables, side_by_side,
};
use taceva_results::{EvaluationReport, Samples, Score, Skip, read, sealed};

use crate::layout::{MOST_MODEL, MOST_TABLE, MOST_TEXT};
use crate::manifest::StudyFiles;
use crate::source::Source;

/// Reason why something cannot be computed again.
#[derive(Clone, Debug)]
pub(crate) struct Stop {
    pub(crate) reason: String,
    /// True if the bundle lacks the files.
    pub(crate) is_absent: bool,
}

/// Scores of a study by its tables.
#[derive(Clone, Debug)]
pub(crate) struct TableScores {
    pub(crate) scores: Vec<Score>,
    /// True if the sums must equal those of the state, and do not.
    pub(crate) has_other_sums: bool,
    /// Metrics that the tables cannot give.
    pub(crate) left_out: Vec<Skip>,
}

/// Scores of a study, computed again.
pub(crate) struct Recomputation {
    /// Scores, subject and provenance by the states.
    pub(crate) states: Result<EvaluationReport, Stop>,
    pub(crate) tables: Result<TableScores, Stop>,
    /// Table of samples, compared with the model on its recording.
    pub(crate) model: Result<PredictionCheck, Stop>,
}

/// Depth and means of a recomputation.
#[derive(Clone, Copy)]
pub(crate) struct Means<'a> {
    /// True if tables are scored again.
    pub(crate) reads_tables: bool,
    /// Recordings on which models predict again; `None` if they do not.
    pub(crate) datasets: Option<&'a [PathBuf]>,
    /// True if this machine has the instruction sets of the one that made the bundle.
    pub(crate) has_same_sets: bool,
    pub(crate) work: Work<'a>,
}

impl Recomputation {
    /// Nothing, because the level does not ask for it.
    pub(crate) fn none() -> Recomputation {
        Recomputation {
            states: Err(Stop::absent("not asked for")),
            tables: Err(Stop::absent("not asked for")),
            model: Err(Stop::absent("not asked for")),
        }
    }

    /// Scores of the study with these files and this report.
    pub(crate) fn of(
        source: &Source,
        files: &StudyFiles,
        report: &EvaluationReport,
        means: Means<'_>,
    ) -> Recomputation {
        let own = &report.provenance;
        let unscored = match (own.tables.is_empty(), own.part.is_some()) {
            _ if files.tables.is_some() => None,
            (true, true) => None,
            // A run scores each phase of its protocol by itself.
            (true, false) => Some("the table of samples holds every sample, scored or not"),
            (false, _) => Some("name the tables that were scored by --truth and --pred"),
        };
        Recomputation {
            states: of_states(source, files),
            tables: match means.reads_tables {
                false => Err(Stop::absent("not asked for")),
                true => match unscored {
                    Some(reason) => Err(Stop::absent(reason)),
                    None => of_tables(source, files, means.work.jobs),
                },
            },
            model: match means.datasets {
                None => Err(Stop::absent("not asked for")),
                Some(datasets) => of_model(source, files, report, datasets, means),
            },
        }
    }
}

impl Stop {
    fn absent(reason: &str) -> Stop {
        Stop {
            reason: reason.to_owned(),
            is_absent: true,
        }
    }

    fn failed(reason: impl ToString) -> Stop {
        Stop {
            reason: reason.to_string(),
            is_absent: false,
        }
    }
}

/// Scores of the states in `files`; several are merged, or stand side by side if their plans differ.
fn of_states(source: &Source, files: &StudyFiles) -> Result<EvaluationReport, Stop> {
    if files.states.is_empty() {
        let reason = "no state: evaluate or score again with --state-out, and give the state to `taceva bundle --state`";
        return Err(Stop::absent(reason));
    }
    for name in &files.states {
        source.size(name, MOST_TEXT).map_err(Stop::failed)?;
    }
    let paths: Vec<PathBuf> = files.states.iter().map(|name| source.path(name)).collect();
    // Shards merge; the states of the phases of a run have plans of their own.
    let report = match merge(&paths) {
        Ok((report, _)) => report,
        Err(error) if paths.len() == 1 => return Err(Stop::failed(error)),
        Err(error) => side_by_side(&paths).map_err(|_| Stop::failed(error))?,
    };
    as_read(&report)
}

/// Scores of the tables in `files`, by the plan of their only state.
fn of_tables(source: &Source, files: &StudyFiles, jobs: NonZeroUsize) -> Result<TableScores, Stop> {
    let [state] = files.states.as_slice() else {
        return Err(Stop::absent(match files.states.len() {
            0 => "no state, which says how tables are scored",
            _ => "several states, and tables are compared with one",
        }));
    };
    let recount: Recount = match (&files.tables, &files.samples) {
        (Some(tables), _) => {
            for name in [&tables.truth, &tables.prediction] {
                source.size(name, MOST_TABLE).map_err(Stop::failed)?;
            }
            let key = tables.key.as_deref().map(RowKey::from);
            recount_tables(
                &source.path(state),
                &source.path(&tables.truth),
                &source.path(&tables.prediction),
                key.as_ref(),
                jobs,
            )
            .map_err(Stop::failed)?
        }
        (None, Some(name)) => {
            let text = source.text(name, MOST_TABLE).map_err(Stop::failed)?;
            let samples = Samples::read(&text).map_err(Stop::failed)?;
            recount_samples(&source.path(state), &samples, jobs).map_err(Stop::failed)?
        }
        (None, None) => return Err(Stop::absent("no tables")),
    };
    Ok(TableScores {
        scores: as_read(&recount.report)?.scores,
        // A table of samples lacks what metrics of the truth alone read.
        has_other_sums: files.tables.is_some() && !recount.has_equal_sums,
        left_out: recount.left_out,
    })
}

/// Table of samples in `files`, compared with the predictions of the model on one of `datasets`.
fn of_model(
    source: &Source,
    files: &StudyFiles,
    report: &EvaluationReport,
    datasets: &[PathBuf],
    means: Means<'_>,
) -> Result<PredictionCheck, Stop> {
    let Some(model) = &files.model else {
        let reason = "no model: make the bundle again with --model FILE";
        return Err(Stop::absent(reason));
    };
    let Some(table) = &files.samples else {
        let reason = "no table of samples, which holds the predictions of the model";
        return Err(Stop::absent(reason));
    };
    let own = &report.provenance;
    if datasets.is_empty() {
        let stated = own.dataset.as_deref().unwrap_or("of the results");
        let reason = format!("no recording: name {} by --dataset", shown(stated));
        return Err(Stop::absent(&reason));
    }
    source.size(model, MOST_MODEL).map_err(Stop::failed)?;
    let text = source.text(table, MOST_TABLE).map_err(Stop::failed)?;
    let samples = Samples::read(&text).map_err(Stop::failed)?;
    drop(text);
    let model = source.path(model);
    let found = check_predictions(&model, datasets, own, &samples, means.work);
    Ok(match found.map_err(Stop::failed)? {
        PredictionCheck::Near { first, .. } if means.has_same_sets => {
            PredictionCheck::Differs(first)
        }
        found => found,
    })
}

/// `report` as it is read from its JSON, so that both sides of a comparison have one form.
fn as_read(report: &EvaluationReport) -> Result<EvaluationReport, Stop> {
    let text = sealed(report).map_err(Stop::failed)?;
    let mut reports = read(&text).map_err(Stop::failed)?;
    reports.pop().ok_or_else(|| Stop::failed("no scores"))
}
