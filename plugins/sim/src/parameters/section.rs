//! One section of a parameter table: a struct of numbers whose keys, units and ranges are declared once.

use std::fmt;

/// How a number came to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Origin {
    /// Fixed by the geometry of the sensor or its data sheet.
    Geometric,
    /// A typical value of the literature.
    Literature,
    /// Tuned until a published number came out; see `docs/validation.md`.
    Fit,
    /// A modelling choice without public evidence.
    Free,
}

impl Origin {
    /// Every origin.
    pub const ALL: [Origin; 4] = [
        Origin::Geometric,
        Origin::Literature,
        Origin::Fit,
        Origin::Free,
    ];

    /// How it is written in tables.
    pub const fn name(self) -> &'static str {
        match self {
            Origin::Geometric => "geometric",
            Origin::Literature => "literature",
            Origin::Fit => "fit",
            Origin::Free => "free",
        }
    }

    /// The origin written as `name`.
    pub fn from_name(name: &str) -> Option<Origin> {
        Origin::ALL.into_iter().find(|origin| origin.name() == name)
    }
}

impl fmt::Display for Origin {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// One number of a parameter table.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// Its section.
    pub section: &'static str,
    /// Its key.
    pub key: &'static str,
    /// The number.
    pub value: f64,
    /// Its unit.
    pub unit: &'static str,
    /// How it came to be.
    pub origin: Origin,
    /// The line of the table it stands on, from 1.
    pub line: usize,
}

/// The declaration of one number.
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

    /// The section with `values`, one a row.
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
