//! Scores laid out as papers print them: a row a metric, a column a channel.

use taceva_study::EvaluationReport;

use super::line::{read_lines, standings};
use super::number::printed;

/// Scores by metric and channel.
pub(super) struct Grid {
    /// The channels and groups, in the order of their first score.
    pub(super) channels: Vec<String>,
    /// Metric by metric, a cell a channel.
    pub(super) rows: Vec<(String, Vec<Option<Cell>>)>,
}

/// One score as printed.
pub(super) struct Cell {
    /// The number, or why there is none.
    pub(super) value: String,
    /// The ends of its interval.
    pub(super) interval: Option<[String; 2]>,
    /// Its unit; empty if it has none.
    pub(super) unit: String,
}

impl Grid {
    pub(super) fn of(report: &EvaluationReport) -> Grid {
        let mut grid = Grid {
            channels: Vec::new(),
            rows: Vec::new(),
        };
        for (_, channel, _) in report.evaluation.scores() {
            if !grid.channels.iter().any(|known| known == channel) {
                grid.channels.push(channel.to_owned());
            }
        }
        for line in read_lines(&report.evaluation) {
            if !grid.rows.iter().any(|(name, _)| *name == line.name) {
                let empty = grid.channels.iter().map(|_| None).collect();
                grid.rows.push((line.name.clone(), empty));
            }
            let printed = printed(&line);
            let has_value = !printed.value.is_empty();
            let cell = Cell {
                value: if has_value {
                    printed.value
                } else {
                    printed.reason.unwrap_or_default()
                },
                interval: printed.interval,
                unit: if has_value && line.unit.symbol() != "1" {
                    line.unit.to_string()
                } else {
                    String::new()
                },
            };
            let column = grid.channels.iter().position(|known| known == line.channel);
            let row = grid.rows.iter_mut().find(|(name, _)| *name == line.name);
            if let (Some((_, cells)), Some(column)) = (row, column) {
                cells[column] = Some(cell);
            }
        }
        grid
    }
}

/// What a reader of the table must know.
pub(super) fn caption(report: &EvaluationReport) -> String {
    let subject = &report.subject;
    let n = report
        .evaluation
        .scores()
        .map(|(_, _, score)| score.n)
        .max()
        .unwrap_or(0);
    let methods: std::collections::BTreeSet<String> = report
        .evaluation
        .scores()
        .filter_map(|(_, _, score)| score.interval.method())
        .collect();
    let intervals = match methods.len() {
        0 => "No intervals".to_owned(),
        _ => format!(
            "95 % intervals: {}",
            methods.into_iter().collect::<Vec<_>>().join("; ")
        ),
    };
    let model = report
        .provenance
        .model
        .as_ref()
        .map_or_else(String::new, |model| format!(" Model: {}.", model.name));
    let split = report
        .provenance
        .split
        .as_ref()
        .map_or_else(String::new, |split| format!(" Split: {split}."));
    let subject = match subject.source.as_str() {
        "unknown" => "Scores of two tables".to_owned(),
        source => format!("{} ({source} samples)", subject.sensor),
    };
    let standings: String = standings(&report.evaluation)
        .iter()
        .map(|standing| format!(" No full part in verdicts: {standing}."))
        .collect();
    format!(
        "{subject}, n = {n}.{model}{split} {intervals}.{standings} TacEva {}.",
        report.provenance.taceva
    )
}
