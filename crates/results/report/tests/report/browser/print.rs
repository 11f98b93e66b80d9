//! Counts the printed sheets of a page.

use serde_json::json;

use taceva_needs::{Browser, from_base64};

/// Number of A4 sheets of the open page.
pub(crate) fn pages(browser: &mut Browser) -> usize {
    // Inches; the style of the page sets the margins.
    let paper = json!({"paperWidth": 8.27, "paperHeight": 11.69, "preferCSSPageSize": false});
    let pdf = browser.call("Page.printToPDF", paper);
    let file = from_base64(pdf["data"].as_str().expect("a file"));
    assert!(file.starts_with(b"%PDF"), "a PDF");
    let text = String::from_utf8_lossy(&file);
    // A page is an object of type Page; the page tree has type Pages.
    let pages = text.match_indices("/Type /Page").filter(|(at, found)| {
        let rest = &text[at + found.len()..];
        !rest.starts_with('s')
    });
    pages.count()
}
