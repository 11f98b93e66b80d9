//! Configuration page of a Net F/T box: the HTTP request for it, and its entries as text.

use std::io::{Read, Write};
use std::net::SocketAddr;
use std::time::Duration;

use taceva_core::ErrorKind;
use thiserror::Error;

use crate::link::{LinkError, connect};
use crate::text::shown;

/// Text of a configuration page that is not truncated.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Page(String);

/// Failure to read the configuration page of a box or one of its entries.
#[derive(Debug, Error)]
pub(super) enum PageError {
    #[error(transparent)]
    Link(#[from] LinkError),
    #[error("{address} does not return {PAGE}: {source}")]
    Unread {
        address: SocketAddr,
        source: std::io::Error,
    },
    #[error(
        "{PAGE} is incomplete, expected `{end}` at its end: open the page in a browser, and restart the box if it is cut off there too"
    )]
    CutOff { end: String },
    #[error("{}, expected {expected}", stated(.key, .found))]
    Entry {
        key: &'static str,
        expected: &'static str,
        found: String,
    },
}

impl PageError {
    /// Kind of the driver error for this failure.
    pub(super) fn kind(&self) -> ErrorKind {
        match self {
            PageError::Link(error) => error.kind(),
            PageError::Unread { .. } | PageError::CutOff { .. } | PageError::Entry { .. } => {
                ErrorKind::Protocol
            }
        }
    }

    /// Error for the entry `key` of the page, whose content is `found`. The error keeps the first 40 characters.
    pub(super) fn entry(key: &'static str, expected: &'static str, found: &str) -> PageError {
        PageError::Entry {
            key,
            expected,
            found: found.chars().take(40).collect(),
        }
    }
}

pub(super) const PAGE: &str = "/netftapi2.xml";
/// Maximum length of the configuration page, bytes.
const PAGE_MAX: u64 = 256 << 10;
const PATIENCE: Duration = Duration::from_secs(3);

impl Page {
    /// Reads the configuration page of the box at `host` over HTTP on `port`.
    pub(super) fn ask(host: &str, port: u16) -> Result<Page, PageError> {
        let (mut stream, address) = connect(host, port)?;
        let failed = |source| PageError::Unread { address, source };
        stream.set_read_timeout(Some(PATIENCE)).map_err(failed)?;
        let request = format!("GET {PAGE} HTTP/1.0\r\nHost: {host}\r\nConnection: close\r\n\r\n");
        stream.write_all(request.as_bytes()).map_err(failed)?;
        let mut page = Vec::new();
        stream
            .take(PAGE_MAX)
            .read_to_end(&mut page)
            .map_err(failed)?;
        let page = text(page);
        let status = page.lines().next().unwrap_or_default();
        if status.split(' ').nth(1) != Some("200") {
            let said = std::io::Error::other(format!("it answers `{}`", shown(status)));
            return Err(failed(said));
        }
        Page::whole(page)
    }

    /// Checks that `page` contains the end tag of its first element. A truncated page would otherwise seem to lack entries.
    pub(super) fn whole(page: String) -> Result<Page, PageError> {
        let names = page.split('<').skip(1);
        let mut elements =
            names.filter(|name| name.starts_with(|first: char| first.is_alphabetic()));
        let is_name = |letter: &char| letter.is_alphanumeric() || "_-.:".contains(*letter);
        let root: String = elements.next().map_or_else(String::new, |root| {
            root.chars().take_while(is_name).collect()
        });
        let end = format!("</{root}>");
        match page.contains(&end) {
            true => Ok(Page(page)),
            false => Err(PageError::CutOff { end }),
        }
    }

    /// Trimmed text of the first XML element `key`, with entities decoded. Empty if the page lacks the element.
    pub(super) fn entry(&self, key: &str) -> String {
        let between = self
            .0
            .split_once(&format!("<{key}>"))
            .and_then(|(_, behind)| behind.split_once(&format!("</{key}>")));
        between.map_or_else(String::new, |(value, _)| decoded(value.trim()))
    }

    /// Number in the XML element `key`; `None` if the page lacks the element or the element is empty.
    ///
    /// # Errors
    /// [`PageError::Entry`] for a text that is not a number.
    pub(super) fn number(&self, key: &'static str) -> Result<Option<f64>, PageError> {
        let found = self.entry(key);
        match found.as_str() {
            "" => Ok(None),
            text => number(text)
                .map(Some)
                .ok_or_else(|| PageError::entry(key, "a number", text)),
        }
    }

    /// Six numbers in the XML element `key`, or in the elements `key0` to `key5`; `None` if these are absent or empty.
    ///
    /// # Errors
    /// [`PageError::Entry`] for a text that is not six numbers.
    pub(super) fn six(&self, key: &'static str) -> Result<Option<[f64; 6]>, PageError> {
        let mut found = self.entry(key);
        if found.is_empty() {
            let parts: Vec<String> = (0..6).map(|at| self.entry(&format!("{key}{at}"))).collect();
            found = parts.join(" ");
        }
        let found = found.trim();
        if found.is_empty() {
            return Ok(None);
        }
        let parts = found.split(|letter: char| letter.is_whitespace() || ";,".contains(letter));
        let numbers: Option<Vec<f64>> = parts.filter(|part| !part.is_empty()).map(number).collect();
        let six = numbers.and_then(|numbers| <[f64; 6]>::try_from(numbers).ok());
        six.map(Some)
            .ok_or_else(|| PageError::entry(key, "six numbers with `;` between them", found))
    }
}

/// Parses a finite number with a decimal point; `None` for any other text.
pub(super) fn number(text: &str) -> Option<f64> {
    text.parse().ok().filter(|number: &f64| number.is_finite())
}

/// Decodes a configuration page as UTF-8, or as Latin-1 if the page is not valid UTF-8. Older boxes send Latin-1.
fn text(page: Vec<u8>) -> String {
    let latin = |page: std::string::FromUtf8Error| {
        let bytes = page.into_bytes();
        bytes.into_iter().map(char::from).collect()
    };
    String::from_utf8(page).unwrap_or_else(latin)
}

/// Decodes character references, the named entities of XML, `&middot;` and `&deg;`.
fn decoded(text: &str) -> String {
    let mut decoded = String::with_capacity(text.len());
    let mut rest = text;
    while let Some((before, behind)) = rest.split_once('&') {
        decoded.push_str(before);
        let entity = behind.split_once(';');
        match entity.and_then(|(name, after)| Some((character(name)?, after))) {
            Some((character, after)) => {
                decoded.push(character);
                rest = after;
            }
            None => {
                decoded.push('&');
                rest = behind;
            }
        }
    }
    decoded.push_str(rest);
    decoded
}

fn character(entity: &str) -> Option<char> {
    match entity {
        "amp" => Some('&'),
        "lt" => Some('<'),
        "gt" => Some('>'),
        "quot" => Some('"'),
        "apos" => Some('\''),
        "middot" => Some('·'),
        "deg" => Some('°'),
        _ => {
            let number = entity.strip_prefix('#')?;
            let code = match number.strip_prefix(['x', 'X']) {
                Some(digits) => u32::from_str_radix(digits, 16),
                None => number.parse(),
            };
            char::from_u32(code.ok()?)
        }
    }
}

/// Phrase of an error message about the entry `key` of the configuration page. `found` is empty if the page lacks the entry.
fn stated(key: &str, found: &str) -> String {
    match found {
        "" => format!("{PAGE} has no `{key}`"),
        found => format!("`{key}` in {PAGE} is `{}`", shown(found)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn page(body: &str) -> Page {
        Page::whole(format!(
            "HTTP/1.0 200 OK\r\n\r\n<?xml version=\"1.0\"?><netft>{body}</netft>"
        ))
        .expect("a whole page")
    }

    #[test]
    fn a_page_that_is_cut_off_is_none_wherever_it_ends() {
        let whole =
            "HTTP/1.0 200 OK\r\n\r\n<?xml version=\"1.0\"?><netft><cfgcpf>1</cfgcpf></netft>";
        assert!(Page::whole(whole.to_owned()).is_ok());
        for length in 0..whole.len() {
            let error = Page::whole(whole[..length].to_owned()).expect_err("cut off");
            assert_eq!(error.kind(), ErrorKind::Protocol, "{length} bytes");
            assert!(error.to_string().contains("incomplete"), "{error}");
        }
    }

    #[test]
    fn entities_and_bytes_of_latin_1_are_letters() {
        let page =
            page("<a>N&#183;m</a><b>N&#xb7;m</b><c>N&middot;m</c><d>&lt;A&amp;B&gt; &x; &</d>");
        for key in ["a", "b", "c"] {
            assert_eq!(page.entry(key), "N·m", "{key}");
        }
        assert_eq!(page.entry("d"), "<A&B> &x; &");
        assert_eq!(text(b"N\xb7m".to_vec()), "N·m");
        assert_eq!(text("N·m °".as_bytes().to_vec()), "N·m °");
    }

    #[test]
    fn six_numbers_stand_in_one_entry_or_in_six() {
        let expected = Some([0.0, 0.5, -1.0, 90.0, 0.0, 45.0]);
        for body in [
            "<f>0;0.5;-1;90;0;45</f>",
            "<f> 0, 0.5, -1, 90, 0, 45 </f>",
            "<f0>0</f0><f1>0.5</f1><f2>-1</f2><f3>90</f3><f4>0</f4><f5>45</f5>",
        ] {
            assert_eq!(page(body).six("f").expect("six"), expected, "{body}");
        }
        assert_eq!(page("").six("f").expect("none"), None);
        for body in [
            "<f>0;0;0</f>",
            "<f>0,5;0,0;0,0;90,0;0,0;45,0</f>",
            "<f>0;0;0;nan;0;0</f>",
            "<f3>90</f3>",
            "<f>Gradé</f>",
        ] {
            let error = page(body).six("f").expect_err(body).to_string();
            assert!(error.contains("`f` in /netftapi2.xml"), "{error}");
        }
    }
}
