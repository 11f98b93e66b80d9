//! Figures that are not drawn, each with its reason.

use crate::figure::Figure;
use crate::results::Study;

/// Id of each figure, metric of its curve or map (empty for samples), and required data.
const NEEDS: [(&str, &str, &str); 15] = [
    (
        "labels",
        "",
        "samples with labels of Px, Py, Pz, Fx, Fy or Fz",
    ),
    (
        "predicted-1",
        "",
        "samples with a true and a predicted value of one channel",
    ),
    (
        "sensitivity",
        "sensitivity",
        "a map of `sensitivity`: presses of one tip at several places",
    ),
    (
        "distance",
        "r_spatial",
        "`r_spatial` over the distance from the centre: a footprint of the sensor and places on it",
    ),
    (
        "depth",
        "r_spatial",
        "`r_spatial` over the depth: labels of Px, Py and Pz",
    ),
    (
        "resolution",
        "sr",
        "presses of gratings with known spacing (`sr`)",
    ),
    (
        "lighting",
        "r_light",
        "presses in several scenes of light (`r_light`)",
    ),
    (
        "repeatability",
        "repeatability",
        "repeated presses of one place (`repeatability`)",
    ),
    (
        "repeatability-volumes",
        "repeatability",
        "samples of repeated presses with Px, Py and Pz",
    ),
    (
        "hysteresis",
        "hysteresis",
        "samples of loading and unloading with Pz and Fz",
    ),
    (
        "units",
        "inter_sensor",
        "a second unit of the sensor, measured at the same points",
    ),
    (
        "bias",
        "bias_level",
        "at least 5 samples in a bin of the truth (`bias_level`)",
    ),
    (
        "tolerance",
        "tolerance",
        "`tolerance` of one of the six channels",
    ),
    (
        "crosstalk",
        "crosstalk",
        "a matrix of `crosstalk`: at least two channels",
    ),
    (
        "radar-accuracy",
        "",
        "two or more results with values on at least three axes",
    ),
];

/// Ids of known figures that are not among `drawn`, each with the missing data.
///
/// If the results state why the metric was skipped, that reason replaces the missing data.
pub fn undrawn(studies: &[Study], drawn: &[Figure]) -> Vec<(String, String)> {
    let absent = NEEDS
        .into_iter()
        .filter(|(id, ..)| drawn.iter().all(|figure| figure.id != *id));
    let reasoned = absent.map(|(id, metric, needs)| {
        let mut skipped = studies.iter().flat_map(|study| &study.skipped);
        let of_metric = skipped.find(|skip| skip.what == format!("metric:{metric}"));
        let reason = match of_metric {
            Some(skip) if !metric.is_empty() => skip.reason.clone(),
            _ => format!("needs {needs}"),
        };
        (id.to_owned(), reason)
    });
    reasoned.collect()
}
