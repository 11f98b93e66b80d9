//! Kinds of plugin for a new project.

use std::fmt;

/// Kind of the driver or estimator that a new plugin provides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Captures pictures of a gel.
    Sensor,
    /// Moves the indenter.
    Robot,
    /// Measures the force on the gel.
    Force,
    /// Controls the light around the sensor.
    Lighting,
    /// Brings specimens or units into place.
    Changer,
    /// Learns to predict from pictures.
    Estimator,
}

/// Files that differ between kinds.
pub(crate) struct Files {
    pub(crate) library: &'static str,
    pub(crate) driver: &'static str,
    pub(crate) provides: &'static str,
}

macro_rules! files {
    ($kind:literal) => {
        Files {
            library: include_str!(concat!("../project/", $kind, "/lib.rs.in")),
            driver: include_str!(concat!("../project/", $kind, "/", $kind, ".rs.in")),
            provides: include_str!(concat!("../project/", $kind, "/provides.toml.in")),
        }
    };
}

impl Kind {
    /// Every kind.
    pub const ALL: [Kind; 6] = [
        Kind::Sensor,
        Kind::Robot,
        Kind::Force,
        Kind::Lighting,
        Kind::Changer,
        Kind::Estimator,
    ];

    /// Name of the kind in manifests.
    pub const fn name(self) -> &'static str {
        match self {
            Kind::Sensor => "sensor",
            Kind::Robot => "robot",
            Kind::Force => "force",
            Kind::Lighting => "lighting",
            Kind::Changer => "changer",
            Kind::Estimator => "estimator",
        }
    }

    /// Noun of the kind in texts.
    pub(crate) const fn noun(self) -> &'static str {
        match self {
            Kind::Force => "force transducer",
            other => other.name(),
        }
    }

    /// Noun with its article, for the beginning of a sentence.
    pub(crate) fn noun_with_article(self) -> String {
        let noun = self.noun();
        let is_vowel = noun.starts_with(['a', 'e', 'i', 'o', 'u']);
        format!("{} {noun}", if is_vowel { "An" } else { "A" })
    }

    /// First step for the author of a new plugin, in words before a colon.
    pub(crate) const fn introduction(self) -> &'static str {
        match self {
            Kind::Estimator => "Replace its fit and its predictions by your own",
            _ => "It is a simulation until you connect a device",
        }
    }

    /// Arguments of `taceva` that list or use the plugin, with the name left to be filled in.
    pub(crate) const fn usage(self) -> &'static str {
        match self {
            Kind::Estimator => "evaluate RECORDING --model org.example.@name@/@name@",
            _ => "devices",
        }
    }

    pub(crate) const fn files(self) -> Files {
        match self {
            Kind::Sensor => files!("sensor"),
            Kind::Robot => files!("robot"),
            Kind::Force => files!("force"),
            Kind::Lighting => files!("lighting"),
            Kind::Changer => files!("changer"),
            Kind::Estimator => files!("estimator"),
        }
    }
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
