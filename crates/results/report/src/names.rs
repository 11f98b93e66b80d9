//! Names of studies, and lists of names as text.

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
    use super::names;
    use crate::results::Study;

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
}
