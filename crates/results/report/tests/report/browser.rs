//! Tests of the report in a real browser: no console error, no request, hover, sort and print.
//!
//! Without Chromium, the tests are skipped and written to the list of skips.

mod axe;
mod every_page;
mod layout;
mod print;

use std::path::Path;

use crate::reports::page as page_of;
use crate::support::drawn;
use serde_json::{Value, json};
use taceva_needs::{Browser, skip};
use taceva_report::Study;

/// An opened page of synthetic results.
struct Opened {
    browser: Browser,
    folder: tempfile::TempDir,
}

fn open(studies: &[Study]) -> Option<Opened> {
    open_page(&page_of(studies))
}

/// Opens a page in a file; `None` without a browser.
fn open_page(text: &str) -> Option<Opened> {
    let folder = tempfile::tempdir().expect("a folder");
    let Some(browser) = Browser::start(folder.path()) else {
        skip(taceva_needs::Need::Browser, "no chromium on the path");
        return None;
    };
    let mut opened = Opened { browser, folder };
    opened.show(text);
    Some(opened)
}

impl Opened {
    fn show(&mut self, text: &str) {
        let path = self.folder.path().join("report.html");
        std::fs::write(&path, text).expect("written");
        self.browser.open(&address(&path));
    }
}

/// True if the URL belongs to the page itself, the only one that it may request.
fn is_report(url: &str) -> bool {
    url.starts_with("data:") || (url.starts_with("file:") && url.ends_with("/report.html"))
}

#[expect(clippy::print_stderr, reason = "a test says what it measures")]
fn print(words: &str) {
    eprintln!("{words}");
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
        json!(17)
    );
    let wide = browser.evaluate("document.documentElement.scrollWidth <= innerWidth");
    assert_eq!(wide, json!(true), "nothing leaves the page to the right");
    browser.assert_quiet(is_report);
}

#[test]
fn pointing_at_a_mark_shows_its_value_and_arrow_keys_go_on() {
    let Some(mut opened) = open(&two()) else {
        return;
    };
    let browser = &mut opened.browser;
    browser.evaluate("document.documentElement.style.scrollBehavior = 'auto'; document.querySelectorAll('details').forEach((fold) => { fold.open = true; }); document.querySelector('#figure-predicted-1').scrollIntoView()");
    // The page hides the tip when it scrolls, in the next frame.
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
    browser.assert_quiet(is_report);
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
    browser.assert_quiet(is_report);
}

#[test]
fn whoever_follows_a_metric_sees_what_it_means() {
    let Some(mut opened) = open(&two()) else {
        return;
    };
    let browser = &mut opened.browser;
    browser.evaluate("document.querySelector('#table-main a.metric').click()");
    browser.evaluate("new Promise((done) => setTimeout(done, 100))");
    let seen = browser.evaluate(
        "(() => { const entry = document.querySelector(location.hash); return [entry.id, entry.checkVisibility(), entry.nextElementSibling.textContent]; })()",
    );
    assert_eq!([&seen[0], &seen[1]], [&json!("metric-mae"), &json!(true)]);
    let words = seen[2].as_str().unwrap_or_default();
    assert!(
        words.contains("Unit:") && words.contains("lower is better"),
        "{words}"
    );
    browser.assert_quiet(is_report);
}

#[test]
fn methods_are_copied_by_keyboard() {
    let Some(mut opened) = open(&two()) else {
        return;
    };
    let browser = &mut opened.browser;
    browser.evaluate("document.querySelector('[data-copy=methods-text]').focus()");
    for kind in ["keyDown", "keyUp"] {
        browser.call(
            "Input.dispatchKeyEvent",
            json!({"type": kind, "key": "Enter", "code": "Enter", "windowsVirtualKeyCode": 13, "text": "\r"}),
        );
    }
    browser.evaluate("new Promise((done) => setTimeout(done, 300))");
    let said = browser.evaluate("document.querySelector('[data-copy=methods-text]').textContent");
    let said = said.as_str().unwrap_or_default();
    assert!(
        said.starts_with("Copied") || said.starts_with("Selected"),
        "{said}"
    );
    browser.assert_quiet(is_report);
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
    opened.browser.assert_quiet(is_report);
}

#[test]
fn a_hundred_thousand_samples_open_within_a_second() {
    let Some(mut opened) = open(&[drawn("many", 100_000, 1.0)]) else {
        return;
    };
    let browser = &mut opened.browser;
    // Two frames later, everything that was loaded is on the screen.
    let taken = browser.evaluate(
        "new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => {
            const paint = performance.getEntriesByName('first-contentful-paint')[0];
            done([performance.getEntriesByType('navigation')[0].loadEventEnd, paint ? paint.startTime : null]);
        })))",
    );
    let [load, paint] = [0, 1].map(|at| taken[at].as_f64());
    print(&format!(
        "100,000 samples: load {} ms, first paint {} ms after navigation",
        taken[0], taken[1]
    ));
    // The limit of one second applies to an idle machine.
    for taken in [load, paint] {
        assert!(
            taken.is_some_and(|taken| taken > 0.0 && taken < 4000.0),
            "{taken:?} ms"
        );
    }
    browser.assert_quiet(is_report);
}
