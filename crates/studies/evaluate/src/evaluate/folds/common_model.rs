//! Combines the models of a cross-validation in one description.

use taceva_dataset::{Dataset, Digest};
use taceva_results::ModelProvenance;

use crate::assess::FitFacts;
use crate::evaluate::scores::Behind;
use crate::note::Note;

/// Combines the models of all folds: their common settings, and a digest of their digests.
pub(super) fn together(dataset: &Dataset, models: Vec<(&str, Behind)>) -> Behind {
    let mut digests = String::new();
    let mut settings = models[0].1.model.settings.clone();
    let mut chosen_by = models[0].1.model.chosen_by.clone();
    let mut notes = Vec::new();
    for (_, behind) in &models {
        chosen_by = chosen_by.filter(|by| behind.model.chosen_by.as_ref() == Some(by));
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
            chosen_by,
            origin: None,
        },
        notes,
        fit: FitFacts::default(),
    }
}

impl Behind {
    /// Description of the models of all folds of a cross-validation of `dataset`, in the order of the folds.
    pub fn of_folds(dataset: &Dataset, models: Vec<Behind>) -> Behind {
        let names: Vec<String> = (1..=models.len()).map(fold_name).collect();
        let named = names.iter().map(String::as_str).zip(models);
        together(dataset, named.collect())
    }
}

/// Name of the fold with this number, counted from 1.
pub(super) fn fold_name(number: usize) -> String {
    format!("fold {number}")
}
