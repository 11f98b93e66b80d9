//! Variation of scores over training seeds. Intervals by contact point do not include this variation.

use maud::{Markup, html};
use taceva_core::Unit;

use crate::markup::metric_link;
use crate::markup::{heads, right_heads, scroll};
use crate::names::names;
use crate::number::{FormattedValue, minus, numeral};
use crate::results::Study;
use taceva_results::{OverSeeds, SeedScore};

/// Number of scores, and the section with a table for each study. `None` if no model was fitted with several seeds.
pub(super) fn section(studies: &[Study]) -> Option<(usize, Markup)> {
    let named = studies.iter().zip(names(studies));
    let over = named.filter_map(|(study, name)| Some((study.over_seeds.as_ref()?, name)));
    let over: Vec<(&OverSeeds, String)> =
        over.filter(|(over, _)| !over.scores.is_empty()).collect();
    let note = "The 95 % interval is that of the mean over seeds; it shows how much a score varies between trainings. Comparisons add the variance between trainings to that between contact points.";
    let body = html! {
        p.note { (note) } "\n"
        @for (over, name) in &over { (table(over, name)) }
    };
    let count = over.iter().map(|(over, _)| over.scores.len()).sum();
    (count > 0).then_some((count, body))
}

fn table(over: &OverSeeds, name: &str) -> Markup {
    let seeds: Vec<String> = over.seeds.iter().map(ToString::to_string).collect();
    let table = html! {
        table.sorts {
            caption { (name) ", over " (seeds.len()) " seeds" }
            thead {
                tr {
                    (heads(["metric", "channel", "unit"]))
                    (right_heads(["mean", "95 % interval of the mean", "standard deviation"]))
                }
            }
            tbody { @for score in &over.scores { (row(score)) } }
        }
    };
    html! {
        p.note {
            (name) ": seeds " (seeds.join(", ")) "; a seed decides " (over.decides) ". "
            "All other scores of this page are of seed " (seeds.first().map_or("", String::as_str)) "."
        } "\n"
        (scroll(&format!("{name}, over seeds"), &table))
    }
}

fn row(score: &SeedScore) -> Markup {
    let formatted = FormattedValue::number(score.mean, Some(score.interval));
    let [low, high] = formatted.interval.unwrap_or_default();
    let unit = match score.unit {
        Unit::One => "",
        unit => unit.symbol(),
    };
    html! {
        tr {
            th scope="row" { (metric_link(&score.metric)) } td { (score.channel) } td { (unit) }
            td.r data-v=(format_args!("{:?}", score.mean)) { (minus(&formatted.value)) }
            td.r { (minus(&low)) " … " (minus(&high)) }
            td.r data-v=(format_args!("{:?}", score.standard_deviation)) { (numeral(score.standard_deviation)) }
        } "\n"
    }
}
