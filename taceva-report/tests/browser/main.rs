//! The report in a real browser: no console error, no request, hover, sort and print.
//!
//! Skipped, with the reason printed, where no Chromium is installed.

#[path = "../support/mod.rs"]
mod support;

mod cdp;

use std::path::Path;

use cdp::Browser;
use serde_json::{Value, json};
use support::drawn;
use taceva_report::{Report, Study, report};

/// A page of drawn results in a file, opened.
struct Opened {
    browser: Browser,
    _folder: tempfile::TempDir,
}

fn open(studies: &[Study]) -> Option<Opened> {
    let folder = tempfile::tempdir().expect("a folder");
    let Some(mut browser) = Browser::start(folder.path()) else {
        print_skip();
        return None;
    };
    let path = folder.path().join("report.html");
    let text = report(&Report {
        title: "drawn",
        studies,
        pictures: &[],
    });
    std::fs::write(&path, text).expect("written");
    browser.open(&address(&path));
    Some(Opened {
        browser,
        _folder: folder,
    })
}

#[expect(clippy::print_stderr, reason = "a skipped test says why")]
fn print_skip() {
    eprintln!("skipped: no chromium on the path");
}

fn address(path: &Path) -> String {
    format!("file://{}", path.display())
}

fn two() -> [Study; 2] {
    [drawn("one", 150, 1.0), drawn("two", 150, 1.4)]
}

#[test]
fn the_page_opens_without_an_error_and_asks_for_nothing() {
    let Some(mut opened) = open(&two()) else {
        return;
    };
    let browser = &mut opened.browser;
    let empty = browser.evaluate(
        "[...document.querySelectorAll('figure svg')].filter((svg) => svg.querySelectorAll('polyline,rect,circle,polygon').length < 10).length",
    );
    assert_eq!(empty, json!(0));
    assert_eq!(
        browser.evaluate("document.querySelectorAll('figure').length"),
        json!(18)
    );
    let wide = browser.evaluate("document.documentElement.scrollWidth <= innerWidth");
    assert_eq!(wide, json!(true), "nothing leaves the page to the right");
    browser.assert_quiet();
}

#[test]
fn pointing_at_a_mark_shows_its_value_and_arrow_keys_go_on() {
    let Some(mut opened) = open(&two()) else {
        return;
    };
    let browser = &mut opened.browser;
    browser.evaluate("document.documentElement.style.scrollBehavior = 'auto'; document.querySelector('#figure-predicted-1').scrollIntoView()");
    // The page hides the tip when it scrolls, which it does with the next frame.
    browser.evaluate(
        "new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(1))))",
    );
    let place = browser.evaluate(
        "(() => { const box = document.querySelector('#figure-predicted-1 circle').getBoundingClientRect(); return [box.x + box.width / 2, box.y + box.height / 2]; })()",
    );
    browser.call(
        "Input.dispatchMouseEvent",
        json!({"type": "mouseMoved", "x": place[0], "y": place[1]}),
    );
    let tip = browser.evaluate(
        "document.getElementById('tip').hidden ? '' : document.getElementById('tip').textContent",
    );
    assert!(
        tip.as_str()
            .is_some_and(|tip| tip.contains("true") && tip.contains("predicted")),
        "{tip}"
    );
    browser.evaluate("document.querySelector('#figure-resolution svg').focus()");
    for kind in ["keyDown", "keyUp"] {
        browser.call(
            "Input.dispatchKeyEvent",
            json!({"type": kind, "key": "ArrowRight", "code": "ArrowRight"}),
        );
    }
    let tip = browser.evaluate("document.getElementById('tip').textContent");
    assert!(
        tip.as_str().is_some_and(|tip| tip.contains("tolerance")),
        "{tip}"
    );
    browser.assert_quiet();
}

#[test]
fn tables_sort_by_number_both_ways() {
    let Some(mut opened) = open(&two()) else {
        return;
    };
    let browser = &mut opened.browser;
    let values = "[...document.querySelectorAll('#table-accuracy tbody tr')].map((row) => Number(row.cells[3].dataset.v))";
    let click = "document.querySelectorAll('#table-accuracy th button')[3].click()";
    let mut seen: Vec<Vec<f64>> = Vec::new();
    for _ in 0..2 {
        browser.evaluate(click);
        let sorted = browser.evaluate(values);
        let numbers = sorted
            .as_array()
            .expect("a list")
            .iter()
            .filter_map(Value::as_f64);
        seen.push(numbers.collect());
    }
    assert!(seen[0].len() > 5 && seen[0].is_sorted(), "{:?}", seen[0]);
    seen[1].reverse();
    assert!(seen[1].is_sorted());
    browser.assert_quiet();
}

#[test]
fn paper_cuts_no_table() {
    let Some(mut opened) = open(&two()) else {
        return;
    };
    let browser = &mut opened.browser;
    browser.call("Emulation.setEmulatedMedia", json!({"media": "print"}));
    // The width of A4 less its margins, at 96 dots an inch.
    browser.call(
        "Emulation.setDeviceMetricsOverride",
        json!({"width": 688, "height": 971, "deviceScaleFactor": 1, "mobile": false}),
    );
    let cut = browser.evaluate(
        "[...document.querySelectorAll('table')].filter((table) => table.getBoundingClientRect().right > innerWidth + 1).map((table) => table.id || table.textContent.slice(0, 80))",
    );
    assert_eq!(cut, json!([]));
    let pdf = browser.call("Page.printToPDF", json!({}));
    let data = pdf["data"].as_str().expect("a file");
    assert!(data.starts_with("JVBERi") && data.len() > 50_000, "a PDF");
    browser.assert_quiet();
}

#[test]
fn no_naughty_name_runs_asks_or_speaks() {
    let strings = naughty_strings::BLNS
        .iter()
        .filter(|text| text.contains(['<', '(', ':', '&', '\u{202e}']));
    let mut studies: Vec<Study> = Vec::new();
    for text in strings {
        let mut study = drawn(text, 4, 1.0);
        study.scores.truncate(12);
        study.samples = None;
        studies.push(study);
    }
    assert!(studies.len() > 100);
    let Some(mut opened) = open(&studies) else {
        return;
    };
    opened.browser.assert_quiet();
}

#[test]
fn a_hundred_thousand_samples_open_within_a_second() {
    let Some(mut opened) = open(&[drawn("many", 100_000, 1.0)]) else {
        return;
    };
    let browser = &mut opened.browser;
    let taken = browser.evaluate("performance.getEntriesByType('navigation')[0].loadEventEnd");
    // A second is promised on a machine with nothing else to do.
    assert!(
        taken
            .as_f64()
            .is_some_and(|taken| taken > 0.0 && taken < 4000.0),
        "{taken} ms"
    );
    browser.assert_quiet();
}
