//! Layouts of score tables: every number for programs, and page-sized tables for pages and papers.

use taceva_core::Unit;
use taceva_metrics::Better;

use super::mark::{BARRED, UNPROVEN};
use super::{ScoreCell, ScoreRow, ScoreTable};
use crate::table::{Align, Cell, Column, Direction, Estimate, Row, Table, Words, latex_symbol};

impl ScoreTable {
    /// Table for programs with one row for each score and study, and numbers in shortest round-trip form.
    pub fn every_number(&self) -> Table {
        let columns = [
            Column::new("sensor"),
            Column::of_metrics(),
            Column::new("channel"),
            Column::new("value"),
            Column::new("unit"),
            Column::new("ci95_low"),
            Column::new("ci95_high"),
            Column::new("method"),
            Column::new("degrees_of_freedom"),
            Column::new("n"),
            Column::new("n_invalid"),
            Column::new("reason"),
            Column::new("standing"),
            Column::new("bounded_share"),
            Column::new("source"),
        ];
        let mut table = Table::new("Scores", columns);
        for row in &self.rows {
            let studies = self.names.iter().zip(&self.sources);
            for ((name, source), cell) in studies.zip(&row.cells) {
                if let Some(cell) = cell {
                    table.push(row.numbers(name, source, cell));
                }
            }
        }
        table
    }

    /// Table for pages with one row for each score and one column for each study: values with intervals; a significantly best value is bold.
    pub fn for_pages(&self) -> Table {
        let columns = ["metric", "channel", "unit"].map(Column::new);
        let [metric, channel, unit] = columns;
        let metric = metric.direction(Direction::OfMetrics);
        let common = self.common_remark();
        let mut table = self.of_studies([metric, channel, unit]);
        for row in &self.rows {
            let words = [
                row.metric.clone(),
                row.channel.clone(),
                row.unit.to_string(),
            ];
            let cells = row.cells.iter();
            let cells = cells.map(|cell| estimate(cell.as_ref(), common.as_deref()));
            table.push(words.map(Cell::text).into_iter().chain(cells));
        }
        if self.names.len() > 1 {
            table.note(self.legend_of_bold());
        }
        table.note_all(common.map(|remark| format!("Every value: {remark}.")));
        table.note_all(self.spread.as_deref());
        table
    }

    /// Table for papers, with the usual symbols, and intervals below the values.
    pub fn for_papers(&self, caption: &str) -> Table {
        let [metric, channel, unit] = ["metric", "channel", "unit"].map(Column::new);
        let metric = metric.direction(Direction::OfRows);
        let mut table = self.of_studies([metric, channel, unit]);
        caption.clone_into(&mut table.caption);
        let mut last = "";
        for row in &self.rows {
            let is_new = row.metric != last;
            let unit = match row.unit {
                Unit::One => "",
                unit => unit.symbol(),
            };
            let name = match is_new {
                true => Words::new(&row.metric).latex(super::notation::metric(&row.metric)),
                false => Words::default(),
            };
            let channel = Words::new(&row.channel).latex(latex_symbol(&row.channel));
            let words = [name, channel, Words::new(unit)];
            let cells = row.cells.iter().map(|cell| without_words(cell.as_ref()));
            table.rows.push(Row {
                cells: words.map(Cell::Text).into_iter().chain(cells).collect(),
                better: Better::of(&row.metric).filter(|_| is_new),
                begins_group: is_new && !last.is_empty(),
                heading: None,
            });
            last = &row.metric;
        }
        if self.names.len() > 1 {
            table.note(self.legend_of_bold());
        }
        let marks = [BARRED, UNPROVEN].into_iter();
        table.note_all(marks.filter_map(|of| self.legend(of)));
        table.note_all(self.spread.as_deref());
        table
    }

    /// Remark that all values share, such as `not better than predicting the mean`. `None` for a single value, different remarks or no remark.
    fn common_remark(&self) -> Option<String> {
        let mut remarks = self.valued().map(ScoreCell::remark);
        let first = remarks.next()??;
        let mut others = remarks.peekable();
        let is_alone = others.peek().is_none();
        let is_common = others.all(|other| other.as_ref() == Some(&first));
        (is_common && !is_alone).then_some(first)
    }

    /// Legend of bold numbers, as plain text and as LaTeX.
    fn legend_of_bold(&self) -> Words {
        let legend = |level: &str| {
            format!(
                "Bold: better than every other {} that takes part in verdicts, at a level of {level} after Holm's adjustment.",
                self.noun
            )
        };
        Words::new(legend("5 %")).latex(legend("5\\,\\%"))
    }

    /// Table with `columns`, then one column for each study.
    fn of_studies<const N: usize>(&self, columns: [Column; N]) -> Table {
        let studies = self.names.iter();
        let studies = studies.map(|name| Column::new(name.as_str()).align(Align::Right));
        let columns = columns.map(|column| column.align(Align::Left));
        Table::new("", columns.into_iter().chain(studies))
    }
}

impl ScoreRow {
    /// Values of the study `name`, in the column order for programs.
    fn numbers(&self, name: &str, source: &str, cell: &ScoreCell) -> [Cell; 15] {
        [
            Cell::text(name),
            Cell::text(self.metric.as_str()),
            Cell::text(self.channel.as_str()),
            Cell::exact(cell.value),
            Cell::text(self.unit.symbol()),
            Cell::exact(cell.ends.map(|ends| ends[0])),
            Cell::exact(cell.ends.map(|ends| ends[1])),
            Cell::text(cell.method.as_deref().unwrap_or_default()),
            Cell::exact(cell.degrees_of_freedom),
            Cell::Number(cell.n.to_string()),
            Cell::Number(cell.n_invalid.to_string()),
            Cell::text(cell.formatted.reason.as_deref().unwrap_or_default()),
            Cell::text(cell.standing.words().unwrap_or_default()),
            Cell::exact(cell.bounded_share),
            Cell::text(source),
        ]
    }
}

/// Value with its interval, or the reason why it is absent. Omits the remark that is `common` to all values.
fn estimate(cell: Option<&ScoreCell>, common: Option<&str>) -> Cell {
    Cell::Estimate(cell.map_or_else(Estimate::default, |cell| Estimate {
        formatted: cell.formatted.clone(),
        unit: String::new(),
        remark: cell.remark().filter(|own| Some(own.as_str()) != common),
        mark: "",
        is_best: cell.is_best,
    }))
}

/// Value with its interval and the sign of its standing. Omits words to save space in a paper.
fn without_words(cell: Option<&ScoreCell>) -> Cell {
    let valued = cell.filter(|cell| cell.value.is_some());
    Cell::Estimate(valued.map_or_else(Estimate::default, |cell| {
        let mut formatted = cell.formatted.clone();
        formatted.reason = None;
        Estimate {
            formatted,
            mark: cell.mark(),
            is_best: cell.is_best,
            ..Estimate::default()
        }
    }))
}
