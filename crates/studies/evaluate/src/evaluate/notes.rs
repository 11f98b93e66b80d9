//! Notes on the predicted rows, and on the model that predicted them.

use std::collections::BTreeSet;

use taceva_dataset::Dataset;
use taceva_metrics::LEAST_CLUSTERS;
use taceva_models::{FoldGroups, SplitKind};

use crate::note::{FewClusters, Note};
use crate::predict::Target;
use crate::rows::DataPart;
use taceva_results::ModelProvenance;

impl Target {
    /// True if the model was fitted on the part.
    pub(super) fn is_seen(&self) -> bool {
        let divided = self.divided.as_ref();
        let is_fitted = divided.is_some_and(|divided| !divided.rows(DataPart::Train).is_empty());
        is_fitted && self.part != DataPart::Test
    }

    /// Notes on the rows of `dataset` that `model` predicted.
    pub(super) fn notes(&self, dataset: &Dataset, model: &ModelProvenance) -> Vec<Note> {
        let is_known = self.divided.is_some() || model.origin.is_some();
        [
            self.is_seen().then_some(Note::Seen(self.part.name())),
            (!is_known).then(|| Note::FittedElsewhere(model.fitted_on.clone())),
            self.copies(dataset),
            fitted_before(dataset, &model.fitted_on),
        ]
        .into_iter()
        .flatten()
        .collect()
    }

    /// Frames of the test part that are byte-identical to a frame of the training part.
    fn copies(&self, dataset: &Dataset) -> Option<Note> {
        let divided = self.divided.as_ref()?;
        if self.part != DataPart::Test {
            return None;
        }
        let frames = dataset.table().frames();
        let digest = |row: &usize| Some(frames[*row].as_ref()?.digest);
        let parts = [DataPart::Train, DataPart::Validation].map(|part| divided.rows(part));
        let seen: BTreeSet<_> = parts.iter().flatten().filter_map(digest).collect();
        let tested = self.rows.iter().filter_map(digest);
        let copies = tested.filter(|digest| seen.contains(digest)).count();
        let of = self.rows.len();
        (copies > 0).then_some(Note::Copies { copies, of })
    }
}

/// Note on a fit from before rows were added, so that the parts now exceed the fitted rows.
fn fitted_before(dataset: &Dataset, fitted_on: &str) -> Option<Note> {
    let mut stages = dataset.header().stages();
    let (_, rows) = stages.find(|(digest, _)| digest.to_string() == fitted_on)?;
    let now = dataset.header().table.rows;
    (rows < now).then_some(Note::FittedBefore { rows, now })
}

/// Note on too few groups, or contact points `points`, for any interval.
pub(super) fn few_clusters(
    dataset: &Dataset,
    target: &Target,
    points: Option<&[String]>,
) -> Option<Note> {
    let divided = target.divided.as_ref();
    let groups = divided.and_then(|divided| divided.groups.as_deref());
    let (scored, all) = match groups {
        Some(groups) => (
            distinct(target.rows.iter().map(|&row| &groups[row])),
            distinct(groups),
        ),
        None => (
            distinct(points?),
            distinct(dataset.table().point_id().iter().flatten()),
        ),
    };
    let kind = divided.map(|divided| &divided.spec.kind);
    let by = match kind.filter(|_| groups.is_some()) {
        Some(SplitKind::ByColumn(by)) => FoldGroups::Column(by.column.clone()),
        Some(SplitKind::ByBlock) => FoldGroups::Blocks,
        Some(SplitKind::Folds(folds)) => folds.by.clone(),
        _ => FoldGroups::Points,
    };
    (scored < LEAST_CLUSTERS).then(|| {
        Note::FewClusters(FewClusters {
            takes_points: groups.is_some() && matches!(kind, Some(SplitKind::ByColumn(_))),
            by,
            scored,
            all,
        })
    })
}

/// Number of distinct names among `names`, without empty ones.
fn distinct<'a>(names: impl IntoIterator<Item = &'a String>) -> usize {
    let names = names.into_iter().filter(|name| !name.is_empty());
    names.collect::<BTreeSet<_>>().len()
}
