//! Sensors by name or alias.

use super::entry::Sensor;
use super::{all, hint};
use crate::names::listed;

/// Reason why a name does not identify an entry of the catalogue.
///
/// ```
/// use taceva_report::catalogue::{NameError, named};
/// assert!(matches!(named("banana"), Err(NameError::Unknown { .. })));
/// ```
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum NameError {
    /// No entry has this name or alias.
    #[error("no such name in the catalogue; {hint}")]
    Unknown {
        /// The most similar name, or the command that lists all.
        hint: String,
    },
    /// Several entries have the alias.
    #[error("several entries of the catalogue have this alias: {}; give one of these names", quoted(.names))]
    Ambiguous {
        /// Names of these entries.
        names: Vec<String>,
    },
}

fn quoted(names: &[String]) -> String {
    let names: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    listed(&names)
}

/// Entry called `name`, or the only entry with that alias; ignores case.
///
/// # Errors
/// [`NameError`] for an unknown name, and for an alias of several entries.
///
/// ```
/// let sensor = taceva_report::catalogue::named("digit 360")?;
/// assert_eq!(sensor.name, "Digit 360");
/// # Ok::<(), taceva_report::catalogue::NameError>(())
/// ```
pub fn named(name: &str) -> Result<Sensor, NameError> {
    of(all(), name)
}

pub(super) fn of(mut sensors: Vec<Sensor>, name: &str) -> Result<Sensor, NameError> {
    let wanted = name.to_lowercase();
    let is_wanted = |own: &String| own.to_lowercase() == wanted;
    if let Some(at) = sensors.iter().position(|sensor| is_wanted(&sensor.name)) {
        return Ok(sensors.swap_remove(at));
    }
    sensors.retain(|sensor| sensor.aliases.iter().any(is_wanted));
    if sensors.len() > 1 {
        let names = sensors.into_iter().map(|sensor| sensor.name);
        return Err(NameError::Ambiguous {
            names: names.collect(),
        });
    }
    let unknown = || NameError::Unknown { hint: hint(name) };
    sensors.pop().ok_or_else(unknown)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    fn entry(name: &str, aliases: &str) -> Sensor {
        let text = format!(
            "catalogue_version = 1\nname = \"{name}\"\naliases = [{aliases}]\nkind = \"sensor\"\nmechanism = []\n"
        );
        Sensor::read("x.toml", &text).expect("an entry")
    }

    fn two() -> Vec<Sensor> {
        vec![
            entry("Gel 1", "\"Gel\", \"first gel\""),
            entry("Gel 2", "\"gel\", \"Gel 1\""),
        ]
    }

    #[test]
    fn a_name_with_two_meanings_is_refused_with_both_candidates() {
        let error = of(two(), "GEL").expect_err("two entries have it");
        assert_eq!(
            error.to_string(),
            "several entries of the catalogue have this alias: `Gel 1` and `Gel 2`; give one of these names"
        );
    }

    #[test]
    fn a_name_stands_before_an_alias_and_an_alias_of_one_entry_finds_it() {
        assert_eq!(of(two(), "gel 1").expect("its name").name, "Gel 1");
        assert_eq!(of(two(), "First Gel").expect("its alias").name, "Gel 1");
    }

    #[test]
    fn names_in_common_use_find_their_entries() {
        for (name, expected) in [
            ("GelSight Mini", "GelSight"),
            ("DIGIT 360", "Digit 360"),
            ("BRL TacTip", "TacTip"),
            ("TacTip family", "TacTip"),
            ("DenseTact 2.0", "DenseTac 2.0"),
            ("digit pinki", "DIGIT Pinki"),
        ] {
            assert_eq!(named(name).expect(name).name, expected);
        }
    }

    #[test]
    fn no_alias_of_an_entry_is_the_name_of_another_or_stands_in_it_twice() {
        let names: BTreeSet<String> = all()
            .iter()
            .map(|entry| entry.name.to_lowercase())
            .collect();
        for entry in all() {
            let aliases: BTreeSet<String> = entry
                .aliases
                .iter()
                .map(|alias| alias.to_lowercase())
                .collect();
            assert_eq!(aliases.len(), entry.aliases.len(), "{}", entry.name);
            assert!(aliases.is_disjoint(&names), "{}: {aliases:?}", entry.name);
        }
    }
}
