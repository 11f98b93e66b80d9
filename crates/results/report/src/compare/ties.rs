//! Finds ties, and studies that the tied studies do not significantly beat.

use super::{Answer, CompareRequest, compare};
use crate::names::listed;
use crate::results::Study;
use crate::tie::{GRATINGS, Tie, tie};

/// Ties of `studies` in predicting the spacing of gratings, one line each: `sr line: tie: GelSight and TacTip both predict the spacing of gratings
/// down to 0.25 mm to within 0.05 mm`.
pub fn ties(studies: &[Study]) -> Vec<String> {
    let names = crate::names::names(studies);
    let scores = studies.iter().flat_map(|study| study.of_metric(GRATINGS));
    let channels = taceva_core::distinct(scores.map(|score| score.channel.as_str()));
    let request = CompareRequest {
        metrics: vec![GRATINGS.to_owned()],
        ..CompareRequest::default()
    };
    let answers = compare(studies, &request).answers;
    let channels = channels.into_iter();
    let lines = channels.filter_map(|channel| {
        let tie = tie(studies, &names, GRATINGS, channel)?;
        let answers = answers.iter().filter(|answer| answer.channel == channel);
        let answers: Vec<&Answer> = answers.collect();
        let others = (0..studies.len()).filter(|at| {
            let score = studies[*at].score(GRATINGS, channel);
            score.is_some_and(|score| score.standing.takes_part() && score.value.number().is_some())
        });
        let unbeaten = tie.unbeaten(&answers, others, &names);
        Some(format!("{GRATINGS} {channel}: {}{unbeaten}", tie.words))
    });
    lines.collect()
}

impl Tie {
    /// Clause on studies that the tied studies do not significantly beat, by the `answers` on one score. Example: `; neither is shown to be better than
    /// MagicTac and ViTacTip`.
    pub(crate) fn unbeaten(
        &self,
        answers: &[&Answer],
        others: impl IntoIterator<Item = usize>,
        names: &[String],
    ) -> String {
        let others: Vec<usize> = others
            .into_iter()
            .filter(|at| !self.who.contains(at))
            .collect();
        let unbeaten = |tied: usize| -> Vec<usize> {
            let loses = |other: usize| {
                let mut answers = answers.iter();
                answers.any(|answer| {
                    let both = [answer.sides.a, answer.sides.b];
                    both.contains(&other) && answer.better() == Some(tied)
                })
            };
            others.iter().copied().filter(|at| !loses(*at)).collect()
        };
        let all: Vec<Vec<usize>> = self.who.iter().map(|tied| unbeaten(*tied)).collect();
        let named = |rivals: &[usize]| {
            let names: Vec<String> = rivals.iter().map(|at| names[*at].clone()).collect();
            listed(&names)
        };
        let who = match self.who.len() {
            2 => "neither",
            _ => "none of them",
        };
        match all.as_slice() {
            _ if others.is_empty() => String::new(),
            [first, rest @ ..] if rest.iter().all(|other| other == first) => match first.is_empty()
            {
                true => "; each is shown to be better than all others".to_owned(),
                false => format!("; {who} is shown to be better than {}", named(first)),
            },
            _ => {
                let pairs = self.who.iter().zip(&all);
                let pairs = pairs.filter(|(_, rivals)| !rivals.is_empty());
                let said = pairs.map(|(tied, rivals)| {
                    let (name, rivals) = (&names[*tied], named(rivals));
                    format!("; {name} is not shown to be better than {rivals}")
                });
                said.collect()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use taceva_results::Samples;

    /// Study with a success rate of `share`, a share `exact` of exact predictions, and the rows `samples`, unless empty.
    fn study(name: &str, [share, exact]: [f64; 2], samples: &str) -> Study {
        let text = format!(
            r#"{{"schema": "taceva.evaluation/1.0", "subject": {{"sensor": "{name}"}}, "metrics": {{"sr": {{"line":
               {{"value": {share}, "unit": "1", "parameters": {{"tolerance_mm": 0.05}}, "exact": {{"value": {exact}, "unit": "1"}}}}}}}}}}"#
        );
        let mut study = crate::results::unsealed(&text).expect("a result").remove(0);
        study.samples = (!samples.is_empty()).then(|| {
            let head = "id,kind,spacing_mm,spacing_predicted_mm\n";
            Samples::read(&format!("{head}{samples}")).expect("samples")
        });
        study
    }

    #[test]
    fn a_tie_says_how_fine_both_resolve_and_a_winner_is_no_tie() {
        let fine = "1,line,0.5,0.5\n2,line,0.3,0.35\n3,line,0.2,0.4\n4,dot,0.1,0.1\n";
        let both = [study("a", [0.75, 0.5], fine), study("b", [0.75, 0.5], fine)];
        let expected = "sr line: tie: a and b both predict the spacing of gratings down to 0.3 mm to within 0.05 mm, and no finer tolerance separates them";
        assert_eq!(ties(&both), [expected]);
        let other = [study("a", [1.0, 0.5], ""), study("b", [0.9, 0.5], "")];
        assert!(ties(&other).is_empty());
    }

    #[test]
    fn a_prediction_that_is_always_a_learnt_board_is_called_that() {
        let tied = |samples: &str| {
            let both = [
                study("a", [1.0, 1.0], samples),
                study("b", [1.0, 1.0], samples),
            ];
            ties(&both).remove(0)
        };
        let apart = tied("1,line,0.5,0.5\n2,line,0.4,0.4\n3,line,0.25,0.25\n4,dot,0.3,0.3\n");
        let expected = "sr line: tie: a and b both predict the spacing of gratings down to 0.25 mm to within 0.05 mm, which means the right one of 3 learnt boards at least 0.1 mm apart, and no finer tolerance separates them";
        assert_eq!(apart, expected);
        let close = tied("1,line,0.5,0.5\n2,line,0.46,0.46\n3,line,0.25,0.25\n");
        assert!(close.contains("to within 0.05 mm, each time as one of 3 learnt boards"));
        // A model that predicts a length does not choose a learnt board.
        let between = tied("1,line,0.5,0.51\n2,line,0.4,0.4\n");
        assert!(!between.contains("learnt"), "{between}");
    }

    #[test]
    fn a_sensor_that_resolves_every_board_resolves_the_finest() {
        let pressed = "1,line,0.5,\n2,line,0.25,\n3,dot,0.1,\n";
        let all = [
            study("a", [1.0, 0.5], pressed),
            study("b", [1.0, 0.25], pressed),
        ];
        let expected = "sr line: tie: a and b both predict the spacing of gratings down to 0.25 mm to within 0.05 mm; exact predictions: a 50 %, b 25 %";
        assert_eq!(ties(&all), [expected]);
    }

    #[test]
    fn without_samples_shares_are_said_and_which_of_them_is_finer() {
        let of = |exact: f64| study("x", [0.9, exact], "");
        let mut all = [of(0.5), of(0.75), study("worse", [0.2, 0.2], "")];
        "a".clone_into(&mut all[0].sensor);
        "b".clone_into(&mut all[1].sensor);
        let expected = "sr line: tie: a and b both predict the spacing of 90 % of the gratings to within 0.05 mm; exact predictions: a 50 %, b 75 %; neither is shown to be better than worse";
        assert_eq!(ties(&all), [expected]);
    }

    #[test]
    fn what_has_no_skill_is_tied_with_nobody() {
        let mut all = [study("a", [0.9, 0.5], ""), study("b", [0.9, 0.5], "")];
        all[1].scores[0].standing = taceva_metrics::Standing::NoSkill;
        assert!(ties(&all).is_empty());
    }
}
