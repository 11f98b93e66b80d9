//! Candidate columns for a channel, ranked by how clearly their names state the channel.

use std::fmt;

use taceva_core::{SourceUnit, Unit};

use super::exclusion::{Exclusion, of_words};
use super::words::words;
use crate::unit_suffix::UnitSuffix;

/// Column that may be a channel, or element of the lists in its cells.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Candidate {
    pub(crate) channel: &'static str,
    /// Index of the element in the cell, such as `[2]`; empty for the whole cell.
    pub(crate) index: String,
    pub(crate) reason: Reason,
    /// Unit stated by the name or by the file, with its source.
    pub(crate) unit: Option<(&'static str, UnitSource)>,
    /// True for counts and volts, which need a scale factor to become the channel.
    pub(crate) is_unscaled: bool,
    /// Reason for a gap (`"?"`) in the line of the channel, if only the lab knows whether the channel was measured.
    pub(crate) open: Option<String>,
}

impl Candidate {
    /// Sets the unit that the file states.
    pub(crate) fn take_unit(&mut self, unit: SourceUnit) {
        if kept_unit(self.channel) == Some(unit.unit()) {
            self.unit = Some((unit.symbol(), UnitSource::File));
        }
        self.is_unscaled = matches!(unit.unit(), Unit::Count | Unit::Volt);
    }
}

/// Words that mark numbers without a physical scale.
const UNSCALED: [&str; 5] = ["adc", "count", "counts", "lsb", "raw"];

/// Reason to take a column for a channel; the most certain reason first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Reason {
    /// The column has the name of the channel.
    Name,
    /// The column has the name of the channel with a unit.
    NameWithUnit,
    /// The last part of the name states quantity and axis, with no other word.
    Words,
    /// The name states quantity and axis together with other words: `left_force_z`.
    MoreWords,
    /// The name of the parent states the quantity.
    Parent,
    /// The name states a force without an axis, which is usually the normal force.
    NoAxis,
    /// The name states a wrench or a pose, and the position of the number in it gives the channel.
    Position,
    /// The name states only an axis, or the number of columns suggests the channel.
    Guess,
}

/// Source of a stated unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum UnitSource {
    Name,
    File,
    /// Column name in the form of `paxini-sdk`, which writes counts of 0.1 N.
    PaxiniCounts,
}

impl UnitSource {
    /// Factor from the numbers to the unit, as a map writes it; `None` for 1.
    pub(crate) fn scale(self) -> Option<&'static str> {
        (self == UnitSource::PaxiniCounts).then_some("0.1")
    }
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Reason::Name => "its name",
            Reason::NameWithUnit => "its name and unit",
            Reason::Words => "the words of its name",
            Reason::MoreWords => "a guess: some words of its name",
            Reason::Parent => "the name of its parent",
            Reason::NoAxis => "a guess: a force without an axis is usually the normal force",
            Reason::Position => "a guess: its place among these numbers",
            Reason::Guess => "a guess",
        })
    }
}

impl fmt::Display for UnitSource {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            UnitSource::Name => "unit by its name",
            UnitSource::File => "unit stated by the file",
            UnitSource::PaxiniCounts => "counts of 0.1 N, as paxini-sdk writes them",
        })
    }
}

/// Unit in which the dataset stores a channel; `None` for an unknown channel.
pub(crate) fn kept_unit(channel: &str) -> Option<Unit> {
    match channel.as_bytes().first()? {
        b'F' => Some(Unit::Newton),
        b'T' => Some(Unit::NewtonMillimetre),
        b'P' => Some(Unit::Millimetre),
        _ => None,
    }
}

/// Quantity with components along the axes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Quantity {
    Force,
    Torque,
    Place,
}

impl Quantity {
    const ALL: [Quantity; 3] = [Quantity::Force, Quantity::Torque, Quantity::Place];

    /// The channels along x, y and z.
    pub(super) fn channels(self) -> [&'static str; 3] {
        match self {
            Quantity::Force => ["Fx", "Fy", "Fz"],
            Quantity::Torque => ["Tx", "Ty", "Tz"],
            Quantity::Place => ["Px", "Py", "Pz"],
        }
    }

    /// Words in column names that denote the quantity.
    fn words(self) -> &'static [&'static str] {
        match self {
            Quantity::Force => &["force", "forces", "f", "load", "loadcell"],
            Quantity::Torque => &["torque", "torques", "moment", "moments", "tau"],
            Quantity::Place => &[
                "pos",
                "position",
                "positions",
                "pose",
                "tcp",
                "p",
                "translation",
                "xyz",
                "location",
                "contact",
                "point",
                "cop",
                "indenter",
                "probe",
                "stage",
                "robot",
                "ee",
                "eef",
                "tip",
                "tool",
                "depth",
            ],
        }
    }

    fn of(words: &[String]) -> Option<Quantity> {
        // The name of a torque may contain `force`: `ft_torque`, `force_torque`.
        let has = |quantity: &Quantity| {
            let known = quantity.words();
            words.iter().any(|word| known.contains(&word.as_str()))
        };
        [Quantity::Torque, Quantity::Force, Quantity::Place]
            .into_iter()
            .find(has)
    }
}

/// Words in column names that do not denote a quantity.
const NEUTRAL: [&str; 22] = [
    "sensor",
    "meas",
    "measured",
    "actual",
    "act",
    "gt",
    "truth",
    "true",
    "ft",
    "fts",
    "wrench",
    "ati",
    "contact",
    "normal",
    "end",
    "effector",
    "of",
    "in",
    "observation",
    "data",
    "label",
    "applied",
];

/// Parsed name of a column, or of one number in its cells.
pub(crate) struct Named {
    /// Words of the last part of the name, without its unit.
    own: Vec<String>,
    /// Words of the parent names, the nearest last.
    parents: Vec<String>,
    /// True for a name with digits: `force2`.
    has_digits: bool,
    suffix: Option<UnitSuffix>,
}

/// Axis in a word, with the quantity that is written together with it: `fz`, `posx`.
fn axis_of(word: &str) -> Option<(Option<Quantity>, usize)> {
    let (before, axis) = word.split_at_checked(word.len().checked_sub(1)?)?;
    let axis = ["x", "y", "z"].iter().position(|known| *known == axis)?;
    match before {
        "" => Some((None, axis)),
        "t" | "m" => Some((Some(Quantity::Torque), axis)),
        before => {
            let known = |quantity: &Quantity| quantity.words().contains(&before);
            let found = Quantity::ALL.into_iter().find(known)?;
            Some((Some(found), axis))
        }
    }
}

impl Named {
    pub(crate) fn new(name: &str) -> Named {
        let suffix = UnitSuffix::of(name);
        let base = suffix.as_ref().map_or(name, |suffix| &suffix.base);
        let mut parts: Vec<&str> = base
            .split(['.', '/', ':'])
            .filter(|part| !part.trim().is_empty())
            .collect();
        // A bare position is not a name: `/ft/0`.
        while let [.., _, last] = parts.as_slice()
            && last.bytes().all(|byte| byte.is_ascii_digit())
        {
            parts.pop();
        }
        let own = parts.pop().unwrap_or_default();
        Named {
            has_digits: own.bytes().any(|byte| byte.is_ascii_digit()),
            own: words(own),
            parents: parts.into_iter().flat_map(words).collect(),
            suffix,
        }
    }

    /// Name of the number `element` in the column `column`.
    pub(super) fn within(column: &str, element: &str) -> Named {
        let mut named = Named::new(element);
        let of_column = Named::new(column);
        named.parents = [of_column.parents, of_column.own, named.parents].concat();
        named.suffix = named.suffix.or(of_column.suffix);
        named
    }

    fn axis(&self) -> Option<(Option<Quantity>, usize)> {
        self.own.iter().find_map(|word| axis_of(word))
    }

    /// Reason to exclude the column from every channel, given by its name.
    pub(super) fn exclusion(&self) -> Option<Exclusion> {
        let has_axis = self.axis().is_some();
        // A single letter may be the name of a sensor.
        let parents = self.parents.iter().filter(|word| word.len() > 1);
        let parents: Vec<String> = parents.cloned().collect();
        of_words(&self.own, has_axis).or_else(|| of_words(&parents, true))
    }

    /// Words that describe a column of several numbers: its own words and the words of its parents.
    pub(super) fn quantity_of_several(&self) -> Vec<&str> {
        let own = self.own.iter().chain(&self.parents);
        own.map(String::as_str).collect()
    }

    /// Channel indicated by the name, ignoring exclusions.
    pub(super) fn channel(&self) -> Option<(&'static str, Reason)> {
        let own = Quantity::of(&self.own);
        let parent = || {
            let mut parents = self.parents.iter().rev();
            parents.find_map(|word| Quantity::of(std::slice::from_ref(word)))
        };
        let Some((written, axis)) = self.axis() else {
            return self.without_axis(own);
        };
        let is_other = |word: &&String| {
            axis_of(word).is_none()
                && !NEUTRAL.contains(&word.as_str())
                && Quantity::of(std::slice::from_ref(*word)).is_none()
        };
        let is_plain = !self.own.iter().any(|word| is_other(&word)) && !self.has_digits;
        let of_words = match is_plain {
            true => Reason::Words,
            false => Reason::MoreWords,
        };
        let (quantity, reason) = match (written, own) {
            (Some(quantity), _) if self.own.len() == 1 && !self.has_digits => (
                quantity,
                match self.suffix {
                    Some(_) => Reason::NameWithUnit,
                    None => Reason::Name,
                },
            ),
            (Some(quantity), _) | (None, Some(quantity)) => (quantity, of_words),
            (None, None) => match (parent(), self.is_in(Unit::Millimetre)) {
                (Some(quantity), _) => (quantity, Reason::Parent),
                (None, true) => (Quantity::Place, of_words),
                (None, false) if self.own.len() == 1 && self.parents.is_empty() => {
                    (Quantity::Place, Reason::Guess)
                }
                (None, false) => return None,
            },
        };
        Some((quantity.channels()[axis], reason))
    }

    /// Channel indicated by a name without an axis: the normal force or the indentation.
    fn without_axis(&self, own: Option<Quantity>) -> Option<(&'static str, Reason)> {
        let is_letter = |word: &&String| word.len() == 1;
        let is_whole = self.own.len() == 1 && !self.has_digits && self.parents.is_empty();
        match own {
            Some(Quantity::Force) if is_whole || !self.own.iter().all(|word| is_letter(&word)) => {
                Some(("Fz", Reason::NoAxis))
            }
            _ => {
                let known = [
                    "depth",
                    "indentation",
                    "indent",
                    "penetration",
                    "press",
                    "pressing",
                    "contact",
                    "z",
                ];
                let is_depth = self.own.iter().all(|word| known.contains(&word.as_str()))
                    && self
                        .own
                        .iter()
                        .any(|word| word == "depth" || word.starts_with("indent"));
                is_depth.then_some(("Pz", Reason::MoreWords))
            }
        }
    }

    fn is_in(&self, quantity: Unit) -> bool {
        let suffix = self.suffix.as_ref();
        suffix.is_some_and(|suffix| suffix.of_quantity(quantity).is_some())
    }

    /// Channel that may be the number at `index` in each cell; `None` if the name indicates no channel, `Err` if the name excludes the column.
    pub(crate) fn candidate(&self, index: String) -> Option<Result<Candidate, Exclusion>> {
        let (channel, reason) = self.channel()?;
        if let Some(exclusion) = self.exclusion() {
            return Some(Err(exclusion));
        }
        Some(self.as_channel(channel, index, reason))
    }

    /// Candidate for `channel`, with the unit in the name.
    pub(super) fn as_channel(
        &self,
        channel: &'static str,
        index: String,
        reason: Reason,
    ) -> Result<Candidate, Exclusion> {
        let unit = match (&self.suffix, kept_unit(channel)) {
            (Some(suffix), Some(kept)) => match suffix.of_quantity(kept) {
                Some(unit) => Some((unit.symbol(), UnitSource::Name)),
                // Counts and volts need a scale before they are forces.
                None if suffix.is_unscaled() => None,
                // A wrench in N also holds torques.
                None if index.is_empty() => {
                    return Err(Exclusion::Unit(suffix.written().to_owned()));
                }
                None => None,
            },
            _ => None,
        };
        let has_word = self
            .own
            .iter()
            .any(|word| UNSCALED.contains(&word.as_str()));
        let has_suffix = self.suffix.as_ref().is_some_and(UnitSuffix::is_unscaled);
        Ok(Candidate {
            is_unscaled: unit.is_none() && (has_word || has_suffix),
            channel,
            index,
            reason,
            unit,
            open: None,
        })
    }
}

#[cfg(test)]
mod tests;
