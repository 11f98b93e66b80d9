//! Curves of several sensors in one panel for each channel.

use taceva_core::Unit;

use crate::figure::{Area, Axes, Canvas, Figure, Grid, Ink, Panel, Points, Scale, Stroke, extent};
use crate::number::numeral;
use crate::results::Study;

/// Curve of one sensor.
pub(super) struct Line {
    /// Index of the study, from 0.
    pub(super) study: usize,
    pub(super) levels: Vec<Level>,
}

/// Point of a curve: its y value over `n` samples at `x`, and its band.
#[derive(Clone)]
pub(super) struct Level {
    pub(super) x: f64,
    pub(super) y: Option<f64>,
    pub(super) n: u64,
    pub(super) band: Option<[f64; 2]>,
}

/// Panel of curves.
pub(super) struct Sheet {
    pub(super) title: String,
    pub(super) x: String,
    pub(super) y: String,
    pub(super) y_unit: Unit,
    /// Least range of the y axis. Values outside widen the range.
    pub(super) least: Option<[f64; 2]>,
    pub(super) ways: Ways,
    pub(super) lines: Vec<Line>,
}

/// Scales of the axes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Ways {
    /// Linear axes.
    Straight,
    /// Logarithmic x axis.
    LogarithmicX,
}

/// Texts of a figure.
pub(super) struct Words<'a> {
    pub(super) id: &'a str,
    pub(super) title: &'a str,
    pub(super) caption: String,
    pub(super) description: String,
}

/// Draws panels, `columns` in a row, below one legend; `None` without panels.
pub(super) fn draw(
    sheets: &[Sheet],
    studies: &[Study],
    columns: usize,
    words: Words<'_>,
    room: Option<f64>,
) -> Option<Figure> {
    if sheets.is_empty() {
        return None;
    }
    let names = crate::names::names(studies);
    let columns = columns.min(sheets.len()).max(1);
    let first = panel_size(columns);
    let grid = Grid::new(sheets.len(), columns, first, [66.0, 78.0]).within(room, 16.0);
    let mut canvas = grid.canvas([16.0, 42.0]);
    let is_drawn = |at: &usize| {
        let mut lines = sheets.iter().flat_map(|sheet| &sheet.lines);
        lines.any(|line| line.study == *at)
    };
    let drawn = (0..names.len()).filter(is_drawn);
    let legend: Vec<(usize, String)> = drawn.map(|at| (at, names[at].clone())).collect();
    if names.len() > 1 {
        canvas.legend([first.left, 16.0], &legend);
    }
    for (position, sheet) in sheets.iter().enumerate() {
        let area = grid.area(position);
        sheet.draw(area, &names, &mut canvas);
    }
    Some(Figure {
        id: words.id.to_owned(),
        title: words.title.to_owned(),
        caption: words.caption,
        description: words.description,
        canvas,
    })
}

/// Size and place of the first panel in a row of `columns` that fills the page width.
fn panel_size(columns: usize) -> Area {
    let (width, height) = match columns {
        1 => (620.0, 260.0),
        2 => (330.0, 220.0),
        _ => (216.0, 168.0),
    };
    Area {
        left: 58.0,
        top: 54.0,
        width,
        height,
    }
}

impl Sheet {
    fn draw(&self, area: Area, names: &[String], canvas: &mut Canvas) {
        let levels = || self.lines.iter().flat_map(|line| &line.levels);
        let seen = levels().filter(|level| level.y.is_some());
        let Some(x) = extent(seen.map(|level| level.x)) else {
            return;
        };
        let bands = levels().filter_map(|level| level.band).flatten();
        let ends = self.least.iter().flatten().copied();
        let y = extent(
            levels()
                .filter_map(|level| level.y)
                .chain(bands)
                .chain(ends),
        );
        let y = y.unwrap_or([0.0, 1.0]);
        let panel = Panel {
            area,
            x: match self.ways {
                Ways::LogarithmicX => Scale::logarithmic(x, area.across()),
                Ways::Straight => Scale::padded(x, area.across()),
            },
            y: Scale::round(y, area.upwards()),
        };
        let axes = Axes {
            title: self.title.clone(),
            x: self.x.clone(),
            y: self.y.clone(),
        };
        panel.axes(&axes, canvas);
        for line in &self.lines {
            let bands = line.levels.iter().map(|level| (level.x, level.band));
            panel.band(bands, Ink::Series(line.study), canvas);
        }
        for line in &self.lines {
            let values = line.levels.iter().map(|level| (level.x, level.y));
            panel.curve(values, Stroke::series(line.study), canvas);
        }
        for line in &self.lines {
            let hovers = self.hovers(line, names, &panel);
            // Small dots keep the line visible.
            let radius = if hovers.at.len() > 30 { 1.3 } else { 2.2 };
            canvas.points(hovers, Ink::Series(line.study), radius, 1.0);
        }
    }

    fn hovers(&self, line: &Line, names: &[String], panel: &Panel) -> Points {
        let mut points = Points::default();
        let unit = match self.y_unit {
            Unit::One => String::new(),
            unit => format!(" {unit}"),
        };
        for level in &line.levels {
            let Some(y) = level.y else { continue };
            points.at.push(panel.at(level.x, y));
            let band = level.band.map_or_else(String::new, |[low, high]| {
                format!(", {} … {}", numeral(low), numeral(high))
            });
            points.words.push(format!(
                "{}, {} {}: {}{unit}{band}, n = {}",
                names[line.study],
                self.x,
                numeral(level.x),
                numeral(y),
                level.n
            ));
        }
        points
    }
}
