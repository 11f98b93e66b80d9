//! Figures of results. Each figure depends only on the studies, and is omitted without data.

mod crosstalk;
mod fault_grid;
mod gaps;
mod heat;
mod histograms;
mod intervals;
mod levels;
mod lighting;
mod loops;
mod models;
mod of_faults;
mod of_study;
mod overlay;
mod predictions;
mod race;
mod radar;
mod radar_web;
mod repeats;
mod resolution;
mod sensitivity;
mod spatial;
mod thin;
mod undrawn;

pub(crate) use intervals::intervals;
pub use models::model_bench;
pub use of_study::{StudyFigures, study_figures};
pub use race::{Race, RacePoint, race};
pub use undrawn::undrawn;

use crate::figure::{Figure, FigureStyle};
use crate::results::Study;

/// All figures with data in `studies`, in report order.
///
/// Figures that draw samples need studies with a table of samples.
pub fn figures(studies: &[Study]) -> Vec<Figure> {
    figures_for(studies, &FigureStyle::default())
}

/// Same as [`figures`], in a style for print. Omits figures without any value; [`undrawn`] states the reasons.
pub fn figures_for(studies: &[Study], style: &FigureStyle) -> Vec<Figure> {
    let room = style.room();
    let all = [
        vec![histograms::draw(studies, room)],
        predictions::draw(studies, room),
        vec![sensitivity::draw(studies, room)],
        spatial::draw(studies, room),
        vec![
            resolution::draw(studies, room),
            lighting::draw(studies, room),
            repeats::curves(studies, room),
            repeats::volumes(studies, room),
            loops::draw(studies, room),
            gaps::draw(studies, room),
            levels::bias(studies, room),
            levels::tolerance(studies, room),
            crosstalk::draw(studies, room),
        ],
        radar::draw(studies),
    ];
    let drawn = all.into_iter().flatten().flatten();
    let drawn = drawn.filter(Figure::has_values);
    drawn.map(|figure| style.apply(figure)).collect()
}

/// Names of the six channels, in report order.
pub(crate) const SIX: [&str; 6] = ["Px", "Py", "Pz", "Fx", "Fy", "Fz"];
