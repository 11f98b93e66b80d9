//! Needs granted to a device: the needs that its manifest declares for its arguments and the user allows. Also the command that allows the other
//! needs.

use std::collections::BTreeSet;
use std::error::Error;
use std::fmt;
use std::net::{IpAddr, ToSocketAddrs};

use taceva_core::{ArgSpec, Args, DriverError, DriverKey, ErrorKind};

use crate::config::{Delivery, PluginConfig};
use crate::manifest::{DeclaredNeed, Need};
use crate::search::{Place, Plugin};

/// Error message for a device whose arguments name a resource without the user's permission.
pub const NOT_ALLOWED: &str = "its user has not allowed the resources in its arguments";

/// Needs granted to a session.
#[derive(Clone, Debug)]
pub(crate) struct Grant {
    /// Granted needs.
    pub(crate) reached: BTreeSet<Need>,
    /// Declared needs that are not allowed.
    pub(crate) withheld: Withheld,
    /// True if some needs depend on arguments.
    pub(crate) is_bound: bool,
}

impl Grant {
    /// True if the arguments of the device may name a withheld need.
    pub(crate) fn lacks_bound(&self) -> bool {
        self.is_bound && !self.withheld.needs().is_empty()
    }
}

/// Needs that a plugin declares and its user does not allow.
///
/// The displayed text is the command that allows these needs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Withheld {
    plugin: String,
    /// Folder of a plugin that is not installed; `None` for an installed plugin.
    folder: Option<String>,
    needs: BTreeSet<Need>,
    /// True if the manifest of a confined plugin declares no needs. A permission has then no effect.
    asks_for_nothing: bool,
}

/// Remedy for a denied access if the manifest declares no needs.
const ASKS_FOR_NOTHING: &str =
    "a plugin can reach only what `needs` in its plugin.toml lists, and this list is empty";

impl Withheld {
    /// Needs that are not allowed; empty if all are.
    pub fn needs(&self) -> &BTreeSet<Need> {
        &self.needs
    }

    /// Appends the remedy to `why` if `why` is a permission error; `None` otherwise, or without a remedy.
    pub fn explain(&self, why: &str) -> Option<String> {
        let is_refusal = [
            "permission denied",
            "permission-denied",
            "operation not permitted",
            "(os error 1)",
            "(os error 13)",
            "eacces",
            "eperm",
        ];
        let folded = why.to_lowercase();
        let is_refused = is_refusal.iter().any(|words| folded.contains(words));
        if !is_refused {
            return None;
        }
        self.remedy().map(|remedy| format!("{why}; {remedy}"))
    }

    /// Remedy for a permission error: the command that allows the needs, or a hint if the manifest of a confined plugin declares none. `None` if
    /// every need is allowed.
    fn remedy(&self) -> Option<String> {
        match (self.needs.is_empty(), self.asks_for_nothing) {
            (false, _) => Some(self.to_string()),
            (true, true) => Some(ASKS_FOR_NOTHING.to_owned()),
            (true, false) => None,
        }
    }

    /// Appends the remedy to `error` if it is a permission error.
    pub(crate) fn explained(&self, error: DriverError) -> DriverError {
        let why =
            Error::source(&error).map_or_else(|| error.kind().to_string(), ToString::to_string);
        let denied = (error.kind() == ErrorKind::PermissionDenied)
            .then(|| self.remedy())
            .flatten();
        let explained = self.explain(&why);
        let Some(explained) = explained.or(denied.map(|remedy| format!("{why}; {remedy}"))) else {
            return error;
        };
        let fault = error.fault();
        let doing = error.doing().to_owned();
        let again =
            DriverError::new(ErrorKind::PermissionDenied, error.driver(), doing).because(explained);
        match fault {
            Some(fault) => again.with_fault(fault),
            None => again,
        }
    }
}

impl fmt::Display for Withheld {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "allow it: taceva plugin allow {}", self.plugin)?;
        for need in &self.needs {
            write!(f, " {}", word(&need.to_string()))?;
        }
        match &self.folder {
            Some(folder) => write!(f, " --plugin-dir {}", word(folder)),
            None => Ok(()),
        }
    }
}

/// Quotes `text` as one shell word.
fn word(text: &str) -> String {
    let is_plain = |letter: char| letter.is_ascii_alphanumeric() || "/:.,_-+@%".contains(letter);
    if text.chars().all(is_plain) {
        text.to_owned()
    } else {
        format!("'{}'", text.replace('\'', r"'\''"))
    }
}

impl PluginConfig {
    /// Needs granted to `plugin` while the arguments of its device are unknown.
    pub(crate) fn grant(&self, plugin: &Plugin) -> Grant {
        let mut grant = self.granted(
            plugin,
            plugin.manifest.needs.iter().filter_map(DeclaredNeed::fixed),
        );
        grant.reached = self.allowed(plugin);
        grant
    }

    /// Needs granted to a device of `plugin` that is opened with `args`.
    ///
    /// # Errors
    /// [`DriverError`] of `driver` for an argument that is not a valid need.
    pub(crate) fn grant_for(
        &self,
        plugin: &Plugin,
        driver: &DriverKey,
        args: &Args,
    ) -> Result<Grant, DriverError> {
        let refused = |error| {
            DriverError::new(ErrorKind::InvalidArgument, driver, "open the device").because(error)
        };
        let mut needs = Vec::new();
        for declared in &plugin.manifest.needs {
            needs.extend(declared.bound_to(args).map_err(refused)?);
        }
        let is_bound = plugin
            .manifest
            .needs
            .iter()
            .any(|declared| declared.fixed().is_none());
        let grant = self.granted(plugin, needs);
        Ok(Grant { is_bound, ..grant })
    }

    fn granted(&self, plugin: &Plugin, needs: impl IntoIterator<Item = Need>) -> Grant {
        let (mut reached, mut withheld) = (BTreeSet::new(), BTreeSet::new());
        let allowed = self.allow.get(plugin.id()).cloned().unwrap_or_default();
        for need in needs {
            let given = need.given_by(&allowed);
            if given.is_empty() {
                withheld.insert(need);
            }
            reached.extend(given);
        }
        if self.delivery(plugin) == Delivery::InProcess {
            // A trusted plugin has no restrictions.
            withheld.clear();
        }
        let is_confined = self.delivery(plugin) != Delivery::InProcess;
        let is_installed = matches!(
            plugin.place,
            Place::User | Place::System | Place::Environment
        );
        let folder = plugin.folder.display().to_string();
        Grant {
            reached,
            withheld: Withheld {
                plugin: plugin.id().to_string(),
                folder: (!is_installed).then_some(folder),
                needs: withheld,
                asks_for_nothing: is_confined && plugin.manifest.needs.is_empty(),
            },
            is_bound: false,
        }
    }
}

/// Replaces host names in `args` by addresses if a need is bound to them, because a confined plugin cannot resolve names.
///
/// # Errors
/// [`DriverError`] of `driver` for a name that cannot be resolved.
pub(crate) fn resolved(
    plugin: &Plugin,
    driver: &DriverKey,
    specs: &[ArgSpec],
    args: &Args,
) -> Result<Args, DriverError> {
    let mut given: Vec<(String, String)> = specs
        .iter()
        .filter_map(|spec| Some((spec.key.clone(), args.get(&spec.key)?.to_string())))
        .collect();
    let mut is_changed = false;
    for need in &plugin.manifest.needs {
        let Some(key) = need.host_argument() else {
            continue;
        };
        let Some((_, name)) = given.iter_mut().find(|(other, _)| other == key) else {
            continue;
        };
        if name.parse::<IpAddr>().is_ok() {
            continue;
        }
        let failed = |why: String| {
            let why = format!(
                "`{key}`: cannot resolve the host name `{}`: {why}",
                taceva_core::shown(name)
            );
            DriverError::new(ErrorKind::NotFound, driver, "open the device").because(why)
        };
        let addresses = (name.as_str(), 0).to_socket_addrs();
        let mut addresses: Vec<IpAddr> = addresses
            .map_err(|error| failed(error.to_string()))?
            .map(|address| address.ip())
            .collect();
        // IPv4 first: laboratory devices with both kinds of address answer on it.
        addresses.sort_by_key(IpAddr::is_ipv6);
        let first = addresses
            .first()
            .ok_or_else(|| failed("no address found".to_owned()))?;
        *name = first.to_string();
        is_changed = true;
    }
    if !is_changed {
        return Ok(args.clone());
    }
    Args::from_pairs(specs, given).map_err(|error| {
        DriverError::new(ErrorKind::InvalidArgument, driver, "open the device").because(error)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn withheld(needs: &[&str]) -> Withheld {
        Withheld {
            plugin: "org.example.arm".to_owned(),
            folder: None,
            needs: needs
                .iter()
                .map(|need| need.parse().expect("a need"))
                .collect(),
            asks_for_nothing: false,
        }
    }

    #[test]
    fn where_the_manifest_asks_for_nothing_a_want_of_permission_says_so() {
        let mut nothing = withheld(&[]);
        nothing.asks_for_nothing = true;
        let refused = std::io::Error::from_raw_os_error(libc::EPERM).to_string();
        let explained = nothing.explain(&refused).expect("it is");
        assert!(explained.ends_with(ASKS_FOR_NOTHING), "{explained}");
        assert_eq!(nothing.explain("no such file (os error 2)"), None);
    }

    #[test]
    fn the_line_is_one_that_a_shell_takes() {
        let mut withheld = withheld(&["tcp:10.0.0.5:502", "serial:/dev/ttyUSB*"]);
        withheld.folder = Some("/opt/a b/it's".to_owned());
        assert_eq!(
            withheld.to_string(),
            r"allow it: taceva plugin allow org.example.arm 'serial:/dev/ttyUSB*' tcp:10.0.0.5:502 --plugin-dir '/opt/a b/it'\''s'"
        );
    }

    #[test]
    fn only_a_want_of_permission_is_explained_and_only_where_something_is_withheld() {
        let some = withheld(&["usb"]);
        let refused = std::io::Error::from_raw_os_error(libc::EACCES).to_string();
        let explained = some.explain(&refused).expect("it is");
        assert!(explained.ends_with("; allow it: taceva plugin allow org.example.arm usb"));
        assert_eq!(some.explain("no such file (os error 2)"), None);
        assert_eq!(some.explain("broken (os error 111)"), None);
        assert_eq!(withheld(&[]).explain(&refused), None);
        let key = DriverKey::fixed("org.example.arm/arm");
        let denied = || DriverError::new(ErrorKind::PermissionDenied, &key, "open the arm");
        assert!(some.explained(denied()).to_string().contains("allow it: "));
        let other = DriverError::new(ErrorKind::Timeout, &key, "open the arm");
        assert_eq!(
            some.explained(other).to_string(),
            "org.example.arm/arm: cannot open the arm: timeout"
        );
        assert!(
            !withheld(&[])
                .explained(denied())
                .to_string()
                .contains("allow it")
        );
    }
}
