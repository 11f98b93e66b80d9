//! Provenance of results: the inputs and settings needed to reproduce them.

use std::collections::BTreeMap;

use taceva_dataset::Dataset;
use taceva_models::{Choice, ChosenBy, Model};
use taceva_results::{ModelProvenance, Provenance};

use crate::error::EvaluateError;
use crate::note::Note;
use crate::recordings;
use crate::rows::DataPart;

/// Name of the setting for the seed, in models with random draws.
const SEED: &str = "seed";

/// Provenance of `dataset`.
pub fn of(dataset: &Dataset) -> Provenance {
    let mut provenance = Provenance {
        taceva: env!("CARGO_PKG_VERSION").to_owned(),
        dataset: Some(dataset.digest().to_string()),
        recordings: recordings::provenance(dataset),
        view: dataset.view(),
        traceability: dataset.header().traceability.clone(),
        devices: dataset.header().settings.clone(),
        ..Provenance::default()
    };
    match dataset.recordings() {
        [] => add_recording(&mut provenance, dataset, ""),
        joined => joined.iter().for_each(|own| {
            add_recording(&mut provenance, own.dataset(), &format!("{}/", own.name()));
        }),
    }
    provenance
}

/// Adds the origin of a recording from its header. File names are prefixed with `folder`.
fn add_recording(provenance: &mut Provenance, dataset: &Dataset, folder: &str) {
    let header = dataset.header();
    if !header.presses.is_empty() {
        let digest = dataset.digest().to_string();
        provenance.presses.insert(digest, header.presses.clone());
    }
    if !header.traceability.is_empty() {
        let days = header.days(dataset.table().t_s());
        let day = days.map(|days| *days.end());
        provenance.recorded_on = provenance.recorded_on.max(day);
    }
    let edits = header.seal.history.iter();
    provenance
        .edits
        .extend(edits.map(|edit| format!("{folder}dataset.toml, {edit}")));
}

/// True if the model was fitted on some of the scored samples. Its skill on other samples is then unknown.
pub(crate) fn is_of_seen_samples(provenance: &Provenance) -> bool {
    let is_test = |part: &str| part == DataPart::Test.name();
    let part = provenance.part.as_deref();
    provenance.split.is_some() && part.is_some_and(|part| !is_test(part))
}

/// Provenance of `model`, from its card.
pub fn model(model: &Model) -> Result<ModelProvenance, EvaluateError> {
    let card = model.card();
    let mut settings: BTreeMap<String, String> = card
        .settings
        .iter()
        .filter_map(|word| word.split_once('='))
        .map(|(key, value)| (key.to_owned(), value.to_owned()))
        .collect();
    settings.insert("features".to_owned(), card.features.to_string());
    // A model with random draws has a seed, even if the caller states none.
    let known = taceva_models::find(&card.model).map_or(&[][..], |info| info.settings);
    if let Some(seed) = known.iter().find(|setting| setting.key == SEED) {
        let seed = || seed.default.to_owned();
        settings.entry(SEED.to_owned()).or_insert_with(seed);
    }
    if let Some(name) = card
        .choice
        .setting
        .as_ref()
        .filter(|_| card.choice.by != ChosenBy::Nobody)
    {
        let channels = card.channels.iter().zip(&card.choice.channels);
        let chosen: Vec<String> = channels
            .filter_map(|(channel, choice)| Some(format!("{}:{:.3e}", channel.name, choice.value?)))
            .collect();
        settings.insert(name.clone(), chosen.join(","));
    }
    Ok(ModelProvenance {
        name: card.model.clone(),
        settings,
        digest: model.digest()?,
        fitted_on: card
            .provenance
            .data
            .clone()
            .unwrap_or_else(|| "unknown".to_owned()),
        chosen_by: chosen_by(&card.choice),
        origin: None,
    })
}

/// Description of the setting that a fit chose, and of the criterion; `None` if it chose no setting.
fn chosen_by(choice: &Choice) -> Option<String> {
    let how = match choice.by {
        ChosenBy::Nobody => return None,
        ChosenBy::Validation => "on the validation part",
        ChosenBy::Likelihood => "by the likelihood of the training labels",
        ChosenBy::LeaveOneGroupOut => "with each group of training samples left out in turn",
        ChosenBy::LeaveOneOut => "with each training sample left out in turn",
        ChosenBy::TenFolds => "with each of ten folds of the training samples left out in turn",
    };
    let setting = choice.setting.as_ref()?;
    Some(format!("{setting} {how}"))
}

/// Notes on the chosen settings that the user had left open.
pub fn choices(model: &Model) -> impl Iterator<Item = Note> {
    let card = model.card();
    let features = card.feature_choice.as_ref().map(ToString::to_string);
    let choices = features
        .into_iter()
        .chain(card.auto.as_ref().map(ToString::to_string));
    choices.map(|choice| Note::Chosen { fold: None, choice })
}
