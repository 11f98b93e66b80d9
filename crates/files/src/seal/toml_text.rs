//! TOML text whose last table is a seal over all preceding bytes, including comments.

use crate::seal::canonical::Canonical;
use crate::seal::digest::{PREFIX, digest_of_bytes};
use crate::seal::error::SealError;
use crate::seal::history::{Edit, Opened};
use crate::seal::keys::{self, Keys};

/// First line of the seal.
const SEAL: &str = "[seal]";

/// Seals the TOML text `body` by appending the seal as the last table.
///
/// # Errors
/// [`SealError::Content`] if `body` is not TOML or already has a seal.
pub fn seal(body: &str) -> Result<String, SealError> {
    if split(body).is_some() {
        return Err(content("the file already has a seal"));
    }
    let line = if body.ends_with('\n') { "" } else { "\n" };
    let body = format!("{body}{line}\n");
    let keys = keys::to_line(&keys_of(&body)?);
    let digest = digest_of_bytes(body.as_bytes());
    let keys = toml::Value::String(keys);
    Ok(format!(
        "{body}{SEAL}\ndigest = \"{digest}\"\nkeys = {keys}\n"
    ))
}

/// Checks that every byte of `text` is unchanged since sealing.
///
/// # Errors
/// [`SealError`] if the content was changed (with the key if known), the seal is missing, or the file has only a seal.
pub fn check(text: &str) -> Result<Opened, SealError> {
    let Some((body, seal)) = split(text) else {
        return Err(SealError::Gone);
    };
    let seal = Written::parse(seal)?;
    if body.trim().is_empty() {
        return Err(SealError::Alone);
    }
    let digest = digest_of_bytes(body.as_bytes());
    if digest != seal.digest {
        let is = keys_of(body).map(|keys| keys::from_line(&keys::to_line(&keys)));
        let key = is
            .ok()
            .and_then(|is| keys::first_change(&keys::from_line(&seal.keys), &is));
        return Err(SealError::Changed { key });
    }
    Ok(Opened {
        digest,
        history: history_of(body)?,
    })
}

/// Accepts `text` in its present state: adds a history entry and a valid seal. If `text` has a valid seal, returns it unchanged.
///
/// # Errors
/// [`SealError::Content`] if `text` is not TOML; [`SealError::Alone`] if `text` contains only a seal.
pub fn reseal(text: &str, date: &str, reason: &str) -> Result<String, SealError> {
    let (body, from) = match split(text) {
        None => (text, "unsealed".to_owned()),
        Some((body, _)) if body.trim().is_empty() => return Err(SealError::Alone),
        Some((body, seal)) => match Written::parse(seal) {
            Ok(seal) if seal.digest == digest_of_bytes(body.as_bytes()) => {
                return Ok(text.to_owned());
            }
            Ok(seal) => (body, seal.digest),
            Err(_) => (body, "unreadable".to_owned()),
        },
    };
    let edit = Edit {
        date: date.to_owned(),
        from,
        to: digest_of_bytes(body.as_bytes()),
        reason: reason.to_owned(),
    };
    let quoted = |text: &str| toml::Value::String(text.to_owned()).to_string();
    let entry = format!(
        "[[history]]\ndate = {}\nfrom = {}\nto = {}\nreason = {}\n",
        quoted(&edit.date),
        quoted(&edit.from),
        quoted(&edit.to),
        quoted(&edit.reason)
    );
    seal(&format!("{}\n\n{entry}", body.trim_end()))
}

/// Splits `text` before its last table; `None` if this table is not the seal.
fn split(text: &str) -> Option<(&str, &str)> {
    let at = match text.rfind(&format!("\n{SEAL}")) {
        Some(before) => before + 1,
        None if text.starts_with(SEAL) => 0,
        None => return None,
    };
    Some(text.split_at(at))
}

/// Contents of the `[seal]` table.
struct Written {
    digest: String,
    keys: String,
}

impl Written {
    fn parse(text: &str) -> Result<Written, SealError> {
        #[derive(serde::Deserialize)]
        #[serde(deny_unknown_fields)]
        struct File {
            seal: Table,
        }
        #[derive(serde::Deserialize)]
        #[serde(deny_unknown_fields)]
        struct Table {
            digest: String,
            keys: String,
        }
        let unreadable = |problem: String| SealError::Unreadable { problem };
        let File { seal } =
            toml::from_str(text).map_err(|error| unreadable(error.message().to_owned()))?;
        if !seal.digest.starts_with(PREFIX) {
            return Err(unreadable(format!(
                "`digest` does not begin with `{PREFIX}`"
            )));
        }
        Ok(Written {
            digest: seal.digest,
            keys: seal.keys,
        })
    }
}

fn keys_of(body: &str) -> Result<Keys, SealError> {
    let value: Canonical = toml::from_str(body).map_err(|error| content(error.message()))?;
    Ok(keys::of(&value))
}

fn history_of(body: &str) -> Result<Vec<Edit>, SealError> {
    #[derive(serde::Deserialize)]
    struct HistoryOnly {
        #[serde(default)]
        history: Vec<Edit>,
    }
    let only: HistoryOnly = toml::from_str(body).map_err(|error| content(error.message()))?;
    Ok(only.history)
}

fn content(problem: &str) -> SealError {
    SealError::Content {
        problem: problem.trim_end().replace('\n', "; "),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BODY: &str = "format = \"1.3\"\nsource = \"synthetic\"\n\n[footprint]\n# measured\nradius_mm = 5.0\n\n[[channels]]\nname = \"Fz\"\n";

    #[test]
    fn an_edit_is_noticed_and_its_key_named() {
        let sealed = seal(BODY).expect("TOML");
        assert!(check(&sealed).is_ok());
        for (from, to, key) in [
            ("5.0", "4.0", "`footprint.radius_mm`"),
            ("synthetic", "recorded", "`source`"),
            ("\"Fz\"", "\"Fx\"", "`channels[0].name`"),
            ("# measured", "# guessed", "the file"),
        ] {
            let error = check(&sealed.replace(from, to)).expect_err(to);
            let error = error.to_string();
            assert!(error.starts_with(&format!("{key} was changed")), "{error}");
        }
    }

    #[test]
    fn a_seal_that_is_gone_alone_or_unreadable_is_refused() {
        let sealed = seal(BODY).expect("TOML");
        assert!(matches!(check(BODY), Err(SealError::Gone)));
        let (_, alone) = split(&sealed).expect("sealed");
        assert!(matches!(check(alone), Err(SealError::Alone)));
        let torn = sealed.replace("digest =", "dogest =");
        assert!(matches!(check(&torn), Err(SealError::Unreadable { .. })));
        let more = format!("{sealed}more = 1\n");
        assert!(matches!(check(&more), Err(SealError::Unreadable { .. })));
    }

    #[test]
    fn every_flip_of_a_bit_is_noticed() {
        let sealed = seal(BODY).expect("TOML");
        let (body, _) = split(&sealed).expect("sealed");
        for at in 0..body.len() {
            for bit in 0..8 {
                let mut bytes = sealed.clone().into_bytes();
                bytes[at] ^= 1 << bit;
                if let Ok(text) = String::from_utf8(bytes) {
                    assert!(check(&text).is_err(), "byte {at}, bit {bit}");
                }
            }
        }
    }

    #[test]
    fn an_accepted_edit_is_listed_and_sealed() {
        let edited = seal(BODY).expect("TOML").replace("5.0", "4.0");
        let accepted = reseal(&edited, "2026-11-22", "measured \"again\"").expect("accepted");
        let opened = check(&accepted).expect("holds");
        assert_eq!(opened.history.len(), 1);
        assert_eq!(opened.history[0].reason, "measured \"again\"");
        assert!(accepted.contains("# measured"));
        assert_eq!(
            reseal(&accepted, "2026-11-23", "nothing").expect("holds"),
            accepted
        );
        let forged = accepted.replace("again", "never");
        assert!(check(&forged).is_err());
    }
}
