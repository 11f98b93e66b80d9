//! Scenes for a benchmark of studies. Each has one study, with one combination of number of points, number of folds and model.

use std::fmt;
use std::num::NonZeroU32;

use serde::Serialize;
use taceva_acquire::{AcquireError, PlannedScene, SceneText};
use taceva_core::{counted, shown, suggestion};
use taceva_evaluate::EvaluateError;
use taceva_models::ModelSettings;
use toml::{Table, Value};

use crate::error::StudyError;
use crate::models::check_models;
use crate::run::RunSetup;

/// Study of the built-in scenes that is benchmarked by default.
const USUAL: &str = "MagicTac";

/// Values of a benchmark of studies, of which every combination is run.
#[derive(Clone, Debug, PartialEq)]
pub struct StudyGrid {
    /// Name of the study in the scene. `None` chooses `MagicTac`, or the first study if the scene has no `MagicTac`.
    pub study: Option<String>,
    /// Seed of all random draws; `None` keeps the seed of the scene.
    pub seed: Option<u64>,
    /// Number of repetitions of each combination, with consecutive seeds.
    pub seeds: NonZeroU32,
    /// Numbers of contact points in the calibration.
    pub points: Vec<u32>,
    /// Numbers of folds of a cross-validation; `None` for a single test part.
    pub folds: Vec<Option<u32>>,
    /// Names of models. The settings of the scene apply only to the model that the scene names. The split of the scene applies to every model. Other
    /// models have default settings.
    pub models: Vec<String>,
}

/// One combination of number of points, number of folds and model.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct StudyVariant {
    /// Number of contact points in the calibration.
    pub points: u32,
    /// Number of folds of a cross-validation; `None` for a single test part.
    pub folds: Option<u32>,
    /// Name of the model.
    pub model: String,
}

/// Planned scene of one combination.
#[derive(Debug)]
pub struct StudyEntry {
    /// Combination of the scene.
    pub variant: StudyVariant,
    /// Scene with one study and the seed of the first repetition.
    pub scene: PlannedScene,
    /// Number of repetitions, with consecutive seeds.
    pub seeds: NonZeroU32,
}

impl StudyGrid {
    /// Plans the scene in `text` with each combination and the first seed, ordered by points, then folds, then models.
    ///
    /// # Errors
    /// [`StudyError`] for an invalid scene or combination, an unknown study or model, and a scene that does not press on the simulated bench.
    pub fn entries(
        &self,
        text: &SceneText,
        setup: RunSetup<'_>,
    ) -> Result<Vec<StudyEntry>, StudyError> {
        // Errors of the scene itself are reported with its own lines.
        let whole = planned(text.clone(), setup, self.seed)?;
        let drivers = setup.workshop.drivers;
        whole.check_simulated(drivers).map_err(|error| {
            AcquireError::Request(format!(
                "{}: {error}; this benchmark presses only on the simulated bench: use `taceva run` for this scene",
                shown(&text.name)
            ))
        })?;
        let study = self.study_of(&whole)?;
        for name in &self.models {
            let known = setup.models.asked(name, ModelSettings::default());
            known.map_err(EvaluateError::from)?;
        }
        let mut entries = Vec::new();
        for points in &self.points {
            for folds in &self.folds {
                for model in &self.models {
                    let variant = StudyVariant {
                        points: *points,
                        folds: *folds,
                        model: model.clone(),
                    };
                    let text = variant.applied_to(text, study);
                    let scene = planned(text, setup, Some(whole.scene.seed));
                    entries.push(StudyEntry {
                        variant,
                        scene: scene.map_err(unplaced)?,
                        seeds: self.seeds,
                    });
                }
            }
        }
        Ok(entries)
    }

    /// Name of the benchmarked study of `scene`.
    fn study_of<'a>(&self, scene: &'a PlannedScene) -> Result<&'a str, StudyError> {
        let names = scene.studies.iter().map(|study| study.plan.name.as_str());
        let names: Vec<&str> = names.collect();
        let named = |wanted: &str| names.iter().copied().find(|name| *name == wanted);
        let found = match &self.study {
            Some(study) => named(study),
            None => named(USUAL).or(names.first().copied()),
        };
        found.ok_or_else(|| {
            let study = self.study.as_deref().unwrap_or(USUAL);
            StudyError::from(AcquireError::Request(format!(
                "{}: no study is called `{}`: {}",
                shown(&scene.text.name),
                shown(study),
                suggestion(study, &names)
            )))
        })
    }
}

impl StudyEntry {
    /// Plans the scene for repetition number `further`, counted from 0, with the seed of this repetition.
    pub(super) fn repeated(
        &self,
        further: u32,
        setup: RunSetup<'_>,
    ) -> Result<PlannedScene, StudyError> {
        let seed = self.scene.scene.seed.wrapping_add(u64::from(further));
        planned(self.scene.text.clone(), setup, Some(seed)).map_err(unplaced)
    }
}

/// Plans the scene in `text` with `seed` instead of the scene's own seed, and checks the models of the scene.
fn planned(
    text: SceneText,
    setup: RunSetup<'_>,
    seed: Option<u64>,
) -> Result<PlannedScene, StudyError> {
    let scene = PlannedScene::new(text, setup.workshop.drivers, seed)?;
    check_models(&scene, setup.models)?;
    Ok(scene)
}

/// Formats the combination, such as `80 points, 3 folds, ridge`.
impl fmt::Display for StudyVariant {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let points = counted(self.points, "point");
        let folds = self.folds.map(|folds| counted(folds, "fold"));
        let folds = folds.unwrap_or_else(|| "no folds".to_owned());
        write!(f, "{points}, {folds}, {}", shown(&self.model))
    }
}

impl StudyVariant {
    /// Number of points times number of fits. The time of a study is roughly proportional to this product.
    pub(super) fn steps(&self) -> u64 {
        u64::from(self.points) * u64::from(self.folds.unwrap_or(1))
    }

    /// Copy of the valid scene `text` that has only the study `study`, with the points, folds and model of this combination.
    fn applied_to(&self, text: &SceneText, study: &str) -> SceneText {
        let mut scene: Table = toml::from_str(&text.text).expect("the scene was parsed before");
        // The benchmark writes no report, and folds leave no single model to keep.
        scene.remove("report");
        let named =
            |table: &Value, name: &str| table.get("name").and_then(Value::as_str) == Some(name);
        let mut own = None;
        if let Some(studies) = scene.get_mut("study").and_then(Value::as_array_mut) {
            studies.retain(|one| named(one, study));
            own = studies
                .iter_mut()
                .find_map(|one| one.as_table_mut()?.remove("model"));
        }
        let own = own.or(scene.remove("model"));
        let split = own.as_ref().and_then(|own| own.get("split")).cloned();
        let mut model = match own.filter(|own| named(own, &self.model)) {
            Some(Value::Table(own)) => own,
            _ => Table::from_iter([("name".to_owned(), Value::String(self.model.clone()))]),
        };
        model.remove("folds");
        // A split divides the points, whatever the model.
        model.extend(split.map(|split| ("split".to_owned(), split)));
        if let Some(folds) = self.folds {
            model.remove("split");
            model.insert("folds".to_owned(), Value::Integer(i64::from(folds)));
        }
        scene.insert("model".to_owned(), Value::Table(model));
        let protocol = subtable(&mut scene, "protocol");
        if let Some(calibration) = protocol.and_then(|own| subtable(own, "calibration")) {
            let points = Value::Integer(i64::from(self.points));
            calibration.insert("points".to_owned(), points);
        }
        SceneText {
            name: format!("{} with {self}", text.name),
            text: toml::to_string(&scene).expect("a table that was read can be written"),
            folder: text.folder.clone(),
        }
    }
}

/// Table with the key `key` in `table`. Creates it if it is absent.
fn subtable<'a>(table: &'a mut Table, key: &str) -> Option<&'a mut Table> {
    let empty = || Value::Table(Table::new());
    table.entry(key).or_insert_with(empty).as_table_mut()
}

/// `error` without its line, because the line belongs to a text that the user did not write.
fn unplaced(error: StudyError) -> StudyError {
    match error {
        StudyError::Acquire(AcquireError::Scene(mut scene)) => {
            scene.line = None;
            AcquireError::Scene(scene).into()
        }
        other => other,
    }
}
