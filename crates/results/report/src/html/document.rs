//! Layout of all pages: style, script, policy, navigation, sections.

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use maud::{DOCTYPE, Markup, PreEscaped, html};
use sha2::{Digest, Sha256};

use crate::escape;
use crate::figure::{DARK, LIGHT, STYLE};

const PAGE_STYLE: &str = include_str!("page.css");
const SCRIPT: &str = include_str!("page.js");

/// Page under construction.
pub(crate) struct Document {
    title: String,
    lead: Markup,
    sections: Vec<Section>,
}

struct Section {
    id: &'static str,
    title: &'static str,
    body: Markup,
}

impl Document {
    /// Creates a page without sections. `lead` is the text below the title.
    pub(crate) fn new(title: &str, lead: Markup) -> Document {
        Document {
            title: title.to_owned(),
            lead,
            sections: Vec::new(),
        }
    }

    /// Adds a section; `id` is a single word.
    pub(crate) fn section(&mut self, id: &'static str, title: &'static str, body: Markup) {
        self.sections.push(Section { id, title, body });
    }

    /// Returns the page as a file. Replaces invisible and direction-changing characters in all parts of the page.
    pub(crate) fn finish(self) -> String {
        let style = style();
        let policy = format!(
            "default-src 'none'; style-src 'sha256-{}'; script-src 'sha256-{}'; img-src data:; base-uri 'none'; form-action 'none'",
            digest(&style),
            digest(SCRIPT)
        );
        let page = html! {
            (DOCTYPE) "\n"
            html lang="en" {
                head {
                    meta charset="utf-8"; "\n"
                    meta http-equiv="Content-Security-Policy" content=(policy); "\n"
                    meta name="viewport" content="width=device-width, initial-scale=1";
                    meta name="color-scheme" content="light dark";
                    meta name="referrer" content="no-referrer";
                    link rel="icon" href="data:,"; "\n"
                    title { (self.title) " · TacEva" } "\n"
                    // Style and script are constants without external text, and the policy has their digests.
                    style { (PreEscaped(style)) } "\n"
                }
                body {
                    a.skip href="#main" { "Skip to the results" } "\n"
                    header { p.mark { "TacEva" } h1 { (self.title) } (self.lead) } "\n"
                    nav aria-label="Sections" {
                        ul { @for section in &self.sections { li { a href={ "#" (section.id) } { (section.title) } } } }
                    } "\n"
                    main id="main" {
                        @for Section { id, title, body } in &self.sections {
                            section id=(id) aria-labelledby={ "h-" (id) } { h2 id={ "h-" (id) } { (title) } "\n" (body) } "\n"
                        }
                    } "\n"
                    footer {
                        "Made by TacEva " (env!("CARGO_PKG_VERSION")) ". This page is one file: it needs no network and sends nothing."
                    } "\n"
                    div #tip role="status" aria-live="polite" hidden {}
                    script { (PreEscaped(SCRIPT)) }
                }
            } "\n"
        };
        escape::obeyed_replaced(&page.into_string())
    }
}

/// Style of a page: light and dark colours, layout, and figures.
fn style() -> String {
    let series = |colours: &[&str]| {
        let colours = colours.iter().enumerate();
        colours.fold(String::new(), |all, (at, colour)| {
            all + &format!("--s{at}:{colour};")
        })
    };
    format!(
        ":root{{{}}}@media screen and (prefers-color-scheme:dark){{:root{{{}}}}}{PAGE_STYLE}{STYLE}",
        series(&LIGHT),
        series(&DARK)
    )
}

fn digest(text: &str) -> String {
    BASE64_STANDARD.encode(Sha256::digest(text.as_bytes()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn style_and_script_have_nothing_that_a_page_replaces() {
        for text in [style(), SCRIPT.to_owned()] {
            assert_eq!(escape::obeyed_replaced(&text), text);
        }
    }
}
