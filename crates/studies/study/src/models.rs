//! Models of a scene: the models of its studies, and the classifier of gratings.

use taceva_acquire::{PlannedScene, PlannedStudy};
use taceva_core::shown;
use taceva_evaluate::{EvaluateError, FitRequest, Recipe};
use taceva_models::{Models, SplitError, SplitKind, SplitSpec};
use taceva_protocol::{ModelSpec, PhaseKind, SceneProblem};

use crate::classifier::SpacingClassifier;
use crate::error::StudyError;
use crate::settings::settings_of;

/// Checks before a run that every model of the scene is known and has valid settings.
///
/// [`PlannedScene::new`] does not make this check, so that programs without these models can read the plan.
///
/// # Errors
/// [`AcquireError::Scene`](taceva_acquire::AcquireError::Scene) with the line.
pub fn check_models(scene: &PlannedScene, models: &Models) -> Result<(), StudyError> {
    for planned in &scene.studies {
        let plan = &planned.plan;
        // Changes of pose have a fit of their own.
        let is_fitted = !plan.fits.is_empty() || plan.phases.contains(&PhaseKind::Pose);
        let (Some(model), true) = (&planned.study.model, is_fitted) else {
            continue;
        };
        check_split(scene, planned, model)?;
        let request = fit_request(planned, scene.scene.seed, models);
        if let (Some(name), Some(request)) = (&model.name, request) {
            let refused = |error: EvaluateError| {
                if scene.is_model_typed {
                    return StudyError::from(error);
                }
                let problem = SceneProblem::Contradiction(error.to_string());
                scene.text.error(name.at(), problem).into()
            };
            let (request, recipe) = request
                .and_then(|request| Recipe::of(&request).map(|recipe| (request, recipe)))
                .map_err(refused)?;
            if let Some(seed) = scene.seeds.first() {
                request.with_seed(*seed)?;
            }
            check_kept(
                scene,
                planned,
                &format!("model `{}`", name.value),
                recipe.cells(),
            )?;
        }
    }
    let classifier = classifier(scene, models)?;
    let pressed_on_boards =
        |planned: &&PlannedStudy| planned.plan.phases.contains(&PhaseKind::Gratings);
    for planned in scene.studies.iter().filter(pressed_on_boards) {
        check_kept(
            scene,
            planned,
            "the classifier of gratings",
            classifier.cells(),
        )?;
    }
    Ok(())
}

/// Rejects, before the first press, a split that cannot divide the samples of the study.
fn check_split(
    scene: &PlannedScene,
    planned: &PlannedStudy,
    model: &ModelSpec,
) -> Result<(), StudyError> {
    let Some(split) = &model.split else {
        return Ok(());
    };
    let refused = |problem: String| {
        let problem = SceneProblem::Contradiction(problem);
        StudyError::from(scene.text.error(split.at(), problem))
    };
    let spec: SplitSpec = split
        .value
        .parse()
        .map_err(|error: SplitError| refused(format!("`split`: {error}")))?;
    if matches!(
        spec.kind,
        SplitKind::Folds(_) | SplitKind::LeaveOneRecordingOut
    ) {
        return Err(refused(format!(
            "`split` is `{}`, which fits several models: use `folds` instead",
            shown(&split.value)
        )));
    }
    let [.., test] = spec.fractions.shares();
    if test <= 0.0 || spec.kind == SplitKind::All {
        return Err(refused(format!(
            "`split` is `{}`, which leaves nothing to score: expected a test share above 0, such as `by-point 40/10/50`",
            shown(&split.value)
        )));
    }
    if planned.study.sensor.dataset.is_none() && spec.kind != SplitKind::ByPoint {
        return Err(refused(format!(
            "`split` is `{}`, but presses at one contact point must be in one part: expected `by-point`, with shares such as `by-point 40/10/50`",
            shown(&split.value)
        )));
    }
    Ok(())
}

/// Rejects, before the first press, stored frames with fewer pixels along x or y than `cells`, the grid that the model `who` reads.
fn check_kept(
    scene: &PlannedScene,
    planned: &PlannedStudy,
    who: &str,
    cells: Option<[u32; 2]>,
) -> Result<(), StudyError> {
    let kept = planned
        .study
        .frames
        .filter(|_| planned.plan.cost.frames > 0);
    let (Some(kept), Some(cells)) = (kept, cells) else {
        return Ok(());
    };
    if kept.value.holds(cells) {
        return Ok(());
    }
    let [least_width, least_height] = cells;
    let problem = SceneProblem::FramesTooSmall {
        found: kept.value,
        who: format!("{who} of study `{}`", planned.plan.name),
        least_width,
        least_height,
    };
    Err(scene.text.error(kept.at(), problem).into())
}

/// Creates the classifier of grating spacings that the scene requests.
///
/// # Errors
/// [`AcquireError::Scene`](taceva_acquire::AcquireError::Scene) with the line of an unknown setting or model.
pub(crate) fn classifier(
    scene: &PlannedScene,
    models: &Models,
) -> Result<SpacingClassifier, StudyError> {
    let gratings = &scene.scene.protocol.gratings;
    SpacingClassifier::of(gratings, models).map_err(|error| {
        let problem = SceneProblem::Contradiction(error.to_string());
        scene.text.error(gratings.set.at(), problem).into()
    })
}

/// Request to fit the model of a study; `None` if the scene fits no model. Samples of one contact point stay in one part.
///
/// The split of the samples uses `seed`, the seed of the scene. Random draws of a model use the seed in the model's own settings.
pub(crate) fn fit_request(
    planned: &PlannedStudy,
    seed: u64,
    models: &Models,
) -> Option<Result<FitRequest, EvaluateError>> {
    let model = planned.study.model.as_ref()?;
    let name = model.name.as_ref()?;
    let split = model.split.as_ref().map(|split| split.value.clone());
    let request = || {
        let (model, settings) = models.asked(&name.value, settings_of(&model.set)?)?;
        Ok(FitRequest {
            model,
            settings,
            channels: planned.plan.channels.clone(),
            split,
            seed,
        })
    };
    Some(request())
}

/// Number of folds of a cross-validation by contact points; `None` if the scene asks for none.
pub(crate) fn folds(planned: &PlannedStudy) -> Option<usize> {
    let folds = planned.study.model.as_ref()?.folds.as_ref()?;
    usize::try_from(folds.value).ok()
}

/// File of the fitted model that the scene names, if any, relative to the folder of the scene.
pub(crate) fn model_file(planned: &PlannedStudy) -> Option<&str> {
    let model = planned.study.model.as_ref()?;
    Some(model.file.as_ref()?.value.as_str())
}
