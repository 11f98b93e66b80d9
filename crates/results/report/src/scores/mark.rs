//! Signs behind values of limited standing, where there is no room for words.

use std::collections::BTreeSet;

use super::{ScoreCell, ScoreTable};

/// Sign of a value that takes no part in verdicts.
pub(super) const BARRED: &str = "†";
/// Sign of a value that takes part without evidence that its model beats a constant.
pub(super) const UNPROVEN: &str = "‡";

impl ScoreCell {
    /// Sign of the standing of its value; empty if it counts without remark.
    pub(super) fn mark(&self) -> &'static str {
        match (self.takes_part(), self.standing.phrase()) {
            (false, _) => BARRED,
            (true, Some(_)) => UNPROVEN,
            (true, None) => "",
        }
    }
}

impl ScoreTable {
    /// Meaning of `mark` with the reasons for it; `None` if no value has it.
    pub(super) fn legend(&self, mark: &str) -> Option<String> {
        let marked = self.valued().filter(|cell| cell.mark() == mark);
        let reasons = marked.filter_map(|cell| cell.standing.phrase());
        let reasons: BTreeSet<&str> = reasons.collect();
        let reasons: Vec<&str> = reasons.into_iter().collect();
        let part = match mark {
            BARRED => "takes no part in verdicts",
            _ => "takes part in verdicts",
        };
        let reasons = (!reasons.is_empty()).then(|| reasons.join(", "))?;
        Some(format!("{mark}: {part} ({reasons})."))
    }
}
