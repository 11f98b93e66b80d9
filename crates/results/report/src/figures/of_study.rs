//! Figures of the TacEva study in its layout: its axes, its four planes, and curves of its quantities.

mod gratings;
mod grey;
mod planes;
mod predictions;
mod radar;
mod repeats;
mod spokes;

use crate::figure::{Figure, FigureStyle};
use crate::results::Study;

/// Drawn figures of the TacEva study, and the reasons why others are not drawn.
#[derive(Clone, Debug, Default)]
pub struct StudyFigures {
    /// Figures with values, in the order of the TacEva study.
    pub drawn: Vec<Figure>,
    /// Name of each figure without values, with the reason.
    pub absent: Vec<(String, String)>,
}

/// Figures 3 to 8 of the TacEva study for `studies`, in a style for print.
pub fn study_figures(studies: &[Study], style: &FigureStyle) -> StudyFigures {
    let room = style.room();
    let all: [(&str, Option<Figure>, &str); 10] = [
        (
            "figure-3c",
            gratings::draw(studies, room),
            "samples of gratings with their spacing and its prediction",
        ),
        (
            "figure-4",
            super::sensitivity::on_one_scale(studies, room),
            "a map of `sensitivity`",
        ),
        (
            "figure-5-radius",
            planes::draw(studies, "distance", room),
            "`r_spatial` over the distance from the centre",
        ),
        (
            "figure-5-depth",
            planes::draw(studies, "depth", room),
            "`r_spatial` over the depth",
        ),
        (
            "figure-6b",
            grey::draw(studies, room),
            "samples in several scenes of light, with their mean grey level",
        ),
        (
            "figure-7a",
            predictions::draw(studies, room),
            "predictions of repeated presses, with their points and steps of depth",
        ),
        (
            "figure-7b",
            repeats::draw(studies, room),
            "samples of repeated presses by depth, and `repeatability`",
        ),
        (
            "figure-8a",
            spokes::accuracy(studies),
            "scores of two or more sensors",
        ),
        (
            "figure-8b",
            spokes::intrinsic(studies),
            "facts of two or more sensors",
        ),
        (
            "figure-8c",
            spokes::robustness(studies),
            "scores of robustness of two or more sensors",
        ),
    ];
    let mut figures = StudyFigures::default();
    for (id, drawn, needs) in all {
        match drawn.filter(Figure::has_values) {
            Some(mut figure) => {
                id.clone_into(&mut figure.id);
                figures.drawn.push(style.apply(figure));
            }
            None => figures
                .absent
                .push((id.to_owned(), format!("needs {needs}"))),
        }
    }
    let reason = "shows camera frames, which results do not contain";
    figures
        .absent
        .push(("figure-6a".to_owned(), reason.to_owned()));
    figures
}
