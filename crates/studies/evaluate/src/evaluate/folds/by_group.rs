//! Folds by groups of samples.

use std::collections::BTreeSet;

use taceva_core::{by_count, counted};
use taceva_dataset::Dataset;
use taceva_models::{FoldGroups, FoldSpec, Split, SplitKind, SplitSpec};

use super::common_model::fold_name;
use super::{Fold, Folds};
use crate::error::EvaluateError;
use crate::grouping::{Grouping, SplitFields, of_all_rows};
use crate::rows::Divided;

impl<'a> Folds<'a> {
    /// Folds by group of the ascending `rows` of `dataset`. All other rows are in no part.
    pub(crate) fn of_groups(
        dataset: &'a Dataset,
        rows: &[usize],
        spec: SplitSpec,
        folds: FoldSpec,
        seed: u64,
    ) -> Result<Folds<'a>, EvaluateError> {
        let by = match folds.by {
            FoldGroups::Detected => Grouping::of(dataset, rows).folds(),
            by => by,
        };
        let folds = FoldSpec { by, ..folds };
        let spec = SplitSpec {
            kind: SplitKind::Folds(folds.clone()),
            ..spec
        };
        let fields = SplitFields::of(dataset, rows, &spec.kind);
        let made = folds.folds(&fields.input(rows.len()), spec.fractions, seed)?;
        let splits: Vec<&Split> = made.splits.iter().collect();
        let neighbours = fields.neighbours(dataset, rows, &spec.kind, &splits);
        let groups = fields.groups_of_rows(dataset, rows, &spec.kind);
        let are_independent = fields.are_independent(dataset, rows, &spec.kind);
        let named = made.groups.iter().filter(|name| !name.is_empty());
        let named = named.collect::<BTreeSet<_>>().len();
        let (count, all) = (made.splits.len(), dataset.table().rows());
        let are_several = folds.by != FoldGroups::Samples;
        let groups_of_rows = are_several.then(|| of_all_rows(&made.groups, rows, all));
        let mut tested: Vec<usize> = splits.iter().flat_map(|split| split.test.clone()).collect();
        tested.sort_unstable();
        let tested: Vec<usize> = tested.into_iter().map(|at| rows[at]).collect();
        let among = |split: &Split| split.test.iter().map(|&at| rows[at]).collect();
        let tested_by_fold: Vec<Vec<usize>> = made.splits.iter().map(among).collect();
        let left_out = (0..all).filter(|row| tested.binary_search(row).is_err());
        let mut note = format!(
            "each sample was predicted once, by one of {count} models fitted without its group ({named} groups); the settings of each model were chosen on the groups of its fit; the baseline of skill is the mean of the truth, because these models share no constant"
        );
        let unnamed = rows.len() - tested.len();
        if unnamed > 0 {
            note += &format!(
                "; {unnamed} of {} {} left out: no group is named for {}; name one in the table, and import the table again",
                counted(rows.len(), "sample"),
                by_count(unnamed, "is", "are"),
                by_count(unnamed, "it", "them")
            );
        }
        let whole = Split {
            left_out: left_out.collect(),
            test: tested,
            note: Some(note),
            ..Split::default()
        };
        let divided = |split| Divided {
            spec: spec.clone(),
            seed,
            split,
            neighbours: neighbours.clone(),
            groups: groups.clone(),
            are_independent,
            folds: Vec::new(),
        };
        let folds = made
            .splits
            .into_iter()
            .enumerate()
            .map(|(number, split)| Fold {
                name: fold_name(number + 1),
                divided: divided(match rows.len() < all {
                    true => split.among(rows, all),
                    false => split,
                }),
            });
        Ok(Folds {
            dataset,
            folds: folds.collect(),
            whole: Divided {
                folds: tested_by_fold,
                ..divided(whole)
            },
            groups: groups_of_rows,
            are_recordings: false,
        })
    }
}
