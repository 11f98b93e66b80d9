//! Notes on the predicted rows, and on the model that predicted them.

use std::collections::{BTreeMap, BTreeSet};

use taceva_dataset::Dataset;
use taceva_metrics::LEAST_CLUSTERS;
use taceva_models::{FoldGroups, SplitKind};

use crate::neighbours::preference;
use crate::note::{FewClusters, Note, Within};
use crate::predict::Target;
use crate::rows::DataPart;
use taceva_results::ModelProvenance;

impl Target {
    /// True if the model was fitted on samples of the scored part.
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

    /// Note on frames of the test part that are byte-identical to a frame of the training or validation part; `None` without such frames.
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

/// Note that rows were added after the fit, if any. The parts then contain more rows than at the fit.
fn fitted_before(dataset: &Dataset, fitted_on: &str) -> Option<Note> {
    let mut stages = dataset.header().stages();
    let (_, rows) = stages.find(|(digest, _)| digest.to_string() == fitted_on)?;
    let now = dataset.header().table.rows;
    (rows < now).then_some(Note::FittedBefore { rows, now })
}

/// Note that the samples have too few groups for any interval, or too few contact points `points` if the split has no groups.
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

/// Note if the groups of the split are within larger groups, which another column names.
pub(super) fn within(dataset: &Dataset, target: &Target) -> Option<Note> {
    let divided = target.divided.as_ref()?;
    let (column, has_parts) = match &divided.spec.kind {
        SplitKind::ByColumn(by) => (&by.column, !by.parts.is_empty()),
        SplitKind::Folds(folds) => match &folds.by {
            FoldGroups::Column(name) => (name, false),
            _ => return None,
        },
        _ => return None,
    };
    let table = dataset.table();
    let cells: Vec<String>;
    let groups = match &divided.groups {
        Some(groups) => groups,
        None if has_parts => return None,
        // Intervals leave out repeated points, but the split keeps the values of its column together.
        None => {
            let values = table.as_text(column)?.into_iter();
            cells = values.map(Option::unwrap_or_default).collect();
            &cells
        }
    };
    let others = table.attribute_names().iter();
    let others = others.filter(|name| *name != column && preference(name).is_some());
    let mut found = others.filter_map(|name| {
        let cells = table.as_text(name)?;
        let mut larger: BTreeMap<&str, &str> = BTreeMap::new();
        for (group, cell) in groups
            .iter()
            .zip(&cells)
            .filter(|(group, _)| !group.is_empty())
        {
            let cell = cell.as_deref()?;
            if *larger.entry(group).or_insert(cell) != cell {
                return None;
            }
        }
        let mut sizes: BTreeMap<&str, usize> = BTreeMap::new();
        larger
            .values()
            .for_each(|name| *sizes.entry(name).or_default() += 1);
        let shared = larger.values().filter(|name| sizes[**name] > 1).count();
        (shared > 0 && sizes.len() > 1).then(|| {
            Note::Within(Within {
                column: column.clone(),
                within: name.clone(),
                shared,
                of: larger.len(),
                larger: sizes.len(),
            })
        })
    });
    found.next()
}

/// Number of distinct names in `names`. Empty names are not counted.
fn distinct<'a>(names: impl IntoIterator<Item = &'a String>) -> usize {
    let names = names.into_iter().filter(|name| !name.is_empty());
    names.collect::<BTreeSet<_>>().len()
}
