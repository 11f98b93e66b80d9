//! Rankings in files: counts of each distinct score, by cluster.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::{Counts, Level, MOST_SCORES, Ranking, ScoreKey, Sides, add};
use crate::error::TaskError;

/// Serialized ranking.
#[derive(Serialize, Deserialize)]
pub(super) struct Stored {
    is_on_grid: bool,
    clusters: BTreeMap<String, Vec<Level>>,
}

impl From<Ranking> for Stored {
    fn from(ranking: Ranking) -> Stored {
        let levels = |counts: Counts| -> Vec<Level> {
            let levels = counts.into_iter();
            levels
                .map(|(key, sides)| Level::of(key.score(), sides))
                .collect()
        };
        let clusters = ranking.clusters.into_sums();
        Stored {
            is_on_grid: ranking.is_on_grid,
            clusters: clusters
                .map(|(cluster, counts)| (cluster, levels(counts)))
                .collect(),
        }
    }
}

impl TryFrom<Stored> for Ranking {
    type Error = TaskError;
    fn try_from(stored: Stored) -> Result<Ranking, TaskError> {
        let mut ranking = Ranking {
            is_on_grid: stored.is_on_grid,
            ..Ranking::default()
        };
        for (cluster, levels) in stored.clusters {
            for level in levels {
                let key = ScoreKey::of(level.score);
                let is_right = level.score.is_finite()
                    && (key.on_grid() == key || !stored.is_on_grid)
                    && (level.positive, level.negative) != (0, 0);
                if !is_right {
                    return Err(TaskError::damaged(format!("the level {level:?}")));
                }
                let sides = Sides {
                    positive: level.positive,
                    negative: level.negative,
                };
                ranking.n = TaskError::checked_count(ranking.n, sides.positive)?;
                ranking.n = TaskError::checked_count(ranking.n, sides.negative)?;
                add(ranking.clusters.entry(&cluster), key, sides);
                add(&mut ranking.all, key, sides);
            }
        }
        if !ranking.is_on_grid && ranking.all.len() > MOST_SCORES {
            return Err(TaskError::damaged("more than 65,536 scores off the grid"));
        }
        Ok(ranking)
    }
}
