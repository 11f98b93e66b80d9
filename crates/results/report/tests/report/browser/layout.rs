//! Tests of pages on paper, on screens and on phones: nothing is cut or squeezed.

use serde_json::json;

use super::{open, print, two};
use crate::support::drawn;

#[test]
fn paper_cuts_no_table() {
    let Some(mut opened) = open(&two()) else {
        return;
    };
    let browser = &mut opened.browser;
    browser.call("Emulation.setEmulatedMedia", json!({"media": "print"}));
    // Width of A4 less its margins, at 96 dots per inch.
    browser.call(
        "Emulation.setDeviceMetricsOverride",
        json!({"width": 688, "height": 971, "deviceScaleFactor": 1, "mobile": false}),
    );
    let cut = browser.evaluate(
        "[...document.querySelectorAll('table')].filter((table) => table.getBoundingClientRect().right > innerWidth + 1).map((table) => table.id || table.textContent.slice(0, 80))",
    );
    assert_eq!(cut, json!([]));
    assert!(print::pages(browser) > 3);
    browser.assert_quiet(super::is_report);
}

/// Height of a screen, in pixels.
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
    browser.assert_quiet(super::is_report);
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
    browser.assert_quiet(super::is_report);
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
    let unmarked = browser.evaluate(
        "[...document.querySelectorAll('.scroll, main figure')].filter((box) => box.scrollWidth > box.clientWidth + 2 && getComputedStyle(box, '::before').content === 'none').length",
    );
    assert_eq!(unmarked, json!(0), "every box that goes on says so");
    let boxes = browser.evaluate("document.querySelectorAll('[data-more]').length");
    assert!(boxes.as_u64() > Some(3), "{boxes}");
    let cut = browser.evaluate(
        "[...document.querySelectorAll('[id^=figure-radar] svg')].filter((svg) => svg.getBoundingClientRect().right > innerWidth || [...svg.querySelectorAll('text')].some((text) => { const box = text.getBoundingClientRect(); return box.left < 0 || box.right > innerWidth; })).map((svg) => svg.textContent.slice(0, 30))",
    );
    assert_eq!(cut, json!([]));
    browser.assert_quiet(super::is_report);
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
    browser.assert_quiet(super::is_report);
}
