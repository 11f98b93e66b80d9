//! The standing of scores without one: older results, and published numbers.

use taceva_metrics::{Standing, catalogue};

use super::{Interval, Score};

/// Gives `scores` the standing that their R² says: a channel whose interval does not lie above zero shows no skill, of one without an
/// interval it is not known; of a channel without R² nothing is known.
pub(crate) fn by_r2(scores: &mut [Score]) {
    judge(scores, |r2| {
        let ends = r2.interval.as_ref().and_then(Interval::ends);
        Standing::of_value(ends.map(|[low, _]| low), r2.value.number())
    });
}

/// The same of published numbers, which have no interval: by the value of R² itself.
pub(crate) fn by_published_r2(scores: &mut [Score]) {
    judge(scores, |r2| match r2.value.number() {
        None => Standing::SkillUnknown,
        number => Standing::of_skill(number),
    });
}

fn judge(scores: &mut [Score], of_r2: impl Fn(&Score) -> Standing) {
    let skills: Vec<(String, Standing)> = scores
        .iter()
        .filter(|score| score.metric == "r2")
        .map(|score| (score.channel.clone(), of_r2(score)))
        .collect();
    let skill_of = |channel: &str| {
        let found = skills.iter().find(|(name, _)| name == channel);
        found.map_or(Standing::SkillUnknown, |(_, standing)| *standing)
    };
    for score in scores {
        let Some(metric) = catalogue::find(&score.metric) else {
            continue;
        };
        let own = [score.channel.clone()];
        let channels = match score.of.is_empty() {
            true => &own[..],
            false => &score.of,
        };
        let channels = channels.iter().map(String::as_str);
        score.standing = Standing::of_channels(metric, channels, skill_of).max(score.standing);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Study;

    fn read(schema: &str, metrics: &str) -> Study {
        let text = format!(
            r#"{{"schema": "{schema}", "subject": {{"sensor": "x"}}, "metrics": {{{metrics}}}}}"#
        );
        let text = taceva_files::seal::json::seal(&text).expect("an object");
        Study::read(&text).expect("results").remove(0)
    }

    const SCORES: &str = r#"
        "mae": {"Pz": {"value": 1, "unit": "mm"}, "Fz": {"value": 1, "unit": "N"}, "Fx": {"value": 1, "unit": "N"},
                "Fxy": {"value": 1, "unit": "N", "of": ["Fx", "Fz"]}},
        "sensitivity": {"Fz": {"value": 1, "unit": "mm/N"}},
        "r2": {"Pz": {"value": 0.1, "unit": "1", "ci95": [-0.2, 0.4], "method": "jackknife by point_id, G=32"},
               "Fz": {"value": 0.5, "unit": "1", "ci95": [0.4, 0.6], "method": "jackknife by point_id, G=32"}}"#;

    fn standings(study: &Study) -> Vec<Standing> {
        let channels = ["Pz", "Fz", "Fx", "Fxy"];
        let of = |channel| study.score("mae", channel).expect("there").standing;
        channels.into_iter().map(of).collect()
    }

    #[test]
    fn results_of_before_standings_are_judged_by_their_r2() {
        let study = read("taceva.evaluation/1.1", SCORES);
        let (counts, unknown) = (Standing::Counts, Standing::SkillUnknown);
        assert_eq!(
            standings(&study),
            [Standing::NoSkill, counts, unknown, unknown]
        );
        let of_truth = study.score("sensitivity", "Fz").expect("there");
        assert_eq!(of_truth.standing, counts);
    }

    #[test]
    fn of_an_older_r2_without_an_interval_it_is_not_known_whether_there_is_skill() {
        let without = SCORES.replace(
            r#", "ci95": [0.4, 0.6], "method": "jackknife by point_id, G=32""#,
            "",
        );
        assert_ne!(without, SCORES);
        let study = read("taceva.evaluation/1.1", &without);
        assert_eq!(standings(&study)[1], Standing::NoInterval);
    }

    #[test]
    fn results_that_say_standings_are_taken_at_their_word() {
        let study = read("taceva.evaluation/1.2", SCORES);
        assert_eq!(standings(&study), [Standing::Counts; 4]);
        let said = r#""mae": {"Pz": {"value": 1, "unit": "mm", "standing": "bounded", "bounded_share": 0.25}}"#;
        let study = read("taceva.evaluation/1.2", said);
        let score = study.score("mae", "Pz").expect("there");
        assert_eq!(
            (score.standing, score.bounded_share),
            (Standing::Bounded, Some(0.25))
        );
    }

    #[test]
    fn a_standing_that_nobody_knows_is_refused_by_its_place() {
        let text = r#"{"schema": "taceva.evaluation/1.2", "subject": {"sensor": "x"}, "metrics": {"mae": {"Pz":
            {"value": 1, "unit": "mm", "standing": "champion"}}}}"#;
        let text = taceva_files::seal::json::seal(text).expect("an object");
        let error = Study::read(&text).expect_err("unknown").to_string();
        assert!(error.contains("metrics.mae.Pz.standing"), "{error}");
        assert!(error.contains("`champion`"), "{error}");
    }

    #[test]
    fn published_numbers_are_judged_by_the_value_of_their_r2() {
        let mut scores = read(
            "taceva.evaluation/1.2",
            r#""mae": {"Pz": {"value": 1, "unit": "mm"}, "Fz": {"value": 1, "unit": "N"}},
               "r2": {"Pz": {"value": 0.9, "unit": "1"}, "Fz": {"value": -0.1, "unit": "1"}}"#,
        )
        .scores;
        by_published_r2(&mut scores);
        let standings: Vec<Standing> = scores[..2].iter().map(|score| score.standing).collect();
        assert_eq!(standings, [Standing::Counts, Standing::NoSkill]);
    }
}
