//! Converts catalogue sensors to studies, and studies to sensors.

use std::collections::BTreeMap;

use taceva_core::Unit;

use super::definition;
use super::entry::{Kind, Sensor};
use super::facts::{SIZE, TESTED};
use super::offer::Goods;
use super::published::Published;
use crate::results::{Fact, Made, PUBLISHED, Statement, Study, by_published_r2};
use taceva_results::{Interval, Score};

/// Source of a number that is read from a result.
pub(crate) const RESULT: &str = "result";

impl Sensor {
    /// Converts results to a sensor for `choose`: their values, and opacity if the results state it. Limits come from the catalogue sensor of the
    /// same name; without such a sensor, and for simulated sensors, limits are unknown.
    pub fn of_study(study: &Study) -> Sensor {
        let result = |score: &Score| {
            let decided_by = score.decided_by().map(|variant| variant.name.clone());
            let score = score.deciding();
            Some(Published {
                metric: score.metric.clone(),
                channel: score.channel.clone(),
                value: score.value.number()?,
                unit: score.unit.symbol().to_owned(),
                source: RESULT.to_owned(),
                read_from: study.source.clone(),
                conditions: "see its provenance".to_owned(),
                definition: score.definition.clone(),
                bound: None,
                note: decided_by
                    .map(|variant| format!("the variant {variant}, which verdicts use")),
                standing: score.standing,
                interval: score.interval.as_ref().and_then(Interval::ends),
            })
        };
        let is_opaque = |reason: &str| reason.contains("opaque");
        let skips = study.skipped.iter().any(|skip| is_opaque(&skip.reason));
        let has_light = study.of_metric("r_light").next().is_some();
        Sensor {
            catalogue_version: 1,
            name: study.sensor.clone(),
            aliases: Vec::new(),
            kind: Kind::Sensor,
            mechanism: Vec::new(),
            shape: None,
            opaque: (skips || has_light).then_some(skips),
            markers: None,
            identity: None,
            limits: super::find(&study.sensor)
                .filter(|_| !study.is_simulated())
                .and_then(|known| known.limits),
            size: None,
            prices: Vec::new(),
            availability: Vec::new(),
            sources: Vec::new(),
            results: study.scores.iter().filter_map(result).collect(),
            measured: Vec::new(),
            unknown: Vec::new(),
            simulated: Vec::new(),
            samples: study.made.samples_digest.clone(),
            faults: study.faults.clone(),
            missing: Vec::new(),
            reported: BTreeMap::new(),
            applications: BTreeMap::new(),
        }
    }

    /// Converts published numbers to results for tables and comparisons. The results have the source `published` and no intervals.
    pub fn as_study(&self) -> Study {
        let score = |metric: &str, channel: &str, value: f64, unit: Unit| Score {
            interval: Some(Interval::Absent("its source states no interval".to_owned())),
            definition: PUBLISHED.to_owned(),
            ..Score::of_number(metric, channel, value, unit)
        };
        let is_score =
            |result: &&Published| definition::is_ours(&result.metric) && result.bound.is_none();
        let published = self.results.iter().filter(is_score);
        let mut scores: Vec<Score> = published
            .map(|result| {
                let unit = Unit::from_symbol(&result.unit).unwrap_or(Unit::One);
                score(&result.metric, &result.channel, result.value, unit)
            })
            .collect();
        by_published_r2(&mut scores);
        let sources = self
            .sources
            .iter()
            .map(|source| ("source".to_owned(), source.text.clone()));
        Study {
            sensor: self.name.clone(),
            serial: "unknown".to_owned(),
            gel: "unknown".to_owned(),
            source: "published".to_owned(),
            scores,
            facts: self.facts(),
            statements: self.statements(),
            skipped: Vec::new(),
            provenance: sources.collect(),
            made: Made::default(),
            references: Vec::new(),
            edits: Vec::new(),
            notes: vec!["published numbers, not measured with this program".to_owned()],
            over_seeds: None,
            tasks: Vec::new(),
            samples: None,
            faults: None,
        }
    }

    /// Values that tables show but comparisons do not test: numbers of other definitions, inexact numbers, size, price, limits, and ways to get the
    /// sensor.
    fn facts(&self) -> Vec<Fact> {
        let size = self.size.iter();
        let mut facts: Vec<Fact> = size.map(|of| fact("size", of.shown(), "mm")).collect();
        if let Some(of) = &self.limits {
            let [depth, force, _] = of.rows();
            facts.extend([depth, force].map(|(name, value, unit, _)| {
                fact(&format!("greatest {name}"), value.to_string(), unit)
            }));
        }
        // Variants of our metrics are shown beside their metric on the page of the sensor.
        let is_fact = |result: &&Published| {
            let family = result.metric.split('.').next().unwrap_or_default();
            !definition::is_ours(family) || result.bound.is_some()
        };
        let published = self.results.iter().filter(is_fact);
        facts.extend(published.map(|of| {
            let unit = match of.unit.as_str() {
                "1" => "",
                unit => unit,
            };
            fact(&format!("{} {}", of.metric, of.channel), of.shown(), unit)
        }));
        let prices = self.prices.iter();
        facts.extend(prices.map(|of| {
            let goods = match of.goods {
                Goods::Sensor => String::new(),
                _ => format!(" ({})", of.of),
            };
            let value = format!("{}{goods}, {}", of.shown(), of.seen);
            fact(of.goods.quantity(), value, "")
        }));
        let ways = self.availability.iter();
        facts.extend(ways.map(|of| fact("availability", of.way.word().to_owned(), "")));
        facts
    }
}

impl Sensor {
    /// Source, conditions and definition of each value, by its row name in tables.
    fn statements(&self) -> Vec<Statement> {
        let text = |id: &str| {
            self.source(id)
                .map_or_else(|| id.to_owned(), |of| of.text.clone())
        };
        let size = self.size.iter();
        let size = size.map(|of| Statement::new("size", &text(&of.source), &of.conditions, SIZE));
        let prices = self.prices.iter().map(|of| {
            let goods = of.goods;
            Statement::new(
                goods.quantity(),
                &text(&of.source),
                &of.of,
                goods.definition(),
            )
        });
        let limits = self.limits.iter().flat_map(|of| {
            let source = text(&of.source);
            of.rows().map(|(name, _, _, definition)| {
                Statement::new(&format!("greatest {name}"), &source, TESTED, definition)
            })
        });
        let results = self.results.iter().map(|of| {
            let name = format!("{} {}", of.metric, of.channel);
            Statement::new(&name, &text(&of.source), &of.conditions, &of.definition)
        });
        size.chain(prices).chain(limits).chain(results).collect()
    }
}

fn fact(name: &str, value: String, unit: &str) -> Fact {
    Fact {
        name: name.trim().to_owned(),
        unit: unit.to_owned(),
        value,
    }
}
