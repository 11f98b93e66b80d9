//! Reasons for decisions, as text.

use taceva_metrology::conformity::{Decision, DecisionRule, Word};

use super::interval::LimitInterval;
use super::limits_file::Limit;
use crate::number::numeral;

/// Reason why the value, or its whole interval, does not meet a limit; `None` if it does.
pub(super) fn broken(limit: &Limit, value: f64, ends: Option<[f64; 2]>) -> Option<String> {
    let [low, high] = match (limit.whole_interval, ends) {
        (false, _) => [value; 2],
        (true, Some(ends)) => ends,
        (true, None) => return Some("there is no interval to compare with the limit".to_owned()),
    };
    let subject = if limit.whole_interval {
        "interval reaches"
    } else {
        "value is"
    };
    if let Some(most) = limit.most.filter(|most| high > *most) {
        return Some(format!("{subject} {}, above {most}", numeral(high)));
    }
    let least = limit.least.filter(|least| low < *least)?;
    Some(format!("{subject} {}, below {least}", numeral(low)))
}

/// Remark on a value within the limit, if the interval is missing or crosses the limit.
pub(super) fn by_value_only(limit: &Limit, ends: Option<[f64; 2]>) -> Option<String> {
    let Some([low, high]) = ends else {
        return Some("met by the value only: there is no interval".to_owned());
    };
    let is_above = limit.most.is_some_and(|most| high > most);
    let is_below = limit.least.is_some_and(|least| low < least);
    (is_above || is_below)
        .then(|| "met by the value only: its interval crosses the limit".to_owned())
}

/// Reason why the decision is not a pass, or a remark that a pass ignores the interval.
pub(super) fn of_decision(
    limit: &Limit,
    decision: &Decision,
    interval: &LimitInterval,
) -> Option<String> {
    let beyond = || broken(limit, decision.value, interval.ends).unwrap_or_default();
    let p = decision.conformance_probability.map(numeral);
    let p = p.map_or_else(String::new, |p| format!("probability of conformity {p}"));
    match decision.word {
        Word::Pass => match decision.rule {
            DecisionRule::Guarded { .. } | DecisionRule::Probability { .. } => None,
            _ => by_value_only(limit, interval.ends),
        },
        Word::ConditionalPass => Some(match acceptance(decision) {
            Some(limits) => {
                format!("within the limit, not within the acceptance limit {limits}; {p}")
            }
            None => format!("within the limits, which leave no room for the uncertainty; {p}"),
        }),
        Word::ConditionalFail => Some(format!("{}; {p}", beyond())),
        Word::Undecided => Some(undecided(limit, decision, interval)),
        _ => Some(beyond()),
    }
}

/// Acceptance limits as text, such as `≤ 0.0432`; `None` without acceptance limits.
pub(super) fn acceptance(decision: &Decision) -> Option<String> {
    let limits = decision.acceptance.as_ref()?;
    Some(bounds(limits.least(), limits.most()))
}

/// Text before the effect of a guard band on a logarithmic scale.
pub(super) const ON_SCALE: &str = ", on the logarithmic scale of the interval: ";

/// Effect of a guard band on the limits, such as `the limit divided by 1.57`. `None` without a guard band, or if its width is in the unit of the
/// value.
pub(super) fn guard(decision: &Decision, interval: &LimitInterval) -> Option<String> {
    let measured = interval.measured.as_ref().ok()?;
    let quantity = measured.guarded_quantity()?;
    let accepted = decision.acceptance.as_ref()?;
    let limits = &decision.limits;
    let ends = [
        (limits.most(), accepted.most(), " (upper)"),
        (limits.least(), accepted.least(), " (lower)"),
    ];
    let effects = ends.into_iter().filter_map(|(limit, inner, end)| {
        let (limit, inner) = limit.zip(inner)?;
        let end = match limits.least().and(limits.most()) {
            Some(_) => end,
            None => "",
        };
        let quotient = measured.guard_quotient(limit, inner);
        let is_moved = (limit - inner).abs() > 0.0;
        is_moved.then(|| match quotient < 1.0 {
            true => format!("divided by {}{end}", numeral(1.0 / quotient)),
            false => format!("multiplied by {}{end}", numeral(quotient)),
        })
    });
    let effects: Vec<String> = effects.collect();
    (!effects.is_empty()).then(|| format!("{quantity} {}", effects.join(" and ")))
}

/// Bounds as text, such as `≤ 0.05`.
pub(super) fn bounds(least: Option<f64>, most: Option<f64>) -> String {
    match (least, most) {
        (Some(least), Some(most)) => format!("{} … {}", numeral(least), numeral(most)),
        (Some(least), None) => format!("≥ {}", numeral(least)),
        (None, Some(most)) => format!("≤ {}", numeral(most)),
        (None, None) => String::new(),
    }
}

fn undecided(limit: &Limit, decision: &Decision, interval: &LimitInterval) -> String {
    match (&interval.measured, decision.rule) {
        (Err(reason), _) => format!("without an uncertainty: {reason}"),
        (
            Ok(_),
            DecisionRule::Shared {
                most_uncertainty, ..
            },
        ) => {
            let expanded = decision.expanded_uncertainty.map(numeral);
            let (expanded, unit) = (expanded.unwrap_or_default(), &limit.unit);
            format!(
                "U is {expanded} {unit}, expected at most {most_uncertainty} {unit} by the rule"
            )
        }
        (Ok(_), _) => "without an uncertainty".to_owned(),
    }
}
