//! Ranks of sensors. Equal sensors share a rank.

use super::{Candidate, Choice};
use crate::names::listed;

/// Words for the first two ranks.
const FIRST: &str = "first";
const SECOND: &str = "second";

impl Choice {
    /// Rank of each sensor: 1 plus the number of better sensors. Equal sensors share a rank.
    pub fn places(&self) -> Vec<usize> {
        let mut places: Vec<usize> = Vec::new();
        for (at, candidate) in self.ranked.iter().enumerate() {
            let before = at.checked_sub(1).and_then(|before| {
                let is_same = same(candidate, self.ranked.get(before)?);
                places.get(before).filter(|_| is_same).copied()
            });
            places.push(before.unwrap_or(at + 1));
        }
        places
    }

    /// True if another sensor has the same rank as the sensor at position `at`.
    pub fn is_tied(&self, at: usize) -> bool {
        let own = self.ranked.get(at);
        let others = self.ranked.iter().enumerate();
        let mut others = others.filter(|(other, _)| *other != at);
        own.is_some_and(|own| others.any(|(_, other)| same(own, other)))
    }

    /// Sentence on first and second place with ties; `None` if no need ranks the sensors.
    pub(super) fn leaders(&self) -> Option<String> {
        let is_ranked = |candidate: &Candidate| {
            let mut steps = candidate.steps.iter();
            steps.any(|step| !step.is_bound)
        };
        if !self.ranked.iter().any(is_ranked) {
            return None;
        }
        let places = self.places();
        let at = |place: usize| -> Vec<String> {
            let all = self.ranked.iter().zip(&places);
            let there = all.filter(|(_, of)| **of == place);
            there.map(|(candidate, _)| candidate.name.clone()).collect()
        };
        let said = |names: &[String], word: &str| match names {
            [] => None,
            [one] => Some(format!("{one} {word}")),
            several => Some(format!("{} tie for {word}", listed(several))),
        };
        let first = at(1);
        let second = match first.len() {
            1 => said(&at(2), SECOND),
            _ => None,
        };
        let both = [said(&first, FIRST), second];
        let both: Vec<String> = both.into_iter().flatten().collect();
        Some(format!("{}{}", both.join(", "), self.caveat()))
    }
}

fn same(left: &Candidate, right: &Candidate) -> bool {
    left.share.total_cmp(&right.share).is_eq()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::choose::{Property, Step};
    use taceva_metrics::Standing;

    fn choice(shares: &[(&str, f64)], is_bound: bool) -> Choice {
        let candidate = |(name, share): &(&str, f64)| Candidate {
            name: (*name).to_owned(),
            share: *share,
            steps: vec![Step {
                need: "even surface".to_owned(),
                property: Property::Uniformity,
                value: Some(*share),
                inexact: None,
                interval: None,
                standing: Standing::Counts,
                share: (!is_bound).then_some(*share),
                part: None,
                is_bound,
                is_unmet: false,
                is_unsure: false,
            }],
        };
        Choice {
            ranked: shares.iter().map(candidate).collect(),
            evidence: Some(Vec::new()),
            ..Choice::default()
        }
    }

    #[test]
    fn equal_shares_have_one_place_and_are_called_a_tie() {
        let tied = choice(&[("a", 1.0), ("b", 1.0), ("c", 0.5)], false);
        assert_eq!(tied.places(), [1, 1, 3]);
        assert_eq!(tied.headline(), "a and b tie for first");
        assert_eq!([0, 1, 2].map(|at| tied.is_tied(at)), [true, true, false]);
        assert_eq!(tied.table().rows[1].plain()[0], "1 (tie)");
        assert!(tied.json().contains("\"tied\": true"));
        let behind = choice(&[("a", 1.0), ("b", 0.5), ("c", 0.5)], false);
        let alone = ", by values only: no test shows a to be better than b";
        let expected = format!("a first, b and c tie for second{alone}");
        assert_eq!(behind.headline(), expected);
        let apart = choice(&[("a", 1.0), ("b", 0.5)], false);
        assert_eq!(apart.headline(), format!("a first, b second{alone}"));
    }

    #[test]
    fn those_that_nothing_ranks_are_neither_first_nor_second() {
        let hard = choice(&[("a", 1.0), ("b", 1.0)], true);
        assert_eq!(
            hard.headline(),
            "a and b meet every need, as far as is known, and no need ranks them"
        );
    }
}
