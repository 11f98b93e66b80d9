//! Summary of the studied sensors in a sentence or two.

use std::collections::BTreeSet;

use crate::markup::counted;
use crate::names::{listed, names};
use crate::results::Study;

/// Plain sentence on the number of sensors, presses and points, the channels, and the model.
pub(super) fn studied(studies: &[Study]) -> String {
    let mut out = format!(
        "{}: {}.",
        counted(studies.len(), "sensor"),
        listed(&names(studies))
    );
    let presses = span(studies, |study| whole(study.made.presses));
    let points = span(studies, points);
    match (presses, points) {
        (Some(presses), Some(points)) => {
            out += &format!(" {presses} presses and {points} contact points a sensor.")
        }
        (Some(presses), None) => out += &format!(" {presses} presses a sensor."),
        (None, Some(points)) => out += &format!(" {points} contact points a sensor."),
        (None, None) => {}
    }
    let mut channels: Vec<String> = Vec::new();
    for channel in studies
        .iter()
        .filter_map(|study| study.samples.as_ref())
        .flat_map(|samples| samples.channels())
        .filter(|channel| channel.is_predicted())
    {
        if !channels.iter().any(|known| known == channel.name) {
            channels.push(channel.name.to_owned());
        }
    }
    let models = studies.iter().filter_map(|study| study.made.model.clone());
    let models: BTreeSet<String> = models.collect();
    let models: Vec<String> = models.into_iter().collect();
    match (models.is_empty(), channels.is_empty()) {
        (false, false) => {
            out += &format!(
                " {} predicted from pictures by {}.",
                listed(&channels),
                listed(&models)
            );
        }
        (false, true) => out += &format!(" Predicted from pictures by {}.", listed(&models)),
        _ => {}
    }
    out
}

/// `400`, or `380 to 400` if studies differ; `None` if unknown.
pub(super) fn span(studies: &[Study], of: impl Fn(&Study) -> Option<usize>) -> Option<String> {
    let known: Vec<usize> = studies.iter().filter_map(of).collect();
    let (least, most) = (known.iter().min()?, known.iter().max()?);
    Some(match least == most {
        true => least.to_string(),
        false => format!("{least} to {most}"),
    })
}

/// Number of contact points of a study; `None` without samples.
pub(super) fn points(study: &Study) -> Option<usize> {
    let samples = study.samples.as_ref()?;
    let rows = 0..samples.rows();
    let points: BTreeSet<&str> = rows
        .filter_map(|row| samples.word("point_id", row))
        .collect();
    (!points.is_empty()).then_some(points.len())
}

/// `count`, or `None` if it is zero.
pub(super) fn whole(count: u64) -> Option<usize> {
    usize::try_from(count).ok().filter(|count| *count > 0)
}
