//! Plan of a fit on a dataset: its channels, its rows, and the frames that it will decode.

use taceva_core::{Channels, counted};
use taceva_dataset::Dataset;
use taceva_models::{
    Checkpoints, ChosenModel, FeatureSpec, ModelEstimator, ModelSettings, OpenFeatures,
};

use super::{FitRequest, Recipe};
use crate::error::EvaluateError;
use crate::features::{kinds, recorded_frames, rows_read};
use crate::plan::Plan;
use crate::rows::{
    DataPart, Divided, Need, chosen_channels, require_samples, seen_channels, usable,
};

/// A request applied to a dataset: its model, channels and rows.
pub struct FitPlan<'a> {
    pub(super) dataset: &'a Dataset,
    pub(super) model: ChosenModel,
    pub(super) estimator: Box<dyn ModelEstimator>,
    /// Settings as the user typed them.
    pub(super) settings: ModelSettings,
    /// Settings of the model only.
    pub(super) of_model: ModelSettings,
    pub(super) features: FeatureSpec,
    pub(super) open: Option<OpenFeatures>,
    /// Finer features that the model also reads, if any.
    pub closer: Option<FeatureSpec>,
    /// Channels to predict.
    pub channels: Channels,
    /// Division of the rows.
    pub divided: Divided,
    /// Rows for the fit.
    pub train: Vec<usize>,
    /// Rows for choosing settings.
    pub validation: Vec<usize>,
    /// Rows whose frames or signals are read: rows of the fit, and earlier rows in their windows.
    pub(crate) read: Vec<usize>,
    /// Group of every row of the dataset. Whole groups are left out to choose settings; `None` to leave out contact points.
    pub(super) groups: Option<Vec<String>>,
    pub(super) left_out: usize,
}

impl<'a> FitPlan<'a> {
    /// Plans `request` on the parts of its split.
    ///
    /// # Errors
    /// [`EvaluateError`] for a request that does not suit the dataset.
    pub fn new(dataset: &'a Dataset, request: &FitRequest) -> Result<FitPlan<'a>, EvaluateError> {
        let recipe = Recipe::of(request)?;
        require_samples(dataset)?;
        let divided = Divided::of(dataset, request.split.as_deref(), request.seed)?;
        FitPlan::on(dataset, request, recipe, divided)
    }

    /// Plans `request` on a dataset that was divided elsewhere.
    pub fn on(
        dataset: &'a Dataset,
        request: &FitRequest,
        recipe: Recipe,
        divided: Divided,
    ) -> Result<FitPlan<'a>, EvaluateError> {
        let Recipe {
            model,
            estimator,
            of_model,
            features,
            by_recording,
            asked,
            open,
            closer,
        } = recipe;
        let model_reads = model.reads_features();
        let mut words = request.settings.words();
        if model_reads && !words.any(|word| word == "input=signals") {
            dataset.require_view()?;
        }
        let (frame, signals) = kinds(dataset);
        let frames = recorded_frames(dataset);
        let features = by_recording.on(features, frames);
        let features = match (model_reads, frame, signals) {
            (true, _, _) => features.on(&asked, frame, signals)?,
            // A model that reads no input accepts any.
            (false, None, Some(info)) => features.of_signals(info),
            (false, _, _) => features,
        };
        let reads_frames = model_reads && features.channels.is_none();
        let mut channels = chosen_channels(dataset, &request.channels)?;
        if request.channels.is_empty() && features.channels.is_none() {
            // Some samples of a run have no frame, such as touches that measure surface height. A model without frames is compared with models that
            // read frames, and no sample has all channels of a run.
            channels = seen_channels(dataset, &channels);
        }
        let need = || Need {
            frame: reads_frames,
            labels: Some(&channels),
        };
        let whole = [
            divided.rows(DataPart::Train),
            divided.rows(DataPart::Validation),
        ];
        let [train, validation] = [&whole[0], &whole[1]].map(|rows| usable(dataset, rows, need()));
        let clusters = dataset.labelled_by().map(|task| task.cluster.as_str());
        let read = [&train[..], &validation].concat();
        let read = match model_reads {
            true => rows_read(dataset, &features, clusters, &read)?,
            false => read,
        };
        let left_out = whole[0].len() + whole[1].len() - train.len() - validation.len();
        let fits = |spec: &FeatureSpec| {
            reads_frames
                && frame
                    .is_some_and(|frame| spec.width <= frame.width && spec.height <= frame.height)
                && estimator.looks_closer([train.len(), spec.shape().len(), channels.len()])
        };
        let closer = closer.map(|(spec, by_recording)| by_recording.on(spec, frames));
        // A grid that the user chose applies to all models.
        let closer = closer.filter(|closer| *closer != features && fits(closer));
        Ok(FitPlan {
            dataset,
            model,
            estimator,
            of_model,
            settings: request.settings.clone(),
            features,
            open: open.filter(|_| model_reads),
            closer,
            channels,
            groups: divided.groups.clone(),
            divided,
            train,
            validation,
            read,
            left_out,
        })
    }

    /// True if frames are decoded; false for a model that reads signals or no input.
    pub fn reads_frames(&self) -> bool {
        self.model.reads_features() && self.features.channels.is_none()
    }

    /// Features of frames or signals. If some settings are still to be chosen, these are the preferred features of the model.
    pub fn features(&self) -> FeatureSpec {
        self.features
    }

    /// Number of kinds of features. Every frame is decoded once for each kind.
    pub fn passes(&self) -> u64 {
        if self.closer.is_some() { 2 } else { 1 }
    }

    /// Number of frames that [`run`](FitPlan::run) decodes.
    pub fn frames_to_decode(&self) -> u64 {
        if self.reads_frames() {
            self.passes() * self.read.len() as u64
        } else {
            0
        }
    }

    /// Adds the steps of [`run`](FitPlan::run) to the plan.
    pub fn explain(&self, plan: &mut Plan) {
        let rows = self.read.len();
        if self.model.reads_features() {
            let features = match self.open {
                Some(_) => format!("{} and other candidates, chosen in the fit", self.features),
                None => match self.closer {
                    Some(closer) => format!("{} and {closer}", self.features),
                    None => self.features.to_string(),
                },
            };
            match self.reads_frames() {
                true => plan.step(
                    "decode",
                    format!("{} to features {features}", counted(rows, "frame")),
                ),
                false => plan.step("read", format!("{features} of {}", counted(rows, "sample"))),
            }
        }
        let names: Vec<&str> = self.channels.iter().map(|channel| channel.name()).collect();
        plan.step(
            "fit",
            format!(
                "{} of {} on {}, settings chosen on {}",
                self.model.name(),
                names.join(", "),
                counted(self.train.len(), "training sample"),
                match self.validation.len() {
                    0 => "the training part, leaving groups out".to_owned(),
                    count => counted(count, "validation sample"),
                }
            ),
        );
    }

    /// Sets groups that are left out as a whole to choose settings. `groups` contains one name for every row of the dataset.
    pub(crate) fn leave_out_groups(&mut self, groups: &[String]) {
        self.groups = Some(groups.to_vec());
    }

    /// Stores checkpoints of a long training in `checkpoints`, and resumes from an existing checkpoint.
    pub fn keep_checkpoints(&mut self, checkpoints: Checkpoints) {
        self.estimator.keep_checkpoints(checkpoints);
    }
}
