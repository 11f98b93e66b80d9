//! Signs for values of limited standing, where words do not fit.

use std::collections::BTreeSet;

use taceva_metrics::Standing;

use super::{ScoreCell, ScoreTable};

/// Sign of a value that is excluded from verdicts.
pub(crate) const BARRED: &str = "†";
/// Sign of a value that takes part in verdicts, although the skill of the model is not shown.
pub(super) const UNPROVEN: &str = "‡";

/// Sign of `standing`; empty if the score counts without remark.
pub(crate) fn sign(standing: Standing) -> &'static str {
    match (standing.takes_part(), standing.phrase()) {
        (false, _) => BARRED,
        (true, Some(_)) => UNPROVEN,
        (true, None) => "",
    }
}

impl ScoreCell {
    /// Sign of the standing of the value; empty if the value counts without remark.
    pub(super) fn mark(&self) -> &'static str {
        match self.value {
            None => BARRED,
            Some(_) => sign(self.standing),
        }
    }
}

impl ScoreTable {
    /// Meaning of `mark` with the reasons in this table; `None` if no value has the mark.
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
