//! Figure of errors with faults.

use taceva_report::{FaultGrid, FaultPanel, FaultRow, Figure, fault_grid};
use taceva_stress::{FaultReport, NEVER, StressReport};

use super::{caption, main_channels};

/// Figure with a panel for each main channel.
pub(crate) fn grid(report: &StressReport) -> Figure {
    let panels = main_channels(&report.clean).into_iter().map(|channel| {
        let rows = report.faults.iter().map(|fault| row(fault, channel));
        FaultPanel {
            channel: channel.to_owned(),
            rows: rows.collect(),
        }
    });
    let not_measured = report.not_measured.iter();
    let not_measured = not_measured.map(|words| format!(" {words}"));
    fault_grid(&FaultGrid {
        title: format!("Faults of {}", report.subject.sensor),
        caption: format!("{}.{}", caption(report), not_measured.collect::<String>()),
        panels: panels.collect(),
    })
}

fn row(fault: &FaultReport, channel: &str) -> FaultRow {
    let of = |severity: u8| {
        let mut tested = fault.severities.iter();
        let tested = tested.find(|of| of.severity == severity)?;
        tested.stale.get(channel)?.degradation.value
    };
    let ends = fault.breaks_at.get(channel).copied().flatten();
    FaultRow {
        fault: fault.id.to_owned(),
        degradation: [1, 2, 3, 4, 5].map(of),
        skill_ends: ends.filter(|severity| *severity < NEVER),
    }
}
