//! Tests of each choice against the other configurations. All tests of the sweep form one family.

mod reach;
mod trainings;

use std::collections::BTreeMap;

use taceva_core::Unit;
use taceva_metrics::{
    Better, ClusterSums, ComparisonError, Difference, Question, Sides, SignFlip, Verdict, decide,
    paired_over_trainings,
};
use taceva_report::{Cell, Column, Table};

use crate::analysis::Group;
use crate::choices::Choice;
use reach::{flips_of, out_of_reach};
use trainings::between_seeds;

/// Compares each chosen configuration with each other of the same recording, split and channel.
pub(crate) fn table(groups: &[Group<'_>], choices: &[Choice]) -> Table {
    let columns = ["recording", "split", "channel", "chosen", "other", "answer"];
    let mut table = Table::new("Chosen against every other", columns.map(Column::new));
    let mut pairs = Vec::new();
    let asked = choices.iter().map(|choice| choice.others.len()).sum();
    let test = SignFlip::default().with_flips(flips_of(asked));
    for choice in choices {
        let sums = |at: usize| pooled(&groups[at], &choice.channel);
        let chosen = sums(choice.chosen);
        for &other in &choice.others {
            let both = Sides {
                a: &chosen,
                b: &sums(other),
            };
            let spread = between_seeds(&groups[choice.chosen], &groups[other], &choice.channel);
            let tested = match spread {
                Some(spread) => paired_over_trainings(both, &[spread]),
                None => test.test(both),
            };
            pairs.push((choice, other, tested));
        }
    }
    let mut family: Vec<Difference> = pairs
        .iter()
        .filter_map(|(.., tested)| tested.as_ref().ok().cloned())
        .collect();
    decide(&mut family);
    let count = family.len();
    let out_of_reach = out_of_reach(&family);
    let mut decided = family.into_iter();
    for (choice, other, tested) in pairs {
        let tested: Result<Difference, ComparisonError> = match tested {
            Ok(before) => Ok(decided.next().unwrap_or(before)),
            Err(error) => Err(error),
        };
        let (group, against) = (&groups[choice.chosen], &groups[other]);
        let unit = Unit::from_symbol(unit_of(group, &choice.channel)).unwrap_or(Unit::One);
        let answer = match &tested {
            Err(error) => format!("no answer: {error}"),
            Ok(_) => Verdict::of(tested, Question::new(unit, Better::Lower)).words(Sides {
                a: "chosen",
                b: "other",
            }),
        };
        table.push([
            Cell::text(group.dataset),
            Cell::text(group.split.unwrap_or("as recorded")),
            Cell::text(choice.channel.as_str()),
            Cell::text(group.configuration.as_str()),
            Cell::text(against.configuration.as_str()),
            Cell::text(answer),
        ]);
    }
    table.note(format!(
        "Tests of mean absolute errors on test parts, paired by sample and summed by contact point over all seeds: by sign flips for one \
         seed and where no seed changes the difference, else by Student's t with the variance between seeds. All {count} tests of the \
         sweep form one family of Holm's procedure, at a level of 5 %."
    ));
    if let Some(words) = out_of_reach {
        table.note(words);
    }
    table
}

fn unit_of(group: &Group<'_>, channel: &str) -> &'static str {
    let first = group.results.first();
    let score = first.and_then(|(_, result)| result.score("mae", channel));
    score.map_or("", |score| score.unit.symbol())
}

/// Errors of all seeds by contact point. A press counts once, however often it was in a test part.
fn pooled(group: &Group<'_>, channel: &str) -> ClusterSums {
    let mut all: BTreeMap<u64, ClusterSums> = BTreeMap::new();
    for (seed, result) in &group.results {
        if let Some(sums) = result.sums(channel) {
            all.insert(*seed, sums);
        }
    }
    let mut sums = ClusterSums::default();
    for of_seed in all.values() {
        sums.merge(of_seed);
    }
    sums
}
