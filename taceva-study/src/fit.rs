//! The stage that learns: a dataset and a request in, a model out.

mod features;

use std::collections::BTreeMap;

use taceva_core::{Channels, Features, FrameInfo, PixelFormat, Targets, TrainingSet};
use taceva_dataset::{Dataset, Source};
use taceva_models::{
    Checkpoints, ChosenModel, FeatureSpec, FitInput, Model, ModelEstimator, OpenFeatures,
    Provenance, Settings, SplitCard, SplitManifest,
};

use crate::error::StudyError;
use crate::features::{blank, extract, extractor};
use crate::plan::Plan;
use crate::rows::{Divided, Need, Part, chosen_channels, require_samples, seen_channels, usable};
use crate::work::Work;

/// What to fit.
#[derive(Clone, Debug)]
pub struct FitRequest {
    /// The model.
    pub model: ChosenModel,
    /// Settings of its features and of itself.
    pub settings: Settings,
    /// Channels by name; empty for all.
    pub channels: Vec<String>,
    /// The split as people write it; by point where points have repeats, else random, if `None`.
    pub split: Option<String>,
    /// The seed of everything that is drawn.
    pub seed: u64,
}

impl FitRequest {
    /// Whether its model and settings can be meant; no data is looked at.
    ///
    /// # Errors
    /// [`StudyError`] for a model that does not exist, or a setting that it does not have.
    pub fn check(&self) -> Result<(), StudyError> {
        Recipe::of(self).map(drop)
    }

    /// The same with `seed` for whatever the model draws; division and everything else stays.
    pub(crate) fn with_seed(self, seed: u64) -> Result<FitRequest, StudyError> {
        const SEED: &str = "seed";
        if !self.model.setting_keys().contains(&SEED) {
            return Err(StudyError::Request(format!(
                "the model {} draws nothing: with every seed it would be the same, so run it without --seeds",
                self.model.name()
            )));
        }
        let others = self.settings.words();
        let others = others.filter(|word| !word.starts_with("seed="));
        let words: Vec<String> = others.chain([format!("{SEED}={seed}")]).collect();
        Ok(FitRequest {
            settings: Settings::parse(words.iter().map(String::as_str))?,
            ..self
        })
    }
}

/// A fitted model and how its dataset was divided.
#[derive(Debug)]
pub struct Fitted {
    /// The model.
    pub model: Model,
    /// How the dataset was divided.
    pub divided: Divided,
    /// The same as a record.
    pub manifest: SplitManifest,
    /// Frames decoded for it.
    pub frames_decoded: u64,
    /// Samples of the training and validation parts that lack a label or a frame.
    pub left_out: usize,
}

/// What a request asks for, before any data is looked at.
pub(crate) struct Recipe {
    model: ChosenModel,
    estimator: Box<dyn ModelEstimator>,
    of_model: Settings,
    features: FeatureSpec,
    /// What of the features is to be chosen.
    open: Option<OpenFeatures>,
}

impl Recipe {
    /// Reads the settings of the model and of its features.
    pub(crate) fn of(request: &FitRequest) -> Result<Recipe, StudyError> {
        let model = &request.model;
        let (open, settings) = match OpenFeatures::of(&request.settings) {
            Some((open, settings)) => (Some(open), settings),
            None => (None, request.settings.clone()),
        };
        let (of_features, of_model) = settings.partition(FeatureSpec::SETTINGS);
        let mut known = model.setting_keys();
        known.extend(FeatureSpec::SETTINGS.iter().map(|setting| setting.key));
        request.settings.check_names(&known)?;
        Ok(Recipe {
            model: model.clone(),
            estimator: model.estimator(&of_model)?,
            of_model,
            features: model.features().changed_by(&of_features)?,
            open,
        })
    }
}

/// Features of the training part and then of the validation part, what they are, and the kind of frame they are of.
struct Seen {
    spec: FeatureSpec,
    features: Features,
    frame: FrameInfo,
}

/// A request made definite.
pub(crate) struct FitPlan<'a> {
    dataset: &'a Dataset,
    model: ChosenModel,
    estimator: Box<dyn ModelEstimator>,
    /// As typed.
    settings: Settings,
    /// Those of them that are the model's own.
    of_model: Settings,
    features: FeatureSpec,
    open: Option<OpenFeatures>,
    pub(crate) channels: Channels,
    pub(crate) divided: Divided,
    pub(crate) train: Vec<usize>,
    pub(crate) validation: Vec<usize>,
    left_out: usize,
}

impl<'a> FitPlan<'a> {
    pub(crate) fn new(
        dataset: &'a Dataset,
        request: &FitRequest,
    ) -> Result<FitPlan<'a>, StudyError> {
        let recipe = Recipe::of(request)?;
        require_samples(dataset)?;
        let divided = Divided::of(dataset, request.split.as_deref(), request.seed)?;
        FitPlan::on(dataset, request, recipe, divided)
    }

    /// The same of a dataset that was divided elsewhere.
    pub(crate) fn on(
        dataset: &'a Dataset,
        request: &FitRequest,
        recipe: Recipe,
        divided: Divided,
    ) -> Result<FitPlan<'a>, StudyError> {
        let Recipe {
            model,
            estimator,
            of_model,
            features,
            open,
        } = recipe;
        let model_reads = model.reads_features();
        let mut channels = chosen_channels(dataset, &request.channels)?;
        if request.channels.is_empty() {
            // Of a recording of a run: heights of the surface are met without a picture. A model that looks at no picture is compared with
            // those that do, and no sample carries all channels of a run.
            channels = seen_channels(dataset, &channels);
        }
        let need = || Need {
            frame: model_reads,
            labels: Some(&channels),
        };
        let whole = [divided.rows(Part::Train), divided.rows(Part::Validation)];
        let [train, validation] = [&whole[0], &whole[1]].map(|rows| usable(dataset, rows, need()));
        let left_out = whole[0].len() + whole[1].len() - train.len() - validation.len();
        Ok(FitPlan {
            dataset,
            model,
            estimator,
            of_model,
            settings: request.settings.clone(),
            features,
            open: open.filter(|_| model_reads),
            channels,
            divided,
            train,
            validation,
            left_out,
        })
    }

    pub(crate) fn reads_frames(&self) -> bool {
        self.model.reads_features()
    }

    /// What is taken of frames; where some of it is open, what the model asks for.
    pub(crate) fn features(&self) -> FeatureSpec {
        self.features
    }

    /// How many frames [`run`](FitPlan::run) decodes.
    pub(crate) fn frames_to_decode(&self) -> u64 {
        if self.reads_frames() {
            (self.train.len() + self.validation.len()) as u64
        } else {
            0
        }
    }

    /// Says what [`run`](FitPlan::run) would do.
    pub(crate) fn explain(&self, plan: &mut Plan) {
        let rows = self.train.len() + self.validation.len();
        if self.reads_frames() {
            let features = match self.open {
                Some(_) => format!("{} and others, of which some are chosen", self.features),
                None => self.features.to_string(),
            };
            plan.step("decode", format!("{rows} frames to features {features}"));
        }
        let names: Vec<&str> = self.channels.iter().map(|channel| channel.name()).collect();
        plan.step(
            "fit",
            format!(
                "{} of {} on {} training samples, settings chosen on {}",
                self.model.name(),
                names.join(", "),
                self.train.len(),
                match self.validation.len() {
                    0 => "the training part, leaving groups out".to_owned(),
                    count => format!("{count} validation samples"),
                }
            ),
        );
    }

    /// From now on puts a long training aside, and goes on from what is found there.
    pub(crate) fn put_aside(&mut self, checkpoints: Checkpoints) {
        self.estimator.keep_checkpoints(checkpoints);
    }

    pub(crate) fn run(mut self, work: Work<'_>) -> Result<Fitted, StudyError> {
        let choice = match self.open {
            Some(open) => Some(self.choose_features(open, work)?),
            None => None,
        };
        let whole: Vec<usize> = (0..self.train.len()).collect();
        let seen = self.see(self.features, work)?;
        let learnt = self.learn(&*self.estimator, seen, &whole, work)?;
        let model = match choice {
            Some(choice) => learnt.with_features_chosen(choice),
            None => learnt,
        };
        let frames_decoded = self.frames_to_decode();
        let manifest = self.divided.manifest(self.dataset.table())?;
        Ok(Fitted {
            model,
            manifest,
            divided: self.divided,
            frames_decoded,
            left_out: self.left_out,
        })
    }

    /// What `spec` takes of the frames of the training part, then of the validation part.
    fn see(&self, spec: FeatureSpec, work: Work<'_>) -> Result<Seen, StudyError> {
        // Of both parts whatever is learnt from: what is kept of features is found by its rows.
        let rows = [&self.train[..], &self.validation].concat();
        if !self.reads_frames() {
            return Ok(Seen {
                spec,
                features: blank(spec.shape(), rows.len())?,
                frame: self.any_frame(),
            });
        }
        let extractor = extractor(self.dataset, spec)?;
        Ok(Seen {
            spec,
            features: extract(self.dataset, &extractor, &rows, work)?,
            frame: extractor.frame_info(),
        })
    }

    /// A model of what was `seen`, fitted on the rows at `positions` of the training part and on the validation part.
    fn learn(
        &self,
        estimator: &dyn ModelEstimator,
        seen: Seen,
        positions: &[usize],
        work: Work<'_>,
    ) -> Result<Model, StudyError> {
        let Seen {
            spec,
            features: seen,
            frame,
        } = seen;
        let train: Vec<usize> = positions.iter().map(|&at| self.train[at]).collect();
        let train_features = seen.select(positions);
        let held: Vec<usize> = (self.train.len()..seen.samples()).collect();
        let held_features = seen.select(&held);
        drop(seen);
        let (train_labels, held_labels) = (self.labels(&train), self.labels(&self.validation));
        let groups = groups(self.dataset, &train);
        let set = |features, values, groups| TrainingSet {
            features,
            targets: Targets {
                channels: &self.channels,
                values,
            },
            groups,
        };
        let input = FitInput {
            estimator,
            settings: &self.settings,
            features: spec,
            frame,
            training: set(&train_features, &train_labels, groups.as_deref()),
            validation: (!self.validation.is_empty())
                .then(|| set(&held_features, &held_labels, None)),
            provenance: self.provenance(),
        };
        Ok(Model::fit(input, work.progress)?)
    }

    fn labels(&self, rows: &[usize]) -> Vec<f64> {
        let table = self.dataset.table();
        let positions: Vec<usize> = self
            .channels
            .iter()
            .filter_map(|channel| table.channels().position(channel.name()))
            .collect();
        let value = |row: usize, position: usize| {
            table
                .truth(position)
                .get(row)
                .expect("rows without a label were left out")
        };
        rows.iter()
            .flat_map(|&row| positions.iter().map(move |&position| (row, position)))
            .map(|(row, position)| value(row, position))
            .collect()
    }

    /// What the card says of frames where none is looked at.
    fn any_frame(&self) -> FrameInfo {
        let unseen = FrameInfo {
            width: 1,
            height: 1,
            format: PixelFormat::Gray8,
        };
        self.dataset
            .header()
            .frames
            .as_ref()
            .map_or(unseen, |frames| frames.info)
    }

    fn provenance(&self) -> Provenance {
        let source = match self.dataset.header().source {
            Source::Recorded => taceva_models::Source::Recorded,
            Source::Simulated => taceva_models::Source::Simulated,
            Source::Synthetic => taceva_models::Source::Synthetic,
        };
        Provenance {
            data: Some(self.dataset.digest().to_string()),
            source,
            split: Some(SplitCard {
                split: self.divided.spec.to_string(),
                seed: self.divided.seed,
            }),
            notes: self.divided.split.note.iter().cloned().collect(),
        }
    }
}

/// Fits a model on the training part of `dataset`.
///
/// A long training is put aside in `checkpoints` and goes on from there; models that are fitted in one go put nothing aside.
///
/// # Errors
/// [`StudyError`] if the request cannot be meant, the dataset cannot be read, or nothing can be learnt from it.
pub fn fit(
    dataset: &Dataset,
    request: &FitRequest,
    checkpoints: Option<Checkpoints>,
    work: Work<'_>,
) -> Result<Fitted, StudyError> {
    let mut plan = FitPlan::new(dataset, request)?;
    if let Some(checkpoints) = checkpoints {
        plan.put_aside(checkpoints);
    }
    plan.run(work)
}

/// A number a row for its contact location, if every row has one.
fn groups(dataset: &Dataset, rows: &[usize]) -> Option<Vec<u32>> {
    let points = dataset.table().point_id();
    let mut numbers: BTreeMap<&str, u32> = BTreeMap::new();
    rows.iter()
        .map(|&row| {
            let point = points[row].as_deref()?;
            let next = u32::try_from(numbers.len()).ok()?;
            Some(*numbers.entry(point).or_insert(next))
        })
        .collect()
}
