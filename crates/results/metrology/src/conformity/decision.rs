//! Decision about one measured value.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::{ConformityError, DecisionRule, Limits, Measurement};

/// ILAC-G8 word for a decision.
///
/// ```
/// use taceva_metrology::conformity::Word;
/// assert_eq!(Word::ConditionalPass.to_string(), "conditional pass");
/// assert!(Word::Pass.is_pass() && !Word::ConditionalPass.is_pass());
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Word {
    /// Accepted by the rule.
    #[serde(rename = "pass")]
    Pass,
    /// Within the limit, but not accepted by the rule.
    #[serde(rename = "conditional pass")]
    ConditionalPass,
    /// Beyond the limit, but not rejected by the rule.
    #[serde(rename = "conditional fail")]
    ConditionalFail,
    /// Rejected by the rule.
    #[serde(rename = "fail")]
    Fail,
    /// No decision: the uncertainty is unknown, or exceeds the agreed maximum.
    #[serde(rename = "undecided")]
    Undecided,
}

impl Word {
    /// True for an unconditional pass.
    #[must_use]
    pub fn is_pass(self) -> bool {
        self == Word::Pass
    }
}

impl fmt::Display for Word {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Word::Pass => "pass",
            Word::ConditionalPass => "conditional pass",
            Word::ConditionalFail => "conditional fail",
            Word::Fail => "fail",
            Word::Undecided => "undecided",
        })
    }
}

/// Decision about one measured value, with the numbers that led to the decision.
///
/// ```
/// use taceva_metrology::conformity::{DecisionRule, Limits, Measurement, decide};
/// let measured = Measurement::new(0.045, 0.004, f64::INFINITY)?;
/// let rule = DecisionRule::Probability { p_conformity: 0.95 };
/// let decision = decide(&measured, &Limits::at_most(0.05)?, &rule)?;
/// let acceptance = decision.acceptance.and_then(|limits| limits.most()).ok_or("a limit")?;
/// // 1.645 standard uncertainties inside.
/// assert!((acceptance - (0.05 - 1.644_853_626_951_472_7 * 0.004)).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Decision {
    /// Measured value.
    pub value: f64,
    /// Standard uncertainty, in the unit of the value; `None` if unknown.
    pub standard_uncertainty: Option<f64>,
    /// Degrees of freedom of the uncertainty; `None` if infinite or unknown.
    pub freedom: Option<f64>,
    /// Coverage factor of the expanded uncertainty; `None` if the uncertainty is unknown.
    pub coverage_factor: Option<f64>,
    /// Expanded uncertainty at the coverage of the rule, in the unit of the value; `None` if unknown. Linear approximation for a logarithmic scale.
    pub expanded_uncertainty: Option<f64>,
    /// Limits of the tolerance.
    pub limits: Limits,
    /// Decision rule.
    pub rule: DecisionRule,
    /// Limits of accepted values; `None` without an uncertainty, or if no value is accepted.
    pub acceptance: Option<Limits>,
    /// Probability of conformity; `None` if the uncertainty is unknown.
    pub conformance_probability: Option<f64>,
    /// Decision in one word.
    pub word: Word,
}

/// Decides about `measured` by `rule`.
///
/// ```
/// use taceva_metrology::conformity::{DecisionRule, Limits, Measurement, Word, decide};
/// let unknown = Measurement::without_uncertainty(0.01)?;
/// let rule = DecisionRule::Guarded { r: 1.0, coverage: 0.95 };
/// let decision = decide(&unknown, &Limits::at_most(0.05)?, &rule)?;
/// assert_eq!(decision.word, Word::Undecided);
/// # Ok::<(), taceva_metrology::conformity::ConformityError>(())
/// ```
///
/// # Errors
/// [`ConformityError::Number`] for a setting of the rule outside its range.
pub fn decide(
    measured: &Measurement,
    limits: &Limits,
    rule: &DecisionRule,
) -> Result<Decision, ConformityError> {
    rule.check()?;
    let probability = measured.conformance_probability(limits);
    let coverage = rule.coverage();
    // Expanded uncertainties are agreed and printed in the unit of the value, even on a logarithmic scale.
    let expanded = measured.expanded(coverage).map(|of| measured.in_unit(of));
    let is_within = limits.contain(measured.value());
    let (acceptance, word) = match (rule, probability) {
        (DecisionRule::Simple, _) => (
            Some(*limits),
            if is_within { Word::Pass } else { Word::Fail },
        ),
        (_, None) => (None, Word::Undecided),
        (
            DecisionRule::Shared {
                most_uncertainty, ..
            },
            Some(_),
        ) => {
            let is_agreed = expanded.is_some_and(|expanded| expanded <= *most_uncertainty);
            match (is_agreed, is_within) {
                (true, true) => (Some(*limits), Word::Pass),
                (true, false) => (Some(*limits), Word::Fail),
                (false, _) => (None, Word::Undecided),
            }
        }
        (DecisionRule::Guarded { r, .. }, Some(_)) => {
            let guard = r * measured.expanded(coverage).unwrap_or(f64::INFINITY);
            let inner = measured.narrowed(limits, guard);
            let outer = measured.narrowed(limits, -guard);
            let is_accepted = inner.is_some_and(|inner| inner.contain(measured.value()));
            // Limits beyond binary64 refuse no value.
            let is_refused = outer.is_some_and(|outer| !outer.contain(measured.value()));
            (inner, word(is_accepted, is_within, is_refused))
        }
        (DecisionRule::Probability { p_conformity }, Some(p)) => {
            let least = *p_conformity;
            let inner = acceptance_of(measured, limits, least);
            (inner, word(p >= least, is_within, 1.0 - p >= least))
        }
    };
    Ok(Decision {
        value: measured.value(),
        standard_uncertainty: measured.standard_uncertainty(),
        freedom: measured.freedom().filter(|freedom| freedom.is_finite()),
        coverage_factor: measured.coverage_factor(coverage),
        expanded_uncertainty: expanded,
        limits: *limits,
        rule: *rule,
        acceptance,
        conformance_probability: probability,
        word,
    })
}

fn word(is_accepted: bool, is_within: bool, is_refused: bool) -> Word {
    match (is_accepted, is_within, is_refused) {
        (true, _, _) => Word::Pass,
        (_, true, _) => Word::ConditionalPass,
        (_, _, false) => Word::ConditionalFail,
        (_, _, true) => Word::Fail,
    }
}

/// Range of values whose probability of conformity is at least `least`; `None` for an empty range.
fn acceptance_of(measured: &Measurement, limits: &Limits, least: f64) -> Option<Limits> {
    let u = measured.expanded(0.5)?;
    if u <= 0.0 {
        return Some(*limits);
    }
    let is_enough = |guard: f64| {
        let inner = measured.narrowed(limits, guard)?;
        // A limit outside the domain of the scale is not moved. If both limits are moved, both ends are equally probable.
        let is_moved = |limit: Option<f64>| limit.is_some_and(|limit| measured.holds(limit));
        let low = inner.least().filter(|_| is_moved(limits.least()));
        let high = inner.most().filter(|_| is_moved(limits.most()));
        let end = low.or(high).unwrap_or(measured.value());
        let p = measured.at(end).conformance_probability(limits)?;
        Some(p >= least)
    };
    // The probability grows with the guard, up to the middle of two limits.
    let mut high = u;
    while is_enough(high) == Some(false) {
        high *= 2.0;
        // An error has no value below a limit of 0.
        if high.is_infinite() {
            return None;
        }
    }
    let mut low = 0.0;
    loop {
        let middle = f64::midpoint(low, high);
        if middle <= low || middle >= high {
            break;
        }
        match is_enough(middle) {
            Some(false) => low = middle,
            Some(true) | None => high = middle,
        }
    }
    match is_enough(high) {
        Some(true) => measured.narrowed(limits, high),
        _ => None,
    }
}
