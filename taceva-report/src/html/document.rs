//! The frame of every page: style, script, policy, navigation, sections.

use sha2::{Digest, Sha256};

use super::base64::base64;
use crate::escape::html;
use crate::figure::{DARK, LIGHT, STYLE};

const PAGE_STYLE: &str = include_str!("page.css");
const SCRIPT: &str = include_str!("page.js");

/// A page that is being put together.
#[derive(Clone, Debug)]
pub struct Document {
    title: String,
    lead: String,
    sections: Vec<Section>,
}

#[derive(Clone, Debug)]
struct Section {
    id: String,
    title: String,
    body: String,
}

impl Document {
    /// A page without a section; `title` is plain text.
    pub fn new(title: &str) -> Document {
        Document {
            title: title.to_owned(),
            lead: String::new(),
            sections: Vec::new(),
        }
    }

    /// What stands below the title, as HTML.
    pub fn lead(&mut self, body: &str) {
        body.clone_into(&mut self.lead);
    }

    /// Adds a section; `id` is a word, `title` plain text, `body` HTML.
    pub fn section(&mut self, id: &str, title: &str, body: &str) {
        self.sections.push(Section {
            id: id.to_owned(),
            title: title.to_owned(),
            body: body.to_owned(),
        });
    }

    /// The page as a file.
    pub fn finish(&self) -> String {
        let style = style();
        let policy = format!(
            "default-src 'none'; style-src 'sha256-{}'; script-src 'sha256-{}'; img-src data:; base-uri 'none'; form-action 'none'",
            digest(&style),
            digest(SCRIPT)
        );
        let title = html(&self.title);
        let mut out = format!(
            "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta http-equiv=\"Content-Security-Policy\" content=\"{policy}\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
             <meta name=\"color-scheme\" content=\"light dark\">\n\
             <meta name=\"referrer\" content=\"no-referrer\">\n\
             <link rel=\"icon\" href=\"data:,\">\n\
             <title>{title} · TacEva</title>\n<style>{style}</style>\n</head>\n<body>\n\
             <a class=\"skip\" href=\"#main\">Skip to the results</a>\n\
             <header><p class=\"mark\">TacEva</p><h1>{title}</h1>{}</header>\n",
            self.lead
        );
        out += "<nav aria-label=\"Sections\"><ul>";
        for section in &self.sections {
            out += &format!(
                "<li><a href=\"#{}\">{}</a></li>",
                section.id,
                html(&section.title)
            );
        }
        out += "</ul></nav>\n<main id=\"main\">\n";
        for section in &self.sections {
            let Section { id, title, body } = section;
            out += &format!(
                "<section id=\"{id}\" aria-labelledby=\"h-{id}\">\n<h2 id=\"h-{id}\">{}</h2>\n{body}\n</section>\n",
                html(title)
            );
        }
        out += &format!(
            "</main>\n<footer>Made by TacEva {}. This page is one file: it needs no network and sends nothing.</footer>\n\
             <div id=\"tip\" role=\"status\" aria-live=\"polite\" hidden></div>\n<script>{SCRIPT}</script>\n</body>\n</html>\n",
            env!("CARGO_PKG_VERSION")
        );
        out
    }
}

/// The style of a page: colours in the light and in the dark, the page, and figures.
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
    base64(&Sha256::digest(text.as_bytes()))
}
