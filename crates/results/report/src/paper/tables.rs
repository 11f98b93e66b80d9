//! Tables I to V of the TacEva study.

use super::beside::{Digits, beside, cell};
use crate::catalogue::{Sensor, find};
use crate::results::Study;
use crate::scores::BARRED;
use crate::scores::ScoreTable;
use crate::table::{Align, Cell, Column, Row, Table, Words, latex_symbol, stacked};
use crate::table::{HEAD_PT, NAME_PT, SMALL_SIZE, VALUE_SIZE};
use crate::variables::VARIABLES;
use taceva_metrics::Better;

/// Table of the TacEva study, or the data that it lacks.
pub(super) struct Made {
    pub(super) number: usize,
    pub(super) table: Option<Table>,
    pub(super) needs: &'static str,
}

/// Force variables, then position variables: the order in the calibration and lighting tables.
const BLOCKS: [[&str; 2]; 2] = [["Fxy", "Fz"], ["Pxy", "Pz"]];
/// Names of the light scenes of the TacEva study.
pub(super) const SCENES: [&str; 4] = ["S1", "S2", "S3", "S4"];

/// All tables, in order.
pub(super) fn all(studies: &[Study], scores: &ScoreTable) -> [Made; 5] {
    let made = |number, table: Table, needs| Made {
        number,
        table: has_values(&table).then_some(table),
        needs,
    };
    let sheet = Sheet { studies, scores };
    [
        made(1, sheet.intrinsic(), "`intrinsic`: facts about the sensors"),
        made(2, sheet.calibration(), "`mae`, `r2` or `smape` of planes"),
        made(
            3,
            sheet.of_planes(
                "r_spatial",
                "Table III. Spatial robustness by plane (mm, N; less is better).",
            ),
            "`r_spatial` of planes",
        ),
        made(4, sheet.lighting(), "`r_light` of planes, by scene"),
        made(5, sheet.repeatability(), "`repeatability` of planes"),
    ]
}

/// True if a cell has a value of the given results. Values that the TacEva study prints do not count.
pub(super) fn has_values(table: &Table) -> bool {
    let mut cells = table.rows.iter().flat_map(|row| &row.cells);
    cells.any(|cell| matches!(cell, Cell::Estimate(of) if !matches!(of.formatted.value.as_str(), "" | "–")))
}

/// Results for the tables.
pub(super) struct Sheet<'a> {
    pub(super) studies: &'a [Study],
    pub(super) scores: &'a ScoreTable,
}

/// Value of `fact` in Table I of the TacEva study; `None` if absent.
fn fact_of_study(sensor: &Sensor, fact: &str) -> Option<f64> {
    let of = |metric: &str, channel: &str| {
        let mut results = sensor.results.iter().filter(|of| of.source == "study");
        let found = results.find(|of| of.metric == metric && of.channel == channel);
        found.map(|of| of.value)
    };
    match fact {
        "camera" => Some(of("intrinsic", "resolution")? / 1e6),
        "thickness" => of("intrinsic", "thickness").or_else(|| of("gel_thickness", "gel")),
        channel => of("intrinsic", channel),
    }
}

impl Sheet<'_> {
    pub(super) fn names(&self) -> &[String] {
        &self.scores.names
    }

    pub(super) fn cell(&self, at: usize, metric: &str, channel: &str, digits: Digits) -> Cell {
        cell(self.studies, self.scores, at, [metric, channel], digits)
    }

    /// Positions of the studies with a value of a metric.
    fn with(&self, metric: &str) -> Vec<usize> {
        let has = |at: &usize| {
            let mut rows = self.scores.rows.iter().filter(|row| row.metric == metric);
            rows.any(|row| {
                row.cells[*at]
                    .as_ref()
                    .is_some_and(|cell| cell.value.is_some())
            })
        };
        (0..self.studies.len()).filter(has).collect()
    }

    /// Table I: one row for each fact, one column for each sensor.
    fn intrinsic(&self) -> Table {
        let facts = [
            ("Resolution (MP)", "camera"),
            ("Thickness (mm)", "thickness"),
            ("Field of view (mm²)", "field_of_view"),
            ("Frame rate (Hz)", "frame_rate"),
        ];
        let mut table = self.table(
            "Table I. Intrinsic properties.",
            [column("property")]
                .into_iter()
                .chain(self.names().iter().map(|name| number_column(name))),
        );
        for (name, channel) in facts {
            let cells = self.studies.iter().map(|study| {
                let ours = study.score("intrinsic", channel);
                let ours = ours.and_then(|score| score.value.number());
                let sensor = find(&study.sensor);
                let printed = sensor.and_then(|sensor| fact_of_study(&sensor, channel));
                Cell::Estimate(beside(ours, printed, Digits::Significant(3)))
            });
            table.rows.push(Row {
                cells: [named(name)].into_iter().chain(cells).collect(),
                ..Row::default()
            });
        }
        table.note("Beside each value: the number that the study prints, and our value divided by it. Our results contain neither the thickness nor the pixels of the camera, because a scene may reduce the recorded frames.");
        table
    }

    /// Table II: forces, then positions; each with one row for each sensor and variable.
    fn calibration(&self) -> Table {
        let heads = [("mae", "MAE"), ("r2", "R²"), ("smape", "sMAPE")];
        let columns = heads.map(|(metric, name)| {
            let words = match metric {
                "r2" => Words::new(name).latex("$R^2$"),
                _ => Words::new(name),
            };
            let better = Better::of(metric).unwrap_or(Better::Described);
            let column = Column::new(words).align(Align::Right);
            column.direction(crate::table::Direction::Is(better))
        });
        // Symbols need no head in LaTeX, which leaves room for the values.
        let variable = Column::new(Words::new("variable").latex("")).align(Align::Left);
        let first = [column("sensor"), variable];
        let caption = "Table II. Calibration by sensor and variable (MAE in N and mm).";
        let mut table = self.table(caption, first.into_iter().chain(columns));
        for block in BLOCKS {
            for (at, name) in self.names().iter().enumerate() {
                for (line, channel) in block.into_iter().enumerate() {
                    let name = if line == 0 { name.as_str() } else { "" };
                    let variable = Words::new(channel).latex(latex_symbol(channel));
                    let cells = heads
                        .map(|(metric, _)| self.cell(at, metric, channel, Digits::Significant(4)));
                    let words = [named(name), Cell::text(variable)].into_iter();
                    table.rows.push(Row {
                        cells: words.chain(cells).collect(),
                        begins_group: at == 0 && line == 0 && block[0] == "Pxy",
                        ..Row::default()
                    });
                }
            }
        }
        self.explain(&mut table);
        table
    }

    /// Table with one row for each plane and one column for each sensor.
    fn of_planes(&self, metric: &str, caption: &str) -> Table {
        let sensors = self.names().iter().map(|name| number_column(name));
        let mut table = self.table(caption, [column("plane")].into_iter().chain(sensors));
        for channel in VARIABLES {
            let plane = Words::new(channel).latex(latex_symbol(channel));
            let cells = (0..self.studies.len())
                .map(|at| self.cell(at, metric, channel, Digits::Significant(3)));
            table.rows.push(Row {
                cells: [Cell::text(plane)].into_iter().chain(cells).collect(),
                ..Row::default()
            });
        }
        self.explain(&mut table);
        table
    }

    /// Table IV: one row for each scene and one row for the mean; one column for each plane and sensor that ambient light reaches.
    fn lighting(&self) -> Table {
        let lit = self.with("r_light");
        let pairs = BLOCKS
            .iter()
            .flatten()
            .flat_map(|channel| lit.iter().map(move |at| (*channel, *at)));
        let pairs: Vec<(&str, usize)> = pairs.collect();
        let columns = pairs.iter().map(|(channel, at)| {
            let name = &self.names()[*at];
            let latex = format!(
                "\\shortstack[r]{{{}\\\\{}}}",
                latex_symbol(channel),
                stacked(name, HEAD_PT, SMALL_SIZE, 'r')
            );
            Column::new(Words::new(format!("{channel} {name}")).latex(latex)).align(Align::Right)
        });
        let caption = "Table IV. Robustness to lighting by scene (more is better).";
        let mut table = self.table(caption, [column("scene")].into_iter().chain(columns));
        for scene in SCENES {
            let metric = format!("r_light.scene:{scene}");
            let cells = pairs
                .iter()
                .map(|(channel, at)| self.cell(*at, &metric, channel, Digits::Percent));
            table.rows.push(Row {
                cells: [Cell::text(scene)].into_iter().chain(cells).collect(),
                ..Row::default()
            });
        }
        let means = pairs
            .iter()
            .map(|(channel, at)| self.cell(*at, "r_light", channel, Digits::Percent));
        table.rows.push(Row {
            cells: [Cell::text("Mean")].into_iter().chain(means).collect(),
            begins_group: true,
            ..Row::default()
        });
        self.explain(&mut table);
        table
    }

    /// Table V: one row for each sensor, one column for each plane.
    fn repeatability(&self) -> Table {
        let planes = VARIABLES.map(|channel| {
            Column::new(Words::new(channel).latex(latex_symbol(channel))).align(Align::Right)
        });
        let caption = "Table V. Repeatability by plane (mm, N; less is better).";
        let mut table = self.table(caption, [column("sensor")].into_iter().chain(planes));
        for (at, name) in self.names().iter().enumerate() {
            let cells = VARIABLES
                .map(|channel| self.cell(at, "repeatability", channel, Digits::Significant(3)));
            table.rows.push(Row {
                cells: [named(name)].into_iter().chain(cells).collect(),
                ..Row::default()
            });
        }
        self.explain(&mut table);
        table
    }

    pub(super) fn table(&self, caption: &str, columns: impl Iterator<Item = Column>) -> Table {
        let simulated = self
            .studies
            .iter()
            .filter(|study| study.is_simulated())
            .count();
        let whose = match simulated {
            0 => "",
            _ if simulated == self.studies.len() => " Our samples are simulated.",
            _ => " Some of our samples are simulated.",
        };
        Table::new(format!("{caption}{whose}"), columns)
    }

    /// Adds notes that explain values, bold type and marks.
    pub(super) fn explain(&self, table: &mut Table) {
        let cells = || {
            let cells = table.rows.iter().flat_map(|row| &row.cells);
            cells.filter_map(|cell| match cell {
                Cell::Estimate(estimate) => Some(estimate),
                _ => None,
            })
        };
        let mut said = Vec::new();
        if cells().any(|cell| cell.remark.is_some()) {
            said.push(
                "Beside each value: the number that the study prints, and our value divided by it.",
            );
        }
        if cells().any(|cell| cell.is_best) {
            said.push(
                "Bold: better than every other sensor at a level of 5 % after Holm's adjustment.",
            );
        }
        if cells().any(|cell| cell.mark == BARRED) {
            said.push("†: not better than predicting the mean, or not above chance.");
        }
        if !said.is_empty() {
            table.note(said.join(" "));
        }
    }
}

pub(super) fn column(name: &str) -> Column {
    Column::new(name).align(Align::Left)
}

/// Column of a sensor. LaTeX writes a long name in several lines.
pub(super) fn number_column(name: &str) -> Column {
    let latex = stacked(name, HEAD_PT, SMALL_SIZE, 'r');
    Column::new(Words::new(name).latex(latex)).align(Align::Right)
}

/// Cell that names a row. LaTeX writes a long name in several lines.
pub(super) fn named(name: &str) -> Cell {
    Cell::text(Words::new(name).latex(stacked(name, NAME_PT, VALUE_SIZE, 'l')))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_sensor_of_the_study_has_its_printed_numbers() {
        let study = |sensor: &str| Study {
            sensor: sensor.to_owned(),
            ..Study::default()
        };
        for sensor in super::super::beside::SENSORS {
            for channel in VARIABLES {
                for metric in ["mae", "r2", "smape", "r_spatial"] {
                    let found = super::super::beside::printed(&study(sensor), metric, channel);
                    assert!(found.is_some(), "{sensor} {metric} {channel}");
                }
            }
        }
    }
}
