//! Values side by side for programs, as JSON and as rows of a comparison.

use serde_json::{Value, json};
use taceva_metrics::Better;

use super::Line;
use crate::compare::{CompareRequest, Comparison};
use crate::results::Study;
use crate::scores::{ScoreCell, ScoreTable};
use crate::table::{Cell, Table};

impl ScoreTable {
    /// JSON of [`COMPARISON_SCHEMA`](crate::COMPARISON_SCHEMA) with the values of [`side_by_side`](ScoreTable::side_by_side).
    ///
    /// ```
    /// use taceva_report::{CompareRequest, ScoreTable, catalogue, compare};
    /// let sensors = ["GelSight", "DIGIT"].map(|name| catalogue::find(name).expect("there").as_study());
    /// let request = CompareRequest::default();
    /// let comparison = compare(&sensors, &request);
    /// let json = ScoreTable::compared(&sensors, &request).comparison_json(&comparison, &sensors, &request, false);
    /// assert!(json.contains("\"quantity\": \"mae Fz\""));
    /// ```
    pub fn comparison_json(
        &self,
        comparison: &Comparison,
        studies: &[Study],
        request: &CompareRequest,
        is_all: bool,
    ) -> String {
        let asked = self.asked(request, is_all);
        let (lines, _) = asked.lines(studies, request);
        let values: Vec<Value> = lines.iter().map(|line| self.line_json(line)).collect();
        let mut whole = comparison.document();
        whole["values"] = Value::Array(values);
        format!("{whole:#}\n")
    }

    /// Rows of `comparison`, then one row for each value of [`side_by_side`](ScoreTable::side_by_side). Rows of values have empty columns for the second
    /// result.
    pub fn comparison_table(
        &self,
        comparison: &Comparison,
        studies: &[Study],
        request: &CompareRequest,
        is_all: bool,
    ) -> Table {
        let asked = self.asked(request, is_all);
        let (lines, _) = asked.lines(studies, request);
        let mut table = comparison.table();
        for line in &lines {
            let (metric, channel) = match line.row {
                Some(row) => (row.metric.as_str(), row.channel.as_str()),
                None => (line.quantity.as_str(), ""),
            };
            for (name, cell) in self.names.iter().zip(&line.cells) {
                let shown = cell.as_ref().map(Cell::plain).unwrap_or_default();
                let [metric, channel, name] = [metric, channel, name].map(Cell::text);
                let [value, unit, origins] =
                    [shown.as_str(), line.unit.as_str(), line.origins].map(Cell::from);
                let blank = || Cell::text("");
                let after = [(); 5].map(|()| blank());
                let cells = [metric, channel, name, blank(), value, blank()];
                let cells = cells.into_iter().chain(after).chain([unit, origins]);
                table.push(cells);
            }
        }
        table
    }

    /// JSON of one quantity, with the value of each study.
    fn line_json(&self, line: &Line<'_>) -> Value {
        let scores = line.row.map(|row| row.cells.as_slice()).unwrap_or_default();
        let value = |(at, name): (usize, &String)| {
            let score = scores.get(at).and_then(Option::as_ref);
            let score = score.filter(|cell| cell.value.is_some());
            let shown = line.cells.get(at).and_then(Option::as_ref);
            json!({
                "of": name,
                "value": score.and_then(|cell| cell.value),
                "ci95": score.and_then(|cell| cell.ends),
                "standing": score.and_then(|cell: &ScoreCell| cell.standing.words()),
                "text": shown.map(Cell::plain),
            })
        };
        let values: Vec<Value> = self.names.iter().enumerate().map(value).collect();
        let metric = line.quantity.split(' ').next().unwrap_or_default();
        json!({
            "quantity": line.quantity,
            "unit": line.unit,
            "better": Better::of(metric).map(Better::name),
            "origins": line.origins,
            "values": values,
        })
    }
}
