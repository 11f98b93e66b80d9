//! Authors of a bundle.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use taceva_core::shown;

/// Longest name of an author or an organization, in bytes.
pub(crate) const MOST_NAME: usize = 200;

/// Author of a bundle.
///
/// ```
/// use taceva_bundle::Author;
/// let author: Author = "Josiah Carberry <0000-0002-1825-0097>".parse()?;
/// assert_eq!(author.orcid.as_deref(), Some("0000-0002-1825-0097"));
/// assert!("Josiah Carberry <0000-0002-1825-0098>".parse::<Author>().is_err());
/// # Ok::<(), String>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Author {
    /// Name of the author.
    pub name: String,
    /// Identifier of the person at orcid.org, with its check digit; `None` if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub orcid: Option<String>,
}

impl FromStr for Author {
    type Err = String;

    fn from_str(text: &str) -> Result<Author, String> {
        let (name, orcid) = match text.split_once('<') {
            None => (text, None),
            Some((name, rest)) => {
                let orcid = rest.trim().strip_suffix('>').unwrap_or_default();
                let orcid = orcid.strip_prefix("https://orcid.org/").unwrap_or(orcid);
                if !is_orcid(orcid) {
                    return Err(format!(
                        "`{}`: expected NAME <ORCID>, such as Ada Lovelace <0000-0002-1825-0097>",
                        shown(text)
                    ));
                }
                (name, Some(orcid.to_owned()))
            }
        };
        let name = name.trim();
        if !is_name(name) {
            return Err(format!(
                "`{}`: expected a name of 1 to {MOST_NAME} bytes",
                shown(text)
            ));
        }
        Ok(Author {
            name: name.to_owned(),
            orcid,
        })
    }
}

impl Author {
    /// True if the name is printable and the check digit of the identifier is correct.
    pub(crate) fn is_right(&self) -> bool {
        is_name(&self.name) && self.orcid.as_deref().is_none_or(is_orcid)
    }

    /// URL of the identifier; `None` without an identifier.
    pub(crate) fn address(&self) -> Option<String> {
        let orcid = self.orcid.as_ref()?;
        Some(format!("https://orcid.org/{orcid}"))
    }
}

impl fmt::Display for Author {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.address() {
            Some(address) => write!(f, "{} ({address})", self.name),
            None => f.write_str(&self.name),
        }
    }
}

/// True for a printable name of a person or an organization.
pub(crate) fn is_name(text: &str) -> bool {
    (1..=MOST_NAME).contains(&text.len()) && !text.contains(taceva_core::is_obeyed)
}

/// True for four groups of four digits whose last digit is the check digit of ISO 7064, mod 11-2.
fn is_orcid(text: &str) -> bool {
    let groups: Vec<&str> = text.split('-').collect();
    if !text.is_ascii() || groups.len() != 4 || groups.iter().any(|group| group.len() != 4) {
        return false;
    }
    let digits = groups.concat();
    let (body, check) = digits.split_at(digits.len() - 1);
    let mut total = 0;
    for letter in body.chars() {
        let Some(digit) = letter.to_digit(10) else {
            return false;
        };
        total = (total + digit) * 2 % 11;
    }
    let expected = match (12 - total) % 11 {
        10 => "X".to_owned(),
        digit => digit.to_string(),
    };
    check == expected
}
