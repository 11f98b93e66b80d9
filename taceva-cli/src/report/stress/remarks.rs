//! Remarks of a test of faults on skill, stimuli and the reference model.

use std::collections::BTreeSet;

use taceva_core::counted;
use taceva_stress::{By, Estimate, StressReport, TARGETS};

use super::{phrase, short};

/// Remark on positive skill that is not significant even without a fault, because too few samples were tested.
pub(super) fn unshown_skill<'a>(
    samples: usize,
    skills: impl Iterator<Item = (&'a str, Estimate)>,
) -> Option<String> {
    let unshown = skills.filter(|(_, skill)| {
        let is_positive = skill.value.is_some_and(|value| value > 0.0);
        is_positive && skill.is_above_zero() == Some(false)
    });
    let unshown = unshown.map(|(name, skill)| format!("{name} {}", phrase(&skill, "")));
    let unshown: Vec<String> = unshown.collect();
    (!unshown.is_empty()).then(|| {
        format!(
            "Skill without a fault is not shown by {}: {}. A larger test part narrows the interval of the skill: fit with shares such as --split 'random 40/10/50'.",
            counted(samples, "sample"),
            unshown.join(", ")
        )
    })
}

/// Remark on severities at which pictures change by less than half or more than twice the [target](TARGETS) of the severity; `None` without any.
pub(super) fn missed_targets(report: &StressReport) -> Option<String> {
    if report.by == By::Parameter {
        return None;
    }
    let cells = report.faults.iter().flat_map(|fault| {
        let severities = fault.severities.iter();
        severities.filter_map(move |of| {
            let target = TARGETS[usize::from(of.severity) - 1];
            let stimulus = of.stimulus?;
            let is_near = (0.5 * target..=2.0 * target).contains(&stimulus);
            let words = || format!("{} {} {}", fault.id, of.severity, short(stimulus));
            (!is_near).then(words)
        })
    });
    let cells: Vec<String> = cells.collect();
    (!cells.is_empty()).then(|| {
        format!(
            "Stimulus of the scored pictures below half or above twice its target (fault, severity, stimulus): {}.",
            cells.join(", ")
        )
    })
}

/// Remark on additionally requested metrics, which are too many for a table for readers; `None` without any.
pub(super) fn other_metrics(report: &StressReport) -> Option<String> {
    let names = report.clean.values().flat_map(|of| of.metrics.keys());
    let names: BTreeSet<&str> = names.map(String::as_str).collect();
    let names: Vec<&str> = names.into_iter().collect();
    let words = "of each channel, fault and severity are in --format csv and json";
    (!names.is_empty()).then(|| format!("{} {words}.", names.join(", ")))
}

/// Remark on the test of differences from the reference model, with the differences that were not tested; `None` without a reference model.
pub(super) fn reference_tests(report: &StressReport, channels: &[&str]) -> Option<String> {
    report.reference.as_ref()?;
    let all = report.faults.iter().filter_map(|of| of.difference.as_ref());
    let untested = all.clone().flatten().filter_map(|(name, of)| {
        let reason = of.reason.as_ref()?;
        let is_main = channels.contains(&name.as_str());
        is_main.then(|| format!("{name}: {reason}"))
    });
    let untested: BTreeSet<String> = untested.collect();
    let untested: Vec<String> = untested.into_iter().collect();
    let untested = untested.join("; ");
    let tested = all.flatten().filter(|(_, of)| of.p.is_some());
    let tested = match tested.count() {
        0 => String::new(),
        count => format!(
            ": paired sign-flip tests by contact point or group, p and intervals by Holm over {}; others are not shown",
            counted(count, "difference")
        ),
    };
    let untested = match untested.is_empty() {
        true => untested,
        false => format!("; not tested: {untested}"),
    };
    let words = tested + &untested;
    (!words.is_empty()).then(|| format!("Differences from the reference model{words}."))
}

#[cfg(test)]
mod tests {
    use taceva_stress::Estimate;

    use super::unshown_skill;

    #[test]
    fn a_wide_interval_of_skill_is_distinguished_from_a_model_without_skill() {
        let skill = |value: f64, ends: [f64; 2]| Estimate {
            ci95: Some(ends),
            ..Estimate::of_known(Some(value))
        };
        let skills = [
            ("Fxy", skill(0.74, [-0.10, 0.94])),
            ("Fz", skill(-0.5, [-1.0, 0.2])),
            ("Pz", skill(0.77, [0.60, 0.86])),
        ];
        let said = unshown_skill(46, skills.into_iter()).unwrap();
        assert!(
            said.starts_with("Skill without a fault is not shown by 46 samples: Fxy 0.7"),
            "{said}"
        );
        assert!(!said.contains("Fz ") && !said.contains("Pz "), "{said}");
        assert_eq!(unshown_skill(46, skills.into_iter().skip(1)), None);
    }
}
