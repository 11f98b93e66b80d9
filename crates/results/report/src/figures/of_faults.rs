//! Grid of a result: faults by severity.

use super::fault_grid::{FaultGrid, FaultPanel, FaultRow, fault_grid};
use crate::faults::{FaultResult, FaultScores, NEVER};
use crate::figure::Figure;

impl FaultResult {
    /// Figure with a panel for each main channel: growth of the error by fault and severity.
    pub fn figure(&self) -> Figure {
        let panels = self.main_channels().into_iter().map(|channel| {
            let tested = self.scored().map(|fault| row(fault, channel));
            let skipped = self.skipped.iter().map(|skipped| FaultRow {
                fault: skipped.fault.clone(),
                degradation: [None; 5],
                skipped: [true; 5],
                skill_ends: None,
            });
            FaultPanel {
                channel: channel.to_owned(),
                rows: tested.chain(skipped).collect(),
            }
        });
        fault_grid(&FaultGrid {
            title: format!("Faults of {}", self.subject.sensor),
            caption: self.caption(),
            panels: panels.collect(),
        })
    }

    /// List of faults, seed and samples, as sentences.
    fn caption(&self) -> String {
        let not_measured = self.not_measured.iter();
        let not_measured = not_measured.map(|words| format!(" {words}"));
        format!(
            "Faults {}, severity by {}, seed {}, {} samples.{}",
            self.list.name,
            self.by,
            self.seed,
            self.samples,
            not_measured.collect::<String>()
        )
    }
}

/// Row of one fault for a channel.
fn row(fault: &FaultScores, channel: &str) -> FaultRow {
    let degradation = |severity: u8| {
        let mut tested = fault.severities.iter();
        let tested = tested.find(|of| of.severity == severity)?;
        tested.stale.get(channel)?.degradation.value
    };
    let is_unreached = |severity: u8| fault.unreached.iter().any(|of| of.severity == severity);
    let ends = fault.breaks_at.get(channel).copied().flatten();
    FaultRow {
        fault: fault.id.clone(),
        degradation: [1, 2, 3, 4, 5].map(degradation),
        skipped: [1, 2, 3, 4, 5].map(is_unreached),
        skill_ends: ends.filter(|severity| *severity < NEVER),
    }
}
