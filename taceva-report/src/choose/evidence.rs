//! What tests say about places, which follow values: who is shown to be better than whom, and in what.

use std::collections::BTreeSet;

use super::{Choice, Need, Property, choose};
use crate::catalogue::Sensor;
use crate::compare::{Answer, CompareRequest, compare};
use crate::figures::{listed, names};
use crate::number::significant;
use crate::results::Study;

/// A difference that is shown between two that are ranked, in a number that they were ranked by.
#[derive(Clone, Debug, PartialEq)]
pub struct Evidence {
    /// Who is better.
    pub better: String,
    /// Than whom.
    pub than: String,
    /// In which number.
    pub property: Property,
    /// The p value, adjusted by Holm's method over all pairs and channels of the metric.
    pub p: f64,
}

/// Chooses among the sensors of `studies` for `needs`, as [`choose`] does, and says which of the differences that rank them are shown: places
/// follow values, and a difference of values may be chance.
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
    let mut choice = choose(&sensors, needs);
    choice.evidence = Some(evidence(studies, needs, &choice));
    choice
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
        let at = answer.better()?;
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

impl Choice {
    /// What tests say of the best against each other one, a sentence each; nothing where nothing was tested, as of published numbers.
    pub(super) fn tested(&self) -> Vec<String> {
        let (Some(evidence), Some(best)) = (&self.evidence, self.ranked.first()) else {
            return Vec::new();
        };
        let is_ranked = best.steps.iter().any(|step| !step.is_bound);
        let others = self.ranked.iter().skip(1).filter(|_| is_ranked);
        let sentence = |other: &str| {
            let said = |better: &str, than: &str| {
                let shown = evidence.iter();
                let shown = shown.filter(|of| of.better == better && of.than == than);
                let shown: Vec<String> = shown
                    .map(|of| format!("{} (p = {})", of.property, significant(of.p)))
                    .collect();
                (!shown.is_empty()).then(|| {
                    format!(
                        "{better} is shown to be better than {than} in {}",
                        listed(&shown)
                    )
                })
            };
            let both = [said(&best.name, other), said(other, &best.name)];
            let both: Vec<String> = both.into_iter().flatten().collect();
            match both.is_empty() {
                true => format!(
                    "{} is not shown to be better than {other} in any of these numbers",
                    best.name
                ),
                false => both.join("; "),
            }
        };
        others.map(|other| sentence(&other.name)).collect()
    }

    /// What to add to the sentence that names first and second: whether a test shows the difference.
    pub(super) fn caveat(&self) -> String {
        let (Some(evidence), [first, second, ..]) = (&self.evidence, self.ranked.as_slice()) else {
            return String::new();
        };
        let is_shown = |better: &str, than: &str| {
            evidence
                .iter()
                .any(|of| of.better == better && of.than == than)
        };
        match (
            is_shown(&first.name, &second.name),
            is_shown(&second.name, &first.name),
        ) {
            (true, false) => String::new(),
            (false, false) => format!(
                ", by values alone: no test shows {} to be better than {}",
                first.name, second.name
            ),
            (_, true) => format!(
                ", by the mean share: {} is shown to be better than {} in some of the numbers",
                second.name, first.name
            ),
        }
    }
}
