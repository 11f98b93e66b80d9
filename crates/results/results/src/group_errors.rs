//! Prediction errors of each group of a split.

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};

use crate::samples::Samples;
use crate::score::Score;

/// Greatest number of groups for which errors are listed.
const MOST: usize = 20;

/// Mean absolute errors of the samples of one group of a split, one per channel. An interval would need several groups.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct GroupErrors {
    /// Name of the group.
    pub group: String,
    /// Errors of the group, one per channel.
    pub errors: Vec<GroupError>,
}

/// Mean absolute error of one channel over the samples of one group.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct GroupError {
    /// Name of the channel: `Fz`.
    pub channel: String,
    /// Symbol of the unit of the error.
    pub unit: String,
    /// Number of samples of the group with a truth and a prediction.
    pub n: u64,
    /// Mean absolute error, in `unit`.
    pub mae: f64,
}

/// Running sum and number of absolute prediction errors.
#[derive(Clone, Copy, Debug, Default)]
struct Errors {
    sum: f64,
    n: u64,
}

impl Errors {
    fn add(&mut self, error: f64) {
        self.sum += error;
        self.n += 1;
    }

    fn mean(self) -> f64 {
        self.sum / self.n as f64
    }
}

/// Mean absolute errors of each group in the column `group`. Covers the channels of which `scores` has a score `mae` over the same samples. Empty
/// unless `samples` has 2 to 20 groups.
///
/// ```
/// use taceva_results::{Samples, group_errors};
/// let samples = Samples::read("sample,group,Fz,Fz_predicted\na,cup,1,1.5\nb,ball,1,2\n")?;
/// assert!(group_errors(&samples, &[]).is_empty());
/// # Ok::<(), taceva_results::SamplesError>(())
/// ```
pub fn group_errors(samples: &Samples, scores: &[Score]) -> Vec<GroupErrors> {
    let rows = 0..samples.rows();
    let names = rows.clone();
    let names = names.filter_map(|row| samples.word(Samples::GROUP, row));
    let names: BTreeSet<&str> = names.collect();
    if !(2..=MOST).contains(&names.len()) {
        return Vec::new();
    }
    let mut groups: BTreeMap<&str, Vec<GroupError>> = BTreeMap::new();
    for score in scores.iter().filter(|score| score.metric == "mae") {
        let Some(channel) = samples.channel(&score.channel) else {
            continue;
        };
        let mut all = Errors::default();
        let mut own: BTreeMap<&str, Errors> = BTreeMap::new();
        for row in rows.clone() {
            let group = samples.word(Samples::GROUP, row);
            if let (Some(group), Some([truth, prediction])) = (group, channel.pair(row)) {
                let error = (truth - prediction).abs();
                all.add(error);
                own.entry(group).or_default().add(error);
            }
        }
        // For an angle with a period, the error may differ from the plain difference.
        let is_same = |value: f64| (all.mean() - value).abs() <= 1e-9 * value.abs();
        if all.n != score.n || !score.value.number().is_some_and(is_same) {
            continue;
        }
        for (group, errors) in own {
            groups.entry(group).or_default().push(GroupError {
                channel: score.channel.clone(),
                unit: score.unit.symbol().to_owned(),
                n: errors.n,
                mae: errors.mean(),
            });
        }
    }
    let groups = groups.into_iter();
    let named = groups.map(|(group, errors)| GroupErrors {
        group: group.to_owned(),
        errors,
    });
    named.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::value::Value;
    use taceva_core::Unit;

    fn mae(value: f64, n: u64) -> Score {
        Score {
            metric: "mae".to_owned(),
            channel: "Fz".to_owned(),
            value: Value::Number(value),
            unit: Unit::Newton,
            n,
            n_invalid: 0,
            interval: None,
            definition: "mae/1".to_owned(),
            parameters: Vec::new(),
            counts: Vec::new(),
            flags: Vec::new(),
            standing: taceva_metrics::Standing::Counts,
            bounded_share: None,
            of: Vec::new(),
            variants: Vec::new(),
        }
    }

    #[test]
    fn each_group_has_its_own_error_and_number_of_samples() {
        let table = "sample,group,Fz,Fz_predicted\na,cup,1,1.5\nb,ball,1,3\nc,ball,1,0\n";
        let samples = Samples::read(table).expect("samples");
        let found = group_errors(&samples, &[mae(3.5 / 3.0, 3)]);
        let named = |group: &str, n: u64, mae: f64| GroupErrors {
            group: group.to_owned(),
            errors: vec![GroupError {
                channel: "Fz".to_owned(),
                unit: "N".to_owned(),
                n,
                mae,
            }],
        };
        assert_eq!(found, [named("ball", 2, 1.5), named("cup", 1, 0.5)]);
        // A score of other samples, or by other differences, is not split.
        assert!(group_errors(&samples, &[mae(3.5 / 3.0, 4)]).is_empty());
        assert!(group_errors(&samples, &[mae(1.0, 3)]).is_empty());
    }

    #[test]
    fn one_group_and_many_groups_are_not_listed() {
        for count in [1, 21] {
            let rows = (0..count).map(|row| format!("{row},g{row},1,2\n"));
            let table = format!("sample,group,Fz,Fz_predicted\n{}", rows.collect::<String>());
            let samples = Samples::read(&table).expect("samples");
            assert!(group_errors(&samples, &[mae(1.0, count)]).is_empty());
        }
    }
}
