//! Summary of the studies in one or two sentences.

use std::collections::BTreeSet;

use taceva_core::counted;

use crate::names::{listed, names, noun};
use crate::results::Study;

/// Sentence on the number of studies, presses and points, the channels, and the model.
pub(super) fn studied(studies: &[Study]) -> String {
    let noun = noun(studies);
    let mut out = format!(
        "{}: {}.",
        counted(studies.len(), noun),
        listed(&names(studies))
    );
    let presses = counted_span(studies, "press", |study| whole(study.made.presses));
    let points = counted_span(studies, "contact point", points);
    match (presses, points) {
        (Some(presses), Some(points)) => out += &format!(" {presses} and {points} a {noun}."),
        (Some(presses), None) => out += &format!(" {presses} a {noun}."),
        (None, Some(points)) => out += &format!(" {points} a {noun}."),
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

/// Range of a number over the studies as text: `400`, or `380 to 400`; `None` if unknown.
pub(super) fn span(studies: &[Study], of: impl Fn(&Study) -> Option<usize>) -> Option<String> {
    let [least, most] = ends(studies, of)?;
    Some(match least == most {
        true => least.to_string(),
        false => format!("{least} to {most}"),
    })
}

/// Range of a number with its noun: `1 press`, or `380 to 400 presses`; `None` if unknown.
pub(super) fn counted_span(
    studies: &[Study],
    noun: &str,
    of: impl Fn(&Study) -> Option<usize>,
) -> Option<String> {
    let [least, most] = ends(studies, of)?;
    let most_counted = counted(most, noun);
    Some(match least == most {
        true => most_counted,
        false => format!("{least} to {most_counted}"),
    })
}

/// Least and greatest known number over the studies; `None` if no study has the number.
fn ends(studies: &[Study], of: impl Fn(&Study) -> Option<usize>) -> Option<[usize; 2]> {
    let known: Vec<usize> = studies.iter().filter_map(of).collect();
    Some([*known.iter().min()?, *known.iter().max()?])
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

/// `count` as `usize`; `None` for zero.
pub(super) fn whole(count: u64) -> Option<usize> {
    usize::try_from(count).ok().filter(|count| *count > 0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::results::Made;

    #[test]
    fn one_press_is_one_press_and_several_numbers_are_a_range() {
        let study = |sensor: &str, presses| Study {
            sensor: sensor.to_owned(),
            made: Made {
                presses,
                ..Made::default()
            },
            ..Study::default()
        };
        assert_eq!(studied(&[study("A", 1)]), "1 sensor: A. 1 press a sensor.");
        let said = studied(&[study("A", 1), study("B", 3)]);
        assert!(said.ends_with(" 1 to 3 presses a sensor."), "{said}");
        let said = studied(&[study("A", 1), study("A", 3)]);
        assert!(said.ends_with(" 1 to 3 presses a result."), "{said}");
    }
}
