//! Sentence about samples that are not measurements.

use std::collections::BTreeSet;

/// Warning that some or all samples from `sources` are not measured. `None` if no source is `simulated`, `synthetic` or `several`.
///
/// A source is a value of [`Subject::source`](crate::Subject). One simulated or emulated device makes a whole recording `simulated`.
///
/// ```
/// use taceva_results::not_measured;
/// assert_eq!(not_measured(["recorded", "unknown"]), None);
/// let said = not_measured(["simulated", "recorded"]).expect("one is simulated");
/// assert_eq!(said, "Not everything here was measured: some of the samples are simulated.");
/// ```
pub fn not_measured<'a>(sources: impl IntoIterator<Item = &'a str>) -> Option<String> {
    let sources: BTreeSet<&str> = sources.into_iter().collect();
    let drawn: Vec<&str> = ["simulated", "synthetic"]
        .into_iter()
        .filter(|source| sources.contains(source))
        .collect();
    if drawn.is_empty() {
        let words = "Perhaps not everything here was measured: the samples have several origins.";
        return sources.contains("several").then(|| words.to_owned());
    }
    let kinds = drawn.join(" and ");
    let others = sources.into_iter().filter(|source| !drawn.contains(source));
    let others: Vec<&str> = others.collect();
    Some(match others.as_slice() {
        [] => format!("Nothing here was measured: the samples are {kinds}."),
        ["unknown"] => format!(
            "Not everything here was measured: all samples whose origin is named are {kinds}."
        ),
        _ => format!("Not everything here was measured: some of the samples are {kinds}."),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_sample_that_is_not_measured_is_stated_with_its_origin() {
        for (sources, said) in [
            (vec![], None),
            (vec!["recorded", "published", "unknown"], None),
            (
                vec!["simulated", "simulated"],
                Some("Nothing here was measured: the samples are simulated."),
            ),
            (
                vec!["synthetic", "simulated"],
                Some("Nothing here was measured: the samples are simulated and synthetic."),
            ),
            (
                vec!["recorded", "synthetic", "recorded"],
                Some("Not everything here was measured: some of the samples are synthetic."),
            ),
            (
                vec!["unknown", "simulated"],
                Some(
                    "Not everything here was measured: all samples whose origin is named are simulated.",
                ),
            ),
            (
                vec!["several", "recorded"],
                Some("Perhaps not everything here was measured: the samples have several origins."),
            ),
        ] {
            assert_eq!(not_measured(sources).as_deref(), said);
        }
    }
}
