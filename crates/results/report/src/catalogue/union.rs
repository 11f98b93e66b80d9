//! Built-in catalogue together with the entries of a folder.

use super::{NameError, Sensor, all, lookup};

impl Sensor {
    /// True if the entry has published facts or numbers. Values from bundles do not count.
    pub fn has_published(&self) -> bool {
        let is_empty = self.results.is_empty()
            && self.prices.is_empty()
            && self.availability.is_empty()
            && self.missing.is_empty()
            && self.reported.is_empty()
            && self.applications.is_empty();
        !is_empty || self.size.is_some() || self.limits.is_some()
    }

    /// True if the entry has values from bundles.
    pub fn has_bundles(&self) -> bool {
        self.all_rows().next().is_some()
    }

    /// True if `name` equals the name or an alias of the entry, apart from case and from characters other than letters and digits. Also true for names with
    /// equal slugs.
    ///
    /// ```
    /// let sensor = taceva_report::catalogue::find("GelSight").expect("there");
    /// assert!(sensor.is_called_like("gelsight-mini") && !sensor.is_called_like("GelSlim"));
    /// assert!(sensor.is_called_like("GelSightMini"));
    /// ```
    pub fn is_called_like(&self, name: &str) -> bool {
        let (wanted, slug) = (letters(name), Sensor::slug_of(name));
        let mut names = std::iter::once(&self.name).chain(&self.aliases);
        names.any(|own| letters(own) == wanted || Sensor::slug_of(own) == slug)
    }

    /// True if `name` equals the name or an alias of the entry, ignoring case.
    pub fn is_called(&self, name: &str) -> bool {
        let wanted = name.to_lowercase();
        let mut names = std::iter::once(&self.name).chain(&self.aliases);
        names.any(|own| own.to_lowercase() == wanted)
    }
}

/// Lower-case letters and digits of a name; the whole name if it has no letters and digits.
fn letters(name: &str) -> String {
    let lower = name.to_lowercase();
    let letters: String = lower.chars().filter(|own| own.is_alphanumeric()).collect();
    if letters.is_empty() { lower } else { letters }
}

/// Merges built-in sensors and `entries`, sorted by name.
///
/// An entry with the name of a built-in sensor adds its values from bundles and its aliases. The built-in sensor keeps its published numbers.
pub fn joined(entries: &[Sensor]) -> Vec<Sensor> {
    let mut sensors = all();
    for entry in entries {
        let Some(at) = sensors.iter().position(|sensor| sensor.name == entry.name) else {
            sensors.push(entry.clone());
            continue;
        };
        let known = &mut sensors[at];
        known.measured.extend(entry.measured.iter().cloned());
        known.unknown.extend(entry.unknown.iter().cloned());
        known.simulated.extend(entry.simulated.iter().cloned());
        for alias in &entry.aliases {
            if !known.is_called(alias) {
                known.aliases.push(alias.clone());
            }
        }
    }
    sensors.sort_by_key(|sensor| sensor.name.to_lowercase());
    sensors
}

/// Entry of `sensors` called `name`, or the only entry with that alias; ignores case.
///
/// # Errors
/// As [`named`](super::named).
pub fn named_among(sensors: &[Sensor], name: &str) -> Result<Sensor, NameError> {
    lookup::of(sensors.to_vec(), name)
}
