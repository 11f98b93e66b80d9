//! Values that the TacEva study publishes in its figures, next to values of this program.

use std::collections::BTreeMap;

use taceva_metrics::SensorFacts;

use super::beside::{Digits, beside, printed};
use super::tables::{SCENES, Sheet, column, has_values, named, number_column};
use crate::results::Study;
use crate::scores::ScoreTable;
use crate::table::{Cell, NAME_PT, Row, Table, VALUE_SIZE, Words, latex_symbol, stacked};
use crate::variables::VARIABLES;

/// Sentence on the figures of the TacEva study without numbers.
pub(super) const UNPRINTED: &str = "The study prints no numbers with its figures 6a, 7a, 7b and 8a to 8c. Its table V has the means of figure 7b. Its tables and figures 3c and 4 have the quantities of figure 8.";

/// A value of a figure: its name, its score, and the printed digits.
struct Quantity {
    name: Words,
    metric: &'static str,
    channel: &'static str,
    digits: Digits,
}

/// One table for each figure, with values of this program, values of the TacEva study, and the name of the figure.
pub(super) fn all(studies: &[Study], scores: &ScoreTable) -> Vec<(String, Table)> {
    let sheet = Sheet { studies, scores };
    let quantity = |name: &str, metric, channel, digits| Quantity {
        name: Words::new(name).latex(stacked(name, NAME_PT, VALUE_SIZE, 'l')),
        metric,
        channel,
        digits,
    };
    let made = [
        (
            "figure-3c",
            sheet.of_figure(
                "Numbers of figure 3c: success rate of gratings to within 0.05 mm (more is better).",
                &[
                    quantity("lines", "sr", "line", Digits::Percent),
                    quantity("dots", "sr", "dot", Digits::Percent),
                    quantity("both", "sr", "all", Digits::Percent),
                ],
            ),
        ),
        (
            "figure-4",
            sheet.of_figure(
                "Numbers of figure 4: sensitivity and uniformity (more is better).",
                &[
                    quantity("sensitivity (mm/N)", "sensitivity", "Fz", Digits::Significant(4)),
                    quantity("uniformity", "uniformity", "Fz", Digits::Significant(3)),
                ],
            ),
        ),
        (
            "figure-5-radius",
            sheet.of_figure(
                "Numbers of figure 5: standard deviation of errors over the radius (mm, N; less is better).",
                &of_planes("r_spatial.std_distance"),
            ),
        ),
        (
            "figure-5-depth",
            sheet.of_figure(
                "Numbers of figure 5: standard deviation of errors over the depth (mm, N; less is better).",
                &of_planes("r_spatial.std_depth"),
            ),
        ),
        ("figure-6b", sheet.grey_levels()),
    ];
    let made = made.into_iter();
    let made = made.filter(|(_, table)| has_values(table) && has_printed(table));
    made.map(|(name, table)| (name.to_owned(), table)).collect()
}

/// Quantities of one metric, one for each plane.
fn of_planes(metric: &'static str) -> [Quantity; 4] {
    VARIABLES.map(|channel| Quantity {
        name: Words::new(channel).latex(latex_symbol(channel)),
        metric,
        channel,
        digits: Digits::Significant(3),
    })
}

/// True if a cell has a value that the TacEva study prints.
fn has_printed(table: &Table) -> bool {
    let mut cells = table.rows.iter().flat_map(|row| &row.cells);
    cells.any(|cell| matches!(cell, Cell::Estimate(estimate) if estimate.remark.is_some()))
}

impl Sheet<'_> {
    /// Table with one row for each quantity and one column for each sensor.
    fn of_figure(&self, caption: &str, quantities: &[Quantity]) -> Table {
        let rows = quantities.iter().map(|of| {
            let cells = 0..self.studies.len();
            let cells = cells.map(|at| self.cell(at, of.metric, of.channel, of.digits));
            let name = [Cell::text(of.name.clone())].into_iter();
            name.chain(cells).collect::<Vec<Cell>>()
        });
        self.figure(caption, rows.collect())
    }

    /// Mean grey level of each light scene.
    fn grey_levels(&self) -> Table {
        let levels: Vec<BTreeMap<&str, f64>> = self.studies.iter().map(grey_levels).collect();
        let scenes = [SensorFacts::REFERENCE_SCENE].into_iter().chain(SCENES);
        let rows = scenes.map(|scene| {
            let cells = self.studies.iter().zip(&levels).map(|(study, levels)| {
                let ours = levels.get(scene).copied();
                let theirs = printed(study, "mean_gray", scene);
                Cell::Estimate(beside(ours, theirs, Digits::Significant(2)))
            });
            let name = [named(scene)].into_iter();
            name.chain(cells).collect::<Vec<Cell>>()
        });
        self.figure(
            "Numbers of figure 6b: mean grey level by scene of light.",
            rows.collect(),
        )
    }

    fn figure(&self, caption: &str, rows: Vec<Vec<Cell>>) -> Table {
        let sensors = self.names().iter().map(|name| number_column(name));
        let mut table = self.table(caption, [column("quantity")].into_iter().chain(sensors));
        table.rows = rows
            .into_iter()
            .map(|cells| Row {
                cells,
                ..Row::default()
            })
            .collect();
        self.explain(&mut table);
        table
    }
}

/// Mean grey level of the samples of each scene.
fn grey_levels(study: &Study) -> BTreeMap<&str, f64> {
    let Some(samples) = study.samples.as_ref().filter(|of| of.has("protocol")) else {
        return BTreeMap::new();
    };
    let mut sums: BTreeMap<&str, [f64; 2]> = BTreeMap::new();
    for row in samples.of_protocol("light-sweep") {
        let scene = samples.word("scene", row);
        if let Some((scene, grey)) = scene.zip(samples.number("intensity", row)) {
            let [sum, count] = sums.entry(scene).or_default();
            *sum += grey;
            *count += 1.0;
        }
    }
    let means = sums.into_iter();
    means
        .map(|(scene, [sum, count])| (scene, sum / count))
        .collect()
}
