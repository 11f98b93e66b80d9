//! The figures of results: each a pure function of studies, absent where they have nothing to draw.

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

use crate::figure::{Figure, short};
use crate::results::Study;

/// Every figure that `studies` have something to draw of, in the order of reports.
///
/// Figures of samples are there where the samples are at hand.
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

/// The names of studies, made distinct where sensors have the same name.
pub fn names(studies: &[Study]) -> Vec<String> {
    let name = |(at, study): (usize, &Study)| {
        let same = |other: &&Study| other.sensor == study.sensor;
        let is_alone = studies.iter().filter(same).count() == 1;
        let sensor = match short(&study.sensor, 80) {
            sensor if sensor.trim().is_empty() => "unnamed".to_owned(),
            sensor => sensor,
        };
        let before = studies[..at].iter();
        let number = before.filter(|other| other.sensor == study.sensor).count() + 1;
        let model = study.provenance.iter().find(|(name, _)| name == "model");
        let model = model.and_then(|(_, text)| text.strip_prefix("name ")?.split(',').next());
        match (is_alone, model) {
            (true, _) => sensor,
            (false, Some(model)) => format!("{sensor} {number} ({})", short(model, 20)),
            (false, None) => format!("{sensor} {number}"),
        }
    };
    studies.iter().enumerate().map(name).collect()
}

/// Names in a row of words: `A, B and C`.
pub(crate) fn listed(names: &[String]) -> String {
    match names {
        [] => String::new(),
        [one] => one.clone(),
        [start @ .., last] => format!("{} and {last}", start.join(", ")),
    }
}

/// The six channels, in the order of reports.
pub(crate) const SIX: [&str; 6] = ["Px", "Py", "Pz", "Fx", "Fy", "Fz"];
