//! Leaving one recording out after the other: each is predicted by a model that was fitted on all others.

use taceva_dataset::{Dataset, Digest, JoinedRecording};
use taceva_models::{Fractions, Split, SplitError, SplitKind, SplitSpec};

use super::request::{EvaluateRequest, Evaluated};
use super::scores::{Behind, score};
use crate::assess::FitFacts;
use crate::error::EvaluateError;
use crate::fit::{FitPlan, FitRequest, Recipe};
use crate::note::Note;
use crate::plan::Plan;
use crate::predict::{self, Predicted, Target};
use crate::rows::{DataPart, Divided};
use crate::work::Work;
use taceva_results::ModelProvenance;

/// A division a recording: that is the test part, and the samples of all others are learnt from.
pub(crate) struct Folds<'a> {
    dataset: &'a Dataset,
    spec: SplitSpec,
    seed: u64,
}

/// The folds that `request` asks for; `None` where it asks for one division.
///
/// # Errors
/// [`EvaluateError::Split`] if there is one recording, or the split means nothing.
pub(crate) fn of<'a>(
    dataset: &'a Dataset,
    request: &FitRequest,
) -> Result<Option<Folds<'a>>, EvaluateError> {
    let spec = request.split.as_deref().map(str::parse::<SplitSpec>);
    let Some(spec) = spec.transpose()? else {
        return Ok(None);
    };
    if spec.kind != SplitKind::LeaveOneRecordingOut {
        return Ok(None);
    }
    if dataset.recordings().is_empty() {
        return Err(SplitError::NoRecordings {
            split: "leave-one-recording-out",
        }
        .into());
    }
    Ok(Some(Folds {
        dataset,
        spec,
        seed: request.seed,
    }))
}

impl<'a> Folds<'a> {
    /// Refuses a part: what is scored is every sample, by a model that has not seen its recording.
    pub(crate) fn refuse_part(&self, request: &EvaluateRequest) -> Result<(), EvaluateError> {
        match request.part {
            None => Ok(()),
            Some(part) => Err(EvaluateError::Request(format!(
                "part `{}`: leave-one-recording-out scores every sample, each by a model that has not seen its recording; leave --part out",
                part.name()
            ))),
        }
    }

    /// Says what is fitted, once for all folds.
    pub(super) fn explain(&self, plan: &mut Plan) {
        let count = self.dataset.recordings().len();
        plan.step(
            "leave out",
            format!("each of {count} recordings in turn: {count} models; of the first:"),
        );
    }

    /// The fit that leaves the first recording out.
    pub(super) fn first(&self, request: &FitRequest) -> Result<FitPlan<'a>, EvaluateError> {
        self.plan(request, &self.dataset.recordings()[0])
    }

    /// The fit of each fold.
    pub(crate) fn plans(
        &self,
        request: &FitRequest,
    ) -> impl Iterator<Item = Result<FitPlan<'a>, EvaluateError>> {
        let left_out = self.dataset.recordings().iter();
        left_out.map(move |left_out| self.plan(request, left_out))
    }

    /// Fits and predicts fold by fold, and scores all predictions together.
    pub(super) fn evaluate(
        &self,
        (request, fit): (&EvaluateRequest, &FitRequest),
        work: Work<'_>,
    ) -> Result<Evaluated, EvaluateError> {
        self.refuse_part(request)?;
        let dataset = self.dataset;
        let mut models = Vec::new();
        let mut predicted: Option<Predicted> = None;
        let mut rows = Vec::new();
        let (mut frames_decoded, mut unlearnt, mut unpredicted) = (0, 0, 0);
        for left_out in dataset.recordings() {
            let fitted = self.plan(fit, left_out)?.run(work)?;
            let model = &fitted.model;
            let reads = model.reads_frames();
            let target = Target::of(dataset, Some(fitted.divided), None, reads)?;
            let own = predict::predict_target(dataset, model, &target, work)?;
            frames_decoded += fitted.frames_decoded;
            unlearnt += fitted.left_out;
            unpredicted += target.left_out;
            rows.extend(target.rows);
            models.push((left_out.name(), Behind::of(model)?));
            predicted = Some(match predicted {
                None => own,
                Some(before) => before.followed_by(own)?,
            });
        }
        let predicted = predicted.expect("at least two recordings were joined");
        let target = Target {
            part: DataPart::Test,
            rows,
            divided: Some(self.divided()),
            left_out: unpredicted,
        };
        let fit = FitFacts {
            frames_decoded,
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
            (&target, &predicted),
            work.jobs,
        )?;
        let manifest = self.divided().manifest(dataset.table())?;
        Ok(Evaluated {
            manifest: Some(manifest),
            ..scored
        })
    }

    fn plan(
        &self,
        request: &FitRequest,
        left_out: &JoinedRecording,
    ) -> Result<FitPlan<'a>, EvaluateError> {
        let dataset = self.dataset;
        let rows = dataset.all_rows();
        let others: Vec<usize> = rows
            .into_iter()
            .filter(|row| !left_out.rows().contains(row))
            .collect();
        let [train, validation, _] = self.spec.fractions.shares();
        let fractions = Fractions::new(train, validation, 0.0)?;
        let mut divided = Divided::within_default(dataset, &others, fractions, self.seed)?;
        divided.split.test = left_out.rows().collect();
        divided.split.left_out.clear();
        divided.spec = self.spec.clone();
        FitPlan::on(dataset, request, Recipe::of(request)?, divided)
    }

    /// Of all folds together: every sample is tested on.
    fn divided(&self) -> Divided {
        let count = self.dataset.recordings().len();
        let note = format!(
            "each of {count} recordings was predicted by a model that was fitted on the other {}; skill is measured by the mean of truth, because \
             these {count} models have no constant in common",
            count - 1
        );
        Divided {
            spec: self.spec.clone(),
            seed: self.seed,
            split: Split {
                test: self.dataset.all_rows(),
                note: Some(note),
                ..Split::default()
            },
        }
    }
}

/// What a result says of the models of all folds: what they have in common, and the digest of their digests.
fn together(dataset: &Dataset, models: Vec<(&str, Behind)>) -> Behind {
    let mut digests = String::new();
    let mut settings = models[0].1.model.settings.clone();
    let mut notes = Vec::new();
    for (_, behind) in &models {
        digests.push_str(&behind.model.digest);
        settings.retain(|key, value| behind.model.settings.get(key) == Some(value));
    }
    let name = models[0].1.model.name.clone();
    for (left_out, behind) in models {
        notes.extend(behind.notes.into_iter().map(|note| match note {
            Note::Chosen { choice, .. } => Note::Chosen {
                fold: Some(left_out.to_owned()),
                choice,
            },
            note => note,
        }));
    }
    Behind {
        model: ModelProvenance {
            name,
            settings,
            digest: Digest::of(digests.as_bytes()).to_string(),
            fitted_on: dataset.digest().to_string(),
            origin: None,
        },
        notes,
        fit: FitFacts::default(),
    }
}
