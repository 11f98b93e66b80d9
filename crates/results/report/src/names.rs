//! Names of studies, and lists of names as text.

use crate::figure::short;
use crate::results::Study;

/// Names of the studies, made distinct if sensors share a name.
pub fn names(studies: &[Study]) -> Vec<String> {
    let name = |(at, study): (usize, &Study)| {
        let same = |other: &&Study| other.sensor == study.sensor;
        let is_alone = studies.iter().filter(same).count() == 1;
        let sensor = match short(&study.sensor, 80) {
            sensor if sensor.trim().is_empty() => "unnamed".to_owned(),
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
