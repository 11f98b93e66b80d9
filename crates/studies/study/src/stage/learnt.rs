//! Models of a study and their predictions: one fitted or opened model, or one model for each fold of a cross-validation.

use std::path::PathBuf;

use taceva_acquire::{PlannedScene, PlannedStudy};
use taceva_dataset::Dataset;
use taceva_evaluate::{
    Behind, Cache, CachedStage, DataPart, Divided, EvaluateError, FitPlan, FitRequest, FoldedRows,
    Key, Need, Predicted, Predictor, Recipe, Target, Work, predicted_numbers, predicted_table,
    usable,
};
use taceva_models::{Checkpoints, FoldGroups, FoldSpec, Model};
use taceva_protocol::PhaseKind;

use super::context::RunContext;
use super::phase_rows::{PhaseRows, seen};
use crate::finished::FittedStudy;
use crate::models::{fit_request, folds, model_file};

/// Models of a study, fitted or read from a file.
pub(super) struct Learnt {
    /// The single model, or one model for each fold; never empty. The first model also predicts the rows that are in no fold.
    models: Vec<Learned>,
    /// Folds of the cross-validation, if the scene asks for one.
    folds: Option<Folded>,
    /// Number of frames that were decoded for the fits. With folds, it includes the frames for the predictions.
    frames_decoded: u64,
}

/// A model, and the split of samples for its fit.
struct Learned {
    model: Model,
    /// Split of samples for the fit; `None` for a model that was fitted on another recording.
    divided: Option<Divided>,
}

/// Folds of a study's cross-validation.
struct Folded {
    /// Split whose test part has the test rows of all folds.
    whole: Divided,
    /// Features of all rows that the models of the folds read, computed once.
    features: Cache,
}

impl Learnt {
    /// Fits the models that the plan needs, with `seed` if given, or reads one from its file. `None` without a metric that reads predictions.
    pub(super) fn new(
        scene: &PlannedScene,
        study: &PlannedStudy,
        dataset: &Dataset,
        phase_rows: &PhaseRows<'_>,
        context: RunContext<'_>,
        seed: Option<u64>,
    ) -> Result<Option<Learnt>, EvaluateError> {
        if !phase_rows.reads_predictions() {
            return Ok(None);
        }
        if let Some(file) = model_file(study) {
            let model = context
                .models
                .open(&scene.text.folder.join(file))
                .map_err(|error| EvaluateError::Request(error.to_string()))?;
            let divided = Divided::by_model(dataset, &model)?;
            return Ok(Some(Learnt {
                models: vec![Learned { model, divided }],
                folds: None,
                frames_decoded: 0,
            }));
        }
        let Some(request) = fit_request(study, scene.scene.seed, context.models) else {
            return Ok(None);
        };
        let mut request = FitRequest {
            channels: phase_rows.predicted_channels(),
            ..request?
        };
        if let Some(seed) = seed {
            request = request.with_seed(seed)?;
        }
        // Only trainings with the first seed have checkpoints; finished trainings with other seeds are in the cache.
        let has_checkpoints = seed == scene.seeds.first().copied();
        let fitting = Fitting {
            dataset,
            request: &request,
            context,
            has_checkpoints,
        };
        let Some(count) = folds(study) else {
            return fitting.on(phase_rows.divided(&request)?).map(Some);
        };
        let rows = phase_rows.rows(PhaseKind::Calibration);
        let spec = FoldSpec {
            count: Some(count),
            // A recording without a plan may name no contact points.
            by: match phase_rows.protocol() {
                Some(_) => FoldGroups::Points,
                None => FoldGroups::Detected,
            },
        };
        let folded = FoldedRows::new(dataset, &rows, spec, request.seed)?;
        fitting
            .on_folds(folded, predicted_rows(phase_rows))
            .map(Some)
    }

    /// The single model, or with folds the model that also predicts the rows that are in no fold.
    pub(super) fn model(&self) -> &Model {
        &self.models[0].model
    }

    /// Split of the calibration rows for the fit. With folds, its test part has the test rows of all folds. `None` for a model that was fitted on
    /// another recording.
    pub(super) fn division(&self) -> Option<&Divided> {
        match &self.folds {
            Some(folds) => Some(&folds.whole),
            None => self.models[0].divided.as_ref(),
        }
    }

    /// Number of frames that were decoded for the fits. With folds, it includes the frames for the predictions.
    pub(super) fn frames_decoded(&self) -> u64 {
        self.frames_decoded
    }

    /// Description of the models for the report.
    pub(super) fn behind(&self, dataset: &Dataset) -> Result<Behind, EvaluateError> {
        let models = self.models.iter();
        let mut behind: Vec<Behind> = models
            .map(|learned| Behind::of(&learned.model))
            .collect::<Result<_, _>>()?;
        Ok(match &self.folds {
            Some(_) => Behind::of_folds(dataset, behind),
            None => behind.swap_remove(0),
        })
    }

    /// Model of the study, with the calibration samples that were not used to fit it.
    pub(super) fn into_fitted(
        mut self,
        dataset: &Dataset,
        phase_rows: &PhaseRows<'_>,
    ) -> FittedStudy {
        let Learned { model, divided } = self.models.swap_remove(0);
        let seen = divided.as_ref().map_or_else(Vec::new, seen);
        let mut rows = phase_rows.rows(PhaseKind::Calibration);
        rows.retain(|row| seen.binary_search(row).is_err());
        let need = Need {
            frame: true,
            labels: None,
        };
        let usable = usable(dataset, &rows, need);
        let part = match divided {
            Some(_) => DataPart::Test,
            None => DataPart::All,
        };
        FittedStudy {
            model,
            unseen: Target {
                part,
                left_out: rows.len() - usable.len(),
                rows: usable,
                divided,
            },
        }
    }

    /// Predictions for all rows that a metric reads, with these rows in ascending order. Each row is predicted by a model that was not fitted on it.
    pub(super) fn predict(
        &self,
        study: &PlannedStudy,
        dataset: &Dataset,
        phase_rows: &PhaseRows<'_>,
        context: RunContext<'_>,
    ) -> Result<(Predicted, Vec<usize>), EvaluateError> {
        let mut rows = predicted_rows(phase_rows);
        let left = match &self.folds {
            // The models of the folds have together seen every calibrated row.
            Some(folds) => folds.whole.split.test.clone(),
            None => self.division().map_or_else(Vec::new, seen),
        };
        rows.retain(|row| left.binary_search(row).is_err());
        let mut found: Option<Predicted> = None;
        let mut all = Vec::new();
        let mut add = |model: &Model, rows: Vec<usize>| -> Result<(), EvaluateError> {
            let Some((own, rows)) = self.predict_rows(model, dataset, rows, context)? else {
                return Ok(());
            };
            found = Some(match found.take() {
                None => own,
                Some(before) => before.followed_by(own)?,
            });
            all.extend(rows);
            Ok(())
        };
        add(self.model(), rows)?;
        if self.folds.is_some() {
            for learned in &self.models {
                let tested = learned.divided.as_ref();
                let tested = tested.map(|divided| divided.rows(DataPart::Test));
                add(&learned.model, tested.unwrap_or_default())?;
            }
        }
        let Some(predicted) = found else {
            return Err(EvaluateError::Request(format!(
                "study `{}` has no sample to predict",
                study.plan.name
            )));
        };
        if self.folds.is_none() {
            return Ok((predicted, all));
        }
        let (rows, mut predicted) = predicted.in_order_of(all);
        // Counted with the fits, which read the same features.
        predicted.frames_decoded = 0;
        Ok((predicted, rows))
    }

    /// Predictions by `model` for those of `rows` that are usable, with the usable rows. `None` if no row is usable.
    fn predict_rows(
        &self,
        model: &Model,
        dataset: &Dataset,
        rows: Vec<usize>,
        RunContext { work, cache, .. }: RunContext<'_>,
    ) -> Result<Option<(Predicted, Vec<usize>)>, EvaluateError> {
        let need = Need {
            frame: model.reads_features(),
            labels: None,
        };
        let usable = usable(dataset, &rows, need);
        if usable.is_empty() {
            return Ok(None);
        }
        let target = Target {
            part: DataPart::All,
            left_out: rows.len() - usable.len(),
            rows: usable,
            divided: None,
        };
        let key = Key::of(CachedStage::Predict)
            .part("dataset", &dataset.digest().to_string())
            .part("model", &model.digest()?)
            .whole("rows", &target.rows)
            .finish();
        let work = match &self.folds {
            Some(folds) => folds.work(work),
            None => work,
        };
        let numbers = cache.value(&key, || predicted_numbers(dataset, model, &target, work))?;
        let predicted = predicted_table(dataset, Predictor::of(model), &target, &numbers)?;
        Ok(Some((predicted, target.rows)))
    }
}

impl Folded {
    /// Copy of `work` whose cache has the features that the folds share.
    fn work<'a>(&'a self, work: Work<'a>) -> Work<'a> {
        Work {
            cache: Some(&self.features),
            ..work
        }
    }
}

/// Inputs of the fits of a study.
struct Fitting<'a> {
    dataset: &'a Dataset,
    request: &'a FitRequest,
    context: RunContext<'a>,
    /// True if checkpoints of unfinished trainings are stored.
    has_checkpoints: bool,
}

impl Fitting<'_> {
    /// Fits one model with the split `divided`.
    fn on(&self, divided: Divided) -> Result<Learnt, EvaluateError> {
        let checkpoint = self.context.checkpoint.to_owned();
        let (learned, plan) = self.fit(divided, checkpoint, self.context.work)?;
        Ok(Learnt {
            models: vec![learned],
            folds: None,
            frames_decoded: plan.frames,
        })
    }

    /// Fits one model for each fold. The features of `rows` and of all folds are computed once.
    fn on_folds(&self, folded: FoldedRows, rows: Vec<usize>) -> Result<Learnt, EvaluateError> {
        let mut rows = [rows, folded.whole.split.test.clone()].concat();
        rows.sort_unstable();
        rows.dedup();
        let need = Need {
            frame: true,
            labels: None,
        };
        let read = usable(self.dataset, &rows, need);
        let count = read.len() as u64;
        let folds = Folded {
            whole: folded.whole,
            features: Cache::of_folded_rows(self.context.work.cache, read),
        };
        let mut models = Vec::new();
        let mut passes = 0;
        for (number, divided) in (1_usize..).zip(folded.folds) {
            let mut checkpoint = self.context.checkpoint.as_os_str().to_owned();
            checkpoint.push(format!(".{number}"));
            let work = folds.work(self.context.work);
            let (learned, plan) = self.fit(divided, checkpoint.into(), work)?;
            passes = passes.max(plan.passes);
            models.push(learned);
        }
        Ok(Learnt {
            models,
            folds: Some(folds),
            frames_decoded: passes * count,
        })
    }

    fn fit(
        &self,
        divided: Divided,
        checkpoint: PathBuf,
        work: Work<'_>,
    ) -> Result<(Learned, Decoded), EvaluateError> {
        let recipe = Recipe::of(self.request)?;
        let mut plan = FitPlan::on(self.dataset, self.request, recipe, divided.clone())?;
        if self.has_checkpoints {
            plan.keep_checkpoints(Checkpoints::at(checkpoint));
        }
        let key = Key::of(CachedStage::Fit)
            .part("dataset", &self.dataset.digest().to_string())
            .whole("request", self.request)
            .whole("divided", &divided)
            .finish();
        let decoded = Decoded {
            frames: plan.frames_to_decode(),
            passes: match plan.reads_frames() {
                true => plan.passes(),
                false => 0,
            },
        };
        let cache = self.context.cache;
        let model = cache.value(&key, || plan.run(work).map(|fitted| fitted.model))?;
        let divided = Some(divided);
        Ok((Learned { model, divided }, decoded))
    }
}

/// Number of frames that a fit decodes.
struct Decoded {
    /// Number of different frames.
    frames: u64,
    /// Number of times that each frame is decoded, once for each kind of features; 0 for a model that reads no frames.
    passes: u64,
}

/// Rows to predict, ascending: the rows of all phases with needed predictions, and the rows of presses that are repeated on other units.
fn predicted_rows(phase_rows: &PhaseRows<'_>) -> Vec<usize> {
    let phases = phase_rows.predicted_phases();
    let mut rows: Vec<usize> = phases
        .into_iter()
        .flat_map(|kind| phase_rows.rows(kind))
        .chain(phase_rows.of_other_units().iter().copied())
        .collect();
    rows.sort_unstable();
    rows.dedup();
    rows
}
