//! Varied settings.

use std::collections::BTreeMap;

use super::ModelEntry;
use super::model_entry::word;
use super::place::FilePlace;
use crate::error::SweepError;

/// Converts varied settings to the text that users type, for each of their values.
pub(super) fn vary(
    written: BTreeMap<String, Vec<toml::Value>>,
    models: &[ModelEntry],
    place: FilePlace<'_>,
) -> Result<BTreeMap<String, Vec<String>>, SweepError> {
    let mut vary = BTreeMap::new();
    for (key, values) in written {
        if let Some(model) = models.iter().find(|model| model.set.contains_key(&key)) {
            return Err(place.wrong(
                &key,
                format!(
                    "`{key}` is both varied and set by the model {}; keep only one",
                    model.name
                ),
            ));
        }
        let texts = values.iter().map(|value| {
            word(value).ok_or_else(|| {
                place.wrong(
                    &key,
                    format!("`{key}`: expected strings, numbers, true or false"),
                )
            })
        });
        let texts: Vec<String> = texts.collect::<Result<_, _>>()?;
        place.check_distinct(&key, &texts)?;
        vary.insert(key, texts);
    }
    Ok(vary)
}
