//! Significance of the differences between ranked sensors. The ranking follows values, which may differ by chance.

use std::collections::{BTreeMap, BTreeSet};

use taceva_metrics::{Better, Sides, p_words};

use super::{Choice, Dropped, Need, Property, choose_together};
use crate::catalogue::Sensor;
use crate::compare::{Answer, CompareRequest, barred_by_split, compare};
use crate::names::{listed, names};
use crate::results::Study;
use crate::spread;

/// Significant difference between two ranked sensors in one ranking value.
#[derive(Clone, Debug, PartialEq)]
pub struct Evidence {
    /// Name of the better sensor.
    pub better: String,
    /// Name of the worse sensor.
    pub than: String,
    /// Property in which the difference is significant.
    pub property: Property,
    /// P value, adjusted by Holm's method over all pairs and channels of the metric.
    pub p: f64,
}

/// Chooses among the sensors of `studies` like [`choose`](super::choose), and tests the differences of the values that rank them.
///
/// ```
/// use taceva_report::{Need, catalogue, choose_results};
/// let published = ["GelSight", "MagicTac"].map(|name| catalogue::find(name).expect("there").as_study());
/// let choice = choose_results(&published, &Need::parse("normal force")?);
/// // Published numbers have no interval, so that no test shows anything.
/// assert_eq!(choice.evidence.map(|all| all.len()), Some(0));
/// # Ok::<(), taceva_report::NeedError>(())
/// ```
pub fn choose_results(studies: &[Study], needs: &[Need]) -> Choice {
    let names = names(studies);
    let sensors = studies.iter().zip(&names).map(|(study, name)| {
        let mut sensor = Sensor::of_study(study);
        name.clone_into(&mut sensor.name);
        sensor
    });
    let sensors: Vec<Sensor> = sensors.collect();
    let mut choice = choose_together(&sensors, needs, |remaining| {
        take_test_parts_apart(remaining, studies, &names, needs)
    });
    choice.evidence = Some(evidence(studies, needs, &choice));
    choice.spread = spread(studies, &names, &choice);
    choice.simulated = studies.iter().any(Study::is_simulated);
    let mut asked = needs.iter().flat_map(Need::properties);
    let of_limits = [Property::GreatestDepth, Property::GreatestForce];
    if asked.any(|property| of_limits.contains(&property)) {
        let known = sensors.iter().filter(|sensor| sensor.limits.is_some());
        choice.limits_of_catalogue = known.map(|sensor| sensor.name.clone()).collect();
    }
    choice
}

/// Removes sensors from `remaining` and returns them, if a need ranks by scores of different test parts of one dataset.
fn take_test_parts_apart(
    remaining: &mut Vec<&Sensor>,
    studies: &[Study],
    names: &[String],
    needs: &[Need],
) -> Vec<Dropped> {
    let ranks = needs.iter().flat_map(|need| &need.ranks);
    let metrics: Vec<&str> = ranks.filter_map(|of| Some(of.score()?.0)).collect();
    let left = studies.iter().zip(names);
    let left = left.filter(|(_, name)| remaining.iter().any(|sensor| sensor.name == **name));
    let left: Vec<(&Study, &String)> = left.collect();
    let mut reasons: BTreeMap<&str, String> = BTreeMap::new();
    for (at, (study, name)) in left.iter().enumerate() {
        for (other, other_name) in &left[at + 1..] {
            let of_studies = Sides {
                a: *study,
                b: *other,
            };
            let of_names = Sides {
                a: name.as_str(),
                b: other_name.as_str(),
            };
            let mut metrics = metrics.iter();
            if let Some(reason) =
                metrics.find_map(|metric| barred_by_split(metric, of_studies, of_names))
            {
                reasons.entry(of_names.b).or_insert_with(|| reason.clone());
                reasons.entry(of_names.a).or_insert(reason);
            }
        }
    }
    let mut apart = Vec::new();
    remaining.retain(|sensor| match reasons.remove(sensor.name.as_str()) {
        Some(reason) => {
            apart.push(Dropped::new(sensor, reason));
            false
        }
        None => true,
    });
    apart
}

fn evidence(studies: &[Study], needs: &[Need], choice: &Choice) -> Vec<Evidence> {
    let properties: Vec<Property> = needs.iter().flat_map(|need| need.ranks.clone()).collect();
    let metrics = properties.iter().filter_map(|property| property.score());
    let metrics: BTreeSet<String> = metrics.map(|(metric, _)| metric.to_owned()).collect();
    if metrics.is_empty() {
        return Vec::new();
    }
    let request = CompareRequest {
        metrics: metrics.into_iter().collect(),
        ..CompareRequest::default()
    };
    let comparison = compare(studies, &request);
    let is_ranked = |name: &str| choice.ranked.iter().any(|candidate| candidate.name == name);
    let of_answer = |answer: &Answer| {
        let mut properties = properties.iter();
        let property = properties.find(|property| {
            property.score() == Some((answer.metric.as_str(), answer.channel.as_str()))
        })?;
        let at = answer.better().or_else(|| by_need(answer, *property))?;
        let other = match answer.sides.a == at {
            true => answer.sides.b,
            false => answer.sides.a,
        };
        let [better, than] = [at, other].map(|at| comparison.names[at].clone());
        (is_ranked(&better) && is_ranked(&than)).then_some(Evidence {
            better,
            than,
            property: *property,
            p: answer.difference.as_ref()?.adjusted_p,
        })
    };
    comparison.answers.iter().filter_map(of_answer).collect()
}

/// Position of the significantly better study for a score without a better direction. The direction of `property` decides.
fn by_need(answer: &Answer, property: Property) -> Option<usize> {
    let describes = answer.direction == Better::Described;
    let difference = answer.difference.as_ref();
    let difference = difference.filter(|difference| describes && difference.is_shown)?;
    let wants_more = property.better() == Better::Higher;
    match (difference.value > 0.0) == wants_more {
        true => Some(answer.sides.a),
        false => Some(answer.sides.b),
    }
}

/// Remark on scores used for ranks, if the label spreads of the ranked sensors differ.
fn spread(studies: &[Study], names: &[String], choice: &Choice) -> Option<String> {
    let steps = choice.ranked.first()?.steps.iter();
    let scores: BTreeSet<(&str, &str)> = steps.filter_map(|step| step.property.score()).collect();
    let scores: Vec<(&str, &str)> = scores.into_iter().collect();
    spread::note(studies, names, &scores)
}

impl Choice {
    /// Sentences on tests: the best sensor against each other sensor, then other significant differences. Empty for a choice without tests, or if no
    /// need ranks the sensors.
    pub(super) fn tested(&self) -> Vec<String> {
        let Some(best) = self.ranked.first().filter(|_| self.evidence.is_some()) else {
            return Vec::new();
        };
        if best.steps.iter().all(|step| step.is_bound) {
            return Vec::new();
        }
        let names: Vec<&str> = self.ranked.iter().map(|of| of.name.as_str()).collect();
        let mut sentences = Vec::new();
        for (at, one) in names.iter().enumerate() {
            for other in &names[at + 1..] {
                let shown = [self.shown(one, other), self.shown(other, one)];
                let shown: Vec<String> = shown.into_iter().flatten().collect();
                match shown.is_empty() {
                    true if at == 0 => sentences.push(format!(
                        "{one} is not shown to be better than {other} in any of these numbers"
                    )),
                    true => {}
                    false => sentences.push(shown.join("; ")),
                }
            }
        }
        sentences
    }

    /// Sentence on a significant difference: `a is shown to be better than b in MAE of Fz (p = 0.001 by Holm)`.
    fn shown(&self, better: &str, than: &str) -> Option<String> {
        let of_both = self.evidence.iter().flatten();
        let of_both = of_both.filter(|of| of.better == better && of.than == than);
        let numbers: Vec<String> = of_both
            .map(|of| format!("{} ({} by Holm)", of.property, p_words(of.p)))
            .collect();
        (!numbers.is_empty()).then(|| {
            format!(
                "{better} is shown to be better than {than} in {}",
                listed(&numbers)
            )
        })
    }

    /// Clause for the sentence on first and second place, which states if tests support or contradict the order.
    pub(super) fn caveat(&self) -> String {
        let [first, second, ..] = self.ranked.as_slice() else {
            return String::new();
        };
        let Some(evidence) = &self.evidence else {
            return ", by published values, whose differences were not tested".to_owned();
        };
        let in_what = |better: &str, than: &str| -> Vec<String> {
            let shown = evidence.iter();
            let shown = shown.filter(|of| of.better == better && of.than == than);
            shown.map(|of| of.property.to_string()).collect()
        };
        let is_shown = |better: &str, than: &str| !in_what(better, than).is_empty();
        let mut against: Vec<String> = Vec::new();
        for (at, higher) in self.ranked.iter().enumerate() {
            for lower in &self.ranked[at + 1..] {
                let [higher, lower] = [&higher.name, &lower.name];
                if is_shown(lower, higher) && !is_shown(higher, lower) {
                    against.push(format!(
                        "{lower} is shown to be better than {higher} in {}",
                        listed(&in_what(lower, higher))
                    ));
                }
            }
        }
        let alone = match self.is_tied(0) || is_shown(&first.name, &second.name) {
            true => String::new(),
            false => format!(
                ", by values only: no test shows {} to be better than {}",
                first.name, second.name
            ),
        };
        match against.is_empty() {
            true => alone,
            false => format!("{alone}; tests contradict this order: {}", listed(&against)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue;

    #[test]
    fn results_on_different_test_parts_of_one_dataset_have_no_place() {
        let study = |name: &str, dataset: &str, seed: &str| {
            let entries = [
                ("dataset", dataset),
                ("split", "by-point 70/20/10"),
                ("seed", seed),
                ("part", "test"),
            ];
            Study {
                sensor: name.to_owned(),
                provenance: entries
                    .map(|(key, text)| (key.to_owned(), text.to_owned()))
                    .to_vec(),
                ..catalogue::find("GelSight").expect("there").as_study()
            }
        };
        let needs = Need::parse("normal force").expect("a need");
        let one = || study("one", "sha256:1", "1");
        let other = || study("other", "sha256:2", "1");
        let choice = choose_results(&[one(), study("two", "sha256:1", "2"), other()], &needs);
        let ranked: Vec<&str> = choice.ranked.iter().map(|of| of.name.as_str()).collect();
        assert_eq!(ranked, ["other"]);
        let apart: Vec<&str> = choice.apart.iter().map(|of| of.name.as_str()).collect();
        assert_eq!(apart, ["one", "two"]);
        for dropped in &choice.apart {
            let expected = "the test parts differ: one was tested on part test, ";
            assert!(dropped.reason.starts_with(expected), "{dropped:?}");
        }
        assert_eq!(choice.values().rows[1].plain()[..2], ["one", "not ranked"]);
        let mut unscored = study("two", "sha256:1", "2");
        unscored.scores.clear();
        let alone = choose_results(&[one(), unscored], &needs);
        assert_eq!((alone.ranked.len(), alone.apart.len()), (1, 0), "{alone:?}");
        let same = choose_results(&[one(), study("two", "sha256:1", "1"), other()], &needs);
        assert_eq!((same.ranked.len(), same.apart.len()), (3, 0), "{same:?}");
    }
}
