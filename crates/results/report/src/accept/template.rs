//! Initial limits file for a result. The result meets each limit, and a comment at each limit states the value of the score.

use taceva_metrics::{Better, Range};
use taceva_metrology::conformity::{DecisionRule, Limits, decide};

use super::interval::LimitInterval;
use super::limits_file::BY_RULES;
use crate::escape::{terminal, toml_string};
use crate::number::{FormattedValue, spaced};
use crate::results::Study;
use crate::scores::ScoreTable;
use taceva_results::{Score, full_name, not_measured};

/// Distance of a limit from the value of the score, as a share of the value.
const MARGIN: f64 = 0.2;
/// Number of significant digits of a limit. More digits would suggest a higher accuracy.
const DIGITS: i32 = 3;
/// Decision rule of the template.
const GUARDED: DecisionRule = DecisionRule::Guarded {
    r: 1.0,
    coverage: 0.95,
};
/// Decision section of the template, with all rules as comments.
const DECISION: &str = r#"
# The rule by which limits are decided. The same keys below a [[limit]] hold for that limit alone.
#   rule = "simple"       the value meets the limit; its uncertainty decides nothing
#   rule = "guarded"      the value is inside the limit by r U, U the expanded uncertainty at `coverage`
#   rule = "probability"  the probability of conformity is at least `p_conformity`, above 0.5 and below 1
#   rule = "shared"       the value meets the limit, and U is at most `most_uncertainty`, in the unit of the score
# Verdicts: pass, conditional pass (within the limit, not accepted by the rule), conditional fail, fail, undecided (no interval).
[decision]
rule = "guarded"
r = 1.0
coverage = 0.95
"#;

/// Limits file for [`super::LimitsFile::read`]. Each headline score of `study` that takes part in verdicts and has a better direction gets one
/// limit, which the score meets. The limit is a fifth worse than the value, or at the worse end of its interval if that is farther away. For R² and
/// skill, 1 − value is a fifth larger at the limit. The rule is `guarded`, or `simple` if the interval is missing or leaves no room for a guard
/// band.
///
/// ```
/// use taceva_report::{LimitsFile, Study, accept, limits_template};
/// let result = r#"{"schema": "taceva.evaluation/1.0", "subject": {"sensor": "TacTip"},
///     "metrics": {"mae": {"Fz": {"value": 0.05, "unit": "N", "n": 46, "ci95": [0.04, 0.055]}}}}"#;
/// let study = Study::read(&taceva_files::seal::json::seal(result)?)?.remove(0);
/// let limits = LimitsFile::read(&limits_template(&study))?;
/// assert_eq!(limits.limits[0].most, Some(0.06));
/// assert!(accept(&study, &limits)?[0].is_kept);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn limits_template(study: &Study) -> String {
    let table = ScoreTable::of(std::slice::from_ref(study)).headlines();
    let scores = table
        .rows
        .iter()
        .filter_map(|row| study.score(&row.metric, &row.channel));
    let scores: Vec<&Score> = scores.collect();
    let (kept, barred): (Vec<&Score>, Vec<&Score>) = scores
        .into_iter()
        .partition(|score| score.standing.takes_part());
    let kept = kept.into_iter().map(Score::deciding);
    let limits: String = kept.filter_map(|score| limit(study, &score)).collect();
    let name = toml_string(&format!("limits made from a result of {}", study.sensor));
    let mut out = format!(
        "# Limits made from a result of {}, serial {}, samples {}.\n\
         # Each is {:.0} % worse than the value of the result (for R² and skill: 1 − value is {:.0} % larger), or the worse end of its interval if that is further: change limits as you need, delete the rest,\n\
         # then: taceva accept RESULT.json --limits THIS.toml\n\
         # `most` must not be exceeded, `least` must be reached.\n\
         limits_version = {BY_RULES}\nname = {name}\n{DECISION}",
        line(&study.sensor),
        line(&study.serial),
        line(&study.source),
        MARGIN * 100.0,
        MARGIN * 100.0
    );
    if let Some(words) = not_measured([study.source.as_str()]) {
        out += &format!("# {words}\n");
    }
    match limits.is_empty() {
        true => out += "\n# This result has no score to derive a limit from.\n",
        false => out += &limits,
    }
    out + &left_out(&barred)
}

/// Comments on scores for which no limit is written, grouped by reason; empty if there are none.
fn left_out(barred: &[&Score]) -> String {
    let mut groups: Vec<(&str, Vec<String>)> = Vec::new();
    for score in barred.iter().filter(|score| score.value.number().is_some()) {
        let Some(reason) = score.standing.reason() else {
            continue;
        };
        let name = line(&format!("{} {}", score.metric, score.channel));
        match groups.iter_mut().find(|(known, _)| *known == reason) {
            Some((_, names)) => names.push(name),
            None => groups.push((reason, vec![name])),
        }
    }
    let groups = groups.into_iter();
    let comments = groups.map(|(reason, names)| {
        format!(
            "\n# Left out, because no limit on them would be met ({reason}):\n# {}\n",
            names.join(", ")
        )
    });
    comments.collect()
}

/// Limit of one score as text, with the value as a comment; `None` for descriptive scores, absent values and differences of 0.
fn limit(study: &Study, score: &Score) -> Option<String> {
    let value = score.value.number()?;
    let variant = score.decided_by().map(|variant| variant.name.as_str());
    let interval = LimitInterval::of(study, score, variant);
    let [low, high] = interval.ends.unwrap_or([value; 2]);
    let room = value.abs() * MARGIN;
    let at_least = |room: f64| Bounds {
        least: Some(-upwards(-(value - room).min(low))),
        most: None,
    };
    let bounds = match score.better() {
        Better::Lower => Bounds {
            least: None,
            most: Some(upwards((value + room).max(high))),
        },
        // The margin applies to 1 − value, the unexplained share.
        Better::Higher if is_below_one(score) => at_least((1.0 - value).abs() * MARGIN),
        Better::Higher => at_least(room),
        Better::NearZero => {
            let reach = upwards((value.abs() + room).max(high.abs()).max(low.abs()));
            // A reach of zero leaves no room between two limits.
            if reach <= 0.0 {
                return None;
            }
            Bounds {
                least: Some(-reach),
                most: Some(reach),
            }
        }
        _ => return None,
    };
    let rule = match bounds.are_met_with_guard(&interval) {
        true => "",
        false => {
            "# No interval, or none that leaves room for a guard: decided by the value alone.\nrule = \"simple\"\n"
        }
    };
    let found =
        FormattedValue::of(&score.value, score.interval.as_ref()).phrase(&spaced(score.unit));
    Some(format!(
        "\n# result: {}, n = {}\n[[limit]]\nmetric = {}\nchannel = {}\nunit = {}\n{}{rule}",
        line(&found),
        score.n,
        toml_string(&full_name(&score.metric, variant)),
        toml_string(&score.channel),
        toml_string(score.unit.symbol()),
        bounds.lines(),
    ))
}

/// Bounds of a limit.
struct Bounds {
    least: Option<f64>,
    most: Option<f64>,
}

impl Bounds {
    /// True if the value meets the bounds by the rule of the template.
    fn are_met_with_guard(&self, interval: &LimitInterval) -> bool {
        let limits = Limits::of(self.least, self.most);
        let (Ok(limits), Ok(measured)) = (limits, &interval.measured) else {
            return false;
        };
        decide(measured, &limits, &GUARDED).is_ok_and(|decision| decision.word.is_pass())
    }

    /// Lines of the limit for the limits file.
    fn lines(&self) -> String {
        let line = |name: &str, end: Option<f64>| {
            end.map_or_else(String::new, |end| format!("{name} = {end:?}\n"))
        };
        line("least", self.least) + &line("most", self.most)
    }
}

/// True for scores of metrics that cannot exceed 1, such as R² and skill.
fn is_below_one(score: &Score) -> bool {
    let metric = taceva_metrics::catalogue::find(&score.metric);
    metric.is_some_and(|metric| metric.range == Range::BelowOne)
}

/// Replaces line breaks of `text`, so that it fits in a comment of one line.
fn line(text: &str) -> String {
    terminal(text).replace(['\n', '\r'], " ")
}

/// Rounds `number` up to [`DIGITS`] significant digits.
fn upwards(number: f64) -> f64 {
    if number.abs() < f64::MIN_POSITIVE {
        return 0.0;
    }
    let digits = usize::try_from(DIGITS - 1).unwrap_or(0);
    let rounded = |number: f64| format!("{number:.digits$e}").parse().unwrap_or(number);
    let nearest = rounded(number);
    // A rounding error of a product adds no digit.
    if nearest >= number - number.abs() * 1e-12 {
        return nearest;
    }
    let step = 10_f64.powf(number.abs().log10().floor() - f64::from(DIGITS - 1));
    let next = rounded(nearest + step);
    if next >= number { next } else { number }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accept::{LimitsFile, accept};
    use crate::catalogue;

    #[test]
    fn what_a_template_says_is_kept_by_the_result_it_is_of() {
        for name in ["GelSight", "MagicTac", "ViTacTip"] {
            let study = catalogue::find(name).expect("there").as_study();
            let limits = LimitsFile::read(&limits_template(&study)).expect("limits");
            assert!(limits.limits.len() > 8, "{name}");
            for finding in accept(&study, &limits).expect("checks") {
                assert!(finding.is_kept, "{name}: {:?}", finding.reason);
            }
        }
    }

    #[test]
    fn a_template_of_samples_that_nobody_measured_states_their_origin() {
        let of = |source: &str| {
            let study = Study {
                source: source.to_owned(),
                ..catalogue::find("GelSight").expect("there").as_study()
            };
            limits_template(&study)
        };
        let words = "\n# Nothing here was measured: the samples are synthetic.\n";
        assert!(of("synthetic").contains(words));
        assert!(!of("recorded").contains("here was measured"));
    }

    #[test]
    fn a_limit_is_worse_than_the_value_and_outside_the_interval() {
        let study = crate::results::unsealed(
            r#"{"schema": "taceva.evaluation/1.0", "subject": {"sensor": "a\n[[limit]] \"b"}, "metrics": {
                "mae": {"Fz": {"value": 0.05, "unit": "N", "n": 46, "ci95": [0.01, 0.0912345]}},
                "r2": {"Fz": {"value": 0.5, "unit": "1", "n": 46, "ci95": [0.25, 0.75]}},
                "bias": {"Fz": {"value": -0.1, "unit": "N", "n": 46}},
                "intrinsic": {"frame_rate": {"value": 30, "unit": "Hz", "n": 46}},
                "rmse": {"Fz": {"undefined": "no sample", "n": 0}}}}"#,
        );
        let study = study.expect("a result").remove(0);
        let limits = LimitsFile::read(&limits_template(&study)).expect("limits");
        let bounds: Vec<_> = limits
            .limits
            .iter()
            .map(|limit| (limit.metric.as_str(), limit.least, limit.most))
            .collect();
        assert_eq!(
            bounds,
            [
                ("mae", None, Some(0.0913)),
                ("bias", Some(-0.12), Some(0.12)),
                ("r2", Some(0.25), None)
            ]
        );
    }

    #[test]
    fn a_limit_on_r2_lets_a_fifth_more_be_unexplained_and_not_three_times_as_much() {
        let study = crate::results::unsealed(
            r#"{"schema": "taceva.evaluation/1.0", "subject": {"sensor": "x"}, "metrics": {
                "r2": {"Fz": {"value": 0.909, "unit": "1", "n": 46}}, "skill": {"Pz": {"value": -0.5, "unit": "1", "n": 46}},
                "tolerance": {"Fz": {"value": 0.5, "unit": "1", "n": 46}}}}"#,
        );
        let text = limits_template(&study.expect("a result").remove(0));
        let margin = "(for R² and skill: 1 − value is 20 % larger)";
        assert!(text.contains(margin), "{text}");
        let limits = LimitsFile::read(&text).expect("limits").limits;
        let least: Vec<_> = limits
            .iter()
            .map(|limit| (limit.metric.as_str(), limit.least))
            .collect();
        // 1 − 1.2 × 0.091, and 1 − 1.2 × 1.5. A share within a tolerance is reduced by a fifth.
        assert_eq!(
            least,
            [
                ("r2", Some(0.89)),
                ("skill", Some(-0.8)),
                ("tolerance", Some(0.4))
            ]
        );
    }

    #[test]
    fn what_shows_no_skill_is_left_out_by_name_and_reason() {
        let study = crate::results::unsealed(
            r#"{"schema": "taceva.evaluation/1.0", "subject": {"sensor": "x"}, "metrics": {
                "mae": {"Fz": {"value": 0.05, "unit": "N", "n": 46, "standing": "no skill"}, "Pz": {"value": 0.05, "unit": "mm", "n": 46}},
                "r2": {"Fz": {"value": 0.1, "unit": "1", "n": 46, "ci95": [-0.25, 0.75], "standing": "no skill"},
                       "Pz": {"value": 0.9, "unit": "1", "n": 46, "ci95": [0.8, 0.95]}}}}"#,
        );
        let text = limits_template(&study.expect("a result").remove(0));
        let limits = LimitsFile::read(&text).expect("limits").limits;
        let kept: Vec<_> = limits
            .iter()
            .map(|limit| (&*limit.metric, &*limit.channel))
            .collect();
        assert_eq!(kept, [("mae", "Pz"), ("r2", "Pz")]);
        assert!(
            text.contains("not better than predicting the mean: ")
                && text.contains("\n# mae Fz, r2 Fz\n"),
            "{text}"
        );
    }

    #[test]
    fn rounding_goes_upwards_only() {
        assert_eq!(
            [0.123_01, 0.123, -0.123_9, 0.0, 9.999, 1e-7].map(|value| upwards(value).to_bits()),
            [0.124, 0.123, -0.123, 0.0, 10.0, 1e-7].map(f64::to_bits)
        );
    }
}
