//! States of the scores of classes: ranks of the positive class, probabilities, and places of the true class.

use taceva_tasks::{Probabilities, Ranking, TaskError, TaskState, TopK};

/// States of the scores of the classes of a task.
pub(crate) struct ScoreStates {
    names: Vec<String>,
    /// Position of the positive class, and the ranks of its scores.
    ranking: Option<(usize, Ranking)>,
    /// States that need the scores of all classes.
    of_all: Option<(Probabilities, TopK)>,
}

impl ScoreStates {
    /// No samples of the classes `names`. Without `are_all`, only the positive class has scores.
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
        let position = names.iter().position(|name| positive == Some(name));
        Ok(ScoreStates {
            names: names.to_vec(),
            ranking: position.map(|position| (position, Ranking::default())),
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
        if let Some((positive, ranking)) = &mut self.ranking {
            ranking.push(cluster, scores[*positive], truth == *positive)?;
        }
        if let Some((probabilities, places)) = &mut self.of_all {
            let truth = &self.names[truth];
            probabilities.push(cluster, truth, scores)?;
            places.push(cluster, truth, scores)?;
        }
        Ok(())
    }

    /// Adds the states to the state of the task.
    pub(crate) fn add_to(self, state: &mut TaskState) {
        state.ranking = self.ranking.map(|(_, ranking)| ranking);
        let (probabilities, places) = self.of_all.unzip();
        state.probabilities = probabilities;
        state.places = places;
    }
}
