//! Cross-validation. Each group of samples, or each recording, is predicted by a model that was fitted on the others.

mod by_group;
mod common_model;
mod default_split;

use std::collections::BTreeSet;

use taceva_dataset::Dataset;
use taceva_models::{Fractions, Split, SplitError, SplitKind, SplitSpec};

use super::fold_progress::FoldProgress;
use super::request::{EvaluateRequest, Evaluated};
use super::scores::{Behind, score};
use crate::assess::FitFacts;
use crate::cache::Cache;
use crate::calibration_rows::PlannedRows;
use crate::error::EvaluateError;
use crate::fit::{FitPlan, FitRequest, Recipe};
use crate::note::Note;
use crate::plan::Plan;
use crate::predict::{self, Predicted, Target};
use crate::rows::{DataPart, Divided};
use crate::work::Work;
use common_model::together;
use default_split::default_split;

/// Divisions that together test every sample.
pub(crate) struct Folds<'a> {
    dataset: &'a Dataset,
    /// Division that combines the test parts of all folds.
    whole: Divided,
    folds: Vec<Fold>,
    /// Group of every row of the dataset, if groups have several samples; the empty text for a row without a group.
    groups: Option<Vec<String>>,
    are_recordings: bool,
}

/// Division of one fold.
struct Fold {
    name: String,
    divided: Divided,
}

/// Folds that `request` names, or the default folds for few groups. `None` for a single division, and for a `part` without a split.
///
/// # Errors
/// [`EvaluateError::Split`] if there is only one recording, if there are fewer groups than folds, or if the split is invalid.
pub(crate) fn of<'a>(
    dataset: &'a Dataset,
    request: &FitRequest,
    part: Option<DataPart>,
) -> Result<Option<Folds<'a>>, EvaluateError> {
    match request.split.as_deref() {
        Some(text) => of_spec(dataset, request.seed, text.parse()?),
        None if part.is_some() => Ok(None),
        None => by_default(dataset, request.seed),
    }
}

/// Default folds of a recording with few groups; `None` for any other recording.
///
/// # Errors
/// Errors of [`of`].
pub(crate) fn by_default(dataset: &Dataset, seed: u64) -> Result<Option<Folds<'_>>, EvaluateError> {
    default_split(dataset)?.map_or(Ok(None), |spec| of_spec(dataset, seed, spec))
}

/// Folds of the cross-validation that `request` names; `None` if it names no cross-validation.
///
/// # Errors
/// Errors of [`of`].
pub(crate) fn asked<'a>(
    dataset: &'a Dataset,
    request: &FitRequest,
) -> Result<Option<Folds<'a>>, EvaluateError> {
    let spec = request.split.as_deref().map(str::parse::<SplitSpec>);
    let spec = spec.transpose()?;
    match spec.filter(|spec| matches!(spec.kind, SplitKind::Folds(_))) {
        Some(spec) => of_spec(dataset, request.seed, spec),
        None => Ok(None),
    }
}

/// Folds of `spec`; `None` if `spec` is a single division.
///
/// # Errors
/// Errors of [`of`].
pub(crate) fn of_spec<'a>(
    dataset: &'a Dataset,
    seed: u64,
    spec: SplitSpec,
) -> Result<Option<Folds<'a>>, EvaluateError> {
    match &spec.kind {
        SplitKind::LeaveOneRecordingOut => Folds::of_recordings(dataset, spec, seed),
        SplitKind::Folds(folds) => {
            let folds = folds.clone();
            let planned = PlannedRows::of(dataset)?;
            let rows = planned.map_or_else(|| dataset.all_rows(), |planned| planned.rows);
            Folds::of_groups(dataset, &rows, spec, folds, seed)
        }
        _ => return Ok(None),
    }
    .map(Some)
}

impl<'a> Folds<'a> {
    fn of_recordings(
        dataset: &'a Dataset,
        spec: SplitSpec,
        seed: u64,
    ) -> Result<Folds<'a>, EvaluateError> {
        let recordings = dataset.recordings();
        if recordings.is_empty() {
            return Err(SplitError::NoRecordings {
                split: "leave-one-recording-out",
            }
            .into());
        }
        let mut folds = Vec::new();
        for left_out in recordings {
            let rows = dataset.all_rows().into_iter();
            let others: Vec<usize> = rows.filter(|row| !left_out.rows().contains(row)).collect();
            let [train, validation, _] = spec.fractions.shares();
            let fractions = Fractions::new(train, validation, 0.0)?;
            let mut divided = Divided::within_default(dataset, &others, fractions, seed)?;
            divided.split.test = left_out.rows().collect();
            divided.split.left_out.clear();
            divided.spec = spec.clone();
            folds.push(Fold {
                name: left_out.name().to_owned(),
                divided,
            });
        }
        let count = recordings.len();
        let note = format!(
            "each of {count} recordings was predicted by a model fitted on the other {}; the baseline of skill is the mean of the truth, \
             because these {count} models share no constant",
            count - 1
        );
        let whole = Divided {
            spec,
            seed,
            split: Split {
                test: dataset.all_rows(),
                note: Some(note),
                ..Split::default()
            },
            neighbours: None,
            groups: None,
            are_independent: false,
            folds: recordings.iter().map(|own| own.rows().collect()).collect(),
        };
        Ok(Folds {
            dataset,
            whole,
            folds,
            groups: None,
            are_recordings: true,
        })
    }

    /// Group of every row of the dataset, if whole groups are left out; `None` for single samples and for recordings.
    pub(crate) fn groups(&self) -> Option<&[String]> {
        self.groups.as_deref()
    }

    /// Division that combines all folds: every sample of a group is in its test part.
    pub(crate) fn into_whole(self) -> Divided {
        self.whole
    }

    /// Division that combines all folds, and the division of each fold.
    pub(crate) fn into_parts(self) -> (Divided, Vec<Divided>) {
        let folds = self.folds.into_iter();
        (self.whole, folds.map(|fold| fold.divided).collect())
    }

    /// Division of each fold.
    pub(crate) fn into_divisions(self) -> Vec<Divided> {
        self.folds.into_iter().map(|fold| fold.divided).collect()
    }

    /// Rejects a request to score one part, because cross-validation scores every sample.
    pub(crate) fn refuse_part(&self, request: &EvaluateRequest) -> Result<(), EvaluateError> {
        match request.part {
            None => Ok(()),
            Some(part) => Err(EvaluateError::Request(format!(
                "part `{}`: {} scores every sample, with a model fitted without its {}; omit --part, or name a --split with a test part, such as by-point",
                part.name(),
                self.words(),
                match self.are_recordings {
                    true => "recording",
                    false => "group",
                }
            ))),
        }
    }

    /// Description of the split without the shares of its parts, which do not apply to left-out recordings.
    fn words(&self) -> String {
        match self.are_recordings {
            true => "leave-one-recording-out".to_owned(),
            false => self.whole.spec.to_string(),
        }
    }

    /// Adds to `plan` the step that leaves out each fold.
    pub(super) fn explain(&self, plan: &mut Plan) {
        let count = self.folds.len();
        let what = match self.are_recordings {
            true => format!("each of {count} recordings"),
            false => format!("each of {count} folds ({})", self.words()),
        };
        plan.step(
            "leave out",
            format!("{what} in turn: {count} models; of the first:"),
        );
    }

    /// Plan of the fit of the first fold.
    pub(crate) fn first(&self, request: &FitRequest) -> Result<FitPlan<'a>, EvaluateError> {
        self.plan(request, &self.folds[0])
    }

    /// Fits and predicts each fold, then scores all predictions together. Features are computed once.
    pub(crate) fn evaluate(
        &self,
        request: &EvaluateRequest,
        fit: &FitRequest,
        work: Work<'_>,
    ) -> Result<Evaluated, EvaluateError> {
        self.refuse_part(request)?;
        let dataset = self.dataset;
        let own;
        let shared = match work.cache {
            Some(cache) if cache.is_in_memory() => cache,
            outer => {
                own = Cache::of_folds(outer);
                &own
            }
        };
        let work = Work {
            cache: Some(shared),
            ..work
        };
        let mut models = Vec::new();
        let mut predicted: Option<Predicted> = None;
        let mut rows = Vec::new();
        let mut decoded = BTreeSet::new();
        let (mut passes, mut unlearnt, mut unpredicted) = (1, 0, 0);
        for (number, fold) in (1_usize..).zip(&self.folds) {
            let plan = self.plan(fit, fold)?;
            let mut name = format!("fold {number} of {}", self.folds.len());
            if self.are_recordings {
                name += &format!(" without {}", fold.name);
            }
            let progress = FoldProgress::of(work.progress, fit.model.name(), name);
            let work = Work {
                progress: &progress,
                ..work
            };
            if plan.reads_frames() {
                decoded.extend(plan.read.iter().copied());
                passes = plan.passes();
            }
            let fitted = plan.run(work)?;
            let model = &fitted.model;
            let reads = model.reads_frames();
            let target = Target::of(dataset, Some(fitted.divided), None, reads)?;
            let own = predict::predict_target(dataset, model, &target, work)?;
            if reads {
                decoded.extend(predict::rows_read_by(dataset, model, &target.rows)?);
            }
            unlearnt += fitted.left_out;
            unpredicted += target.left_out;
            rows.extend(target.rows);
            models.push((fold.name.as_str(), Behind::of(model)?));
            predicted = Some(match predicted {
                None => own,
                Some(before) => before.followed_by(own)?,
            });
        }
        let predicted = predicted.expect("BUG: there are at least two folds");
        let (rows, mut predicted) = predicted.in_order_of(rows);
        // Each frame counts once for each kind of features, however many folds there are.
        predicted.frames_decoded = 0;
        let target = Target {
            part: DataPart::Test,
            rows,
            divided: Some(self.whole.clone()),
            left_out: unpredicted,
        };
        let fit = FitFacts {
            frames_decoded: passes * decoded.len() as u64,
            notes: Note::left_out("training and validation of all folds", unlearnt)
                .into_iter()
                .collect(),
        };
        let scored = score(
            dataset,
            request.asked(),
            Behind {
                fit,
                ..together(dataset, models)
            },
            &target,
            &predicted,
            work.jobs,
        )?;
        let manifest = self.whole.manifest(dataset.table())?;
        Ok(Evaluated {
            manifest: Some(manifest),
            ..scored
        })
    }

    fn plan(&self, request: &FitRequest, fold: &Fold) -> Result<FitPlan<'a>, EvaluateError> {
        let recipe = Recipe::of(request)?;
        let mut plan = FitPlan::on(self.dataset, request, recipe, fold.divided.clone())?;
        if let Some(groups) = self.groups() {
            plan.leave_out_groups(groups);
        }
        Ok(plan)
    }
}
