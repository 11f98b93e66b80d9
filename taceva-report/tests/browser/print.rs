//! Pages on paper.

use serde_json::json;

use crate::cdp::Browser;

/// How many sheets of A4 the page that is open takes.
pub(crate) fn pages(browser: &mut Browser) -> usize {
    // In inches; the margins are those of the page's own style.
    let paper = json!({"paperWidth": 8.27, "paperHeight": 11.69, "preferCSSPageSize": false});
    let pdf = browser.call("Page.printToPDF", paper);
    let file = from_base64(pdf["data"].as_str().expect("a file"));
    assert!(file.starts_with(b"%PDF"), "a PDF");
    let text = String::from_utf8_lossy(&file);
    // A page is an object of the type Page; their tree is of the type Pages.
    let pages = text.match_indices("/Type /Page").filter(|(at, found)| {
        let rest = &text[at + found.len()..];
        !rest.starts_with('s')
    });
    pages.count()
}

/// The bytes that a text of base64 stands for.
fn from_base64(text: &str) -> Vec<u8> {
    let value = |letter: u8| match letter {
        b'A'..=b'Z' => letter - b'A',
        b'a'..=b'z' => letter - b'a' + 26,
        b'0'..=b'9' => letter - b'0' + 52,
        b'+' => 62,
        b'/' => 63,
        other => panic!("`{other}` is no letter of base64"),
    };
    let letters: Vec<u8> = text
        .bytes()
        .filter(|letter| *letter != b'=')
        .map(value)
        .collect();
    let mut bytes = Vec::with_capacity(letters.len() * 3 / 4);
    for four in letters.chunks(4) {
        let bits = four
            .iter()
            .fold(0_u32, |bits, six| bits << 6 | u32::from(*six));
        let bits = bits << (6 * (4 - four.len()));
        bytes.extend(&bits.to_be_bytes()[1..four.len()]);
    }
    bytes
}
