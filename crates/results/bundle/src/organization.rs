//! Organization behind a bundle.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use taceva_core::shown;

use crate::author::is_name;

/// Longest address, in bytes.
const MOST_ADDRESS: usize = 200;

/// Organization of the authors of a bundle.
///
/// ```
/// use taceva_bundle::Organization;
/// let own: Organization = "Touch Lab <https://touch.example>".parse()?;
/// assert_eq!((own.name.as_str(), own.url.as_str()), ("Touch Lab", "https://touch.example"));
/// assert!("Touch Lab".parse::<Organization>().is_err());
/// # Ok::<(), String>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Organization {
    /// Name of the organization.
    pub name: String,
    /// Address of a page of the organization, which identifies the organization.
    pub url: String,
}

impl FromStr for Organization {
    type Err = String;

    fn from_str(text: &str) -> Result<Organization, String> {
        let refused = || {
            format!(
                "`{}`: expected NAME <URL>, such as Touch Lab <https://touch.example>",
                shown(text)
            )
        };
        let (name, rest) = text.split_once('<').ok_or_else(refused)?;
        let url = rest.trim().strip_suffix('>').ok_or_else(refused)?;
        let own = Organization {
            name: name.trim().to_owned(),
            url: url.to_owned(),
        };
        own.is_right().then_some(own).ok_or_else(refused)
    }
}

impl Organization {
    /// True if name and address can be printed.
    pub(crate) fn is_right(&self) -> bool {
        is_name(&self.name) && is_address(&self.url)
    }
}

impl fmt::Display for Organization {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ({})", self.name, self.url)
    }
}

/// True for a web address without characters that need escaping.
fn is_address(text: &str) -> bool {
    let is_web = ["https://", "http://"].iter().any(|scheme| {
        let rest = text.strip_prefix(scheme);
        rest.is_some_and(|rest| !rest.is_empty())
    });
    let is_plain = |letter: char| letter.is_ascii_graphic() && !"\"<>\\^`{|}".contains(letter);
    is_web && text.len() <= MOST_ADDRESS && text.chars().all(is_plain)
}
