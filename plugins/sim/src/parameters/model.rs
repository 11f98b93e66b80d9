//! Sensors with built-in parameters.

use std::fmt;

use super::Parameters;

/// A sensor of the TacEva study with built-in parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Model {
    /// A soft dome with pins under a transparent skin.
    ViTacTip,
    /// A transparent, flat block with a printed lattice.
    MagicTac,
    /// A flat opaque gel with markers.
    GelSight,
    /// A flat opaque gel without markers.
    GelSightWm,
}

impl Model {
    /// All built-in sensors.
    pub const ALL: [Model; 4] = [
        Model::ViTacTip,
        Model::MagicTac,
        Model::GelSight,
        Model::GelSightWm,
    ];

    /// Name in driver keys and files.
    pub const fn key(self) -> &'static str {
        match self {
            Model::ViTacTip => "vitactip",
            Model::MagicTac => "magictac",
            Model::GelSight => "gelsight",
            Model::GelSightWm => "gelsight-wm",
        }
    }

    /// Finds a model by its key; `None` for an unknown key.
    pub fn from_key(key: &str) -> Option<Model> {
        Model::ALL.into_iter().find(|model| model.key() == key)
    }

    /// Parameter table, to copy and change.
    pub const fn table(self) -> &'static str {
        match self {
            Model::ViTacTip => include_str!("../../parameters/vitactip.toml"),
            Model::MagicTac => include_str!("../../parameters/magictac.toml"),
            Model::GelSight => include_str!("../../parameters/gelsight.toml"),
            Model::GelSightWm => include_str!("../../parameters/gelsight-wm.toml"),
        }
    }

    /// Parses the parameters of the model.
    pub fn parameters(self) -> Parameters {
        Parameters::parse(self.table()).expect("compiled-in tables are parsed by a test")
    }
}

impl fmt::Display for Model {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.key())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_compiled_in_table_is_accepted_and_differs_from_the_others() {
        let digests: std::collections::BTreeSet<_> = Model::ALL
            .into_iter()
            .map(|model| *model.parameters().digest())
            .collect();
        assert_eq!(digests.len(), Model::ALL.len());
    }

    #[test]
    fn models_are_found_by_their_key() {
        for model in Model::ALL {
            assert_eq!(Model::from_key(model.key()), Some(model));
        }
        assert_eq!(Model::from_key("GelSight"), None);
    }
}
