//! Folds of a cross-validation: each group of samples is tested once, by a model fitted to other groups.

use std::collections::{BTreeMap, BTreeSet};

use taceva_core::random::SplitMix64;

use super::assign::Split;
use super::error::SplitError;
use super::fold_spec::{FoldGroups, FoldSpec};
use super::fractions::Fractions;
use super::input::SplitInput;
use super::part::Part;
use crate::settings::Suggestion;

/// Splits of a cross-validation, and the group of every sample.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Folds {
    /// One split per fold. Each sample that has a group is in the test part of exactly one split.
    pub splits: Vec<Split>,
    /// Group name of each sample; empty for samples without a group.
    pub groups: Vec<String>,
}

impl FoldSpec {
    /// Divides the samples of `input` into folds. The same seed gives the same folds on every machine. The groups outside the test part of a fold are
    /// divided between training and validation in the shares of `fractions`.
    ///
    /// ```
    /// use taceva_models::{Fractions, FoldGroups, FoldSpec, SplitInput};
    /// let points: Vec<String> = (0..20).map(|row| format!("p{}", row / 2)).collect();
    /// let input = SplitInput { rows: 20, points: Some(&points), ..SplitInput::default() };
    /// let spec = FoldSpec { count: Some(5), by: FoldGroups::Points };
    /// let folds = spec.folds(&input, Fractions::default(), 7)?;
    /// assert_eq!(folds.splits.iter().map(|split| split.test.len()).sum::<usize>(), 20);
    /// # Ok::<(), taceva_models::SplitError>(())
    /// ```
    ///
    /// # Errors
    /// [`SplitError`] for columns of unequal lengths, for missing group names, and for fewer than two groups or fewer groups than folds.
    pub fn folds(
        &self,
        input: &SplitInput<'_>,
        fractions: Fractions,
        seed: u64,
    ) -> Result<Folds, SplitError> {
        input.check()?;
        let groups = self.groups(input)?;
        let mut order: Vec<&str> = Vec::new();
        let mut seen = BTreeSet::new();
        for name in groups.iter().filter(|name| !name.is_empty()) {
            if seen.insert(name.as_str()) {
                order.push(name);
            }
        }
        SplitMix64::new(seed).shuffle(&mut order);
        let count = self.count.unwrap_or(order.len());
        if order.len() < count || count < 2 {
            return Err(SplitError::FewGroups {
                groups: order.len(),
                folds: count,
                by: self.by.clone(),
            });
        }
        let splits = (0..count).map(|fold| {
            let parts = parts(&order, fold, count, fractions);
            let part = |name: &String| parts.get(name.as_str()).copied();
            input.apart(Split::of(groups.iter().map(part)))
        });
        Ok(Folds {
            splits: splits.collect(),
            groups,
        })
    }

    /// Group name of every row of `input`; empty for rows without a group.
    ///
    /// # Errors
    /// [`SplitError`] if `input` lacks the names of the groups.
    pub fn groups(&self, input: &SplitInput<'_>) -> Result<Vec<String>, SplitError> {
        let samples = || (0..input.rows).map(|row| format!("{row}")).collect();
        Ok(match &self.by {
            FoldGroups::Detected => match (input.points, input.blocks) {
                (Some(points), _) => points.to_vec(),
                (None, Some(blocks)) => blocks.names.to_vec(),
                (None, None) => samples(),
            },
            FoldGroups::Samples => samples(),
            FoldGroups::Points => input.points.ok_or(SplitError::NoPoints)?.to_vec(),
            FoldGroups::Blocks => input.blocks.ok_or(SplitError::NoBlocks)?.names.to_vec(),
            FoldGroups::Recordings => {
                let recordings = input.recordings.ok_or(SplitError::NoRecordings {
                    split: "by-recording",
                })?;
                recordings.to_vec()
            }
            FoldGroups::Column(name) => {
                let column = input.columns.get(name.as_str());
                let column = column.ok_or_else(|| SplitError::NoColumn {
                    name: name.clone(),
                    suggestion: Suggestion::of(name, input.columns.keys().copied()),
                })?;
                column.to_vec()
            }
        })
    }
}

/// Part of each group of `order` in fold number `fold` of `count`. The groups of this fold are the test part. The others are taken in the order of
/// the next folds: the first ones are the validation part, and the rest the training part. `fractions` gives the number of validation groups.
fn parts<'a>(
    order: &[&'a str],
    fold: usize,
    count: usize,
    fractions: Fractions,
) -> BTreeMap<&'a str, Part> {
    let mut parts = BTreeMap::new();
    // Starts at the next fold, so that every fold chooses settings by other groups.
    let mut others = Vec::new();
    for turn in 0..count {
        let own = order.iter().skip((fold + turn) % count).step_by(count);
        match turn {
            0 => parts.extend(own.map(|name| (*name, Part::Test))),
            _ => others.extend(own.copied()),
        }
    }
    let validation = fractions.validation_of_rest(others.len());
    for (at, name) in others.into_iter().enumerate() {
        let part = match at < validation {
            true => Part::Validation,
            false => Part::Train,
        };
        parts.insert(name, part);
    }
    parts
}
