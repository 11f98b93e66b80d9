//! A bench without random errors, to compare methods of pressing one gel.

use super::{ParameterError, Parameters};

/// Values that are 0 on a quiet bench: errors of robot, transducer and camera, and relaxation of the gel.
const SILENCED: [(&str, &str); 8] = [
    ("robot", "positioning_mm"),
    ("transducer", "point_drift_n"),
    ("transducer", "press_drift_n"),
    ("transducer", "cross_talk"),
    ("material", "relaxing_fraction"),
    ("camera", "shot_gain"),
    ("camera", "read_noise"),
    ("camera", "flicker"),
];
/// Noise of a quiet transducer, in N. Without any noise, the signal would count as frozen.
const HISS_N: f64 = 0.000_001;

impl Parameters {
    /// Parses the parameters in `text` without random errors of robot, transducer and camera, and without relaxation of the gel. A reading keeps a
    /// noise of 1 µN. Variation between units and places, conditioning by presses and buckling of a lattice are kept.
    ///
    /// ```
    /// use taceva_sim::{Model, Parameters};
    /// let quiet = Parameters::parse_quiet(Model::GelSight.table())?;
    /// assert_eq!((quiet.camera.read_noise, quiet.robot.positioning_mm), (0.0, 0.0));
    /// assert_eq!(quiet.body, Model::GelSight.parameters().body);
    /// # Ok::<(), taceva_sim::ParameterError>(())
    /// ```
    ///
    /// # Errors
    /// As [`Parameters::parse`].
    pub fn parse_quiet(text: &str) -> Result<Parameters, ParameterError> {
        Parameters::parse(text)?;
        let mut table: toml::Table = text.parse().expect("the same text was parsed before");
        let mut set = |section: &str, key: &str, value: f64| {
            let number = table
                .get_mut(section)
                .and_then(|section| section.get_mut(key))
                .and_then(toml::Value::as_table_mut)
                .expect("a table that was accepted has the numbers of robot, transducer, material and camera");
            number.insert("value".to_owned(), value.into());
        };
        for (section, key) in SILENCED {
            set(section, key, 0.0);
        }
        set("transducer", "noise_n", HISS_N);
        Parameters::parse(&table.to_string())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parameters::Model;

    #[test]
    fn every_gel_can_be_quiet_and_is_no_other_otherwise() {
        for model in Model::ALL {
            let quiet = Parameters::parse_quiet(model.table()).expect("a table that reads");
            let usual = model.parameters();
            for entry in quiet.entries() {
                let place = (entry.section, entry.key);
                let before = usual
                    .entries()
                    .iter()
                    .find(|usual| (usual.section, usual.key) == place)
                    .expect("the same numbers");
                let expected = match place {
                    place if SILENCED.contains(&place) => 0.0,
                    ("transducer", "noise_n") => HISS_N,
                    _ => before.value,
                };
                assert!((entry.value - expected).abs() < 1e-15, "{model}: {entry:?}");
            }
            assert_eq!(quiet.name, usual.name);
        }
    }

    #[test]
    fn a_table_that_does_not_read_is_refused_by_its_own_line() {
        let text = Model::GelSight.table();
        let broken = text.replace("thickness_mm", "thikness_mm");
        assert_eq!(Parameters::parse_quiet(&broken), Parameters::parse(&broken));
    }
}
