//! Figure 7a of the TacEva study: predictions of repeated presses, with one panel for each plane. A panel of a lateral plane shows one axis against
//! the other. A panel of a normal axis shows predictions over the depth.

use taceva_core::Unit;

use crate::figure::{
    Area, Axes, Canvas, Figure, Grid, Ink, Panel, Points, Scale, axis_label, extent, short,
};
use crate::number::numeral;
use crate::results::Study;
use taceva_results::{SampleChannel, Samples};

use super::super::thin::thin;

/// Greatest number of dots of a sensor in a panel.
const MOST: usize = 400;

/// Panel of a plane.
struct Plane {
    name: &'static str,
    across: Across,
    /// Channel on the vertical axis.
    up: &'static str,
}

/// Horizontal axis of a panel.
enum Across {
    /// Prediction of a channel.
    Predicted(&'static str),
    /// True depth.
    Depth,
}

/// Planes in the order of the TacEva study.
const PANELS: [Plane; 4] = [
    Plane {
        name: "Pxy",
        across: Across::Predicted("Px"),
        up: "Py",
    },
    Plane {
        name: "Pz",
        across: Across::Depth,
        up: "Pz",
    },
    Plane {
        name: "Fxy",
        across: Across::Predicted("Fx"),
        up: "Fy",
    },
    Plane {
        name: "Fz",
        across: Across::Depth,
        up: "Fz",
    },
];

/// Predictions of a sensor in a panel.
struct Cloud {
    /// Index of the study, from 0.
    study: usize,
    dots: Vec<Dot>,
}

/// One prediction.
struct Dot {
    at: [f64; 2],
    /// Prediction error in the channel on the vertical axis, truth minus prediction; 0 if the truth is unknown.
    error: f64,
    /// Contact point and depth step of the press, as text.
    press: String,
}

pub(super) fn draw(studies: &[Study], room: Option<f64>) -> Option<Figure> {
    let names = crate::names::names(studies);
    let panels = PANELS.map(|plane| {
        let clouds = plane.clouds(studies);
        (plane, clouds)
    });
    let panels = || panels.iter().filter(|(_, clouds)| !clouds.is_empty());
    let count = panels().count();
    if count == 0 {
        return None;
    }
    let first = Area {
        left: 58.0,
        top: 54.0,
        width: 330.0,
        height: 220.0,
    };
    let grid = Grid::new(count, 2, first, [66.0, 78.0]).within(room, 16.0);
    let mut canvas = grid.canvas([16.0, 42.0]);
    let is_drawn = |at: &usize| {
        let mut clouds = panels().flat_map(|(_, clouds)| clouds);
        clouds.any(|cloud| cloud.study == *at)
    };
    let drawn = (0..names.len()).filter(is_drawn);
    let legend: Vec<(usize, String)> = drawn.map(|at| (at, names[at].clone())).collect();
    if names.len() > 1 {
        canvas.dot_legend([first.left, 16.0], &legend);
    }
    for (position, (plane, clouds)) in panels().enumerate() {
        plane.draw(clouds, &names, grid.area(position), &mut canvas);
    }
    Some(Figure {
        id: "figure-7a".to_owned(),
        title: "Figure 7a: predictions of repeated presses".to_owned(),
        caption: format!(
            "Predictions of presses that were repeated at the same points and depths, by plane: y over x of Pxy and Fxy, and Pz and Fz over the true depth. Of more than {MOST} predictions of a sensor, evenly spaced ones and those with the largest errors are drawn."
        ),
        description: format!(
            "Predictions of repeated presses in four planes of {}.",
            crate::names::listed(&names)
        ),
        canvas,
    })
}

impl Plane {
    /// Predictions of each sensor that has predictions in this plane.
    fn clouds(&self, studies: &[Study]) -> Vec<Cloud> {
        let clouds = studies.iter().enumerate().filter_map(|(at, study)| {
            let dots = self.dots(study.samples.as_ref()?)?;
            (!dots.is_empty()).then_some(Cloud { study: at, dots })
        });
        clouds.collect()
    }

    /// Predictions of repeated presses, thinned for the drawing.
    fn dots(&self, samples: &Samples) -> Option<Vec<Dot>> {
        if !samples.has("protocol") {
            return None;
        }
        let across = samples.channel(self.channel())?;
        let up = samples.channel(self.up)?;
        let dots = samples.of_protocol("repeatability").into_iter();
        let dots: Vec<Dot> = dots
            .filter_map(|row| {
                let y = up.prediction(row)?;
                let step = samples.number("depth_step", row)?;
                let point = samples.word("point_id", row)?;
                Some(Dot {
                    at: [self.place(across, row)?, y],
                    error: up.truth(row).map_or(0.0, |truth| truth - y),
                    press: format!("point {}, step {}", short(point, 20), numeral(step)),
                })
            })
            .collect();
        let errors: Vec<f64> = dots.iter().map(|dot| dot.error).collect();
        let kept = thin(&errors, MOST);
        let dots = dots.into_iter().enumerate();
        let dots = dots.filter(|(at, _)| kept.binary_search(at).is_ok());
        Some(dots.map(|(_, dot)| dot).collect())
    }

    /// Channel of the horizontal axis.
    fn channel(&self) -> &'static str {
        match self.across {
            Across::Predicted(channel) => channel,
            Across::Depth => "Pz",
        }
    }

    /// Position of a sample on the horizontal axis.
    fn place(&self, across: SampleChannel<'_>, row: usize) -> Option<f64> {
        match self.across {
            Across::Predicted(_) => across.prediction(row),
            Across::Depth => across.truth(row),
        }
    }

    fn draw(&self, clouds: &[Cloud], names: &[String], area: Area, canvas: &mut Canvas) {
        let dots = || clouds.iter().flat_map(|cloud| &cloud.dots);
        let along = |axis: usize| extent(dots().map(move |dot| dot.at[axis]));
        let (Some(x), Some(y)) = (along(0), along(1)) else {
            return;
        };
        let panel = Panel {
            area,
            x: Scale::padded(x, area.across()),
            y: Scale::padded(y, area.upwards()),
        };
        let axes = Axes {
            title: self.name.to_owned(),
            x: match self.across {
                Across::Predicted(channel) => label(channel),
                Across::Depth => "depth (mm)".to_owned(),
            },
            y: label(self.up),
        };
        panel.axes(&axes, canvas);
        for cloud in clouds {
            let mut points = Points::default();
            for dot in &cloud.dots {
                let [x, y] = dot.at;
                points.at.push(panel.at(x, y));
                points.words.push(format!(
                    "{}, {}: {} {}, {} {}",
                    names[cloud.study],
                    dot.press,
                    axes.x,
                    numeral(x),
                    axes.y,
                    numeral(y)
                ));
            }
            canvas.points(points, Ink::Series(cloud.study), 1.8, 0.55);
        }
    }
}

/// Axis label of a predicted channel.
fn label(channel: &str) -> String {
    let unit = match channel.starts_with('P') {
        true => Unit::Millimetre,
        false => Unit::Newton,
    };
    axis_label(&format!("predicted {channel}"), unit)
}
