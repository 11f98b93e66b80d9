//! Redaction of texts: addresses, serial numbers and absolute paths are replaced by a word.

use std::str::FromStr;

use taceva_core::shown;

/// Word that replaces redacted text.
const REDACTED: &str = "redacted";

/// Kind of word that is redacted in the texts of a bundle.
///
/// ```
/// use taceva_bundle::{Redaction, redacted};
/// let scene = "robot = { driver = \"ur/robot:address=10.0.0.7,serial=X81\" }\nmap = \"/home/user/map.toml\"\n";
/// let (text, words) = redacted(scene, &[Redaction::Hosts, Redaction::Paths]);
/// assert_eq!(
///     text,
///     "robot = { driver = \"ur/robot:address=redacted,serial=X81\" }\nmap = \"redacted\"\n"
/// );
/// assert_eq!(words, 2);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Redaction {
    /// Addresses and names of machines.
    Hosts,
    /// Serial numbers.
    Serials,
    /// Absolute paths.
    Paths,
}

impl FromStr for Redaction {
    type Err = String;

    fn from_str(word: &str) -> Result<Redaction, String> {
        match word {
            "hosts" => Ok(Redaction::Hosts),
            "serials" => Ok(Redaction::Serials),
            "paths" => Ok(Redaction::Paths),
            other => Err(format!(
                "`{}`: expected hosts, serials or paths",
                shown(other)
            )),
        }
    }
}

/// Keys whose value is the address or name of a machine.
const HOST_KEYS: [&str; 6] = ["address", "host", "hostname", "ip", "server", "url"];
/// Keys whose value is a serial number.
const SERIAL_KEYS: [&str; 4] = ["serial", "serial_number", "serial_no", "sn"];
/// Characters that end a word, and a path outside quotes.
const ENDS: &str = " \t\r\n\"',;()[]{}=";

/// Redacts words of the kinds `what` in `text`. Returns the text and the number of redacted words.
pub fn redacted(text: &str, what: &[Redaction]) -> (String, u64) {
    let (mut written, mut count) = (String::with_capacity(text.len()), 0);
    let (mut key, mut quote, mut lists) = (String::new(), None, 0_usize);
    let mut rest = text;
    while let Some(letter) = rest.chars().next() {
        if ENDS.contains(letter) {
            match letter {
                '"' | '\'' if quote.is_none() => quote = Some(letter),
                own if quote == Some(own) => quote = None,
                '\n' if lists > 0 => quote = None,
                '\n' => (quote, key) = (None, String::new()),
                '[' if quote.is_none() => lists += 1,
                ']' if quote.is_none() => lists = lists.saturating_sub(1),
                // All items of a list have the key of the list.
                ',' if quote.is_none() && lists > 0 => {}
                ',' | ';' | '{' => key.clear(),
                _ => {}
            }
            written.push(letter);
            rest = &rest[letter.len_utf8()..];
            continue;
        }
        let end = rest.find(|letter: char| ENDS.contains(letter));
        let word = &rest[..end.unwrap_or(rest.len())];
        let after = rest[word.len()..].trim_start_matches(['"', '\'']);
        if after.trim_start().starts_with('=') {
            // The key of a driver's argument follows the driver's name.
            key = word.rsplit(':').next().unwrap_or(word).to_lowercase();
            written.push_str(word);
            rest = &rest[word.len()..];
            continue;
        }
        let is_wanted = |kind: Redaction| what.contains(&kind);
        let path = path_start(word);
        let word = match path {
            Some(start) => &rest[..start + path_length(&rest[start..], quote)],
            None => word,
        };
        let is_redacted = (is_wanted(Redaction::Paths) && path.is_some())
            || (is_wanted(Redaction::Serials) && is_serial(&key, word))
            || (is_wanted(Redaction::Hosts) && is_host(&key, word));
        count += u64::from(is_redacted);
        written.push_str(if is_redacted { REDACTED } else { word });
        rest = &rest[word.len()..];
    }
    (written, count)
}

/// Start of the absolute path in a word: at its beginning, or after a character such as `:` or `@`; `None` without a path.
fn path_start(word: &str) -> Option<usize> {
    let marks = word.char_indices();
    let marks = marks.filter(|(_, own)| ":`<>|@".contains(*own));
    let mut behind = marks.map(|(at, own)| at + own.len_utf8());
    if is_path(word) {
        return Some(0);
    }
    // `//` after a mark belongs to an address.
    behind.find(|at| is_path(&word[*at..]) && !word[*at..].starts_with("//"))
}

/// True if a word begins an absolute path.
fn is_path(word: &str) -> bool {
    let mut letters = word.chars();
    let drive = letters
        .next()
        .is_some_and(|first| first.is_ascii_alphabetic())
        && letters.next() == Some(':')
        && letters.next().is_some_and(|third| "/\\".contains(third));
    let is_rooted = word.starts_with('/') && word.len() > 1;
    let beginnings = ["~/", "\\\\", "file:"];
    drive || is_rooted || beginnings.iter().any(|own| word.starts_with(own))
}

/// Length of the path at the start of `rest`: up to the closing quote, a comma or a line end inside quotes, else to the end of the word.
fn path_length(rest: &str, quote: Option<char>) -> usize {
    let ends = |letter: char| match quote {
        Some(quote) => letter == quote || letter == ',' || letter == '\n',
        None => ENDS.contains(letter),
    };
    rest.find(ends).unwrap_or(rest.len())
}

fn is_serial(key: &str, word: &str) -> bool {
    SERIAL_KEYS.contains(&key) || word.contains("/serial/by-id/")
}

fn is_host(key: &str, word: &str) -> bool {
    let is_local = word.ends_with(".local") || word.contains('@');
    HOST_KEYS.contains(&key) || word.contains("://") || is_local || is_address(word)
}

/// True if a part of the word is an IPv4, IPv6 or MAC address.
fn is_address(word: &str) -> bool {
    let of_four = |part: &str| part.parse::<std::net::Ipv4Addr>().is_ok();
    // The network interface follows `%`.
    let six = word.split('%').next().unwrap_or(word);
    let is_six = six.matches(':').count() > 1 && six.parse::<std::net::Ipv6Addr>().is_ok();
    let octets: Vec<&str> = word.split([':', '-']).collect();
    let is_octet = |octet: &&str| octet.len() == 2 && u8::from_str_radix(octet, 16).is_ok();
    let is_interface = octets.len() == 6 && octets.iter().all(is_octet);
    is_six || is_interface || word.split([':', '/']).any(of_four)
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [Redaction; 3] = [Redaction::Hosts, Redaction::Serials, Redaction::Paths];

    #[test]
    fn addresses_serials_and_absolute_paths_are_redacted_and_numbers_stay() {
        for (text, expected) in [
            ("a = \"10.1.2.3:50000\"", "a = \"redacted\""),
            ("a = \"tcp://lab-pc:3000\"", "a = \"redacted\""),
            ("host = \"lab-pc\"", "host = \"redacted\""),
            ("mac = \"00:1b:63:84:45:e6\"", "mac = \"redacted\""),
            ("v6 = \"fe80::1\"", "v6 = \"redacted\""),
            ("serial = \"0042\"", "serial = \"redacted\""),
            ("out = '/home/user/a b/x'", "out = 'redacted'"),
            ("out = \"C:\\\\lab\\\\x\"", "out = \"redacted\""),
            ("# see /home/user/notes here", "# see redacted here"),
            ("# see `/home/user/notes`", "# see redacted"),
            ("port = \"serial:/dev/ttyUSB0\"", "port = \"redacted\""),
            ("v6 = \"fe80::1%eth0\"", "v6 = \"redacted\""),
            ("\"host\" = \"lab-pc\"", "\"host\" = \"redacted\""),
            ("at = \"//server/share\"", "at = \"redacted\""),
            ("at = \"file:///home/user/x y\"", "at = \"redacted\""),
            ("unc = \"\\\\\\\\server\\\\share\"", "unc = \"redacted\""),
            (
                "unit = \"N/mm\"\nrate = \"1/s\"",
                "unit = \"N/mm\"\nrate = \"1/s\"",
            ),
            ("size = 0.5\nname = \"a/b\"", "size = 0.5\nname = \"a/b\""),
        ] {
            let (found, words) = redacted(text, &ALL);
            assert_eq!(found, expected);
            assert_eq!(words, u64::from(text != expected), "{text}");
        }
    }

    #[test]
    fn every_host_of_a_list_is_redacted() {
        let text = "host = [\"pc-1\",\n  \"pc-2\"]\nname = \"x\"\n";
        let expected = "host = [\"redacted\",\n  \"redacted\"]\nname = \"x\"\n";
        assert_eq!(
            redacted(text, &[Redaction::Hosts]),
            (expected.to_owned(), 2)
        );
    }

    #[test]
    fn only_what_is_asked_for_is_redacted() {
        let text = "serial = \"7\"\nhost = \"pc\"\nat = \"/x/y\"\n";
        assert_eq!(redacted(text, &[]), (text.to_owned(), 0));
        let (found, words) = redacted(text, &[Redaction::Serials]);
        assert_eq!(
            (found.lines().next(), words),
            (Some("serial = \"redacted\""), 1)
        );
        assert!(found.ends_with("host = \"pc\"\nat = \"/x/y\"\n"));
    }
}
