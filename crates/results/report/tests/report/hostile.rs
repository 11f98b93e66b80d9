//! Tests that a name with markup or direction marks is plain text on every kind of page.

use crate::support::{self, results, samples};
use serde_json::json;
use taceva_report::catalogue::Sensor;
use taceva_report::{
    Acceptance, CompareRequest, LimitsFile, Need, Picture, ReportPage, Study, Triple, accept,
    choose_results, compare, picks, report,
};
use taceva_results::Samples;

/// Closes an element, an attribute in either quotes and a comment. Contains C0 and C1 controls, direction marks and a zero-width space.
const HOSTILE: &str = "</title><script>alert(1)</script>\" onload=\"x()\" '><!--&lt;\u{202e}\u{2066}\u{9b}31m\u{0}\u{1b}[2J\u{200b}";

/// A harmless name with the length and sort position of [`HOSTILE`].
fn harmless() -> String {
    let letter = |letter: char| if letter == ' ' { ' ' } else { '0' };
    HOSTILE.chars().map(letter).collect()
}

/// Two studies; every text of the first is `name`.
fn studies(name: &str) -> [Study; 2] {
    [name, "other"].map(|name| {
        let mut result = results(name, 1.0);
        result["metrics"]["mae"]["Px"]["flags"] = json!([name]);
        result["metrics"]["mae"][name] = json!({"undefined": name, "n": 0, "definition": name});
        result["metrics"]["r2"]["Fz"]["ci95"] = json!({"undefined": name});
        result["metrics"][name][name] = json!({"value": 0.2, "unit": "N", "n": 9});
        result["over_seeds"] = json!({"seeds": [1, 2], "decides": name, "scores": [
            {"metric": name, "channel": name, "unit": "mm", "values": [0.1, 0.3], "mean": 0.2, "standard_deviation": 0.1, "interval": [0.1, 0.3]}
        ]});
        let mut study = support::study(&result);
        study.samples = Some(Samples::read(&samples(name, 40, 1.0)).expect("samples"));
        study
    })
}

fn triple(name: &str) -> Triple {
    Triple {
        study: 0,
        media_type: "image/png",
        untouched: Some(vec![1]),
        pressed: vec![2],
        difference: Some(vec![3]),
        gain: 4.0,
        words: name.to_owned(),
    }
}

fn report_of(name: &str) -> String {
    let studies = studies(name);
    let picture = |pick: taceva_report::Pick| Picture {
        study: 0,
        id: pick.id,
        media_type: "image/png",
        bytes: vec![1],
    };
    let pictures: Vec<Picture> = picks(&studies[0]).into_iter().map(picture).collect();
    report(&ReportPage {
        title: name,
        studies: &studies,
        pictures: &pictures,
        triples: &[triple(name)],
    })
}

fn sheet_of(name: &str) -> String {
    let study = &studies(name)[0];
    let limit = json!(name);
    let limits = LimitsFile::read(&format!(
        "name = {limit}\n[[limit]]\nmetric = {limit}\nchannel = {limit}\nunit = \"N\"\nmost = 0.1\n[[limit]]\nmetric = \"mae\"\nchannel = {limit}\nunit = \"N\"\nmost = 0.1\n",
        limit = in_toml(&limit)
    ));
    let limits = limits.expect("limits");
    let acceptance = Acceptance {
        limits: &limits,
        study,
        findings: &accept(study, &limits).expect("checks"),
        date: Some(name),
        pictures: Some(&triple(name)),
    };
    acceptance.page()
}

/// A JSON string in TOML syntax, where C1 controls also need an escape.
fn in_toml(text: &serde_json::Value) -> String {
    text.to_string().replace('\u{9b}', "\\u009b")
}

/// The list, and the page of a sensor whose every text is `name`.
fn site_of(name: &str) -> [String; 2] {
    let word = in_toml(&json!(name));
    let sensor = Sensor::read(
        "x.toml",
        &format!(
            "catalogue_version = 1\nname = {word}\nkind = \"sensor\"\nmechanism = [\"IMM\"]\nshape = {word}\n\
             [[source]]\nid = {word}\ntext = {word}\nlink = {link}\n[[source]]\nid = \"no\"\ntext = \"t\"\nlink = \"javascript:alert(1)\"\n\
             [[result]]\nmetric = {word}\nchannel = {word}\nvalue = 1\nunit = \"N\"\nsource = {word}\nread_from = {word}\nconditions = {word}\ndefinition = {word}\nnote = {word}\n\
             [[missing]]\nmetric = {word}\nreason = {word}\n[reported]\n{word} = {word}\n[applications]\n{word} = [{word}]\n",
            link = in_toml(&json!(format!("https://{name}")))
        ),
    );
    let pages = taceva_report::site(&[sensor.expect("an entry")], &studies(name));
    let [list, page] = pages.try_into().expect("two pages");
    [list.text, page.text]
}

/// One page of every kind.
fn pages(name: &str) -> [(&'static str, String); 6] {
    let studies = studies(name);
    let comparison = compare(&studies, &CompareRequest::default());
    let needs = Need::parse("depth error 0.5 mm").expect("needs");
    let [list, sensor] = site_of(name);
    [
        ("report", report_of(name)),
        ("comparison", comparison.page(&studies)),
        ("choice", choose_results(&studies, &needs).page(name)),
        ("data sheet", sheet_of(name)),
        ("catalogue", list),
        ("sensor", sensor),
    ]
}

/// Elements of a page with the names of their attributes, in order.
fn elements(page: &str) -> Vec<Vec<&str>> {
    let body = page.split_once("<body>").expect("a body").1;
    let body = body.split_once("<script>").expect("a script").0;
    body.split('<').skip(1).map(element).collect()
}

/// Names of an element and its attributes, from the text after `<`. Skips quoted text.
fn element(tag: &str) -> Vec<&str> {
    let parts = tag.split('"').step_by(2);
    let mut words = Vec::new();
    for part in parts {
        let end = part.split_once('>');
        words.extend(end.map_or(part, |(inside, _)| inside).split_whitespace());
        if end.is_some() {
            break;
        }
    }
    words
}

#[test]
fn a_hostile_name_is_words_on_every_kind_of_page() {
    let plain = pages(&harmless());
    for ((kind, page), (_, plain)) in pages(HOSTILE).iter().zip(&plain) {
        let words =
            "&lt;/title&gt;&lt;script&gt;alert(1)&lt;/script&gt;&quot; onload=&quot;x()&quot;";
        assert!(page.contains(words), "{kind}: the name is not there");
        let (found, expected) = (elements(page), elements(plain));
        let differs = found.iter().zip(&expected).find(|(found, of)| found != of);
        assert_eq!(differs, None, "{kind}");
        assert_eq!(found.len(), expected.len(), "{kind}");
        assert_eq!(page.matches("<script").count(), 1, "{kind}");
        assert!(!page.contains("href=\"javascript"), "{kind}");
        let is_obeyed = |letter: char| taceva_core::is_obeyed(letter) && !"\n\t".contains(letter);
        assert_eq!(page.find(is_obeyed), None, "{kind}");
        assert!(page.contains("\u{fffd}\u{fffd}31m"), "{kind}");
    }
}
