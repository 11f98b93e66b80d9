//! Figures of results. Each is a pure function of studies, and absent without data.

mod crosstalk;
mod gaps;
mod heat;
mod histograms;
mod levels;
mod lighting;
mod loops;
mod models;
mod overlay;
mod predicted;
mod race;
mod radar;
mod repeats;
mod resolution;
mod sensitivity;
mod spatial;
mod thin;

pub use models::model_bench;
pub use race::{Race, RacePoint, race};

use crate::figure::Figure;
use crate::results::Study;

/// All figures with data in `studies`, in report order.
///
/// Figures of samples require the samples.
pub fn figures(studies: &[Study]) -> Vec<Figure> {
    let all = [
        vec![histograms::draw(studies)],
        predicted::draw(studies),
        vec![sensitivity::draw(studies)],
        spatial::draw(studies),
        vec![
            resolution::draw(studies),
            lighting::draw(studies),
            repeats::curves(studies),
            repeats::volumes(studies),
            loops::draw(studies),
            gaps::draw(studies),
            levels::bias(studies),
            levels::tolerance(studies),
            crosstalk::draw(studies),
        ],
        radar::draw(studies),
    ];
    all.into_iter().flatten().flatten().collect()
}

/// The six channels, in report order.
pub(crate) const SIX: [&str; 6] = ["Px", "Py", "Pz", "Fx", "Fy", "Fz"];
