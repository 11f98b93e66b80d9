//! What kind of bench it is.

use taceva_sim::{Model, ParameterError, Parameters};

/// Which gel is on the bench, and how much everything errs.
#[derive(Clone, Debug, PartialEq)]
pub struct BenchOptions {
    /// The sensor.
    pub model: Model,
    /// What every error is drawn from.
    pub seed: u64,
    /// Whether the robot errs nowhere, the transducer does not drift and the gel does not relax, so that a study over sockets can be
    /// compared with one that is simulated in the program.
    pub is_quiet: bool,
    /// Pixels of the camera, along x and along y, that make one of a frame.
    pub reduction: u32,
}

/// Numbers that are 0 on a quiet bench.
const QUIET: [(&str, &str); 5] = [
    ("robot", "positioning_mm"),
    ("transducer", "point_drift_n"),
    ("transducer", "press_drift_n"),
    ("transducer", "cross_talk"),
    ("material", "relaxing_fraction"),
];
/// What a quiet transducer hisses by, in N: one without any noise would be taken for one that is frozen.
const QUIET_NOISE_N: f64 = 0.000_2;

impl BenchOptions {
    /// A GelSight that errs as the simulated bench does.
    pub fn noisy(seed: u64) -> BenchOptions {
        BenchOptions {
            model: Model::GelSight,
            seed,
            is_quiet: false,
            reduction: 20,
        }
    }

    /// A GelSight on a bench that errs nowhere.
    pub fn quiet(seed: u64) -> BenchOptions {
        BenchOptions {
            is_quiet: true,
            ..BenchOptions::noisy(seed)
        }
    }

    /// The table of parameters of this bench, as the argument `table` of the simulated sensors takes it.
    pub fn table(&self) -> String {
        if !self.is_quiet {
            return self.model.table().to_owned();
        }
        let mut table: toml::Table = self
            .model
            .table()
            .parse()
            .expect("the tables that are compiled in are TOML");
        let mut set = |section: &str, key: &str, value: f64| {
            let entry = table
                .get_mut(section)
                .and_then(|section| section.get_mut(key))
                .and_then(toml::Value::as_table_mut)
                .expect("every table has the sections of robot, transducer and material");
            entry.insert("value".to_owned(), value.into());
        };
        for (section, key) in QUIET {
            set(section, key, 0.0);
        }
        set("transducer", "noise_n", QUIET_NOISE_N);
        table.to_string()
    }

    /// The parameters of this bench.
    pub(crate) fn parameters(&self) -> Result<Parameters, ParameterError> {
        Parameters::parse(&self.table())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_gel_can_be_quiet_and_is_no_other_otherwise() {
        for model in Model::ALL {
            let options = BenchOptions {
                model,
                ..BenchOptions::quiet(1)
            };
            let quiet = options.parameters().expect("a table that reads");
            assert!(quiet.robot.positioning_mm.abs() <= 0.0);
            assert!(quiet.material.relaxing_fraction.abs() <= 0.0);
            assert!((quiet.transducer.noise_n - 0.0002).abs() < 1e-12);
            let usual = model.parameters();
            assert_eq!(quiet.body, usual.body);
            assert_eq!(quiet.camera, usual.camera);
            assert_eq!(quiet.name, usual.name);
        }
    }
}
