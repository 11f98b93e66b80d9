//! Converts values from bundles to studies, and to sensors that `choose` considers.

use std::collections::BTreeMap;

use taceva_core::Unit;
use taceva_results::{Interval, Score, Value, Variant};

use super::bundle_row::{Measured, Origin, short};
use super::entry::Sensor;
use crate::results::{Made, Study, by_published_r2};

/// Method of an interval whose row states no method.
const AS_STATED: &str = "as the bundle states it";

impl Sensor {
    /// Converts published numbers, then the values from each bundle, to results. Omits published numbers if the entry has only values from bundles.
    pub fn studies(&self) -> Vec<Study> {
        let is_published = self.has_published() || !self.has_bundles();
        let published = is_published.then(|| self.as_study());
        let origins = Origin::ALL.into_iter();
        let of_bundles = origins.flat_map(|origin| self.measured_studies(origin));
        published.into_iter().chain(of_bundles).collect()
    }

    /// Results of this sensor in bundles, one result for each study of a bundle. The name contains the origin, the depth of verification, and the
    /// bundle.
    pub fn measured_studies(&self, origin: Origin) -> Vec<Study> {
        let mut bundles: BTreeMap<(&str, usize), Vec<&Measured>> = BTreeMap::new();
        for row in self.rows(origin) {
            let rows = bundles.entry((row.bundle.as_str(), row.study));
            rows.or_default().push(row);
        }
        let studies = bundles.values();
        studies.filter_map(|rows| study(&self.name, rows)).collect()
    }

    /// Copies of this sensor, one for each study of a measured bundle, with the numbers of the study instead of published numbers.
    pub fn measured_candidates(&self) -> Vec<Sensor> {
        let studies = self.measured_studies(Origin::Measured).into_iter();
        let candidates = studies.map(|study| Sensor {
            results: Sensor::of_study(&study).results,
            samples: study.made.samples_digest,
            name: study.sensor,
            measured: Vec::new(),
            unknown: Vec::new(),
            simulated: Vec::new(),
            ..self.clone()
        });
        candidates.collect()
    }
}

/// Values of one study in one bundle; `None` without rows.
fn study(sensor: &str, rows: &[&Measured]) -> Option<Study> {
    let first = rows.first()?;
    let least = rows.iter().min_by_key(|row| row.depth())?;
    let mut scores: Vec<Score> = Vec::new();
    for row in rows.iter().filter(|row| row.variant.is_none()) {
        scores.push(Score {
            n: row.n,
            interval: Some(interval(row)),
            definition: row.definition.clone(),
            ..Score::of_number(&row.metric, &row.channel, row.value, unit(row))
        });
    }
    for row in rows {
        let Some(name) = &row.variant else { continue };
        let mut scores = scores.iter_mut();
        let is_of = |score: &&mut Score| score.metric == row.metric && score.channel == row.channel;
        if let Some(score) = scores.find(is_of) {
            score.variants.push(Variant {
                name: name.clone(),
                value: Value::Number(row.value),
                unit: unit(row),
                interval: Some(interval(row)),
            });
        }
    }
    by_published_r2(&mut scores);
    let stated = [
        ("bundle", first.bundle.clone()),
        ("verified", least.verified.clone()),
        ("by", first.by.join(", ")),
    ];
    Some(Study {
        sensor: format!(
            "{sensor} ({}, {}, {})",
            first.origin_word(),
            least.verified,
            first.short_bundle()
        ),
        serial: "unknown".to_owned(),
        gel: "unknown".to_owned(),
        source: first.source.clone(),
        scores,
        provenance: stated.map(|(key, text)| (key.to_owned(), text)).to_vec(),
        made: Made {
            samples_digest: Some(first.samples.clone()),
            ..Made::default()
        },
        notes: vec![format!(
            "numbers of the bundle {}, verified to the level {} when it was added",
            short(&first.bundle),
            least.verified
        )],
        ..Study::default()
    })
}

fn unit(row: &Measured) -> Unit {
    Unit::from_symbol(&row.unit).unwrap_or(Unit::One)
}

fn interval(row: &Measured) -> Interval {
    match row.ci95 {
        Some(ends) => Interval::Ends {
            ends,
            method: row.method.clone().unwrap_or_else(|| AS_STATED.to_owned()),
            standard_error: None,
            clusters: row.clusters,
            degrees_of_freedom: None,
        },
        None => Interval::Absent("the bundle states none".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_numbers_of_a_bundle_are_results_whose_name_states_their_level() {
        let digest = format!("sha256:{}", "5".repeat(64));
        let row = |metric: &str, more: &str| {
            format!(
                "[[measured]]\nmetric = \"{metric}\"\nchannel = \"Fz\"\nvalue = 0.5\nunit = \"1\"\nn = 9\ndefinition = \"{metric}/1\"\n\
                 samples = \"{digest}\"\nbundle = \"{digest}\"\nverified = \"scores\"\nsource = \"recorded\"\ndate = 2026-11-28\n{more}"
            )
        };
        let text = format!(
            "catalogue_version = 2\nname = \"X\"\nkind = \"sensor\"\nmechanism = []\n{}{}{}",
            row("r2", "ci95 = [0.4, 0.6]\n"),
            row("hysteresis", ""),
            row("hysteresis", "variant = \"ratio\"\n")
        );
        let sensor = Sensor::read("x.toml", &text).expect("an entry");
        let studies = sensor.measured_studies(Origin::Measured);
        assert_eq!(studies[0].sensor, "X (measured, scores, 55555555)");
        assert_eq!(studies[0].scores.len(), 2);
        let ends = studies[0].scores[0]
            .interval
            .as_ref()
            .and_then(Interval::ends);
        assert_eq!(ends, Some([0.4, 0.6]));
        assert!(studies[0].scores[1].variant("ratio").is_some());
        assert!(sensor.measured_studies(Origin::Simulated).is_empty());
        let candidates = sensor.measured_candidates();
        assert_eq!(candidates[0].samples.as_ref(), Some(&digest));
    }
}
