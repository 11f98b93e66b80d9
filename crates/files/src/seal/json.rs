//! JSON text whose last key is a seal over all other values.

use sha2::{Digest as _, Sha256};

use crate::seal::canonical::Canonical;
use crate::seal::digest::text_of;
use crate::seal::entries;
use crate::seal::error::SealError;
use crate::seal::history::{Edit, Opened};
use crate::seal::keys::{self, Keys};

/// Name of the seal's key.
const SEAL: &str = "seal";
/// Key of the accepted edits.
const HISTORY: &str = "history";

/// Seals `text`, a JSON object, by appending the seal as its last key.
///
/// # Errors
/// [`SealError::Content`] if `text` is not a JSON object or already has a seal.
pub fn seal(text: &str) -> Result<String, SealError> {
    seal_with(text, &[])
}

/// Seals `text` like [`seal`], but the seal also covers `attached`, named bytes outside the text.
///
/// # Errors
/// Errors of [`seal`].
pub fn seal_with(text: &str, attached: &[(&str, &[u8])]) -> Result<String, SealError> {
    let parsed = Parsed::of(text, attached)?;
    if parsed.seal.is_some() {
        return Err(content("the file already has a seal".to_owned()));
    }
    with_entries(text, &[(SEAL, seal_entry(&parsed))])
}

/// Checks that the content of `text` equals the sealed content, ignoring spaces and key order.
///
/// # Errors
/// [`SealError`] if the content was changed (with the key if known), the seal is missing, or the file has only a seal.
pub fn check(text: &str) -> Result<Opened, SealError> {
    check_with(text, &[])
}

/// Checks `text` like [`check`], for a file that [`seal_with`] sealed with the bytes `attached`.
///
/// # Errors
/// Errors of [`check`].
pub fn check_with(text: &str, attached: &[(&str, &[u8])]) -> Result<Opened, SealError> {
    let parsed = Parsed::of(text, attached)?;
    let opened = Opened {
        digest: parsed.digest.clone(),
        history: parsed.history.clone(),
    };
    match &parsed.seal {
        None => Err(SealError::Gone),
        Some(_) if parsed.is_alone => Err(SealError::Alone),
        Some((digest, _)) if *digest == parsed.digest => Ok(opened),
        Some((_, line)) => Err(SealError::Changed {
            key: keys::first_change(&keys::from_line(line), &parsed.keys()),
        }),
    }
}

/// Accepts `text` in its present state: adds a history entry and a valid seal, and keeps all other entries with their order and formatting. If `text`
/// has a valid seal, returns it unchanged.
///
/// # Errors
/// [`SealError::Content`] if `text` is not a JSON object; [`SealError::Alone`] if `text` contains only a seal.
pub fn reseal(text: &str, date: &str, reason: &str) -> Result<String, SealError> {
    let parsed = Parsed::of(text, &[])?;
    if parsed.is_alone {
        return Err(SealError::Alone);
    }
    let from = match &parsed.seal {
        Some((digest, _)) if *digest == parsed.digest => return Ok(text.to_owned()),
        Some((digest, _)) => digest.clone(),
        None => "unsealed".to_owned(),
    };
    let mut history = parsed.history.clone();
    history.push(Edit {
        date: date.to_owned(),
        from,
        to: parsed.digest.clone(),
        reason: reason.to_owned(),
    });
    let history = serde_json::to_string(&history).map_err(|error| content(error.to_string()))?;
    let bare = entries::without(text, &[SEAL, HISTORY])?;
    let edited = with_entries(&bare, &[(HISTORY, history)])?;
    Ok(format!("{}\n", seal(&edited)?.trim_end()))
}

/// JSON text after parsing: all values except the seal, the digests computed from them, and the stored seal.
struct Parsed {
    rest: Canonical,
    digest: String,
    attached: Keys,
    seal: Option<(String, String)>,
    history: Vec<Edit>,
    is_alone: bool,
}

impl Parsed {
    fn of(text: &str, attached: &[(&str, &[u8])]) -> Result<Parsed, SealError> {
        let Canonical::Object(mut entries) = Canonical::parse(text).map_err(content)? else {
            return Err(content("expected a JSON object".to_owned()));
        };
        let seal = entries.remove(SEAL).map(seal_of).transpose()?;
        let is_alone = entries.is_empty();
        let history = match entries.contains_key(HISTORY) {
            true => {
                #[derive(serde::Deserialize)]
                struct HistoryOnly {
                    history: Vec<Edit>,
                }
                let only: HistoryOnly =
                    serde_json::from_str(text).map_err(|error| content(error.to_string()))?;
                only.history
            }
            false => Vec::new(),
        };
        let rest = Canonical::Object(entries);
        let mut hasher = Sha256::new();
        hasher.update(b"taceva.seal/1 json");
        hasher.update(rest.digest());
        let mut beside = Keys::new();
        for (name, bytes) in attached {
            let digest: [u8; 32] = Sha256::digest(bytes).into();
            hasher.update((name.len() as u64).to_le_bytes());
            hasher.update(name.as_bytes());
            hasher.update(digest);
            beside.insert(
                (*name).to_owned(),
                crate::seal::digest::hexadecimal(&digest[..4]),
            );
        }
        Ok(Parsed {
            rest,
            digest: text_of(&hasher.finalize()),
            attached: beside,
            seal,
            history,
            is_alone,
        })
    }

    /// Digests of the values by key. Separators in names are percent-encoded.
    fn keys(&self) -> Keys {
        let mut keys = keys::of(&self.rest);
        keys.extend(self.attached.clone());
        keys::from_line(&keys::to_line(&keys))
    }
}

/// Parts of a seal: the digest of the content, and the digests of the values by key, encoded as one line.
fn seal_of(seal: Canonical) -> Result<(String, String), SealError> {
    let unreadable = |problem: &str| SealError::Unreadable {
        problem: problem.to_owned(),
    };
    let Canonical::Object(mut entries) = seal else {
        return Err(unreadable("no object"));
    };
    let Some(Canonical::Text(digest)) = entries.remove("digest") else {
        return Err(unreadable("no `digest`"));
    };
    match entries.remove("keys") {
        Some(Canonical::Text(line)) => Ok((digest, line)),
        _ => Err(unreadable("no `keys`")),
    }
}

fn seal_entry(parsed: &Parsed) -> String {
    let keys = parsed.keys();
    let line = serde_json::Value::String(keys::to_line(&keys));
    format!("{{\"digest\": \"{}\", \"keys\": {line}}}", parsed.digest)
}

/// Inserts entries at the end of the object `text`, without reformatting the rest.
fn with_entries(text: &str, entries: &[(&str, String)]) -> Result<String, SealError> {
    let no_object = || content("expected a JSON object".to_owned());
    let (head, tail) = text.rsplit_once('}').ok_or_else(no_object)?;
    let is_pretty = head.ends_with('\n');
    let head = head.trim_end();
    let (comma, space) = match (head.ends_with('{'), is_pretty) {
        (true, _) => ("", ""),
        (false, true) => (",", "\n  "),
        (false, false) => (",", ""),
    };
    let entries: Vec<String> = entries
        .iter()
        .map(|(key, value)| match is_pretty {
            true => format!("\"{key}\": {value}"),
            false => format!("\"{key}\":{value}"),
        })
        .collect();
    let end = if is_pretty { "\n}" } else { "}" };
    let between = format!(",{space}");
    Ok(format!(
        "{head}{comma}{space}{}{end}{tail}",
        entries.join(&between)
    ))
}

fn content(problem: String) -> SealError {
    SealError::Content { problem }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "{\n  \"schema\": \"x/1.2\",\n  \"metrics\": {\n    \"mae\": {\n      \"Fz\": {\n        \"value\": 0.5\n      }\n    }\n  },\n  \"n\": 2\n}\n";

    #[test]
    fn one_digit_is_noticed_and_its_key_named_whatever_the_form() {
        let compact: serde_json::Value = serde_json::from_str(TEXT).expect("JSON");
        for text in [TEXT.to_owned(), compact.to_string()] {
            let sealed = seal(&text).expect("an object");
            assert!(check(&sealed).is_ok());
            let changed = sealed.replace("0.5", "0.25");
            let error = check(&changed).expect_err("changed").to_string();
            assert!(error.starts_with("`metrics.mae.Fz` was changed"), "{error}");
            let value: serde_json::Value = serde_json::from_str(&sealed).expect("JSON");
            let rewritten = serde_json::to_string_pretty(&value).expect("JSON");
            assert!(check(&rewritten).is_ok(), "only the form is another");
        }
    }

    #[test]
    fn a_seal_that_is_gone_alone_or_unreadable_is_refused() {
        assert!(matches!(check(TEXT), Err(SealError::Gone)));
        let sealed = seal(TEXT).expect("an object");
        let at = sealed.find("\"seal\"").expect("a seal");
        let alone = format!("{{{}", &sealed[at..]);
        assert!(matches!(check(&alone), Err(SealError::Alone)));
        let torn = sealed.replace("\"digest\"", "\"dogest\"");
        assert!(matches!(check(&torn), Err(SealError::Unreadable { .. })));
    }

    #[test]
    fn what_is_attached_is_under_the_seal() {
        let sealed = seal_with("{\"card\":1}", &[("weights", b"abc")]).expect("an object");
        let check = |bytes: &[u8]| check_with(&sealed, &[("weights", bytes)]);
        assert!(check(b"abc").is_ok());
        let error = check(b"abd").expect_err("changed").to_string();
        assert!(error.starts_with("`weights` was changed"), "{error}");
    }

    #[test]
    fn edits_are_listed_one_after_the_other() {
        let first = seal(TEXT).expect("sealed").replace("0.5", "0.25");
        let second = reseal(&first, "2026-11-22", "typed wrongly").expect("accepted");
        let third = reseal(
            &second.replace("\"n\": 2", "\"n\": 3"),
            "2026-11-23",
            "again",
        );
        let third = third.expect("accepted");
        let history = check(&third).expect("holds").history;
        let reasons: Vec<&str> = history.iter().map(|edit| edit.reason.as_str()).collect();
        assert_eq!(reasons, ["typed wrongly", "again"]);
        assert_ne!(history[0].from, history[0].to);
        let changed = third.replace("typed wrongly", "typed rightly");
        assert!(check(&changed).is_err(), "the history is sealed too");
        let (before, _) = third.split_once("  \"history\"").expect("a history");
        let kept = TEXT.replace("0.5", "0.25").replace("\"n\": 2", "\"n\": 3");
        let (kept, _) = kept.rsplit_once("\n}").expect("an object");
        assert_eq!(before, format!("{kept},\n"), "order and form stay");
        let untouched = reseal(&third, "2026-11-24", "for nothing").expect("holds");
        assert_eq!(untouched, third);
    }
}
