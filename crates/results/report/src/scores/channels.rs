//! Scores of named channels.

use super::ScoreTable;

impl ScoreTable {
    /// Scores of the channels and planes called `names`, or all scores if it is empty. Without the score of a plane, its axes keep their own.
    #[must_use]
    pub fn of_channels(mut self, names: &[String]) -> ScoreTable {
        self.rows
            .retain(|row| names.is_empty() || names.contains(&row.channel));
        self
    }
}
