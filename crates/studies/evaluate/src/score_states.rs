//! Sums for the scores of classes: ranks of the positive class, probabilities, and rank of the true class among the scores.

use std::collections::BTreeMap;

use taceva_tasks::{Probabilities, Ranking, TaskError, TaskState, TopK};

/// Sums for the scores of the classes of a task.
pub(crate) struct ScoreStates {
    names: Vec<String>,
    /// Position of the positive class, if there is one.
    positive: Option<usize>,
    /// Scores of the positive class by cluster. Each cluster is sorted once.
    ranked: BTreeMap<String, RankedRows>,
    /// Sums that need the scores of all classes; `None` if only the positive class has scores.
    of_all: Option<(Probabilities, TopK)>,
}

/// Scores of the positive class in one cluster.
#[derive(Default)]
struct RankedRows {
    scores: Vec<f64>,
    is_positive: Vec<bool>,
}

impl ScoreStates {
    /// Creates empty sums for the classes `names`. If `are_all` is false, only the positive class has scores.
    ///
    /// # Errors
    /// [`TaskError`] for fewer than two names, equal names, or a positive class that is not among them.
    pub(crate) fn new(
        names: &[String],
        positive: Option<&str>,
        are_all: bool,
    ) -> Result<ScoreStates, TaskError> {
        let of_all = match are_all {
            true => Some((Probabilities::new(names, positive)?, TopK::new(names)?)),
            false => None,
        };
        Ok(ScoreStates {
            names: names.to_vec(),
            positive: names.iter().position(|name| positive == Some(name)),
            ranked: BTreeMap::new(),
            of_all,
        })
    }

    /// Adds a sample of `cluster` with the scores of its classes. `truth` is the position of the true class.
    ///
    /// # Errors
    /// [`TaskError`] for a score that is not finite.
    pub(crate) fn push(
        &mut self,
        cluster: &str,
        truth: u32,
        scores: &[f64],
    ) -> Result<(), TaskError> {
        let truth = truth as usize;
        if let Some(positive) = self.positive {
            if !self.ranked.contains_key(cluster) {
                self.ranked
                    .insert(cluster.to_owned(), RankedRows::default());
            }
            if let Some(rows) = self.ranked.get_mut(cluster) {
                rows.scores.push(scores[positive]);
                rows.is_positive.push(truth == positive);
            }
        }
        if let Some((probabilities, places)) = &mut self.of_all {
            let truth = &self.names[truth];
            probabilities.push(cluster, truth, scores)?;
            places.push(cluster, truth, scores)?;
        }
        Ok(())
    }

    /// Adds these sums to the state of the task.
    ///
    /// # Errors
    /// [`TaskError`] for a score that is not finite.
    pub(crate) fn add_to(self, state: &mut TaskState) -> Result<(), TaskError> {
        if self.positive.is_some() {
            let mut ranking = Ranking::default();
            for (cluster, rows) in self.ranked {
                ranking.push_rows(&cluster, &rows.scores, &rows.is_positive)?;
            }
            state.ranking = Some(ranking);
        }
        let (probabilities, places) = self.of_all.unzip();
        state.probabilities = probabilities;
        state.places = places;
        Ok(())
    }
}
