//! Glossary of metrics from the catalogue of metrics, and links to its entries.

use std::collections::BTreeSet;

use maud::{Markup, html};
use taceva_metrics::{Better, Metric, ScoreUnit, catalogue};

use super::fold::fold;

/// Entries of the metrics in `ids`, in catalogue order: title, meaning, unit, direction and definition. The id of a variant selects the entry of its metric.
pub(crate) fn glossary<'a>(ids: impl Iterator<Item = &'a str>) -> Markup {
    let named: BTreeSet<&str> = ids.map(base).collect();
    let metrics = catalogue::ALL.iter().copied();
    let metrics: Vec<&Metric> = metrics.filter(|metric| named.contains(metric.id)).collect();
    html! {
        @if metrics.is_empty() {
            p { "No metric of these results is in the catalogue." }
        } @else {
            dl.glossary { @for metric in metrics { (entry(metric)) } }
        }
    }
}

/// Folded glossary. A link to a metric unfolds the glossary.
pub(crate) fn folded_glossary<'a>(ids: impl Iterator<Item = &'a str>) -> Markup {
    let holds = "what each metric means, its unit and its definition";
    fold("glossary", "Glossary", holds, &glossary(ids))
}

/// Name of a metric or variant as a link to its glossary entry, with its direction sign; plain text if the catalogue lacks the name.
pub(crate) fn metric_link(id: &str) -> Markup {
    html! { (link(id)) (sign(id)) }
}

/// Score with its metric as a link: `mae Pz ↓`.
pub(crate) fn score_link(id: &str, channel: &str) -> Markup {
    html! { (link(id)) " " (channel) (sign(id)) }
}

/// Direction sign after a space, ` ↓`; empty without a better direction.
fn sign(id: &str) -> String {
    Better::of(id).map_or_else(String::new, |better| better.beside(""))
}

fn link(id: &str) -> Markup {
    html! {
        @if let Some(metric) = catalogue::find(base(id)) {
            a.metric href={ "#metric-" (metric.id) } title=(metric.title) { (id) }
        } @else {
            (id)
        }
    }
}

/// Metric without the variant: `hysteresis` for `hysteresis.ratio`.
fn base(id: &str) -> &str {
    id.split('.').next().unwrap_or_default()
}

fn entry(metric: &Metric) -> Markup {
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
    html! {
        dt id={ "metric-" (metric.id) } tabindex="-1" { (metric.title) " " code { (metric.id) } }
        dd {
            (metric.documentation) " Unit: " (unit) "; " (better) ". "
            "Definition " code { (metric.definition) } ": " (metric.reference) "."
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_link_of_a_metric_meets_its_entry() {
        let ids = catalogue::ALL.iter().map(|metric| metric.id);
        let text = glossary(ids.clone()).into_string();
        for id in ids {
            let link = metric_link(&format!("{id}.some-variant")).into_string();
            assert!(link.contains(&format!("href=\"#metric-{id}\"")), "{link}");
            assert!(text.contains(&format!("id=\"metric-{id}\"")), "{id}");
        }
        assert_eq!(metric_link("<own>").into_string(), "&lt;own&gt;");
    }
}
