//! Selection of scores by channel.

use super::ScoreTable;

impl ScoreTable {
    /// Scores of the channels and planes in `names`, or all scores if `names` is empty.
    #[must_use]
    pub fn of_channels(mut self, names: &[String]) -> ScoreTable {
        self.rows
            .retain(|row| names.is_empty() || names.contains(&row.channel));
        self
    }
}
