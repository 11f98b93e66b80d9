//! Whether what was chosen is better than the others: one family of tests, which is the sweep.

use std::collections::BTreeMap;

use taceva_core::Unit;
use taceva_metrics::{
    Better, ClusterSums, ComparisonError, Difference, DifferenceTest, Question, Sides, SignFlip,
    Verdict, decide,
};
use taceva_report::{Cell, Column, Table};

use crate::analysis::Group;
use crate::chosen::Choice;

/// The level of the family.
const LEVEL: f64 = 0.05;
/// Flips for each test of the family: so that the least p value is half of what the first step of Holm's procedure takes, `LEVEL` over the tests.
const FLIPS_A_TEST: usize = 40;
/// Flips of all tests together, which are kept until the family is decided: 16 bytes each.
const MOST_FLIPS: usize = 1 << 24;

/// Each chosen configuration against each other of the same recording, split and channel.
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
            pairs.push((choice, other, test.test(both)));
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
        "Mean absolute errors on test parts, paired sample by sample and summed by contact point over all seeds; signs of contact points are flipped. All {count} tests of the sweep are one family of Holm's procedure, at a level of 5 %."
    ));
    if let Some(words) = out_of_reach {
        table.note(words);
    }
    table
}

/// How many patterns of signs each of so many tests tries: with so many, the first step of Holm's procedure is in reach.
fn flips_of(tests: usize) -> u32 {
    let wanted = tests
        .saturating_mul(FLIPS_A_TEST)
        .max(SignFlip::default().flips as usize);
    let most = (MOST_FLIPS / tests.max(1)).max(1);
    u32::try_from(wanted.min(most)).unwrap_or(u32::MAX)
}

/// That nothing can be shown, where no test of the family can have a p value that the first step of Holm's procedure takes.
fn out_of_reach(family: &[Difference]) -> Option<String> {
    let step = LEVEL / family.len() as f64;
    let least = family
        .iter()
        .filter_map(|difference| match difference.test {
            DifferenceTest::SignFlip {
                flips,
                exhaustive: true,
                ..
            } => Some(2.0 / f64::from(flips)),
            DifferenceTest::SignFlip { flips, .. } => Some(1.0 / (f64::from(flips) + 1.0)),
            _ => None,
        });
    let least = least.min_by(f64::total_cmp)?;
    (least > step).then(|| {
        format!(
            "Nothing can be shown here, whatever the difference: the first of {} tests needs p ≤ {step:.2e}, and with so few contact points or flips no p is below {least:.2e}. Sweep fewer configurations, press more points, or ask one question with taceva compare.",
            family.len()
        )
    })
}

fn unit_of<'a>(group: &'a Group<'_>, channel: &str) -> &'a str {
    let first = group.results.first();
    let score = first.and_then(|(_, result)| result.score("mae", channel));
    score.map_or("", |score| score.unit.as_str())
}

/// The errors of every seed by contact point, all seeds together: a press counts as one, however often it was in a test part.
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

#[cfg(test)]
mod tests {
    use super::*;

    fn sums(points: u32, errors: impl Fn(u32) -> f64) -> ClusterSums {
        let mut sums = ClusterSums::default();
        for point in 0..points {
            sums.try_add(&format!("p{point}"), errors(point))
                .expect("finite");
        }
        sums
    }

    fn family(tests: usize, points: u32) -> Vec<Difference> {
        let (a, b) = (
            sums(points, |_| 1.0),
            sums(points, |point| 2.0 + f64::from(point)),
        );
        let test = SignFlip::default().with_flips(flips_of(tests));
        let one = test.test(Sides { a: &a, b: &b }).expect("a test");
        let mut family = vec![one; tests];
        decide(&mut family);
        family
    }

    #[test]
    fn a_larger_family_has_more_flips_so_that_a_plain_difference_is_shown() {
        assert_eq!(flips_of(1), 10_000);
        assert_eq!(flips_of(600), 24_000);
        let family = family(600, 40);
        assert!(family.iter().all(|difference| difference.is_shown));
        assert_eq!(out_of_reach(&family), None);
    }

    #[test]
    fn a_family_in_which_nothing_can_be_shown_says_so() {
        // 2^8 patterns of signs: no p below 2/256, and Holm's first step of ten tests takes 0.005.
        let family = family(10, 8);
        assert!(family.iter().all(|difference| !difference.is_shown));
        let words = out_of_reach(&family).expect("out of reach");
        assert!(words.contains("Nothing can be shown"), "{words}");
        assert_eq!(out_of_reach(&[]), None);
    }
}
