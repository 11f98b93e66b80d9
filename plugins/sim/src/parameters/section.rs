//! Sections of a parameter table: structs of values. Keys, units and ranges are declared in one place.

use std::fmt;

/// Origin of a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Origin {
    /// Fixed by the geometry of the sensor or its data sheet.
    Geometric,
    /// A typical value of the literature.
    Literature,
    /// Fitted to a published number; see `docs/validation.md`.
    Fit,
    /// A modelling choice without public evidence.
    Free,
}

impl Origin {
    /// All origins.
    pub const ALL: [Origin; 4] = [
        Origin::Geometric,
        Origin::Literature,
        Origin::Fit,
        Origin::Free,
    ];

    /// Name of the origin in parameter tables.
    pub const fn name(self) -> &'static str {
        match self {
            Origin::Geometric => "geometric",
            Origin::Literature => "literature",
            Origin::Fit => "fit",
            Origin::Free => "free",
        }
    }

    /// Finds an origin by its name; `None` for an unknown name.
    pub fn from_name(name: &str) -> Option<Origin> {
        Origin::ALL.into_iter().find(|origin| origin.name() == name)
    }
}

impl fmt::Display for Origin {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// One value of a parameter table.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// Section of the value.
    pub section: &'static str,
    /// Key of the value.
    pub key: &'static str,
    /// Value, in the unit of `unit`.
    pub value: f64,
    /// Unit of the value.
    pub unit: &'static str,
    /// Origin of the value.
    pub origin: Origin,
    /// Line of the value in the table, counted from 1.
    pub line: usize,
}

/// Declaration of one value.
#[derive(Clone, Copy, Debug)]
pub(super) struct Row {
    pub(super) key: &'static str,
    pub(super) unit: &'static str,
    pub(super) least: f64,
    pub(super) most: f64,
}

/// A struct whose fields are the keys of a section.
pub(super) trait Section: Sized {
    const NAME: &'static str;
    const ROWS: &'static [Row];

    /// Builds the section from `values`, in the order of the rows.
    fn from_values(values: &[f64]) -> Self;
}

macro_rules! section {
    ($(#[$doc:meta])* $name:ident, $section:literal, {
        $($(#[$key_doc:meta])* $key:ident: $unit:literal, $least:literal ..= $most:literal;)+
    }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $name {
            $($(#[$key_doc])* pub $key: f64,)+
        }

        impl Section for $name {
            const NAME: &'static str = $section;
            const ROWS: &'static [Row] = &[
                $(Row { key: stringify!($key), unit: $unit, least: $least, most: $most },)+
            ];

            fn from_values(values: &[f64]) -> $name {
                let mut values = values.iter().copied();
                $(let $key = values.next().expect("a value a row");)+
                $name { $($key),+ }
            }
        }
    };
}
pub(super) use section;
