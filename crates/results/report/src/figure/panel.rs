//! Plotting area with two axes.

use super::canvas::{Anchor, Canvas, Ink, Label, Points, Stroke, width_of};
use super::scale::Scale;
use super::words::short;

/// Rectangle on a canvas, in canvas units.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Area {
    pub(crate) left: f64,
    pub(crate) top: f64,
    pub(crate) width: f64,
    pub(crate) height: f64,
}

impl Area {
    pub(crate) fn right(&self) -> f64 {
        self.left + self.width
    }

    pub(crate) fn bottom(&self) -> f64 {
        self.top + self.height
    }

    /// Horizontal range from left to right.
    pub(crate) fn across(&self) -> [f64; 2] {
        [self.left, self.right()]
    }

    /// Vertical range from bottom to top.
    pub(crate) fn upwards(&self) -> [f64; 2] {
        [self.bottom(), self.top]
    }
}

/// Titles of a panel and its axes.
#[derive(Clone, Debug, Default)]
pub(crate) struct Axes {
    pub(crate) title: String,
    pub(crate) x: String,
    pub(crate) y: String,
}

/// Area with two scales.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Panel {
    pub(crate) area: Area,
    pub(crate) x: Scale,
    pub(crate) y: Scale,
}

impl Panel {
    /// Canvas position of a pair of values.
    pub(crate) fn at(&self, x: f64, y: f64) -> [f64; 2] {
        [self.x.at(x), self.y.at(y)]
    }

    /// Draws grid, ticks and titles. Call before drawing the data.
    pub(crate) fn axes(&self, axes: &Axes, canvas: &mut Canvas) {
        let (top, bottom) = (self.area.top, self.area.bottom());
        let room = (self.area.width / 62.0).clamp(2.0, 8.0);
        for tick in self.x.ticks(room) {
            let x = self.x.at(tick.value);
            canvas.line([x, top], [x, bottom], Stroke::thin(Ink::Grid));
            canvas.label(Label::new([x, bottom + 15.0], tick.label, Anchor::Middle));
        }
        self.frame(axes, bottom + 32.0, canvas);
    }

    /// Same as [`Panel::axes`], with one column on the x axis for each of `names`. Names are vertical if they do not fit side by side.
    pub(crate) fn axes_of_names(&self, axes: &Axes, names: &[String], canvas: &mut Canvas) {
        let (top, bottom) = (self.area.top, self.area.bottom());
        let room = self.area.width / names.len().max(1) as f64;
        let is_narrow = names.iter().any(|name| width_of(name, 11.0) > room - 3.0);
        for (at, name) in names.iter().enumerate() {
            if at > 0 {
                let edge = self.x.at(at as f64 - 0.5);
                canvas.line([edge, top], [edge, bottom], Stroke::thin(Ink::Grid));
            }
            let x = self.x.at(at as f64);
            let mut label = Label::new([x, bottom + 15.0], short(name, 24), Anchor::Middle);
            if is_narrow {
                label = Label::new([x + 4.0, bottom + 5.0], short(name, 10), Anchor::End);
                label.upwards = true;
            }
            canvas.label(label);
        }
        let below = if is_narrow { 78.0 } else { 32.0 };
        self.frame(axes, bottom + below, canvas);
    }

    /// Draws the y ticks, both axis lines and all titles. `below` is the height of the x title.
    fn frame(&self, axes: &Axes, below: f64, canvas: &mut Canvas) {
        let Area { left, top, .. } = self.area;
        let (right, bottom) = (self.area.right(), self.area.bottom());
        for tick in self.y.ticks((self.area.height / 34.0).clamp(2.0, 8.0)) {
            let y = self.y.at(tick.value);
            canvas.line([left, y], [right, y], Stroke::thin(Ink::Grid));
            canvas.label(Label::new([left - 6.0, y + 4.0], tick.label, Anchor::End));
        }
        canvas.line([left, bottom], [right, bottom], Stroke::thin(Ink::Muted));
        canvas.line([left, top], [left, bottom], Stroke::thin(Ink::Muted));
        if !axes.title.is_empty() {
            let title = Label::new([left, top - 9.0], axes.title.clone(), Anchor::Start);
            canvas.label(title.heading());
        }
        let middle = left + self.area.width / 2.0;
        canvas.label(Label::new([middle, below], axes.x.clone(), Anchor::Middle));
        let mut y = Label::new(
            [left - 44.0, top + self.area.height / 2.0],
            axes.y.clone(),
            Anchor::Middle,
        );
        y.upwards = true;
        canvas.label(y);
    }

    /// Draws a line through points with a y value. Points without a y value interrupt the line.
    pub(crate) fn curve(
        &self,
        levels: impl Iterator<Item = (f64, Option<f64>)>,
        stroke: Stroke,
        canvas: &mut Canvas,
    ) {
        let mut run: Vec<[f64; 2]> = Vec::new();
        for (x, y) in levels {
            match y {
                Some(y) => run.push(self.at(x, y)),
                None => self.end_run(&mut run, stroke, canvas),
            }
        }
        self.end_run(&mut run, stroke, canvas);
    }

    /// Draws a section of a line without gaps. A section of one point becomes a dot.
    fn end_run(&self, run: &mut Vec<[f64; 2]>, stroke: Stroke, canvas: &mut Canvas) {
        if let [alone] = run[..] {
            let points = Points {
                at: vec![alone],
                words: Vec::new(),
            };
            canvas.points(points, stroke.ink, 1.8, 1.0);
        }
        canvas.path(std::mem::take(run), stroke);
    }

    /// Draws the band between two curves. Points without a band interrupt the band.
    pub(crate) fn band(
        &self,
        levels: impl Iterator<Item = (f64, Option<[f64; 2]>)>,
        ink: Ink,
        canvas: &mut Canvas,
    ) {
        let mut run: Vec<(f64, [f64; 2])> = Vec::new();
        let draw = |run: &mut Vec<(f64, [f64; 2])>, canvas: &mut Canvas| {
            if run.len() > 1 {
                let low = run.iter().map(|(x, [low, _])| self.at(*x, *low));
                let high = run.iter().rev().map(|(x, [_, high])| self.at(*x, *high));
                canvas.area(low.chain(high).collect(), ink, 0.18);
            }
            run.clear();
        };
        for (x, ends) in levels {
            match ends {
                Some(ends) => run.push((x, ends)),
                None => draw(&mut run, canvas),
            }
        }
        draw(&mut run, canvas);
    }
}
