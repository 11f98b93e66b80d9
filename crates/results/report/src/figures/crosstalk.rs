//! Crosstalk between channels, as a matrix of colours.

use taceva_metrics::Matrix;

use crate::figure::{Anchor, Area, Canvas, Figure, Grid, Ink, Label, diverging, short};
use crate::number::{fixed, minus, numeral};
use crate::results::Study;
use taceva_results::Value;

/// Greatest number of names in a readable matrix.
const MOST: usize = 16;

pub(super) fn draw(studies: &[Study], room: Option<f64>) -> Option<Figure> {
    let names = crate::names::names(studies);
    let mut matrices = Vec::new();
    for (study, name) in studies.iter().zip(&names) {
        let variant = study
            .score("crosstalk", "all")
            .and_then(|score| score.variant("matrix"));
        let is_readable = |matrix: &Matrix| {
            (1..=MOST).contains(&matrix.rows.len()) && (1..=MOST).contains(&matrix.columns.len())
        };
        match variant.map(|variant| &variant.value) {
            Some(Value::Matrix(matrix)) if is_readable(matrix) => matrices.push((matrix, name)),
            _ => {}
        }
    }
    if matrices.is_empty() {
        return None;
    }
    let first = Area {
        left: 66.0,
        top: 58.0,
        width: 300.0,
        height: 216.0,
    };
    let grid = Grid::new(matrices.len(), 2, first, [86.0, 84.0]).within(room, 16.0);
    let mut canvas = grid.canvas([16.0, 16.0]);
    for (position, (matrix, name)) in matrices.iter().enumerate() {
        let area = grid.area(position);
        cells(matrix, name, area, &mut canvas);
    }
    Some(Figure {
        id: "crosstalk".to_owned(),
        title: "Crosstalk between channels".to_owned(),
        caption: "Change of the predicted channel (row) over the range of the true channel (column), both as shares of their ranges. A sensor without crosstalk has 1 on the diagonal and 0 elsewhere. Colours end at ±1.".to_owned(),
        description: format!("Matrices of crosstalk of {}.", crate::names::listed(&names)),
        canvas,
    })
}

fn cells(matrix: &Matrix, name: &str, area: Area, canvas: &mut Canvas) {
    let heading = Label::new([area.left, area.top - 28.0], short(name, 40), Anchor::Start);
    canvas.label(heading.heading());
    let [width, height] = [
        area.width / matrix.columns.len() as f64,
        area.height / matrix.rows.len() as f64,
    ];
    for (column, name) in matrix.columns.iter().enumerate() {
        let x = area.left + (column as f64 + 0.5) * width;
        let at = [x, area.top - 7.0];
        canvas.label(Label::new(
            at,
            format!("true {}", short(name, 8)),
            Anchor::Middle,
        ));
    }
    for (row, (name, values)) in matrix.rows.iter().zip(&matrix.values).enumerate() {
        let top = area.top + row as f64 * height;
        let at = [area.left - 7.0, top + height / 2.0 + 4.0];
        canvas.label(Label::new(at, short(name, 9), Anchor::End));
        for (column, value) in values.iter().enumerate() {
            let Some(value) = value else { continue };
            let left = area.left + column as f64 * width;
            let words = format!(
                "predicted {} over true {}: {}",
                short(name, 16),
                short(&matrix.columns[column], 16),
                numeral(*value)
            );
            let place = [left + 1.0, top + 1.0, width - 2.0, height - 2.0];
            canvas.fill(place, Ink::Rgb(diverging(*value)), words);
            let middle = [left + width / 2.0, top + height / 2.0 + 4.0];
            let mut label = Label::new(middle, minus(&fixed(*value, 2)), Anchor::Middle);
            label.ink = Ink::Text;
            canvas.cell_label(label);
        }
    }
}
