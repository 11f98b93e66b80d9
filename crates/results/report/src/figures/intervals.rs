//! Values of one metric with their intervals: one column for each channel, one dot for each study.

use taceva_core::distinct;
use taceva_metrics::plane_of;
use taceva_results::{Interval, Score, full_name};

use crate::figure::{
    Area, Axes, Canvas, Figure, Grid, Ink, Panel, Points, Scale, Stroke, axis_label, directed,
    extent, short,
};
use crate::names::{listed, names};
use crate::number::with_interval;
use crate::results::Study;

/// Share of a column that its dots span.
const SPAN: f64 = 0.6;

/// Value of one study, as verdicts use it.
struct Dot {
    study: usize,
    value: f64,
    score: Score,
}

/// Figure of `metric` with one panel for each unit; `None` without a value. A plane replaces its axes.
pub(crate) fn intervals(studies: &[Study], metric: &str) -> Option<Figure> {
    let names = names(studies);
    let mut dots: Vec<Dot> = Vec::new();
    for (study, own) in studies.iter().enumerate() {
        let scores = own.of_metric(metric).map(Score::deciding);
        dots.extend(scores.filter_map(|score| {
            Some(Dot {
                study,
                value: score.value.number()?,
                score,
            })
        }));
    }
    let channels = distinct(dots.iter().map(|dot| dot.score.channel.clone()));
    let has_plane = |channel: &str| {
        plane_of(channel).is_some_and(|plane| channels.iter().any(|own| own == plane))
    };
    dots.retain(|dot| !has_plane(&dot.score.channel));
    let variant = dots.first()?.score.decided_by();
    let named = full_name(metric, variant.map(|variant| variant.name.as_str()));
    let counts = dots.iter().map(|dot| dot.score.n);
    let n = match (counts.clone().min()?, counts.max()?) {
        (0, _) => String::new(),
        (least, most) if least == most => format!(" n is {least}."),
        (least, most) => format!(" n is {least} to {most}."),
    };
    let units = distinct(dots.iter().map(|dot| dot.score.unit));
    let first = Area {
        left: 62.0,
        // Below a legend with one row for each name.
        top: 14.0 + 16.0 * names.len() as f64,
        width: 300.0,
        height: 200.0,
    };
    let grid = Grid::new(units.len(), 2, first, [72.0, 100.0]);
    let mut canvas = grid.canvas([20.0, 84.0]);
    let legend: Vec<(usize, String)> = names.iter().cloned().enumerate().collect();
    canvas.dot_legend([12.0, 18.0], &legend);
    for (position, unit) in units.iter().enumerate() {
        let own: Vec<&Dot> = dots.iter().filter(|dot| dot.score.unit == *unit).collect();
        panel(&own, &named, &names, grid.area(position), &mut canvas);
    }
    Some(Figure {
        id: format!("intervals-{metric}"),
        title: format!("{named} with 95 % intervals"),
        caption: format!(
            "Dot: value. Line: its 95 % interval; a dot without a line has no interval.{n}"
        ),
        description: format!("Values of {named} with intervals, of {}.", listed(&names)),
        canvas,
    })
}

/// Draws the `dots` of one unit, of the metric or variant `named`.
fn panel(dots: &[&Dot], named: &str, names: &[String], area: Area, canvas: &mut Canvas) {
    let channels = distinct(dots.iter().map(|dot| dot.score.channel.clone()));
    let ends = dots.iter().filter_map(|dot| dot.ends()).flatten();
    let reach = extent(ends.chain(dots.iter().map(|dot| dot.value)));
    let (Some([low, high]), Some(one)) = (reach, dots.first()) else {
        return;
    };
    let panel = Panel {
        area,
        x: Scale::linear([-0.5, channels.len() as f64 - 0.5], area.across()),
        y: Scale::round([low.min(0.0), high.max(0.0)], area.upwards()),
    };
    let axes = Axes {
        y: directed(&axis_label(named, one.score.unit), &one.score.metric),
        ..Axes::default()
    };
    panel.axes_of_names(&axes, &channels, canvas);
    for dot in dots {
        let column = channels.iter().position(|own| *own == dot.score.channel);
        let aside = (dot.study as f64 + 0.5) / names.len() as f64 - 0.5;
        let at = panel.at(column.unwrap_or_default() as f64 + SPAN * aside, dot.value);
        if let Some(ends) = dot.ends() {
            let ends = ends.map(|end| panel.y.at(end).clamp(area.top, area.bottom()));
            let stroke = Stroke {
                width: 1.4,
                ..Stroke::thin(Ink::Series(dot.study))
            };
            canvas.line([at[0], ends[0]], [at[0], ends[1]], stroke);
        }
        // Published numbers rarely state n.
        let n = match dot.score.n {
            0 => String::new(),
            n => format!(", n = {n}"),
        };
        let words = format!(
            "{}, {}: {}{n}",
            short(&names[dot.study], 40),
            dot.score.channel,
            with_interval(&dot.score)
        );
        let point = Points {
            at: vec![at],
            words: vec![words],
        };
        canvas.points(point, Ink::Series(dot.study), 4.0, 1.0);
    }
}

impl Dot {
    /// Both ends of the interval; `None` without an interval.
    fn ends(&self) -> Option<[f64; 2]> {
        self.score.interval.as_ref().and_then(Interval::ends)
    }
}
