//! Run time against error of models: one panel for each channel, with its Pareto front.

use taceva_core::counted;

use crate::figure::{
    Area, Axes, Canvas, Figure, Grid, Ink, Panel, Points, Scale, Stroke, axis_label, beside,
    extent, short,
};
use crate::number::numeral;
use crate::results::{BenchRecording, ChannelError, ModelBench, ModelRow};

/// Ratio of greatest to least error above which the axis is logarithmic.
const FAR: f64 = 8.0;
const MILLI: f64 = 1e3;

/// A model in a panel.
struct Dot<'a> {
    row: &'a ModelRow,
    error: &'a ChannelError,
    is_on_front: bool,
}

/// Figure of prediction time against mean absolute error of each model; `None` if no model has an error.
pub fn model_bench(bench: &ModelBench) -> Option<Figure> {
    let time = "time from frame to prediction (ms)";
    let (canvas, fronts) = draw(bench, time)?;
    Some(Figure {
        id: "models".to_owned(),
        title: "Run time against error of models".to_owned(),
        caption: caption(bench),
        description: format!("On the Pareto front by channel. {fronts}."),
        canvas,
    })
}

/// Draws one panel for each channel. Also returns a sentence on the Pareto fronts. `None` without channels.
fn draw(bench: &ModelBench, time: &str) -> Option<(Canvas, String)> {
    let channels = bench.channels();
    if channels.is_empty() {
        return None;
    }
    let first = Area {
        left: 62.0,
        top: 30.0,
        width: 330.0,
        height: 240.0,
    };
    let grid = Grid::new(channels.len(), 2, first, [72.0, 78.0]);
    let mut canvas = grid.canvas([20.0, 42.0]);
    let mut fronts = Vec::new();
    for (position, channel) in channels.iter().enumerate() {
        let dots = dots(bench, channel);
        let names: Vec<String> = dots
            .iter()
            .filter(|dot| dot.is_on_front)
            .map(|dot| dot.row.model.clone())
            .collect();
        fronts.push(format!("{channel}: {}", crate::names::listed(&names)));
        panel(&dots, [channel, time], grid.area(position), &mut canvas);
    }
    Some((canvas, fronts.join("; ")))
}

/// Caption remark on simulated samples.
fn simulated(is_simulated: bool, recording: &BenchRecording) -> String {
    match is_simulated {
        true => format!(
            " Nothing here was measured: the samples are {}.",
            recording.source
        ),
        false => String::new(),
    }
}

fn caption(bench: &ModelBench) -> String {
    let recording = &bench.recording;
    let simulated = simulated(bench.is_simulated(), recording);
    let machine = &bench.machine;
    let threads = counted(machine.threads, "thread");
    format!(
        "Mean absolute error on {}, with its 95 % interval by contact point, over the time from one frame to its prediction. {}, {}; fitted on {}, split {}; {}, {threads}. Filled and joined: on the Pareto front, where no other model is both faster and more accurate.{simulated}",
        counted(recording.test, "sample"),
        recording.name,
        recording.sensor,
        counted(recording.train, "sample"),
        recording.split,
        machine.cpu
    )
}

/// Models with an error of `channel` and a positive time.
fn dots<'a>(bench: &'a ModelBench, channel: &str) -> Vec<Dot<'a>> {
    let found = bench.rows.iter().filter(|row| row.latency_s > 0.0);
    let found: Vec<(&ModelRow, &ChannelError)> = found
        .filter_map(|row| Some((row, row.error(channel)?)))
        .collect();
    let beats = |(a, error): &(&ModelRow, &ChannelError),
                 (b, than): &(&ModelRow, &ChannelError)| {
        let is_no_worse = a.latency_s <= b.latency_s && error.mae <= than.mae;
        is_no_worse && (a.latency_s < b.latency_s || error.mae < than.mae)
    };
    let dot = |one: &(&'a ModelRow, &'a ChannelError)| Dot {
        row: one.0,
        error: one.1,
        is_on_front: !found.iter().any(|other| beats(other, one)),
    };
    found.iter().map(dot).collect()
}

fn panel(dots: &[Dot<'_>], [channel, time]: [&str; 2], area: Area, canvas: &mut Canvas) {
    let times = extent(dots.iter().map(|dot| dot.row.latency_s * MILLI));
    let errors = extent(dots.iter().map(|dot| dot.error.mae));
    let (Some([fast, slow]), Some([low, high]), Some(one)) = (times, errors, dots.first()) else {
        return;
    };
    let ends = dots.iter().filter_map(|dot| dot.error.ci95).flatten();
    let y = match low > 0.0 && high / low > FAR {
        true => Scale::logarithmic([low / 1.6, high * 1.6], area.upwards()),
        false => {
            let highest = ends.fold(high, f64::max);
            Scale::round([0.0, highest * 1.05], area.upwards())
        }
    };
    let panel = Panel {
        area,
        x: Scale::logarithmic([fast / 2.0, slow * 2.0], area.across()),
        y,
    };
    let axes = Axes {
        title: channel.to_owned(),
        x: time.to_owned(),
        y: axis_label("MAE", one.error.unit),
    };
    panel.axes(&axes, canvas);
    front(dots, &panel, canvas);
    let mut names = Vec::new();
    for dot in dots {
        let at = panel.at(dot.row.latency_s * MILLI, dot.error.mae);
        names.push((at, short(&dot.row.model, 24)));
        mark(dot, at, &panel, canvas);
    }
    for label in beside(&names, area) {
        canvas.label(label);
    }
}

/// Draws a dot with the interval of its error.
fn mark(dot: &Dot<'_>, at: [f64; 2], panel: &Panel, canvas: &mut Canvas) {
    if let Some(ends) = dot.error.ci95 {
        let [top, bottom] = [panel.area.top, panel.area.bottom()];
        let ends = ends.map(|end| panel.y.at(end).clamp(top, bottom));
        let stroke = Stroke {
            width: 1.4,
            ..Stroke::thin(Ink::Series(0))
        };
        canvas.line([at[0], ends[0]], [at[0], ends[1]], stroke);
    }
    let one = |words: Vec<String>| Points {
        at: vec![at],
        words,
    };
    canvas.points(one(vec![words(dot)]), Ink::Series(0), 5.0, 1.0);
    if !dot.is_on_front {
        canvas.points(one(Vec::new()), Ink::Paper, 3.5, 1.0);
    }
}

fn words(dot: &Dot<'_>) -> String {
    let ChannelError { unit, mae, n, .. } = dot.error;
    let interval = dot.error.ci95.map_or_else(String::new, |ends| {
        let [low, high] = ends.map(numeral);
        format!(" ({low} … {high})")
    });
    // A model with a decoded scale needs no fit.
    let fitted = match dot.row.fit_s > 0.0 {
        true => format!(", fitted in {} s", numeral(dot.row.fit_s)),
        false => String::new(),
    };
    format!(
        "{}: {} {unit}{interval}, n = {n}; {} ms a frame{fitted}",
        short(&dot.row.model, 40),
        numeral(*mae),
        numeral(dot.row.latency_s * MILLI),
    )
}

/// Draws the line through the models on the front, from the fastest to the most accurate.
fn front(dots: &[Dot<'_>], panel: &Panel, canvas: &mut Canvas) {
    let mut corners: Vec<[f64; 2]> = dots
        .iter()
        .filter(|dot| dot.is_on_front)
        .map(|dot| panel.at(dot.row.latency_s * MILLI, dot.error.mae))
        .collect();
    corners.sort_by(|left, right| left[0].total_cmp(&right[0]));
    let mut steps: Vec<[f64; 2]> = Vec::new();
    for corner in corners {
        // Step line, because between two models only the faster model is available.
        if let Some([_, y]) = steps.last().copied() {
            steps.push([corner[0], y]);
        }
        steps.push(corner);
    }
    let stroke = Stroke {
        dash: "3 3",
        ..Stroke::thin(Ink::Muted)
    };
    canvas.path(steps, stroke);
}

#[cfg(test)]
mod tests {
    use taceva_core::Unit;

    use super::*;
    use crate::results::BenchMachine;

    /// Three models: a fast one, an accurate one, and one that is neither.
    fn bench() -> ModelBench {
        let recording = BenchRecording {
            name: "drawn".to_owned(),
            source: "simulated".to_owned(),
            ..BenchRecording::default()
        };
        let mut bench = ModelBench::new(BenchMachine::default(), recording);
        for (model, latency_s, mae) in [
            ("fast", 1e-4, 0.3),
            ("right", 1e-2, 0.1),
            ("neither", 2e-2, 0.2),
        ] {
            bench.rows.push(ModelRow {
                model: model.to_owned(),
                latency_s,
                errors: vec![ChannelError {
                    channel: "Fz".to_owned(),
                    unit: Unit::Newton,
                    mae,
                    ci95: Some([mae - 0.05, mae + 0.05]),
                    n: 40,
                    beaten_by: Vec::new(),
                }],
                ..ModelRow::default()
            });
        }
        bench
    }

    #[test]
    fn the_front_holds_whom_nobody_beats_both_ways() {
        let bench = bench();
        let on_front: Vec<bool> = dots(&bench, "Fz")
            .iter()
            .map(|dot| dot.is_on_front)
            .collect();
        assert_eq!(on_front, [true, true, false]);
        let figure = model_bench(&bench).expect("a channel");
        assert_eq!(
            figure.description,
            "On the Pareto front by channel. Fz: fast and right."
        );
        assert!(
            figure
                .caption
                .ends_with("Nothing here was measured: the samples are simulated.")
        );
        let svg = figure.svg();
        assert!(
            svg.contains("neither: 0.2 N (0.15 … 0.25), n = 40; 20 ms a frame"),
            "{svg}"
        );
    }

    #[test]
    fn a_model_that_failed_is_not_drawn() {
        let mut bench = bench();
        for row in &mut bench.rows {
            row.errors.clear();
            row.failed = Some("no memory".to_owned());
        }
        assert!(model_bench(&bench).is_none());
    }
}
