//! The catalogue as a static site: a list that filters and sorts, and a page a sensor under a permanent name.

use super::{Kind, Published, Sensor};
use crate::escape::html;
use crate::figures::figures;
use crate::html::{Document, figure, folded_glossary, metric_link};
use crate::number::numeral;
use crate::results::Study;

/// A file of the site.
#[derive(Clone, Debug)]
pub struct SitePage {
    /// Its name: `index.html`, `vitactip.html`.
    pub file: String,
    /// What is in it.
    pub text: String,
}

/// The pages of the site: the list first. `ours` are results of this program, which stand apart.
pub fn site(sensors: &[Sensor], ours: &[Study]) -> Vec<SitePage> {
    let mut pages = vec![SitePage {
        file: "index.html".to_owned(),
        text: index(sensors, ours),
    }];
    pages.extend(sensors.iter().map(|sensor| SitePage {
        file: format!("{}.html", sensor.slug()),
        text: page(sensor),
    }));
    pages
}

fn index(sensors: &[Sensor], ours: &[Study]) -> String {
    let mut document = Document::new("Catalogue of vision-based tactile sensors");
    document.lead("<p class=\"lead\">What was published of them, each number with its source.</p>");
    let mut rows = String::new();
    let of_kind = |kind| sensors.iter().filter(move |entry| entry.kind == kind);
    for sensor in of_kind(Kind::Sensor) {
        rows += &row(sensor);
    }
    let list = format!(
        "<fieldset><legend>Show</legend><label>containing <input type=\"search\" data-filter=\"text\"></label>\
         <label>mechanism <select data-filter=\"tag\"><option value=\"\">any</option><option value=\"imm\">IMM: intensity</option>\
         <option value=\"mdm\">MDM: markers</option><option value=\"mfm\">MFM: fusion</option>\
         <option value=\"magnetic\">magnetic taxels</option><option value=\"capacitive\">capacitive taxels</option></select></label>\
         <label>light <select data-filter=\"tag\"><option value=\"\">any</option><option value=\"opaque\">kept out</option></select></label>\
         <label>numbers <select data-filter=\"tag\"><option value=\"\">any</option><option value=\"numbers\">published here</option></select></label></fieldset>\n\
         <div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"Sensors\"><table class=\"sorts\"><thead><tr><th scope=\"col\">sensor</th><th scope=\"col\">mechanism</th>\
         <th scope=\"col\" class=\"r\">MAE Pxy (mm) ↓</th><th scope=\"col\" class=\"r\">MAE Pz (mm) ↓</th><th scope=\"col\" class=\"r\">MAE Fxy (N) ↓</th>\
         <th scope=\"col\" class=\"r\">MAE Fz (N) ↓</th><th scope=\"col\" class=\"r\">rate (Hz)</th><th scope=\"col\" class=\"r\">reported</th></tr></thead><tbody>\n{rows}</tbody></table></div>\n\
         <p class=\"note\">A dash: no number of that metric and unit is known here. The page of a sensor has every number that is. IMM maps intensity, MDM displacements of markers, MFM fuses modalities; magnetic and capacitive sensors have taxels and no camera. The last column counts which of ten properties the work itself reports.</p>"
    );
    document.section("sensors", "Sensors", &list);
    let studies: String = of_kind(Kind::Study).map(study).collect();
    if !studies.is_empty() {
        let studies = format!(
            "<p>Evaluations, benchmarks and reviews of sensors, with what they report of ten properties.</p>\n<ul>{studies}</ul>"
        );
        document.section("studies", "Studies of sensors", &studies);
    }
    let published: Vec<Study> = sensors
        .iter()
        .filter(|sensor| !sensor.results.is_empty())
        .map(Sensor::as_study)
        .collect();
    document.section("radars", "Side by side, as published", &radars(&published));
    if !ours.is_empty() {
        let simulated = "<p class=\"badge\">These are results of this program, not published ones; what is simulated was not measured.</p>";
        document.section(
            "ours",
            "Results of this program",
            &format!("{simulated}\n{}", radars(ours)),
        );
    }
    document.finish()
}

fn radars(studies: &[Study]) -> String {
    let drawn = figures(studies);
    let radars = drawn.iter().filter(|drawn| drawn.id.starts_with("radar"));
    let radars: String = radars.map(figure).collect();
    match radars.is_empty() {
        true => {
            "<p>Fewer than two sensors have numbers that can stand side by side.</p>".to_owned()
        }
        false => format!("<div class=\"radars\">\n{radars}</div>"),
    }
}

fn row(sensor: &Sensor) -> String {
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
    let mut out = format!(
        "<tr data-tags=\"{}\"><th scope=\"row\"><a href=\"{}.html\">{}</a></th><td>{}</td>",
        html(&tags.join(" ")),
        sensor.slug(),
        html(&sensor.name),
        html(&sensor.mechanism.join(" + "))
    );
    let mae = ["Pxy", "Pz", "Fxy", "Fz"]
        .map(|channel| sensor.result("mae", channel).map(|result| result.value));
    for value in mae.into_iter().chain([sensor.frame_rate_hz()]) {
        out += &match value {
            Some(value) => format!("<td class=\"r\" data-v=\"{value}\">{}</td>", numeral(value)),
            None => "<td class=\"none\" data-v=\"\">–</td>".to_owned(),
        };
    }
    let yes = properties_reported(sensor);
    let count = match sensor.reported.is_empty() {
        true => "<td class=\"none\" data-v=\"\">–</td>".to_owned(),
        false => format!("<td class=\"r\" data-v=\"{yes}\">{yes}</td>"),
    };
    out + &count + "</tr>\n"
}

/// Of how many properties the work itself says that it reports them.
fn properties_reported(entry: &Sensor) -> usize {
    let words = entry.reported.values();
    words.filter(|word| *word == "yes").count()
}

fn study(entry: &Sensor) -> String {
    let count = match entry.reported.is_empty() {
        true => String::new(),
        false => format!(": {} of 10", properties_reported(entry)),
    };
    format!(
        "<li><a href=\"{}.html\">{}</a>{count}</li>",
        entry.slug(),
        html(&entry.name)
    )
}

fn page(sensor: &Sensor) -> String {
    let mut document = Document::new(&sensor.name);
    document.lead("<p class=\"lead\"><a href=\"index.html\">Catalogue of vision-based tactile sensors</a></p>");
    if sensor.kind == Kind::Study {
        document.lead("<p>A study of sensors, and no sensor.</p>");
    }
    document.section("properties", "Properties", &properties(sensor));
    if !sensor.results.is_empty() {
        document.section("results", "Published results", &results(sensor));
    }
    let named = sensor.results.iter().map(|result| result.metric.as_str());
    let is_known = |id: &str| taceva_metrics::Better::of(id).is_some();
    if named.clone().any(is_known) {
        document.section("meanings", "What the metrics mean", &folded_glossary(named));
    }
    if !sensor.reported.is_empty() {
        document.section("reported", "What the work reports", &reported(sensor));
    }
    let mut sources = String::from("<ul>");
    for source in &sensor.sources {
        let link = match &source.link {
            Some(link) if link.starts_with("https://") => {
                format!(" <a href=\"{0}\" rel=\"noreferrer\">{0}</a>", html(link))
            }
            _ => String::new(),
        };
        sources += &format!(
            "<li>{}: {}{link}</li>",
            html(&source.id),
            html(&source.text)
        );
    }
    document.section("sources", "Sources", &(sources + "</ul>"));
    document.finish()
}

fn properties(sensor: &Sensor) -> String {
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
    if let Some(of) = &sensor.intrinsic {
        entries.extend([
            ("camera".to_owned(), format!("{} MP", of.camera_mp)),
            ("thickness".to_owned(), format!("{} mm", of.thickness_mm)),
            (
                "field of view".to_owned(),
                format!("{} mm²", of.field_of_view_mm2),
            ),
            ("frame rate".to_owned(), format!("{} Hz", of.frame_rate_hz)),
        ]);
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
    for (theme, terms) in &sensor.applications {
        if !terms.is_empty() {
            entries.push((format!("used for: {theme}"), terms.join(", ")));
        }
    }
    let rows = entries
        .iter()
        .map(|(term, text)| format!("<dt>{}</dt><dd>{}</dd>", html(term), html(text)));
    format!("<dl>{}</dl>", rows.collect::<String>())
}

fn results(sensor: &Sensor) -> String {
    let row = |result: &Published| {
        let unit = if result.unit == "1" { "" } else { &result.unit };
        let note = result
            .note
            .as_ref()
            .map_or_else(String::new, |note| format!("; {note}"));
        format!(
            "<tr><th scope=\"row\">{}</th><td>{}</td><td class=\"r\" data-v=\"{}\">{}</td><td>{}</td><td>{}, {}</td><td class=\"wrap\">{}</td><td class=\"wrap\">{}{}</td></tr>\n",
            metric_link(&result.metric),
            html(&result.channel),
            result.value,
            html(&result.shown()),
            html(unit),
            html(&result.source),
            html(&result.read_from),
            html(&result.definition),
            html(&result.conditions),
            html(&note)
        )
    };
    let rows: String = sensor.results.iter().map(row).collect();
    let missing = sensor.missing.iter().map(|missing| {
        format!(
            "<p class=\"note\">No number of {}: {}.</p>",
            html(&missing.metric),
            html(&missing.reason)
        )
    });
    format!(
        "<div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"Published results\"><table class=\"sorts\"><thead><tr><th scope=\"col\">metric</th><th scope=\"col\">channel</th><th scope=\"col\" class=\"r\">value</th>\
         <th scope=\"col\">unit</th><th scope=\"col\">source</th><th scope=\"col\">definition</th><th scope=\"col\">conditions</th></tr></thead><tbody>\n{rows}</tbody></table></div>\n{}",
        missing.collect::<String>()
    )
}

fn reported(sensor: &Sensor) -> String {
    let entries = sensor.reported.iter().filter(|(key, _)| *key != "source");
    let entries = entries.map(|(key, word)| {
        format!(
            "<dt>{}</dt><dd>{}</dd>",
            html(&key.replace('_', " ")),
            html(word)
        )
    });
    format!("<dl>{}</dl>", entries.collect::<String>())
}
