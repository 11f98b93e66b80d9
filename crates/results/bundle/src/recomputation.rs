//! Scores of a study, computed again from its states and from its tables.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use taceva_core::shown;
use taceva_evaluate::{
    EvaluateError, PredictionCheck, ReadState, Recount, Refit, RowKey, Work, check_predictions,
    merge_read, recount_phases, recount_samples, recount_tables, refit, side_by_side,
};
use taceva_results::{EvaluationReport, Samples, Score, Skip, read, sealed};

use crate::error::Damage;
use crate::layout::{MOST_MODEL, MOST_STATES, MOST_TABLE, MOST_TEXT};
use crate::manifest::StudyFiles;
use crate::source::Source;

/// Reason why a result cannot be computed again.
#[derive(Clone, Debug)]
pub(crate) struct Stop {
    pub(crate) reason: String,
    /// True if the bundle lacks the files.
    pub(crate) is_absent: bool,
}

/// Scores of a study, computed from its tables.
#[derive(Clone, Debug)]
pub(crate) struct TableScores {
    pub(crate) scores: Vec<Score>,
    /// True if the sums of the tables differ from the sums of the state, although they must be equal.
    pub(crate) has_other_sums: bool,
    /// Metrics that cannot be computed from the tables.
    pub(crate) left_out: Vec<Skip>,
}

/// Scores of a study, computed again.
pub(crate) struct Recomputation {
    /// Scores, subject and provenance, computed from the states.
    pub(crate) states: Result<EvaluationReport, Stop>,
    pub(crate) tables: Result<TableScores, Stop>,
    /// Comparison of the table of samples with the model on its recording.
    pub(crate) model: Result<PredictionCheck, Stop>,
    pub(crate) fit: Result<FitScores, Stop>,
}

/// Outcome of a repeated fit.
#[derive(Clone, Debug)]
pub(crate) enum FitScores {
    /// The repeated fit gives the same model.
    Equal,
    /// The repeated fit gives another model, with these scores.
    Other(Vec<Score>),
}

/// Depth, inputs and threads of a recomputation.
#[derive(Clone, Copy)]
pub(crate) struct RecomputationSettings<'a> {
    /// True if tables are scored again.
    pub(crate) reads_tables: bool,
    /// True if the maker of the bundle left tables out.
    pub(crate) are_tables_withheld: bool,
    /// Recordings on which models predict again; empty for the recordings in the bundle, `None` without predictions.
    pub(crate) datasets: Option<&'a [PathBuf]>,
    /// True if models are fitted again.
    pub(crate) fits: bool,
    /// True if this machine has the instruction sets of the machine that made the bundle.
    pub(crate) has_same_sets: bool,
    pub(crate) work: Work<'a>,
}

impl Recomputation {
    /// Empty recomputation, for a level that needs no scores.
    pub(crate) fn none() -> Recomputation {
        Recomputation {
            states: Err(Stop::absent("not requested")),
            tables: Err(Stop::absent("not requested")),
            model: Err(Stop::absent("not requested")),
            fit: Err(Stop::absent("not requested")),
        }
    }

    /// Computes the scores of the study with these files and this report again.
    pub(crate) fn of(
        source: &Source,
        files: &StudyFiles,
        report: &EvaluationReport,
        states: &[ReadState],
        settings: RecomputationSettings<'_>,
    ) -> Recomputation {
        let own = &report.provenance;
        let unscored = match own.tables.is_empty() {
            _ if files.tables.is_some() => None,
            _ if settings.are_tables_withheld && files.samples.is_none() => {
                Some("the maker of the bundle withheld the tables")
            }
            true => None,
            false => Some("name the scored tables by --truth and --pred"),
        };
        let named = |stop: Stop| Stop {
            reason: source.as_named(&stop.reason),
            ..stop
        };
        Recomputation {
            states: of_states(states).map_err(named),
            tables: match settings.reads_tables {
                false => Err(Stop::absent("not requested")),
                true => match unscored {
                    Some(reason) => Err(Stop::absent(reason)),
                    None => {
                        of_tables(source, files, report, states, settings.work.jobs).map_err(named)
                    }
                },
            },
            model: match settings.datasets {
                None => Err(Stop::absent("not requested")),
                Some([]) => {
                    let folders = files.frames.iter().map(|folder| source.path(folder));
                    let recordings: Vec<PathBuf> = folders.collect();
                    of_model(source, files, report, &recordings, settings).map_err(named)
                }
                Some(datasets) => {
                    of_model(source, files, report, datasets, settings).map_err(named)
                }
            },
            fit: match settings.datasets.filter(|_| settings.fits) {
                None => Err(Stop::absent("not requested")),
                Some(datasets) => {
                    of_fit(source, files, report, states, datasets, settings.work).map_err(named)
                }
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

/// States in `files`, each of which is read once.
///
/// # Errors
/// [`Damage`] if a state cannot be read.
pub(crate) fn states(source: &Source, files: &StudyFiles) -> Result<Vec<ReadState>, Damage> {
    let mut total = 0_u64;
    for name in &files.states {
        total = total.saturating_add(source.size(name, MOST_TEXT)?);
        if total > MOST_STATES {
            let rule = "files are not too long to read";
            let problem = format!(
                "the states of its study have more than {MOST_STATES} bytes together; merge them by `taceva merge --state-out`"
            );
            return Err(Damage::new(name, rule, problem));
        }
    }
    let rule = "states have their schema and seal";
    let read = |name: &String| {
        let read = ReadState::read(&source.path(name));
        read.map_err(|error| Damage::new(name, rule, source.as_named(&error.to_string())))
    };
    files.states.iter().map(read).collect()
}

/// Scores of `states`; states with equal plans are merged.
fn of_states(states: &[ReadState]) -> Result<EvaluationReport, Stop> {
    if states.is_empty() {
        let reason = "no state: evaluate or score again with --state-out, and give the state to `taceva bundle --state`";
        return Err(Stop::absent(reason));
    }
    // Merges shards. The states of a run's phases have different plans and stay separate.
    let report = match merge_read(states) {
        Ok((report, _)) => report,
        Err(error) if states.len() == 1 => return Err(Stop::failed(error)),
        Err(error) => side_by_side(states).map_err(|_| Stop::failed(error))?,
    };
    as_read(&report)
}

/// Computes scores again from the tables in `files`. An evaluation has one state, a run has one for each phase; `states` says which metrics to compute.
fn of_tables(
    source: &Source,
    files: &StudyFiles,
    report: &EvaluationReport,
    states: &[ReadState],
    jobs: NonZeroUsize,
) -> Result<TableScores, Stop> {
    let own = &report.provenance;
    let is_run = own.part.is_none() && own.tables.is_empty();
    let recount: Result<Recount, EvaluateError> = match (&files.tables, &files.samples, states) {
        (_, _, []) => return Err(Stop::absent("no state with the settings of the scores")),
        (None, Some(name), states) if is_run => {
            recount_phases(states, &samples(source, name)?, jobs)
        }
        (Some(tables), _, [state]) => {
            for name in [&tables.truth, &tables.prediction] {
                source.size(name, MOST_TABLE).map_err(Stop::failed)?;
            }
            let key = tables.key.as_deref().map(RowKey::from);
            recount_tables(
                state,
                &source.path(&tables.truth),
                &source.path(&tables.prediction),
                key.as_ref(),
                jobs,
            )
        }
        (None, Some(name), [state]) => recount_samples(state, &samples(source, name)?, jobs),
        (None, None, _) => return Err(Stop::absent("no tables")),
        _ => {
            let reason = "several states, and tables are compared with one";
            return Err(Stop::absent(reason));
        }
    };
    let recount = recount.map_err(Stop::failed)?;
    Ok(TableScores {
        scores: as_read(&recount.report)?.scores,
        // The samples of an evaluation lack columns that metrics of the truth alone use, so their sums may differ.
        has_other_sums: (files.tables.is_some() || is_run) && !recount.has_equal_sums,
        left_out: recount.left_out,
    })
}

/// The table of samples called `name`.
fn samples(source: &Source, name: &str) -> Result<Samples, Stop> {
    let text = source.text(name, MOST_TABLE).map_err(Stop::failed)?;
    Samples::read(&text).map_err(Stop::failed)
}

/// Compares the table of samples in `files` with the predictions of the model on one of `datasets`.
fn of_model(
    source: &Source,
    files: &StudyFiles,
    report: &EvaluationReport,
    datasets: &[PathBuf],
    settings: RecomputationSettings<'_>,
) -> Result<PredictionCheck, Stop> {
    let model = model_file(source, files)?;
    let Some(table) = &files.samples else {
        let reason = "no table of samples, which holds the predictions of the model";
        return Err(Stop::absent(reason));
    };
    let own = &report.provenance;
    check_named(datasets, report)?;
    let samples = samples(source, table)?;
    let found = check_predictions(&model, datasets, own, &samples, settings.work);
    Ok(match found.map_err(Stop::failed)? {
        PredictionCheck::Near { first, .. } if settings.has_same_sets => {
            PredictionCheck::Differs(first)
        }
        found => found,
    })
}

/// Fits the model in `files` again on one of `datasets`. If the result is another model, scores it with the plan of the only state.
fn of_fit(
    source: &Source,
    files: &StudyFiles,
    report: &EvaluationReport,
    states: &[ReadState],
    datasets: &[PathBuf],
    work: Work<'_>,
) -> Result<FitScores, Stop> {
    let model = model_file(source, files)?;
    let ([state], Some(_)) = (states, &report.provenance.part) else {
        let reason = "a fit is repeated for an evaluation with one state";
        return Err(Stop::absent(reason));
    };
    check_named(datasets, report)?;
    let fitted = refit(&model, datasets, &report.provenance, work);
    let samples = match fitted.map_err(Stop::failed)? {
        Refit::Equal => return Ok(FitScores::Equal),
        Refit::Other(samples) => samples,
        _ => return Err(Stop::absent("not compared")),
    };
    let recount = recount_samples(state, &samples, work.jobs).map_err(Stop::failed)?;
    Ok(FitScores::Other(recount.report.scores))
}

/// Path of the model in `files`.
fn model_file(source: &Source, files: &StudyFiles) -> Result<PathBuf, Stop> {
    let Some(model) = &files.model else {
        let reason = "no model: make the bundle again with --model FILE";
        return Err(Stop::absent(reason));
    };
    source.size(model, MOST_MODEL).map_err(Stop::failed)?;
    Ok(source.path(model))
}

/// Rejects an empty list of recordings.
fn check_named(datasets: &[PathBuf], report: &EvaluationReport) -> Result<(), Stop> {
    if !datasets.is_empty() {
        return Ok(());
    }
    let stated = report.provenance.dataset.as_deref();
    let stated = shown(stated.unwrap_or("of the results"));
    let reason = format!("no recording: name {stated} by --dataset");
    Err(Stop::absent(&reason))
}

/// `report` after a round trip through JSON, so that both sides of a comparison have one form.
fn as_read(report: &EvaluationReport) -> Result<EvaluationReport, Stop> {
    let text = sealed(report).map_err(Stop::failed)?;
    let mut reports = read(&text).map_err(Stop::failed)?;
    reports.pop().ok_or_else(|| Stop::failed("no scores"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn states_that_are_too_long_together_are_refused_before_one_is_read() {
        let folder = tempfile::tempdir().expect("a folder");
        let mut files = StudyFiles::default();
        for number in 0..3 {
            let name = format!("{number}.json");
            let file = std::fs::File::create(folder.path().join(&name)).expect("room");
            file.set_len(MOST_TEXT).expect("a hole");
            files.states.push(name);
        }
        let source = Source::open(folder.path(), u64::MAX).expect("a folder");
        let damage = states(&source, &files).expect_err("72 MiB");
        assert_eq!(damage.path, "2.json");
        assert!(damage.problem.contains("merge them"), "{damage}");
    }
}
