//! What a reader of scores must know of the samples and the model behind them.

use std::collections::BTreeSet;

use taceva_dataset::Dataset;

use crate::predict::Target;
use crate::provenance::ModelProvenance;
use crate::rows::DataPart;

/// A note that scores are of samples that the model was fitted on.
pub(super) fn seen_note(target: &Target) -> Option<String> {
    let divided = target.divided.as_ref()?;
    let is_seen = match target.part {
        DataPart::Train | DataPart::Validation | DataPart::All => true,
        DataPart::Test => false,
    };
    (is_seen && !divided.rows(DataPart::Train).is_empty()).then(|| {
        format!(
            "scored on the part `{}`, which the model has seen: this is no test",
            target.part.name()
        )
    })
}

/// A note that pictures of the test part are, byte for byte, among those that the model was fitted on.
pub(super) fn copies_note(dataset: &Dataset, target: &Target) -> Option<String> {
    let divided = target.divided.as_ref()?;
    if target.part != DataPart::Test {
        return None;
    }
    let frames = dataset.table().frames();
    let digest = |row: &usize| Some(frames[*row].as_ref()?.digest);
    let parts = [DataPart::Train, DataPart::Validation].map(|part| divided.rows(part));
    let seen: BTreeSet<_> = parts.iter().flatten().filter_map(digest).collect();
    let tested = target.rows.iter().filter_map(digest);
    let copies = tested.filter(|digest| seen.contains(digest)).count();
    (copies > 0).then(|| {
        format!(
            "{copies} of {} pictures of the test part are, byte for byte, also fitted on: the scores flatter (taceva check, TAC002 and TAC007)",
            target.rows.len()
        )
    })
}

/// A note that the model was fitted before rows were added, so that the parts named here are larger than those it was fitted on.
pub(super) fn stage_note(dataset: &Dataset, fitted_on: &str) -> Option<String> {
    let mut stages = dataset.header().stages();
    let (_, rows) = stages.find(|(digest, _)| digest.to_string() == fitted_on)?;
    let now = dataset.header().table.rows;
    (rows < now).then(|| {
        format!("the model was fitted when the dataset had {rows} of its {now} samples; the parts are those of now")
    })
}

/// A note that a model was fitted on other data, of which nobody can say whether it held these samples too.
pub(super) fn elsewhere_note(target: &Target, model: &ModelProvenance) -> Option<String> {
    let is_known = target.divided.is_some() || model.origin.is_some();
    (!is_known).then(|| {
        format!(
            "every sample is scored, because the model was fitted on other data, {}; samples that both hold, as an export or a second import of one recording does, are not distinguished",
            model.fitted_on
        )
    })
}

pub(super) fn left_out_note(part: &str, count: usize) -> Option<String> {
    (count > 0).then(|| {
        format!("{count} samples of the part {part} lack a label or a frame and were left out")
    })
}

/// What to do where the scored part has too few contact points for any interval.
pub(super) fn few_points_note(points: Option<&[&str]>) -> Option<String> {
    let distinct: BTreeSet<&str> = points?.iter().copied().collect();
    (distinct.len() < 5).then(|| {
        format!(
            "scored on {} contact points, too few for intervals; test on more of them: --split 'by-point 50/10/40'",
            distinct.len()
        )
    })
}
