//! Figures that include other figures, and effects that a test does not vary. A budget must count each effect once.

use super::error::{BudgetError, BudgetProblem};
use super::evidence::Evidence;
use super::input::Input;
use super::report::Missing;

/// Figure of the height from which depths are measured. The error of this height differs between presses, so residuals and repeats contain it.
const ZERO: &str = "zero_u_mm";

/// Figures of residuals, each with the figures included in it.
const INSIDE: [(&str, &[&str]); 4] = [
    (
        "error",
        &[
            "error.between",
            "error.within",
            "bias",
            "repeatability",
            "noise",
            "placement",
            ZERO,
        ],
    ),
    (
        "error.within",
        &["repeatability", "noise", "placement", ZERO],
    ),
    ("error.between", &[ZERO]),
    ("repeatability", &[ZERO]),
];

/// Figures of effects that are constant over the presses of one unit in one session, each with the effect in words.
const UNEXERCISED: [(&str, &str); 4] = [
    ("hysteresis", "unloading"),
    ("r_light", "other light"),
    ("gauge", "other units"),
    ("drift", "other days"),
];

/// Rejects two sources that use the same figure, and a source whose effect another source includes.
pub(super) fn check(inputs: &[Input]) -> Result<(), BudgetError> {
    let of = |input: &Input| input.from.clone().unwrap_or_default();
    for (at, input) in inputs.iter().enumerate() {
        let Some(from) = input.from.clone() else {
            continue;
        };
        let error = |problem| Err(BudgetError::new(input.line, "from", problem));
        if let Some(first) = inputs[..at].iter().find(|first| of(first) == from) {
            let other = first.line;
            return error(BudgetProblem::Twice { name: from, other });
        }
        let holder = inputs.iter().find(|outer| holds(&of(outer), &from));
        if let Some(outer) = holder {
            let (inner, line) = (from, outer.line);
            let outer = of(outer);
            return error(BudgetProblem::Inside { inner, outer, line });
        }
    }
    Ok(())
}

/// True if the figure `outer` includes the figure `inner`.
fn holds(outer: &str, inner: &str) -> bool {
    if let (Some((file, sum)), Some((other, part))) =
        (outer.rsplit_once('#'), inner.rsplit_once('#'))
    {
        return file == other && holds_component(sum, part);
    }
    let plain = match inner.rsplit_once('#') {
        Some((_, "repeatability")) => "repeatability",
        _ => inner,
    };
    let whole = match outer.rsplit_once('#') {
        Some((_, "repeatability" | "gauge" | "total")) => "repeatability",
        _ => outer,
    };
    let inside = INSIDE.iter().find(|(name, _)| *name == whole);
    let is_inside = inside.is_some_and(|(_, figures)| figures.contains(&plain));
    is_inside || (plain == outer && inner != outer)
}

/// True if the component `sum` of a gauge study includes its component `part`. Unknown names are names of operators.
fn holds_component(sum: &str, part: &str) -> bool {
    const SUMS: [&str; 5] = ["reproducibility", "repeatability", "gauge", "part", "total"];
    match sum {
        "total" => part != sum,
        "gauge" => part != sum && !["part", "total"].contains(&part),
        "reproducibility" => !SUMS.contains(&part),
        _ => false,
    }
}

/// Effects that no source names by `from` or `covers`.
pub(super) fn missing(inputs: &[Input], evidence: &Evidence) -> Vec<Missing> {
    let is_of = |name: &str, figure: &str| match figure {
        // A component of a gauge study, such as `gauge.json#unit`.
        "gauge" => name == figure || name.contains('#') || name.starts_with("gauge."),
        _ => name == figure,
    };
    let names = |input: &Input| [input.from.clone(), input.covers.clone()];
    let all: Vec<String> = inputs.iter().flat_map(names).flatten().collect();
    let absent = UNEXERCISED
        .iter()
        .filter(|(figure, _)| !all.iter().any(|name| is_of(name, figure)));
    let effects = absent.map(|(figure, effect)| {
        let is_measured = evidence.names().any(|name| is_of(name, figure));
        let reason = match is_measured {
            true => "measured, but no source of the budget names it",
            false => "not in this recording",
        };
        Missing::new(figure, &format!("{effect}: {reason}"))
    });
    let reference = (!all.iter().any(|name| name == "certificate")).then(|| {
        let reason = match evidence.certificate() {
            Some(_) => "reference: certified, but no source of the budget names it",
            None => "reference: the recording has no certificate",
        };
        Missing::new("certificate", reason)
    });
    let names_residuals = all.iter().any(|name| name.starts_with("error."));
    let is_corrected = all.iter().any(|name| name == "bias" || name == "error");
    let is_measured = evidence.figure("bias").is_some();
    let bias = (names_residuals && is_measured && !is_corrected).then(|| {
        Missing::new(
            "bias",
            "mean residual: measured, but no source of the budget names it",
        )
    });
    let is_counted = all.iter().any(|name| name == ZERO || holds(name, ZERO));
    let zero = (evidence.figure(ZERO).is_some() && !is_counted).then(|| {
        let reason = "zero of depths: measured, but no source of the budget names it";
        Missing::new(ZERO, reason)
    });
    effects.chain(bias).chain(zero).chain(reference).collect()
}
