//! Rows of a data sheet: limits with findings, and the uncertainties of the decisions.

use taceva_core::{counted, distinct};
use taceva_metrology::conformity::{Decision, Word};

use super::Acceptance;
use crate::accept::{Limit, LimitCheck, reason};
use crate::number::numeral;
use crate::table::{Cell, Column, Table};

impl Acceptance<'_> {
    /// Columns of the table, after the metric.
    pub(super) fn columns(&self) -> Vec<Column> {
        let mut names = vec!["channel", "limit", "value", "95 %", "unit", "n"];
        if self.limits.is_by_rules() {
            names.extend(["u", "nu", "p_c", "acceptance limit"]);
        }
        if self.has_risks() {
            names.extend(["consumer's risk", "producer's risk", "limit for risk"]);
        }
        names.extend(["verdict", "why"]);
        if !self.study.edits.is_empty() {
            names.push("edits");
        }
        names.into_iter().map(Column::new).collect()
    }

    /// Cells of one limit.
    pub(super) fn row(&self, check: &LimitCheck) -> Vec<Cell> {
        let limit = &check.limit;
        let interval = check.ends.map(|ends| {
            let [low, high] = ends.map(numeral);
            format!("{low} … {high}")
        });
        let mut cells: Vec<Cell> = vec![
            limit.metric.clone().into(),
            limit.channel.clone().into(),
            bounds(limit).into(),
            or_dash(check.value.map(numeral)),
            or_dash(interval),
            limit.unit.clone().into(),
            check.n.to_string().into(),
        ];
        if self.limits.is_by_rules() {
            cells.extend(of_decision(check.decision.as_ref()));
        }
        if self.has_risks() {
            let process = check.process.as_ref().and_then(|known| known.as_ref().ok());
            let limits = process.and_then(|process| process.acceptance.as_ref());
            cells.push(or_dash(process.map(|of| numeral(of.risk.consumer))));
            cells.push(or_dash(process.map(|of| numeral(of.risk.producer))));
            cells.push(or_dash(
                limits.map(|limits| reason::bounds(limits.least(), limits.most())),
            ));
        }
        cells.push(match (self.limits.is_by_rules(), check.verdict) {
            (false, _) => Cell::Verdict(check.is_kept),
            (true, Word::Pass) => Cell::Verdict(true),
            (true, word) => Cell::text(word.to_string()),
        });
        cells.push(check.reason.clone().unwrap_or_default().into());
        if !self.study.edits.is_empty() {
            cells.push(counted(self.study.edits.len(), "accepted edit").into());
        }
        cells
    }

    fn has_risks(&self) -> bool {
        self.findings.iter().any(|check| check.process.is_some())
    }

    /// Table with the uncertainty, the coverage factor and the decision rule for the score of each limit.
    pub(super) fn uncertainties(&self) -> Table {
        let names = [
            "channel", "value", "unit", "u", "nu", "k", "U", "p_c", "rule",
        ];
        let columns = [Column::of_metrics()].into_iter();
        let mut table = Table::new("Uncertainties", columns.chain(names.map(Column::new)));
        for check in self.findings {
            let decision = check.decision.as_ref();
            let number =
                |of: fn(&Decision) -> Option<f64>| or_dash(decision.and_then(of).map(numeral));
            let cells: [Cell; 10] = [
                check.limit.metric.clone().into(),
                check.limit.channel.clone().into(),
                or_dash(check.value.map(numeral)),
                check.limit.unit.clone().into(),
                number(|of| of.standard_uncertainty),
                number(|of| of.freedom),
                number(|of| of.coverage_factor),
                number(|of| of.expanded_uncertainty),
                number(|of| of.conformance_probability),
                Cell::text(check.rule()),
            ];
            table.push(cells);
        }
        table.note("U = k u is the expanded uncertainty at the coverage of the rule, 0.95 if it has none. On a logarithmic scale U is a first-order approximation.");
        table
    }

    /// Remarks on the decision rules of the limits file.
    pub(super) fn rule_notes(&self) -> Vec<String> {
        if !self.limits.is_by_rules() {
            return Vec::new();
        }
        let mut rules: Vec<(String, Vec<&LimitCheck>)> = Vec::new();
        for check in self.findings {
            let rule = check.limit.decided_by.to_string();
            match rules.iter_mut().find(|(known, _)| *known == rule) {
                Some((_, checks)) => checks.push(check),
                None => rules.push((rule, vec![check])),
            }
        }
        let mut notes = vec![
            "u: standard uncertainty; nu: its degrees of freedom; p_c: probability of conformity.".to_owned(),
            "u includes the scatter of the tested presses, but not the calibration of the reference.".to_owned(),
            "Conditional pass: within the limit, not within the acceptance limit. Conditional fail: beyond the limit by less than the guard. Undecided: no uncertainty, or one greater than agreed.".to_owned(),
        ];
        for (rule, checks) in &rules {
            let names: Vec<String> = checks.iter().map(|check| name_of(check)).collect();
            let of = match rules.len() {
                1 => String::new(),
                _ => format!(" of {}", names.join(", ")),
            };
            notes.push(format!("Decision rule{of}: {rule}{}.", guards_of(checks)));
        }
        if self.limits.counts_conditional_passes() {
            notes.push("A conditional pass counts as met.".to_owned());
        }
        notes
    }

    /// Remarks, one for each metric, on limits without a variant. Such a limit applies to the variant that verdicts use.
    pub(super) fn variant_notes(&self) -> Vec<String> {
        let notes = self.findings.iter().filter_map(|check| {
            let Limit {
                metric, channel, ..
            } = &check.limit;
            let variant = self.study.score(metric, channel)?.decided_by()?;
            Some(format!(
                "{metric}: the limit applies to {metric}.{}, which verdicts use.",
                variant.name
            ))
        });
        distinct(notes)
    }

    /// Remark on accepted edits of the result or its recording; `None` if there are none.
    pub(super) fn edits_note(&self) -> Option<String> {
        let edits = &self.study.edits;
        (!edits.is_empty()).then(|| format!("Edited by hand: {}.", edits.join("; ")))
    }
}

/// Uncertainty, degrees of freedom, probability of conformity and acceptance limit of a decision.
fn of_decision(decision: Option<&Decision>) -> [Cell; 4] {
    let number = |of: fn(&Decision) -> Option<f64>| or_dash(decision.and_then(of).map(numeral));
    [
        number(|of| of.standard_uncertainty),
        number(|of| of.freedom),
        number(|of| of.conformance_probability),
        or_dash(decision.and_then(reason::acceptance)),
    ]
}

fn name_of(check: &LimitCheck) -> String {
    format!("{} {}", check.limit.metric, check.limit.channel)
}

/// Scale and effect of the guard bands of limits with the same rule; empty if no guard band has a logarithmic scale.
fn guards_of(checks: &[&LimitCheck]) -> String {
    let guards = checks.iter().filter_map(|check| {
        let guard = check.guard.as_ref()?;
        Some(match checks.len() {
            1 => guard.clone(),
            _ => format!("{}, {guard}", name_of(check)),
        })
    });
    let guards: Vec<String> = guards.collect();
    match guards.is_empty() {
        true => String::new(),
        false => format!("{}{}", reason::ON_SCALE, guards.join("; ")),
    }
}

fn or_dash(text: Option<String>) -> Cell {
    text.unwrap_or_else(|| "–".to_owned()).into()
}

fn bounds(limit: &Limit) -> String {
    let whole = if limit.whole_interval {
        ", whole interval"
    } else {
        ""
    };
    reason::bounds(limit.least, limit.most) + whole
}
