//! Catalogues on pages.

use std::fs;

use super::{bundle, names, text};
use crate::support::Bench;

/// Number of bundles in the catalogue of a community.
const BUNDLES: usize = 30;

#[test]
fn thirty_bundles_are_added_checked_and_shown_with_every_number() {
    let bench = Bench::new();
    for (number, error) in (0..BUNDLES).zip(1_u32..) {
        let model = ["Foo", "Bar", "Baz"][number % 3];
        let name = format!("b{number}");
        bundle(&bench, &name, model, f64::from(error) / 1000.0);
        bench.ok(&format!("catalogue add {name} --to c -q"));
    }
    bench.ok("catalogue check c -q");
    let bundles = names(&bench, "bundles");
    assert_eq!(bundles.len(), BUNDLES);
    let index: serde_json::Value = serde_json::from_str(&text(&bench, "index.json")).expect("JSON");
    assert_eq!(index["bundles"].as_array().map(Vec::len), Some(BUNDLES));
    bench.ok("catalogue site c --out pages -q");
    let page = fs::read_to_string(bench.path("pages/measured.html")).expect("written");
    let entries = ["foo", "bar", "baz"].map(|name| text(&bench, &format!("entries/{name}.toml")));
    let rows: usize = entries
        .iter()
        .map(|entry| entry.matches("[[measured]]").count())
        .sum();
    assert_eq!(page.matches("<tr data-tags=").count(), rows);
    for bundle in &bundles {
        assert!(page.contains(&bundle[..8]), "{bundle}");
    }
    for words in [
        "level-predictions",
        "sensor-foo",
        "metric-mae",
        "without a certificate",
        "Ada",
        "CC-BY-4.0",
        "2026-11-28",
    ] {
        assert!(page.contains(words), "{words}");
    }
    let own = fs::read_to_string(bench.path("pages/baz.html")).expect("written");
    assert!(own.contains("id=\"measured\""), "its own page has them");
    let list = fs::read_to_string(bench.path("pages/index.html")).expect("written");
    assert!(
        list.contains("href=\"measured.html\""),
        "the list leads to them"
    );
}

#[test]
fn text_of_a_bundle_is_escaped_on_pages() {
    let bench = Bench::new();
    bundle(&bench, "one", "X <script>alert(1)</script>", 0.01);
    bench.ok("catalogue add one --to c -q");
    bench.ok("catalogue site c --out pages -q");
    for page in fs::read_dir(bench.path("pages")).expect("pages") {
        let path = page.expect("readable").path();
        let page = fs::read_to_string(&path).expect("a page");
        assert!(!page.contains("<script>alert"), "{}", path.display());
    }
    let page = fs::read_to_string(bench.path("pages/measured.html")).expect("written");
    assert!(page.contains("X &lt;script&gt;alert(1)"), "it is a text");
}
