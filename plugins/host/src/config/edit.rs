//! Edits the permissions in the text of the user's settings. Comments and order are kept.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use serde::Deserialize;
use toml::Spanned;

use super::PluginConfig;
use crate::id::PluginId;
use crate::manifest::{ManifestError, Need};

/// The header of the table of permissions.
const HEADER: &str = "[plugins.allow]";

/// Positions of the permissions in the text.
#[derive(Default, Deserialize)]
struct Places {
    #[serde(default)]
    plugins: PluginPlaces,
}

#[derive(Default, Deserialize)]
struct PluginPlaces {
    #[serde(default)]
    allow: BTreeMap<String, Spanned<Vec<Spanned<String>>>>,
}

impl PluginConfig {
    /// Edits the settings `text` so that the plugin `id` may reach exactly `needs`.
    ///
    /// ```
    /// use taceva_host::PluginConfig;
    /// let id = "org.example.digit".parse()?;
    /// let text = "# of this machine\n[plugins.allow]\n";
    /// let edited = PluginConfig::edited(text, &id, &["usb".parse()?].into())?;
    /// assert_eq!(edited, "# of this machine\n[plugins.allow]\n\"org.example.digit\" = [\"usb\"]\n");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`ManifestError`] if the settings have a mistake or cannot be edited. If they cannot be edited, the message contains the line to write by
    /// hand.
    pub fn edited(
        text: &str,
        id: &PluginId,
        needs: &BTreeSet<Need>,
    ) -> Result<String, ManifestError> {
        let mut expected = PluginConfig::parse(text)?;
        let places: Places =
            toml::from_str(text).map_err(|error| ManifestError::of_parser(text, &error))?;
        let allow = &places.plugins.allow;
        let edited = match allow.get(id.as_str()) {
            Some(list) => with_list(text, list, needs),
            None => with_line(text, id, needs, allow),
        };
        expected.allow.insert(id.clone(), needs.clone());
        // Returns the edited text only if it parses to the intended settings.
        if PluginConfig::parse(&edited).ok().as_ref() == Some(&expected) {
            return Ok(edited);
        }
        let line = line(id, needs);
        Err(ManifestError::whole(format!(
            "the permissions are not a table `{HEADER}`, so they cannot be edited; add this line by hand: {}",
            line.trim_end()
        )))
    }
}

/// Line with the needs of a plugin in the table of permissions.
fn line(id: &PluginId, needs: &BTreeSet<Need>) -> String {
    let needs: Vec<String> = needs.iter().map(quoted).collect();
    format!("\"{id}\" = [{}]\n", needs.join(", "))
}

fn quoted(need: &Need) -> String {
    toml::Value::String(need.to_string()).to_string()
}

/// Adds an entry after the last entry of the table of permissions.
fn with_line(
    text: &str,
    id: &PluginId,
    needs: &BTreeSet<Need>,
    allow: &BTreeMap<String, Spanned<Vec<Spanned<String>>>>,
) -> String {
    let line = line(id, needs);
    let last = allow.values().map(|list| list.span().end).max();
    let header = || header_end(text);
    match last.or_else(header) {
        Some(place) => {
            let rest = &text[place..];
            let end = rest
                .find('\n')
                .map_or(text.len(), |newline| place + newline + 1);
            let begin = &text[..end];
            let newline = if begin.ends_with('\n') { "" } else { "\n" };
            format!("{begin}{newline}{line}{}", &text[end..])
        }
        None => {
            let gap = match text {
                "" => "",
                text if text.ends_with('\n') => "\n",
                _ => "\n\n",
            };
            format!("{text}{gap}{HEADER}\n{line}")
        }
    }
}

/// Byte offset after the header of the table of permissions; `None` if there is no such table.
fn header_end(text: &str) -> Option<usize> {
    let mut place = 0;
    for line in text.split_inclusive('\n') {
        let begin = line.split('#').next().unwrap_or_default();
        let name: String = begin
            .chars()
            .filter(|letter| !letter.is_whitespace())
            .collect();
        if name == HEADER {
            return Some(place + begin.trim_end().len());
        }
        place += line.len();
    }
    None
}

/// Edits the list of one plugin: removes needs that are no longer allowed and appends new needs.
fn with_list(text: &str, list: &Spanned<Vec<Spanned<String>>>, needs: &BTreeSet<Need>) -> String {
    let mut edits: Vec<(Range<usize>, String)> = Vec::new();
    let mut written = BTreeSet::new();
    let items = list.get_ref();
    let is_kept = |item: &&Spanned<String>| {
        let need: Result<Need, _> = item.get_ref().parse();
        need.is_ok_and(|need| needs.contains(&need))
    };
    for (number, item) in items.iter().enumerate() {
        if is_kept(&item) {
            written.extend(item.get_ref().parse::<Need>());
            continue;
        }
        edits.push((item.span(), String::new()));
        // Removes one comma too: the comma after the item, or for the last item the comma before it.
        let behind = comma(text, item.span().end);
        let before = || {
            let kept = items[..number].iter().rfind(is_kept)?;
            comma(text, kept.span().end)
        };
        if let Some(place) = behind.or_else(before) {
            edits.push((place..place + 1, String::new()));
        }
    }
    let new: Vec<String> = needs.difference(&written).map(quoted).collect();
    if !new.is_empty() {
        let new = new.join(", ");
        match items.iter().rfind(is_kept) {
            Some(last) => edits.push((last.span().end..last.span().end, format!(", {new}"))),
            None => edits.push((list.span().start + 1..list.span().start + 1, new)),
        }
    }
    edits.sort_by_key(|(range, _)| (range.start, range.end));
    edits.dedup();
    let mut edited = text.to_owned();
    for (range, new) in edits.into_iter().rev() {
        edited.replace_range(range, &new);
    }
    edited
}

/// Byte offset of the next comma after `from`, skipping spaces and comments. `None` if another character comes first.
fn comma(text: &str, from: usize) -> Option<usize> {
    let mut in_comment = false;
    for (place, letter) in text[from..].char_indices() {
        match letter {
            '\n' => in_comment = false,
            _ if in_comment => {}
            '#' => in_comment = true,
            ',' => return Some(from + place),
            letter if letter.is_whitespace() => {}
            _ => return None,
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    fn edited(text: &str, needs: &[&str]) -> Result<String, String> {
        let id = "org.example.arm".parse().expect("an id");
        let needs = needs
            .iter()
            .map(|need| need.parse().expect("a need"))
            .collect();
        PluginConfig::edited(text, &id, &needs).map_err(|error| error.to_string())
    }

    #[test]
    fn what_is_not_about_it_stays_byte_for_byte() {
        let entry = "\"org.example.arm\" = [\"usb\"]\n";
        for (before, after) in [
            ("", ""),
            (
                "[plugins]\nprefer = [\"/opt/a\"] # mine\n\n[plugins.allow]\n",
                "",
            ),
            (
                "[ plugins . allow ] # of the lab\n",
                "\n[plugins]\nprefer = []\n",
            ),
            (
                "[plugins.allow]\n# the eye\n\"org.example.eye\" = [\n  \"hid\",\n] # yes\n",
                "# end\n",
            ),
        ] {
            let text = edited(&format!("{before}{after}"), &["usb"]).expect(before);
            let header = if before.is_empty() {
                "[plugins.allow]\n"
            } else {
                ""
            };
            assert_eq!(text, format!("{before}{header}{entry}{after}"));
        }
        let text = edited("[plugins]\nprefer = []", &["usb"]).expect("no table yet");
        assert_eq!(
            text,
            format!("[plugins]\nprefer = []\n\n[plugins.allow]\n{entry}")
        );
    }

    #[test]
    fn a_list_keeps_its_comments_and_its_order() {
        let list = |list: &str| format!("[plugins.allow]\n\"org.example.arm\" = [{list}]\n");
        for (before, needs, after) in [
            ("", &["usb"][..], "\"usb\""),
            ("\"usb\"", &["usb", "hid"], "\"usb\", \"hid\""),
            ("\"usb\",", &["usb", "hid"], "\"usb\", \"hid\","),
            ("\"usb\", \"hid\"", &["hid"], " \"hid\""),
            ("\"usb\", \"hid\"", &["usb"], "\"usb\" "),
            ("\"usb\", \"hid\"", &[], " "),
            ("\"usb\", \"hid\", \"camera\"", &["usb"], "\"usb\"  "),
            (
                "\n  \"usb\", # a, \"b\"\n  \"hid\", # c\n",
                &["usb", "camera"],
                "\n  \"usb\", \"camera\", # a, \"b\"\n   # c\n",
            ),
            (" # none, yet\n", &["usb"], "\"usb\" # none, yet\n"),
        ] {
            assert_eq!(edited(&list(before), needs), Ok(list(after)), "{before}");
        }
    }

    #[test]
    fn settings_that_cannot_be_edited_are_left_and_the_line_is_said() {
        let error = edited(
            "plugins = { allow = { \"org.example.eye\" = [\"usb\"] } }\n",
            &["hid"],
        );
        let error = error.expect_err("one line");
        assert!(error.contains("\"org.example.arm\" = [\"hid\"]"), "{error}");
        let error = edited("[plugins]\ntrust = 1\n", &["hid"]).expect_err("a mistake");
        assert!(error.starts_with("line 2"), "{error}");
    }
}
