//! Catalogue as a static site: a sortable, filterable list, and one page for each sensor with a stable file name.

mod bundle_rows;

use maud::{Markup, html};

use crate::catalogue::{Kind, MECHANISMS, Published, Sensor, Size, prices};
use crate::figures::figures;
use crate::html::Document;
use crate::markup::{filter, folded_glossary, heads, metric_link, right_heads, scroll, terms};
use crate::number::numeral;
use crate::results::Study;
use crate::variables::VARIABLES;

const TITLE: &str = "Catalogue of tactile sensors";
/// Text for a property that an entry lacks.
const ABSENT: &str = "not in the catalogue";

/// A file of the site.
#[derive(Clone, Debug)]
pub struct SitePage {
    /// File name: `index.html`, `vitactip.html`.
    pub file: String,
    /// Content as HTML.
    pub text: String,
}

/// Pages of the site, beginning with the list. `ours` are results of this program, shown in a separate section.
pub fn site(sensors: &[Sensor], ours: &[Study]) -> Vec<SitePage> {
    let mut pages = vec![SitePage {
        file: "index.html".to_owned(),
        text: index(sensors, ours),
    }];
    pages.extend(bundle_rows::page(sensors));
    pages.extend(sensors.iter().map(|sensor| SitePage {
        file: format!("{}.html", sensor.slug()),
        text: page(sensor),
    }));
    pages
}

fn index(sensors: &[Sensor], ours: &[Study]) -> String {
    let lead = "Published facts and results of each sensor, every number with its source.";
    let has_bundles = sensors.iter().any(Sensor::has_bundles);
    let lead = html! {
        p.lead {
            (lead)
            @if has_bundles { " " a href=(bundle_rows::FILE) { "Numbers of bundles" } }
        }
    };
    let mut document = Document::new(TITLE, lead);
    let of_kind = |kind| sensors.iter().filter(move |entry| entry.kind == kind);
    document.section("sensors", "Sensors", list(of_kind(Kind::Sensor)));
    if of_kind(Kind::Study).next().is_some() {
        let studies = html! {
            p { "Evaluations, benchmarks and reviews of sensors, with the number of the ten properties that each reports." } "\n"
            ul { @for entry in of_kind(Kind::Study) { (study(entry)) } }
        };
        document.section("studies", "Studies of sensors", studies);
    }
    let published = sensors.iter().filter(|sensor| !sensor.results.is_empty());
    let published: Vec<Study> = published.map(Sensor::as_study).collect();
    let side_by_side = radars(&published);
    document.section("radars", "Side by side, as published", side_by_side);
    if !ours.is_empty() {
        let ours = html! {
            p.badge { "These are results of this program, not published ones; simulated samples were not measured." } "\n"
            (radars(ours))
        };
        document.section("ours", "Results of this program", ours);
    }
    document.finish()
}

/// List of all sensors with its filters.
fn list<'a>(sensors: impl Iterator<Item = &'a Sensor>) -> Markup {
    let mechanisms = [
        ("imm", "IMM: intensity"),
        ("mdm", "MDM: markers"),
        ("mfm", "MFM: fusion"),
        ("magnetic", "magnetic taxels"),
        ("capacitive", "capacitive taxels"),
        ("resistive", "resistive taxels"),
        ("optical", "optical taxels"),
    ];
    let errors = ["Pxy (mm)", "Pz (mm)", "Fxy (N)", "Fz (N)"];
    let table = html! {
        table.sorts {
            thead {
                tr {
                    (heads(["sensor", "mechanism"]))
                    (right_heads(errors.map(|error| format!("MAE {error} ↓"))))
                    (right_heads(["rate (Hz)", "reported"]))
                    (heads(["size (mm)", "price", "can be"]))
                }
            }
            tbody { @for sensor in sensors { (row(sensor)) } }
        }
    };
    html! {
        fieldset {
            legend { "Show" }
            label { "containing " input type="search" data-filter="text"; }
            (filter("mechanism", "any", mechanisms))
            (filter("light", "any", [("opaque", "kept out")]))
            (filter("numbers", "any", [("numbers", "published here")]))
            (filter("to get", "any", [("bought", "can be bought"), ("built", "can be built")]))
        } "\n"
        (scroll("Sensors", &table))
        p.note {
            "A dash: no number of that metric and unit is known here. The page of a sensor lists every known number. " (MECHANISMS)
            " The column `reported` counts how many of ten properties the work itself reports. Prices are in the currency of their source and not converted."
        }
    }
}

fn radars(studies: &[Study]) -> Markup {
    let none = "Fewer than two sensors have numbers that can be shown side by side.";
    crate::html::radars(&figures(studies)).unwrap_or_else(|| html! { p { (none) } })
}

fn row(sensor: &Sensor) -> Markup {
    let mut tags: Vec<String> = sensor
        .mechanism
        .iter()
        .map(|word| word.to_lowercase())
        .collect();
    if sensor.opaque == Some(true) {
        tags.push("opaque".to_owned());
    }
    if !sensor.results.is_empty() {
        tags.push("numbers".to_owned());
    }
    let ways = sensor.availability.iter().map(|offer| offer.way.word());
    let mut ways: Vec<&str> = ways.collect();
    ways.dedup();
    tags.extend(ways.iter().map(|way| (*way).to_owned()));
    let size = sensor.size.as_ref().map(Size::shown).unwrap_or_default();
    let offers = [size, prices(sensor), ways.join("; ")];
    let mae = VARIABLES.map(|channel| sensor.result("mae", channel).map(|result| result.value));
    let number = |value: f64| (value.to_string(), numeral(value));
    let numbers = mae.into_iter().chain([sensor.frame_rate_hz()]);
    let count = properties_reported(sensor).to_string();
    let count = (!sensor.reported.is_empty()).then(|| (count.clone(), count));
    html! {
        tr data-tags=(tags.join(" ")) {
            th scope="row" { a href={ (sensor.slug()) ".html" } { (sensor.name) } } td { (sensor.mechanism.join(" + ")) }
            @for cell in numbers.map(|value| value.map(number)).chain([count]) {
                @if let Some((value, shown)) = cell { td.r data-v=(value) { (shown) } } @else { td.none data-v="" { "–" } }
            }
            @for words in &offers { td { (if words.is_empty() { "–" } else { words.as_str() }) } }
        } "\n"
    }
}

/// Number of properties that the publication reports.
fn properties_reported(entry: &Sensor) -> usize {
    let words = entry.reported.values();
    words.filter(|word| *word == "yes").count()
}

fn study(entry: &Sensor) -> Markup {
    html! {
        li {
            a href={ (entry.slug()) ".html" } { (entry.name) }
            @if !entry.reported.is_empty() { ": " (properties_reported(entry)) " of 10" }
        }
    }
}

fn page(sensor: &Sensor) -> String {
    let lead = html! {
        p.lead { a href="index.html" { (TITLE) } }
        @if sensor.kind == Kind::Study { p { "A study of sensors, not a sensor." } }
    };
    let mut document = Document::new(&sensor.name, lead);
    document.section("properties", "Properties", properties(sensor));
    if !sensor.results.is_empty() {
        document.section("results", "Published results", results(sensor));
    }
    bundle_rows::add_sections(&mut document, std::slice::from_ref(sensor));
    let named = sensor.results.iter().map(|result| result.metric.as_str());
    let is_known = |id: &str| taceva_metrics::Better::of(id).is_some();
    if named.clone().any(is_known) {
        document.section("meanings", "What the metrics mean", folded_glossary(named));
    }
    if !sensor.reported.is_empty() {
        let entries = sensor.reported.iter().filter(|(key, _)| *key != "source");
        let entries = entries.map(|(key, word)| (key.replace('_', " "), word));
        let reported = html! { dl { (terms(entries)) } };
        document.section("reported", "What the work reports", reported);
    }
    let sources = html! {
        ul {
            @for source in &sensor.sources {
                li {
                    (source.id) ": " (source.text)
                    @if let Some(link) = source.link.as_ref().filter(|link| link.starts_with("https://")) {
                        " " a href=(link) rel="noreferrer" { (link) }
                    }
                }
            }
        }
    };
    document.section("sources", "Sources", sources);
    document.finish()
}

fn properties(sensor: &Sensor) -> Markup {
    let word = |value: Option<bool>| {
        value
            .map_or("unknown", |yes| if yes { "yes" } else { "no" })
            .to_owned()
    };
    let mut entries = match sensor.kind {
        Kind::Study => Vec::new(),
        Kind::Sensor => vec![
            ("mechanism".to_owned(), sensor.mechanism.join(" + ")),
            (
                "shape".to_owned(),
                sensor.shape.clone().unwrap_or_else(|| "unknown".to_owned()),
            ),
            ("keeps light out".to_owned(), word(sensor.opaque)),
            ("markers".to_owned(), word(sensor.markers)),
        ],
    };
    for result in &sensor.results {
        let name = match result.metric.as_str() {
            "intrinsic" => result.channel.as_str(),
            "gel_thickness" => result.metric.as_str(),
            _ => continue,
        };
        let shown = format!("{} {} ({})", result.shown(), result.unit, result.definition);
        entries.push((name.replace('_', " "), shown));
    }
    if let Some(of) = &sensor.limits {
        entries.extend([
            ("greatest depth".to_owned(), format!("{} mm", of.pz_max_mm)),
            (
                "greatest normal force".to_owned(),
                format!("{} N", of.fz_max_n),
            ),
            (
                "greatest distance from the centre".to_owned(),
                format!("{} mm", of.radius_max_mm),
            ),
        ]);
    }
    if sensor.kind == Kind::Sensor {
        entries.extend(offers(sensor));
    }
    if !sensor.aliases.is_empty() {
        entries.push(("also called".to_owned(), sensor.aliases.join(", ")));
    }
    for (theme, terms) in &sensor.applications {
        if !terms.is_empty() {
            entries.push((format!("used for: {theme}"), terms.join(", ")));
        }
    }
    html! { dl { (terms(entries)) } }
}

/// Size, prices and ways to get a sensor; a phrase in place of each absent fact.
fn offers(sensor: &Sensor) -> Vec<(String, String)> {
    let entry = |name: &str, shown: String| (name.to_owned(), shown);
    let size = sensor.size.as_ref();
    let size = size.map(|size| format!("{} mm, {}", size.shown(), size.conditions));
    let mut entries = vec![entry("size", size.unwrap_or_else(|| ABSENT.to_owned()))];
    for price in &sensor.prices {
        let shown = format!("{} ({})", price.shown(), price.conditions());
        entries.push(entry(price.goods.quantity(), shown));
    }
    if sensor.prices.is_empty() {
        entries.push(entry("price", ABSENT.to_owned()));
    }
    for offer in &sensor.availability {
        let shown = format!("{}, seen on {}", offer.conditions, offer.seen);
        entries.push(entry(&format!("can be {}", offer.way.word()), shown));
    }
    if sensor.availability.is_empty() {
        entries.push(entry("seller or drawings", ABSENT.to_owned()));
    }
    if let Some(identity) = &sensor.identity {
        entries.push(entry("identity", identity.clone()));
    }
    entries
}

fn results(sensor: &Sensor) -> Markup {
    let row = |result: &Published| {
        let unit = if result.unit == "1" { "" } else { &result.unit };
        html! {
            tr {
                th scope="row" { (metric_link(&result.metric)) } td { (result.channel) }
                td.r data-v=(result.value) { (result.shown()) } td { (unit) } td { (result.source) ", " (result.read_from) }
                td.wrap { (result.definition) }
                td.wrap { (result.conditions) @if let Some(note) = &result.note { "; " (note) } }
            } "\n"
        }
    };
    let table = html! {
        table.sorts {
            thead { tr { (heads(["metric", "channel"])) (right_heads(["value"])) (heads(["unit", "source", "definition", "conditions"])) } }
            tbody { @for result in &sensor.results { (row(result)) } }
        }
    };
    html! {
        (scroll("Published results", &table))
        @for missing in &sensor.missing { p.note { "No number of " (missing.metric) ": " (missing.reason) "." } }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_list_has_a_column_of_prices_and_a_filter_of_what_can_be_bought() {
        let pages = site(&crate::catalogue::all(), &[]);
        let page = |file: &str| {
            &pages
                .iter()
                .find(|page| page.file == file)
                .expect("there")
                .text
        };
        let index = page("index.html");
        assert!(
            index.contains("<h1>Catalogue of tactile sensors</h1>"),
            "the title"
        );
        for words in ["size (mm)", "15 USD (parts)", "can be bought"] {
            assert!(index.contains(words), "{words}");
        }
        assert!(page("gelsight.html").contains(ABSENT), "no size is known");
        assert!(
            page("digit.html").contains("cost of parts"),
            "its price is of parts"
        );
    }

    #[test]
    fn every_page_leads_back_to_the_list() {
        let pages = site(&crate::catalogue::all(), &[]);
        assert!(pages.len() > 12);
        for page in &pages[1..] {
            let link = format!("<a href=\"index.html\">{TITLE}</a>");
            assert!(page.text.contains(&link), "{}", page.file);
        }
    }
}
