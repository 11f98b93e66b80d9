//! Standing of published numbers in verdicts.

use taceva_metrics::{Standing, catalogue};

use taceva_results::Score;

/// Sets the standing of `scores` by their published R². A published R² has no interval.
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

    #[test]
    fn published_numbers_are_judged_by_the_value_of_their_r2() {
        let text = r#"{"schema": "taceva.evaluation/1.0", "subject": {"sensor": "x"}, "metrics": {
            "mae": {"Pz": {"value": 1, "unit": "mm"}, "Fz": {"value": 1, "unit": "N"}},
            "r2": {"Pz": {"value": 0.9, "unit": "1"}, "Fz": {"value": -0.1, "unit": "1"}}}}"#;
        let mut scores = crate::results::unsealed(text)
            .expect("results")
            .remove(0)
            .scores;
        by_published_r2(&mut scores);
        let standings: Vec<Standing> = scores[..2].iter().map(|score| score.standing).collect();
        assert_eq!(standings, [Standing::Counts, Standing::NoSkill]);
    }
}
