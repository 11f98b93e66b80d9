//! Significance tests of each chosen configuration against the other configurations. All tests of the sweep form one family.

#[cfg(test)]
mod example_groups;
mod reach;
mod shared_seeds;
mod trainings;

use taceva_core::Unit;
use taceva_metrics::{
    Better, Difference, Question, Sides, SignFlip, Verdict, decide, paired_over_trainings,
};
use taceva_report::{Cell, Column, Table};

use crate::analysis::Group;
use crate::choices::Choice;
use reach::{flips_of, out_of_reach};
use shared_seeds::SharedSeeds;
use trainings::between_seeds;

/// A chosen configuration and a configuration compared with it.
struct Pair<'a> {
    choice: &'a Choice,
    other: usize,
    seeds: String,
    tested: Result<Difference, String>,
}

/// Compares each chosen configuration with every other configuration of the same recording, split and channel.
pub(crate) fn table(groups: &[Group<'_>], choices: &[Choice]) -> Table {
    let columns = [
        "recording",
        "split",
        "channel",
        "chosen",
        "other",
        "seeds",
        "answer",
    ];
    let mut table = Table::new(
        "Chosen against other configurations",
        columns.map(Column::new),
    );
    let mut pairs = Vec::new();
    let asked = choices.iter().map(|choice| choice.others.len()).sum();
    let test = SignFlip::default().with_flips(flips_of(asked));
    for choice in choices {
        for &other in &choice.others {
            let groups = Sides {
                a: &groups[choice.chosen],
                b: &groups[other],
            };
            let seeds = SharedSeeds::of(groups, &choice.channel);
            let both = Sides {
                a: &seeds.sums.a,
                b: &seeds.sums.b,
            };
            let spread = between_seeds(groups.a, groups.b, &choice.channel);
            let tested = match (seeds.count, spread) {
                (0, _) => Err("no seed has a result on both sides".to_owned()),
                (_, Some(spread)) => {
                    paired_over_trainings(both, &[spread]).map_err(|error| error.to_string())
                }
                (_, None) => test.test(both).map_err(|error| error.to_string()),
            };
            pairs.push(Pair {
                choice,
                other,
                seeds: seeds.words(),
                tested,
            });
        }
    }
    let mut family: Vec<Difference> = pairs
        .iter()
        .filter_map(|pair| pair.tested.as_ref().ok().cloned())
        .collect();
    decide(&mut family);
    let count = family.len();
    let out_of_reach = out_of_reach(&family);
    let mut decided = family.into_iter();
    for Pair {
        choice,
        other,
        seeds,
        tested,
    } in pairs
    {
        let (group, against) = (&groups[choice.chosen], &groups[other]);
        let unit = Unit::from_symbol(unit_of(group, &choice.channel)).unwrap_or(Unit::One);
        let answer = match tested {
            Err(error) => format!("no answer: {error}"),
            Ok(before) => {
                let tested = decided.next().unwrap_or(before);
                Verdict::of(Ok(tested), Question::new(unit, Better::Lower)).words(Sides {
                    a: "chosen",
                    b: "other",
                })
            }
        };
        table.push([
            Cell::text(group.dataset),
            Cell::text(group.split.unwrap_or("as recorded")),
            Cell::text(choice.channel.as_str()),
            Cell::text(group.configuration.as_str()),
            Cell::text(against.configuration.as_str()),
            Cell::text(seeds),
            Cell::text(answer),
        ]);
    }
    table.note(format!(
        "Tests compare mean absolute errors on test parts, over the seeds with results on both sides. Errors are paired by sample, and \
         summed by group of the split or by contact point. A test is by sign flips for one seed, and if no seed changes the difference; \
         otherwise by Student's t with the variance between seeds. All {count} tests of the sweep form one family of Holm's procedure, at a level of 5 %."
    ));
    table.note_all(out_of_reach);
    table
}

fn unit_of(group: &Group<'_>, channel: &str) -> &'static str {
    let first = group.results.first();
    let score = first.and_then(|(_, result)| result.score("mae", channel));
    score.map_or("", |score| score.unit.symbol())
}

#[cfg(test)]
mod tests {
    use super::example_groups::{group, result};
    use super::*;
    use crate::choices::choices;

    /// Rows of the table, each with the chosen configuration, the compared configuration, the seeds and the result.
    fn rows(groups: &[Group<'_>]) -> Vec<[String; 4]> {
        let choices = choices(groups, &["Fz".to_owned()]);
        let csv = table(groups, &choices).csv();
        let mut reader = csv::Reader::from_reader(csv.as_bytes());
        let rows = reader.records().map(|row| {
            let row = row.expect("a row");
            [3, 4, 5, 6].map(|at: usize| row[at].to_owned())
        });
        rows.collect()
    }

    #[test]
    fn a_seed_without_a_result_on_one_side_is_left_out_on_both_and_counted() {
        let (one, other) = ([0.5, 0.6, 0.7].map(result), [0.1, 0.2].map(result));
        let first = Group {
            configuration: "ridge".to_owned(),
            ..group(&[1, 2, 3], &one)
        };
        // Only the first has all seeds: it is chosen, although the other has smaller errors.
        let partial = group(&[1, 3], &other);
        let found = rows(&[first.clone(), partial]);
        let [[chosen, against, seeds, answer]] = &found[..] else {
            panic!("{found:?}");
        };
        assert_eq!((chosen.as_str(), against.as_str()), ("ridge", "cnn"));
        assert_eq!(seeds, "2 shared (chosen 3, other 2)");
        assert!(!answer.contains("no answer"), "{answer}");
        let whole = [0.1, 0.2, 0.3].map(result);
        let found = rows(&[first.clone(), group(&[1, 2, 3], &whole)]);
        assert_eq!(found[0][..3], ["cnn", "ridge", "3"]);
        let none = group(&[4], &whole[..1]);
        let found = rows(&[first, none]);
        assert_eq!(found[0][2], "0 shared (chosen 3, other 1)");
        assert_eq!(found[0][3], "no answer: no seed has a result on both sides");
    }

    #[test]
    fn a_seed_that_failed_everywhere_leaves_a_choice_among_the_others() {
        let (one, other) = ([0.5, 0.7].map(result), [0.1, 0.2].map(result));
        let groups = [group(&[1, 3], &one), group(&[1, 3], &other)];
        let groups = groups.map(|group| Group {
            is_whole: false,
            ..group
        });
        let choices = choices(&groups, &["Fz".to_owned()]);
        assert_eq!((choices[0].chosen, choices[0].among), (1, 2));
        assert_eq!(rows(&groups)[0][2], "2");
    }
}
