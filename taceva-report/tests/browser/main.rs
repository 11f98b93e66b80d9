//! The report in a real browser: no console error, no request, hover, sort and print.
//!
//! Skipped, and written into the list of skips, where no Chromium is installed.

#[path = "../support/mod.rs"]
mod support;

mod axe;
mod cdp;
mod print;

use std::path::Path;

use cdp::Browser;
use serde_json::{Value, json};
use support::drawn;
use taceva_needs::skip;
use taceva_report::{
    Acceptance, CompareRequest, LimitsFile, Need, Report, Study, accept, catalogue, choose,
    compare, report,
};

/// A page of drawn results in a file, opened.
struct Opened {
    browser: Browser,
    folder: tempfile::TempDir,
}

fn open(studies: &[Study]) -> Option<Opened> {
    open_page(&page_of(studies))
}

fn page_of(studies: &[Study]) -> String {
    report(&Report {
        title: "drawn",
        studies,
        pictures: &[],
        triples: &[],
    })
}

/// A page in a file, opened; none where there is no browser.
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
    browser.evaluate("document.documentElement.style.scrollBehavior = 'auto'; document.querySelectorAll('details').forEach((fold) => { fold.open = true; }); document.querySelector('#figure-predicted-1').scrollIntoView()");
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
    assert!(print::pages(browser) > 3);
    browser.assert_quiet();
}

/// The height of a screen, in pixels.
const SCREEN: f64 = 900.0;

#[test]
fn a_report_of_four_sensors_is_at_most_twelve_screens_until_it_is_unfolded() {
    let four = [1.0, 1.4, 1.8, 2.2].map(|scale| drawn(&format!("sensor {scale}"), 150, scale));
    let Some(mut opened) = open(&four) else {
        return;
    };
    let browser = &mut opened.browser;
    browser.call(
        "Emulation.setDeviceMetricsOverride",
        json!({"width": 1280, "height": 900, "deviceScaleFactor": 1, "mobile": false}),
    );
    let height = "document.documentElement.scrollHeight";
    let folded = browser.evaluate(height).as_f64().expect("a height") / SCREEN;
    let first = "(() => { const last = [...document.querySelectorAll('#summary li')].pop(); return last.getBoundingClientRect().bottom; })()";
    let summary = browser.evaluate(first).as_f64().expect("a height") / SCREEN;
    let unfold = "document.querySelector('[data-unfold]').click()";
    browser.evaluate(unfold);
    let unfolded = browser.evaluate(height).as_f64().expect("a height") / SCREEN;
    print(&format!(
        "screens of {SCREEN} px: summary {summary:.1}, folded {folded:.1}, unfolded {unfolded:.1}"
    ));
    assert!(
        folded <= 12.0 && unfolded > folded * 2.0,
        "{folded} {unfolded}"
    );
    browser.assert_quiet();
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
    browser.assert_quiet();
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
    browser.assert_quiet();
}

#[test]
fn paper_unfolds_everything() {
    let Some(mut opened) = open(&two()) else {
        return;
    };
    let browser = &mut opened.browser;
    browser.call("Emulation.setEmulatedMedia", json!({"media": "print"}));
    let hidden = browser.evaluate(
        "[...document.querySelectorAll('main figure svg')].filter((one) => one.getBoundingClientRect().height < 10).length",
    );
    assert_eq!(hidden, json!(0));
    browser.assert_quiet();
}

#[test]
fn a_phone_says_where_a_table_goes_on_and_cuts_no_radar() {
    let Some(mut opened) = open(&two()) else {
        return;
    };
    let browser = &mut opened.browser;
    browser.call(
        "Emulation.setDeviceMetricsOverride",
        json!({"width": 390, "height": 844, "deviceScaleFactor": 2, "mobile": true}),
    );
    browser.evaluate("document.querySelectorAll('details').forEach((fold) => { fold.open = true; }); new Promise((done) => setTimeout(done, 300))");
    let silent = browser.evaluate(
        "[...document.querySelectorAll('.scroll, main figure')].filter((box) => box.scrollWidth > box.clientWidth + 2 && getComputedStyle(box, '::before').content === 'none').length",
    );
    assert_eq!(silent, json!(0), "every box that goes on says so");
    let told = browser.evaluate("document.querySelectorAll('[data-more]').length");
    assert!(told.as_u64() > Some(3), "{told}");
    let cut = browser.evaluate(
        "[...document.querySelectorAll('[id^=figure-radar] svg')].filter((svg) => svg.getBoundingClientRect().right > innerWidth || [...svg.querySelectorAll('text')].some((text) => { const box = text.getBoundingClientRect(); return box.left < 0 || box.right > innerWidth; })).map((svg) => svg.textContent.slice(0, 30))",
    );
    assert_eq!(cut, json!([]));
    browser.assert_quiet();
}

#[test]
fn a_phone_scrolls_down_and_squeezes_nothing() {
    let Some(mut opened) = open(&two()) else {
        return;
    };
    let browser = &mut opened.browser;
    browser.call(
        "Emulation.setDeviceMetricsOverride",
        json!({"width": 400, "height": 800, "deviceScaleFactor": 2, "mobile": true}),
    );
    let wide = browser.evaluate("document.documentElement.scrollWidth <= innerWidth");
    assert_eq!(wide, json!(true), "nothing leaves the page to the right");
    let squeezed = browser.evaluate(
        "[...document.querySelectorAll('p, li, dd, figcaption, caption')].filter((one) => one.textContent.length > 40 && one.getBoundingClientRect().width < 140 && one.checkVisibility()).map((one) => one.textContent.slice(0, 60))",
    );
    assert_eq!(squeezed, json!([]));
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

/// Limits of three metrics of every channel: what a unit of six channels is held to.
fn sheet(limits_of: &[&str]) -> String {
    let mut text = "limits_version = 1\nname = \"line 3\"\n".to_owned();
    for metric in limits_of {
        for channel in support::SIX {
            let unit = match (*metric, channel.starts_with('P')) {
                ("r2" | "r_light", _) => "1",
                (_, true) => "mm",
                (_, false) => "N",
            };
            text += &format!(
                "[[limit]]\nmetric = \"{metric}\"\nchannel = \"{channel}\"\nunit = \"{unit}\"\nmost = 0.05\n"
            );
        }
    }
    let limits = LimitsFile::read(&text).expect("limits");
    let study = drawn("one", 60, 1.0);
    let findings = accept(&study, &limits);
    assert!(findings.iter().any(|finding| !finding.is_kept));
    let acceptance = Acceptance {
        name: &limits.name,
        study: &study,
        findings: &findings,
        date: Some("2026-11-22"),
        pictures: None,
    };
    acceptance.page()
}

#[test]
fn a_data_sheet_is_one_page_of_paper() {
    for metrics in [&["mae"][..], &["mae", "r2", "r_spatial", "repeatability"]] {
        let Some(mut opened) = open_page(&sheet(metrics)) else {
            return;
        };
        assert_eq!(print::pages(&mut opened.browser), 1, "{metrics:?}");
        opened.browser.assert_quiet();
    }
}

#[test]
fn no_page_keeps_anybody_out() {
    let axe = match axe::source() {
        Ok(axe) => axe,
        Err(why) => return skip(taceva_needs::Need::Axe, why),
    };
    let studies = two();
    let needs = Need::parse("accurate shear, ambient light").expect("needs");
    let site = catalogue::site(&catalogue::all(), &studies);
    let mut pages = vec![
        ("report", page_of(&studies)),
        (
            "comparison",
            compare(&studies, &CompareRequest::default()).page(&studies),
        ),
        (
            "choice",
            choose(&catalogue::all(), &needs).page("accurate shear, ambient light"),
        ),
        ("data sheet", sheet(&["mae"])),
    ];
    for file in ["index.html", "vitactip.html", "digit.html"] {
        let page = site.iter().find(|page| page.file == file).expect("there");
        pages.push((file, page.text.clone()));
    }
    let Some(mut opened) = open_page(&pages[0].1) else {
        return;
    };
    for (name, page) in &pages {
        opened.show(page);
        axe::assert_accessible(&mut opened.browser, &axe, name);
    }
}

#[test]
fn a_hundred_thousand_samples_open_within_a_second() {
    let Some(mut opened) = open(&[drawn("many", 100_000, 1.0)]) else {
        return;
    };
    let browser = &mut opened.browser;
    // Two frames later whatever was loaded is on the screen.
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
    // A second is promised on a machine with nothing else to do.
    for taken in [load, paint] {
        assert!(
            taken.is_some_and(|taken| taken > 0.0 && taken < 4000.0),
            "{taken:?} ms"
        );
    }
    browser.assert_quiet();
}
