//! Grid of a result: faults by severity.

use super::{FaultResult, FaultScores};
use crate::figure::Figure;
use crate::figures::{FaultGrid, FaultPanel, FaultRow, fault_grid};

/// Placeholder of results for a fault that ends the skill at no severity.
pub(super) const NEVER: u8 = 6;

impl FaultResult {
    /// Figure with a panel for each main channel: growth of the error by fault and severity.
    pub fn figure(&self) -> Figure {
        let panels = self.main_channels().into_iter().map(|channel| {
            let tested = self.faults.iter().map(|fault| fault.row(channel));
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

impl FaultScores {
    fn row(&self, channel: &str) -> FaultRow {
        let degradation = |severity: u8| {
            let mut tested = self.severities.iter();
            let tested = tested.find(|of| of.severity == severity)?;
            tested.stale.get(channel)?.degradation.value
        };
        let is_unreached = |severity: u8| self.unreached.iter().any(|of| of.severity == severity);
        let ends = self.breaks_at.get(channel).copied().flatten();
        FaultRow {
            fault: self.id.clone(),
            degradation: [1, 2, 3, 4, 5].map(degradation),
            skipped: [1, 2, 3, 4, 5].map(is_unreached),
            skill_ends: ends.filter(|severity| *severity < NEVER),
        }
    }
}
