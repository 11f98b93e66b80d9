//! Amount of data that fitting and evaluating will read and store, computed before they begin.

use taceva_dataset::Dataset;
use taceva_models::FeatureSpec;

use crate::cache::ONE_MAX;
use crate::error::EvaluateError;
use crate::evaluate::{EvaluateRequest, ModelChoice, folds};
use crate::fit::{FitPlan, FitRequest};
use crate::predict::Target;
use crate::rows::DataPart;

/// Number of bytes per stored feature.
const FEATURE_BYTES: u64 = 4;

/// Number of frames to decode, and number of bytes to store if there is a cache.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Effort {
    /// Rows whose frames are decoded, one part after another.
    pub rows: Vec<usize>,
    /// Upper limit of the stored features, in bytes. If features are still to be chosen, each trial stores additional features.
    pub kept_bytes: u64,
}

impl Effort {
    /// Frames that [`fit`](crate::fit) decodes, and bytes that it stores.
    ///
    /// # Errors
    /// [`EvaluateError`] if the request is not valid.
    pub fn of_fit(dataset: &Dataset, request: &FitRequest) -> Result<Effort, EvaluateError> {
        let Some(folds) = folds::asked(dataset, request)? else {
            return Ok(Effort::of_plan(&FitPlan::new(dataset, request)?));
        };
        Effort::of_fold(dataset, folds.first(request)?, None)
    }

    /// Frames that [`evaluate`](crate::evaluate) decodes, and bytes that it stores.
    ///
    /// # Errors
    /// [`EvaluateError`] if the request is not valid.
    pub fn of_evaluation(
        dataset: &Dataset,
        request: &EvaluateRequest,
    ) -> Result<Effort, EvaluateError> {
        match &request.model {
            ModelChoice::Fit(fit) => {
                if let Some(folds) = folds::of(dataset, fit, request.part)? {
                    folds.refuse_part(request)?;
                    // Each fold covers all samples, and features are computed once for all folds.
                    return Effort::of_fold(dataset, folds.first(fit)?, None);
                }
                Effort::of_fold(dataset, FitPlan::new(dataset, fit)?, request.part)
            }
            ModelChoice::Fitted(model) => {
                let target = Target::new(dataset, model, request.part)?;
                let spec = &model.card().features;
                Ok(Effort::of_rows(target.rows, *spec, model.reads_frames()))
            }
        }
    }

    /// Frames and bytes of one fit, and of predicting `part` with the fitted model.
    fn of_fold(
        dataset: &Dataset,
        plan: FitPlan<'_>,
        part: Option<DataPart>,
    ) -> Result<Effort, EvaluateError> {
        let (reads, spec) = (plan.reads_frames(), plan.features());
        let learning = Effort::of_plan(&plan);
        let target = Target::of(dataset, Some(plan.divided), part, reads)?;
        Ok(learning.and(Effort::of_rows(target.rows, spec, reads)))
    }

    fn of_plan(plan: &FitPlan<'_>) -> Effort {
        let rows = [&plan.train[..], &plan.validation].concat();
        let closer = plan
            .closer
            .map(|spec| Effort::of_rows(rows.clone(), spec, true));
        let own = Effort::of_rows(rows, plan.features(), plan.reads_frames());
        own.and(closer.unwrap_or_default())
    }

    fn of_rows(rows: Vec<usize>, spec: FeatureSpec, reads_frames: bool) -> Effort {
        if !reads_frames {
            return Effort::default();
        }
        let bytes = rows.len() as u64 * spec.shape().len() as u64 * FEATURE_BYTES;
        Effort {
            rows,
            // Larger sets are not stored.
            kept_bytes: if bytes > ONE_MAX { 0 } else { bytes },
        }
    }

    fn and(mut self, other: Effort) -> Effort {
        self.rows.extend(other.rows);
        self.kept_bytes += other.kept_bytes;
        self
    }
}
