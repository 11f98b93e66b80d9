//! The data sheet of a sensor unit: limits, what was found, pass or fail, on one page.

use serde_json::json;

use super::{Finding, Limit};
use crate::escape::html;
use crate::html::{Document, lead};
use crate::listing::Listing;
use crate::number::numeral;
use crate::results::Study;

/// The schema of an acceptance as JSON.
pub const ACCEPTANCE_SCHEMA: &str = "taceva.acceptance/1";

/// Findings with what they are of.
#[derive(Clone, Debug)]
pub struct Acceptance<'a> {
    /// What the limits are for.
    pub name: &'a str,
    /// What was held to them.
    pub study: &'a Study,
    /// What became of each limit.
    pub findings: &'a [Finding],
}

impl Acceptance<'_> {
    /// Whether every limit is kept.
    pub fn is_passed(&self) -> bool {
        self.findings.iter().all(|finding| finding.is_kept)
    }

    /// A row a limit.
    pub fn listing(&self) -> Listing {
        let verdict = if self.is_passed() { "passed" } else { "failed" };
        let name = match self.name {
            "" => String::new(),
            name => format!(" by {name}"),
        };
        let caption = format!(
            "{}, serial {}: {verdict}{name}",
            self.study.sensor, self.study.serial
        );
        let head = [
            "metric", "channel", "limit", "value", "95 %", "unit", "n", "verdict", "why",
        ];
        let mut listing = Listing::new(&caption, &head);
        listing.rows = self.findings.iter().map(row).collect();
        if self.study.is_simulated() {
            listing
                .notes
                .push("Nothing here was measured: the samples are simulated.".to_owned());
        }
        listing
    }

    /// As JSON of [`ACCEPTANCE_SCHEMA`].
    pub fn json(&self) -> String {
        let finding = |finding: &Finding| {
            json!({
                "metric": finding.limit.metric,
                "channel": finding.limit.channel,
                "unit": finding.limit.unit,
                "most": finding.limit.most,
                "least": finding.limit.least,
                "value": finding.value,
                "ci95": finding.ends,
                "n": finding.n,
                "kept": finding.is_kept,
                "reason": finding.reason,
            })
        };
        let findings: Vec<_> = self.findings.iter().map(finding).collect();
        let whole = json!({
            "schema": ACCEPTANCE_SCHEMA,
            "subject": {"sensor": self.study.sensor, "serial": self.study.serial, "gel": self.study.gel, "source": self.study.source},
            "passed": self.is_passed(),
            "findings": findings,
        });
        format!("{whole:#}\n")
    }

    /// As a data sheet of one page.
    pub fn page(&self) -> String {
        let study = self.study;
        let mut document = Document::new(&format!("Data sheet: {}", study.sensor));
        let verdict = match self.is_passed() {
            true => "<p class=\"pass\">PASS: every limit is kept.</p>".to_owned(),
            false => {
                let broken = self
                    .findings
                    .iter()
                    .filter(|finding| !finding.is_kept)
                    .count();
                format!(
                    "<p class=\"fail\">FAIL: {broken} of {} limits are not kept.</p>",
                    self.findings.len()
                )
            }
        };
        document.lead(&(lead(std::slice::from_ref(study)) + &verdict));
        document.section("limits", "Limits", &self.listing().html());
        let mut entries = vec![
            ("serial", study.serial.as_str()),
            ("gel", &study.gel),
            ("samples", &study.source),
        ];
        let wanted = ["dataset", "model", "split", "seed", "part", "taceva"];
        let known = study
            .provenance
            .iter()
            .filter(|(name, _)| wanted.contains(&name.as_str()));
        entries.extend(known.map(|(name, text)| (name.as_str(), text.as_str())));
        let entries = entries
            .iter()
            .map(|(name, text)| format!("<dt>{}</dt><dd>{}</dd>", html(name), html(text)));
        document.section(
            "unit",
            "Unit",
            &format!("<dl>{}</dl>", entries.collect::<String>()),
        );
        document.finish()
    }
}

fn row(finding: &Finding) -> Vec<String> {
    let limit = &finding.limit;
    let dash = || "–".to_owned();
    let interval = finding.ends.map_or_else(dash, |ends| {
        let [low, high] = ends.map(numeral);
        format!("{low} … {high}")
    });
    vec![
        limit.metric.clone(),
        limit.channel.clone(),
        bounds(limit),
        finding.value.map_or_else(dash, numeral),
        interval,
        limit.unit.clone(),
        finding.n.to_string(),
        if finding.is_kept { "pass" } else { "FAIL" }.to_owned(),
        finding.reason.clone().unwrap_or_default(),
    ]
}

fn bounds(limit: &Limit) -> String {
    let whole = if limit.whole_interval {
        ", whole interval"
    } else {
        ""
    };
    let ends = match (limit.least, limit.most) {
        (Some(least), Some(most)) => format!("{} … {}", numeral(least), numeral(most)),
        (Some(least), None) => format!("≥ {}", numeral(least)),
        (None, Some(most)) => format!("≤ {}", numeral(most)),
        (None, None) => String::new(),
    };
    ends + whole
}
