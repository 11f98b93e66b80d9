//! Names of studies, and lists of names as text.

use std::collections::BTreeSet;

use crate::figure::short;
use crate::results::Study;

/// Sensor name in results and maps that state none.
const UNKNOWN: &str = "unknown";

/// Names of the studies, made distinct if sensors share a name. Several results without a sensor are `result 1`, `result 2`.
pub fn names(studies: &[Study]) -> Vec<String> {
    let name = |(at, study): (usize, &Study)| {
        let same = |other: &&Study| other.sensor == study.sensor;
        let is_alone = studies.iter().filter(same).count() == 1;
        let sensor = match short(&study.sensor, 80) {
            sensor if sensor.trim().is_empty() => "unnamed".to_owned(),
            sensor if sensor == UNKNOWN && is_alone => "unnamed sensor".to_owned(),
            sensor if sensor == UNKNOWN => "result".to_owned(),
            sensor => sensor,
        };
        let before = studies[..at].iter();
        let number = before.filter(|other| other.sensor == study.sensor).count() + 1;
        let model = study.stated("model");
        let model = model.and_then(|text| text.strip_prefix("name ")?.split(',').next());
        match (is_alone, model) {
            (true, _) => sensor,
            (false, Some(model)) => format!("{sensor} {number} ({})", short(model, 20)),
            (false, None) => format!("{sensor} {number}"),
        }
    };
    studies.iter().enumerate().map(name).collect()
}

/// Noun for what differs between the studies: `sensor`, `model` for models of one sensor, otherwise `result`.
pub(crate) fn noun(studies: &[Study]) -> &'static str {
    let sensors: BTreeSet<&str> = studies.iter().map(|study| study.sensor.as_str()).collect();
    // Arrays have a name, but do not state if it is of a sensor or of a model.
    if are_distinct(studies, |study| {
        (study.source != UNKNOWN).then_some(study.sensor.as_str())
    }) {
        "sensor"
    } else if sensors.len() == 1 && are_distinct(studies, |study| study.made.model.as_deref()) {
        "model"
    } else {
        "result"
    }
}

/// True if each study has a name by `of`, and no two studies share a name.
fn are_distinct(studies: &[Study], of: fn(&Study) -> Option<&str>) -> bool {
    let named: Option<BTreeSet<&str>> = studies.iter().map(of).collect();
    named.is_some_and(|named| named.len() == studies.len())
}

/// Names of all studies as text: `A, B and C`.
pub(crate) fn all(studies: &[Study]) -> String {
    listed(&names(studies))
}

/// List of names as text: `A, B and C`.
pub(crate) fn listed(names: &[String]) -> String {
    match names {
        [] => String::new(),
        [one] => one.clone(),
        [start @ .., last] => format!("{} and {last}", start.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::{names, noun};
    use crate::results::{Made, Study};

    fn study(sensor: &str, model: Option<&str>) -> Study {
        let model = model.map(|name| ("model".to_owned(), format!("name {name}, settings ")));
        Study {
            sensor: sensor.to_owned(),
            provenance: model.into_iter().collect(),
            ..Study::default()
        }
    }

    #[test]
    fn sensors_without_a_name_are_not_headed_unknown() {
        let one = [study("unknown", None)];
        assert_eq!(names(&one), ["unnamed sensor"]);
        let several = [
            study("unknown", Some("ridge")),
            study("unknown", None),
            study("DIGIT", None),
        ];
        assert_eq!(names(&several), ["result 1 (ridge)", "result 2", "DIGIT"]);
    }

    #[test]
    fn the_noun_of_several_studies_is_what_differs_between_them() {
        let of = |sensor: &str, model: Option<&str>, source: &str| Study {
            source: source.to_owned(),
            made: Made {
                model: model.map(str::to_owned),
                ..Made::default()
            },
            ..study(sensor, model)
        };
        let recorded = |sensor, model| of(sensor, Some(model), "recorded");
        let sensors = [recorded("DIGIT", "ridge"), recorded("TacTip", "knn")];
        assert_eq!(noun(&sensors), "sensor");
        let models = [recorded("DIGIT", "ridge"), recorded("DIGIT", "knn")];
        assert_eq!(noun(&models), "model");
        let repeated = [recorded("DIGIT", "ridge"), recorded("DIGIT", "ridge")];
        assert_eq!(noun(&repeated), "result");
        let arrays = ["near", "far"].map(|name| of(name, None, "unknown"));
        assert_eq!(noun(&arrays), "result");
        let [digit, tactip] = sensors;
        let [_, other_model] = models;
        assert_eq!(noun(&[digit, tactip, other_model]), "result");
    }
}
