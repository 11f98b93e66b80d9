//! Values from bundles on pages, each with its authors, its samples, and the depth of its verification.

use std::collections::BTreeMap;

use maud::{Markup, html};

use super::{SitePage, TITLE};
use crate::catalogue::{DEPTH_NOTE, DEPTHS, Measured, Origin, Sensor, short};
use crate::html::Document;
use crate::markup::{filter, heads, right_heads, scroll};
use crate::number::numeral;

/// Name of the page with the numbers of all sensors.
pub(super) const FILE: &str = "measured.html";
/// Remarks on the numbers.
const NOTE: &str = "Numbers of different samples or definitions are not comparable, and none is ranked. A grey number has no interval. A seal is a \
                    digest, not a signature.";

/// Value from a bundle, with its sensor.
struct Entry<'a> {
    sensor: &'a Sensor,
    row: &'a Measured,
}

/// Page with the values from all bundles and their filters; `None` if there are none.
pub(super) fn page(sensors: &[Sensor]) -> Option<SitePage> {
    let all: Vec<&Sensor> = sensors.iter().filter(|own| own.has_bundles()).collect();
    if all.is_empty() {
        return None;
    }
    let lead = html! {
        p.lead { "Numbers that others measured or simulated, each with its bundle of TacEva. " a href="index.html" { (TITLE) } }
        (filters(&all))
    };
    let mut document = Document::new("Numbers of bundles", lead);
    add_sections(&mut document, sensors);
    Some(SitePage {
        file: FILE.to_owned(),
        text: document.finish(),
    })
}

/// Adds the values from the bundles of `sensors` to a page, with one section for each origin.
pub(super) fn add_sections(document: &mut Document, sensors: &[Sensor]) {
    for origin in Origin::ALL {
        let mut entries: Vec<Entry<'_>> = Vec::new();
        for sensor in sensors {
            let rows = sensor.rows(origin).iter();
            entries.extend(rows.map(|row| Entry { sensor, row }));
        }
        if !entries.is_empty() {
            add_table(document, origin, &entries);
        }
    }
}

fn add_table(document: &mut Document, origin: Origin, entries: &[Entry<'_>]) {
    let table = html! {
        table.sorts {
            thead {
                tr {
                    (heads(["sensor", "metric", "channel"]))
                    (right_heads(["value", "95 % interval"]))
                    (heads(["unit"]))
                    (right_heads(["n"]))
                    (heads(["level", "origin", "samples", "handed in by", "made on", "certificates", "definition", "protocol", "bundle"]))
                }
            }
            tbody { @for entry in entries { (line(entry)) } }
        }
    };
    let (title, badge) = match origin {
        Origin::Measured => ("Measured", None),
        Origin::Unknown => (
            "Origin unknown",
            Some("The bundles do not state that a sensor recorded these samples."),
        ),
        Origin::Simulated => (
            "Simulated",
            Some("Nothing here was measured: the samples are simulated or synthetic."),
        ),
    };
    let body = html! {
        @if let Some(badge) = badge { p.badge { (badge) } "\n" }
        (scroll(title, &table))
        p.note { (DEPTH_NOTE) " " (NOTE) }
    };
    document.section(origin.table(), title, body);
}

fn filters(sensors: &[&Sensor]) -> Markup {
    let rows = || sensors.iter().flat_map(|sensor| sensor.all_rows());
    let depths = DEPTHS.into_iter();
    let depths = depths.filter(|depth| rows().any(|row| row.verified == *depth));
    let named = |kind: &str, word: &str| (tag(kind, word), word.to_owned());
    let names = sensors.iter().map(|sensor| named("sensor", &sensor.name));
    let names: BTreeMap<String, String> = names.collect();
    let metrics: BTreeMap<String, String> =
        rows().map(|row| named("metric", &row.metric)).collect();
    html! {
        fieldset {
            legend { "Show" }
            label { "containing " input type="search" data-filter="text"; }
            (filter("level", "any", depths.map(|depth| named("level", depth))))
            (filter("sensor", "any", names))
            (filter("metric", "any", metrics))
            (filter("certificate", "any", [("certified", "with a certificate"), ("uncertified", "without a certificate")]))
        } "\n"
    }
}

/// Tag of a row for a filter: one word.
fn tag(kind: &str, word: &str) -> String {
    let lower = word.to_lowercase();
    let letters = lower.chars().map(|letter| match letter.is_alphanumeric() {
        true => letter,
        false => '-',
    });
    format!("{kind}-{}", letters.collect::<String>())
}

fn line(entry: &Entry<'_>) -> Markup {
    let Entry { sensor, row } = entry;
    let certified = match row.traceability.is_empty() {
        true => "uncertified",
        false => "certified",
    };
    let tags = [
        tag("level", &row.verified),
        tag("sensor", &sensor.name),
        tag("metric", &row.metric),
        certified.to_owned(),
    ];
    let unit = match row.unit.as_str() {
        "1" => "",
        unit => unit,
    };
    let by = match row.by.is_empty() {
        true => "not stated".to_owned(),
        false => row.by.join(", "),
    };
    html! {
        tr data-tags=(tags.join(" ")) {
            th scope="row" { a href={ (sensor.slug()) ".html" } { (sensor.name) } }
            td { (row.metric) @if let Some(variant) = &row.variant { "." (variant) } }
            td { (row.channel) }
            @if let Some([low, high]) = row.ci95 {
                td.r data-v=(row.value) { (numeral(row.value)) } td.r data-v=(low) { (numeral(low)) " … " (numeral(high)) }
            } @else {
                td.none data-v=(row.value) { (numeral(row.value)) } td.none data-v="" { "no interval" }
            }
            td { (unit) } td.r data-v=(row.n) { (row.n) } td { (row.verified) } td { (row.origin_word()) }
            td { (short(&row.samples)) } td.wrap { (by) } td { (row.date.to_string()) }
            td.wrap { (row.traceability.join(", ")) } td { (row.definition) }
            td.wrap { @if let Some(protocol) = &row.protocol { (protocol) } @else { "–" } }
            td.wrap {
                (row.short_bundle())
                @if let Some(licence) = &row.licence { ", " (licence) }
                @if let Some(url) = &row.url { ", " a href=(url) rel="noreferrer" { (url) } }
            }
        } "\n"
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Entry with one measured row, and further text at its end.
    fn entry(more: &str) -> Sensor {
        let digest = format!("sha256:{}", "5".repeat(64));
        let text = format!(
            "catalogue_version = 2\nname = \"X <b>\"\nkind = \"sensor\"\nmechanism = []\n[[measured]]\nmetric = \"mae\"\nchannel = \"Fz\"\nvalue = 0.02\n\
             unit = \"N\"\nn = 320\ndefinition = \"mae/1\"\nsamples = \"{digest}\"\nbundle = \"{digest}\"\nverified = \"predictions\"\n\
             source = \"recorded\"\ndate = 2026-11-28\nby = [\"Ada <script>\"]\n{more}"
        );
        Sensor::read("x.toml", &text).expect("an entry")
    }

    #[test]
    fn a_number_says_who_handed_it_in_on_which_samples_and_how_deep_it_was_verified() {
        let page = page(&[entry("ci95 = [0.01, 0.03]\ntraceability = [\"D-K-1\"]\n")]);
        let text = page.expect("a page").text;
        for words in [
            "Ada &lt;script&gt;",
            "handed in by",
            "55555555",
            "<td>predictions</td>",
            "level-predictions sensor-x--b- metric-mae certified",
            "D-K-1",
            "2026-11-28",
            "`model` predicts again",
            "`fit` fits the model again",
        ] {
            assert!(text.contains(words), "{words}");
        }
        assert!(!text.contains("Ada <script>"), "names are escaped");
        assert!(!text.contains("td class=\"none\""), "it has an interval");
    }

    #[test]
    fn a_number_without_an_interval_is_grey() {
        let text = page(&[entry("")]).expect("a page").text;
        assert!(
            text.contains("<td class=\"none\" data-v=\"0.02\">"),
            "{text}"
        );
        assert!(page(&crate::catalogue::all()).is_none());
    }
}
