//! What metrics mean, as the catalogue of metrics says it; and links to it from wherever a metric is named.

use std::collections::BTreeSet;

use taceva_metrics::{Better, Metric, ScoreUnit, catalogue};

use super::fold::fold;
use crate::escape::html;

/// The metrics that are named in `ids`, in the order of the catalogue: title, meaning, unit, direction and where each is defined. Names of
/// variants stand for their metric.
pub(crate) fn glossary<'a>(ids: impl Iterator<Item = &'a str>) -> String {
    let named: BTreeSet<&str> = ids.map(base).collect();
    let metrics = catalogue::ALL.iter();
    let entries: String = metrics
        .filter(|metric| named.contains(metric.id))
        .map(|metric| entry(metric))
        .collect();
    match entries.is_empty() {
        true => "<p>No metric of these results is in the catalogue.</p>".to_owned(),
        false => format!("<dl class=\"glossary\">{entries}</dl>"),
    }
}

/// The same, folded; a link to a metric unfolds it.
pub(crate) fn folded_glossary<'a>(ids: impl Iterator<Item = &'a str>) -> String {
    let holds = "what each metric means, its unit and its definition";
    fold("glossary", "Glossary", holds, &glossary(ids))
}

/// The name of a metric or variant as a link to what the metric means, with the sign of its direction; plain where the catalogue does not
/// know it.
pub(crate) fn metric_link(id: &str) -> String {
    signed(id, &link(id))
}

/// A score with its metric as a link: `mae Pz ↓`.
pub(crate) fn score_link(id: &str, channel: &str) -> String {
    signed(id, &format!("{} {}", link(id), html(channel)))
}

fn signed(id: &str, body: &str) -> String {
    Better::of(id).map_or_else(|| body.to_owned(), |better| better.beside(body))
}

fn link(id: &str) -> String {
    match catalogue::find(base(id)) {
        Some(metric) => format!(
            "<a class=\"metric\" href=\"#metric-{}\" title=\"{}\">{}</a>",
            metric.id,
            html(metric.title),
            html(id)
        ),
        None => html(id),
    }
}

/// `hysteresis` of `hysteresis.ratio`.
fn base(id: &str) -> &str {
    id.split('.').next().unwrap_or_default()
}

fn entry(metric: &Metric) -> String {
    let unit = match metric.unit {
        ScoreUnit::OfChannel => "that of each channel, such as mm or N".to_owned(),
        ScoreUnit::PerHour => "that of each channel an hour, such as mm/h or N/h".to_owned(),
        ScoreUnit::Fixed(unit) => unit.to_string(),
        _ => "none, it is a ratio".to_owned(),
    };
    let better = match metric.better {
        Better::Lower => "lower is better (↓)",
        Better::Higher => "higher is better (↑)",
        Better::NearZero => "nearer to zero is better (→0)",
        _ => "descriptive, neither good nor bad by itself",
    };
    format!(
        "<dt id=\"metric-{}\" tabindex=\"-1\">{} <code>{}</code></dt><dd>{} Unit: {}; {better}. Definition <code>{}</code>: {}.</dd>",
        metric.id,
        html(metric.title),
        metric.id,
        html(metric.documentation),
        html(&unit),
        html(metric.definition),
        html(metric.reference)
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_link_of_a_metric_meets_its_entry() {
        let ids = catalogue::ALL.iter().map(|metric| metric.id);
        let text = glossary(ids.clone());
        for id in ids {
            let link = metric_link(&format!("{id}.some-variant"));
            assert!(link.contains(&format!("href=\"#metric-{id}\"")), "{link}");
            assert!(text.contains(&format!("id=\"metric-{id}\"")), "{id}");
        }
        assert_eq!(metric_link("<own>"), "&lt;own&gt;");
    }
}
