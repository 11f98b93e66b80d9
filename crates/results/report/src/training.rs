//! Training behind the results of several sensors: number of contact points, and different models.

use std::collections::BTreeSet;

use taceva_core::counted;
use taceva_metrics::catalogue;

use crate::names::{listed, names, noun};
use crate::results::Study;

/// Least number of contact points for a verdict on sensors. Below this number, twice as many points halve the errors, so a comparison reflects the
/// training.
pub(crate) const LEAST_PLACES: usize = 200;

/// Number of contact points of calibration samples without predictions, which fitted or selected the model; `None` if unknown.
fn places(study: &Study) -> Option<usize> {
    let is_training = |(part, count): &(String, u64)| part == "train" && *count > 0;
    let samples = study.samples.as_ref()?;
    if !study.made.samples.iter().any(is_training) || !samples.has("protocol") {
        return None;
    }
    let channels = samples.channels();
    let is_learnt = |row: &usize| {
        let mut channels = channels.iter();
        channels.all(|channel| channel.prediction(*row).is_none())
    };
    let calibration = samples.of_protocol("calibration").into_iter();
    let points: BTreeSet<&str> = calibration
        .filter(is_learnt)
        .filter_map(|row| samples.word("point_id", row))
        .collect();
    (!points.is_empty()).then_some(points.len())
}

/// Least number of contact points among several sensors; `None` if sufficient for a verdict on sensors.
fn too_few(studies: &[Study]) -> Option<usize> {
    let sensors: BTreeSet<&str> = studies.iter().map(|study| study.sensor.as_str()).collect();
    let fewest = studies.iter().filter_map(places).min()?;
    (sensors.len() > 1 && fewest < LEAST_PLACES).then_some(fewest)
}

/// True if `metric` gives no verdict on sensors, because its models were trained at too few contact points.
pub(crate) fn is_demonstration(studies: &[Study], metric: &str) -> bool {
    let reads = catalogue::find(metric).is_some_and(|metric| metric.reads_predictions());
    reads && too_few(studies).is_some()
}

/// Reason for no verdict on a metric whose models were trained at too few contact points.
pub(crate) const NO_VERDICT: &str = "this demonstration gives no verdict on sensors";

/// Sentence for pages whose models were trained at too few contact points.
pub(crate) fn demonstration(studies: &[Study]) -> Option<String> {
    let fewest = too_few(studies)?;
    Some(format!(
        "A demonstration: models were fitted and chosen on {}, fewer than {LEAST_PLACES}, so scores of predictions give no verdict on sensors.",
        counted(fewest, "contact place")
    ))
}

/// Sentence on the models of the studies, if they differ.
pub(crate) fn unequal_models(studies: &[Study]) -> Option<String> {
    // The best epoch depends on each training; features are compared by size and colour.
    let is_set = |setting: &&(String, String)| setting.0 != "epoch" && setting.0 != "features";
    let settings = |study: &Study| -> Vec<(String, String)> {
        study.made.settings.iter().filter(is_set).cloned().collect()
    };
    let made: Vec<(&str, Vec<(String, String)>)> = studies
        .iter()
        .map(|study| Some((study.made.model.as_deref()?, settings(study))))
        .collect::<Option<_>>()?;
    let first = made.first()?;
    if made.iter().all(|other| other == first) {
        return None;
    }
    let is_shared = |setting: &(String, String)| {
        let mut all = made.iter();
        all.all(|(_, settings)| settings.contains(setting))
    };
    let each = made
        .iter()
        .zip(names(studies))
        .map(|((model, settings), name)| {
            let own = settings.iter().filter(|setting| !is_shared(setting));
            let own: Vec<String> = own.map(|(key, value)| format!("{key}={value}")).collect();
            match own.is_empty() {
                true => format!("{name} by {model}"),
                false => format!("{name} by {model} {}", own.join(" ")),
            }
        });
    let each: Vec<String> = each.collect();
    let models = format!("Different models: {}.", listed(&each));
    Some(match noun(studies) {
        "model" => models,
        noun => format!("{models} Differences between {noun}s include those between their models."),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fmt::Write as _;
    use taceva_results::Samples;

    /// A study whose model was fitted on `places` contact points.
    fn study(sensor: &str, places: usize, settings: &[(&str, &str)]) -> Study {
        let mut table = String::from("sample,protocol,point_id,Fz,Fz_predicted\n");
        for place in 0..places {
            writeln!(table, "l{place},calibration,p{place},1,").expect("a text");
        }
        table += "t,calibration,q,1,1.1\nu,spatial,r,1,\n";
        let mut study = Study {
            sensor: sensor.to_owned(),
            samples: Some(Samples::read(&table).expect("samples")),
            ..Study::default()
        };
        study.made.samples = vec![("train".to_owned(), 400)];
        study.made.model = Some("cnn".to_owned());
        let settings = settings.iter();
        study.made.settings = settings
            .map(|(key, value)| ((*key).to_owned(), (*value).to_owned()))
            .collect();
        study
    }

    #[test]
    fn few_learnt_places_of_several_sensors_are_a_demonstration() {
        let few = [study("a", 112, &[]), study("b", 300, &[])];
        let words = demonstration(&few).expect("a demonstration");
        assert!(
            words.contains("112 contact places, fewer than 200"),
            "{words}"
        );
        assert!(is_demonstration(&few, "mae") && is_demonstration(&few, "r2"));
        // Metrics of the gel alone do not depend on the training.
        assert!(!is_demonstration(&few, "sensitivity"));
        let many = [study("a", 200, &[]), study("b", 300, &[])];
        assert_eq!(demonstration(&many), None);
        assert_eq!(demonstration(&few[..1]), None);
        let models = [study("a", 112, &[]), study("a", 112, &[])];
        assert_eq!(
            demonstration(&models),
            None,
            "models of one sensor are compared as they are"
        );
        // The training of a model that was not fitted here is unknown.
        let mut opened = few;
        opened[0].made.samples.clear();
        assert_eq!(demonstration(&opened), None);
    }

    /// A study of a model with skill, fitted on `places` contact points.
    fn scored(sensor: &str, places: usize, mae: f64) -> Study {
        let text = format!(
            r#"{{"schema": "taceva.evaluation/1.0", "subject": {{"sensor": "x"}}, "metrics": {{
            "r2": {{"Fz": {{"value": 0.9, "unit": "1", "n": 400, "ci95": [0.88, 0.92], "clusters": 40, "method": "drawn", "definition": "r2/1"}}}},
            "mae": {{"Fz": {{"value": {mae}, "unit": "N", "n": 400, "ci95": [{}, {}], "clusters": 40, "method": "drawn", "definition": "mae/1"}}}}
            }}}}"#,
            mae - 0.01,
            mae + 0.01
        );
        let mut study = study(sensor, places, &[]);
        study.scores = crate::results::unsealed(&text)
            .expect("a result")
            .remove(0)
            .scores;
        study
    }

    #[test]
    fn a_comparison_of_a_demonstration_calls_no_sensor_better_in_any_format() {
        let forms = |places: usize| {
            let studies = [scored("a", places, 0.1), scored("b", places, 0.9)];
            let comparison = crate::compare(&studies, &crate::CompareRequest::default());
            let forms = [
                comparison.text(),
                comparison.markdown(),
                comparison.json(),
                comparison.table().csv(),
                comparison.page(&studies),
            ];
            let joined = |form: &str| form.split_whitespace().collect::<Vec<_>>().join(" ");
            (comparison.answers, forms.map(|form| joined(&form)))
        };
        let (answers, measured) = forms(300);
        assert!(answers.iter().any(|answer| answer.better() == Some(0)));
        assert!(measured.iter().all(|form| form.contains("a better by 0.8")));
        let (answers, demonstrated) = forms(112);
        assert!(answers.iter().all(|answer| answer.better().is_none()));
        for form in demonstrated {
            assert!(!form.contains("better by"), "{form}");
            assert!(form.contains("a and b differ by"), "{form}");
            assert!(form.contains(&format!("; {NO_VERDICT}")), "{form}");
            assert!(!form.contains("is better than"), "{form}");
        }
    }

    #[test]
    fn a_comparison_of_a_demonstration_names_no_winner() {
        let decided = |places: usize| {
            let studies = [scored("a", places, 0.1), scored("b", places, 0.9)];
            let comparison = crate::compare(&studies, &crate::CompareRequest::default());
            let decision = comparison.decisions().remove(0);
            (decision.winner, decision.words, comparison.notes)
        };
        let (winner, words, notes) = decided(300);
        assert_eq!(winner, Some(0), "{words}");
        assert!(!notes.iter().any(|note| note.starts_with("A demonstration")));
        let (winner, words, notes) = decided(112);
        assert_eq!(winner, None, "{words}");
        assert!(
            words.starts_with(&format!(
                "a has the best value, but {NO_VERDICT}, with 0.1 N"
            )),
            "{words}"
        );
        assert!(notes[0].starts_with("A demonstration: models"), "{notes:?}");
    }

    #[test]
    fn unequal_models_are_named_with_what_differs() {
        let same = [("size", "64x64"), ("epochs", "24")];
        let equal = [study("a", 1, &same), study("b", 1, &same)];
        assert_eq!(unequal_models(&equal), None);
        let other = [("size", "64x64"), ("epochs", "100")];
        let unequal = [study("a", 1, &same), study("b", 1, &other)];
        assert_eq!(
            unequal_models(&unequal).as_deref(),
            Some(
                "Different models: a by cnn epochs=24 and b by cnn epochs=100. Differences between sensors include those between their \
                    models."
            )
        );
    }
}
