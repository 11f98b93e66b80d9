//! Effect of light on the errors of a sensor: the scenes of its lighting robustness, as numbers and words.

use taceva_core::by_count;
use taceva_metrics::{Flag, Standing};

use crate::number::numeral;
use crate::results::Study;
use taceva_results::{Score, Value};

/// Metric of lighting robustness.
const METRIC: &str = "r_light";

/// Light scenes of one score.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Light {
    pub(crate) scenes: Vec<Scene>,
    /// True if the light hardly changed in at least one scene.
    pub(crate) is_low: bool,
}

/// One scene relative to the reference light. Errors are computed from predictions before clipping to the bounds of the model.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Scene {
    pub(crate) name: String,
    /// Ratio of brightness to the reference light; `None` if unknown.
    pub(crate) light: Option<f64>,
    /// Ratio of the mean absolute error to the error in reference light; `None` if unknown.
    pub(crate) error: Option<f64>,
}

impl Light {
    /// Scenes of a `score` of lighting robustness; empty for metrics other than lighting robustness, and for results without scenes.
    pub(crate) fn of(score: &Score) -> Light {
        let found = score.variant("scenes").filter(|_| score.metric == METRIC);
        let scenes = match found.map(|variant| &variant.value) {
            Some(Value::Matrix(matrix)) => {
                let column = |name: &str| matrix.columns.iter().position(|of| of == name);
                let [light, error] = ["intensity_ratio", "error_ratio"].map(column);
                let scene = |(name, row): (&String, &Vec<Option<f64>>)| {
                    let at = |column: Option<usize>| row.get(column?).copied().flatten();
                    Scene {
                        name: name.clone(),
                        light: at(light),
                        error: at(error),
                    }
                };
                matrix.rows.iter().zip(&matrix.values).map(scene).collect()
            }
            _ => Vec::new(),
        };
        Light {
            scenes,
            is_low: score.metric == METRIC && score.flags.contains(&Flag::LowStimulus.to_string()),
        }
    }

    /// Effect of light as text: `errors of unbounded predictions become 66 to 325 times as large in the lit scenes`.
    fn errors(&self) -> Option<String> {
        let [low, high] = crate::figure::extent(self.scenes.iter().filter_map(|of| of.error))?;
        let scenes = by_count(self.scenes.len(), "scene", "scenes");
        let times = range(low, high);
        Some(format!(
            "errors of unbounded predictions become {times} times as large in the lit {scenes}"
        ))
    }

    /// Remark on nearly constant light: `light changed by 0.0089 % to 10.1 %: stimulus hardly changed in at least one scene`. `None` if the score lacks this flag.
    pub(crate) fn low_stimulus(&self) -> Option<String> {
        if !self.is_low {
            return None;
        }
        let changes = self.scenes.iter().filter_map(|of| of.light);
        let changes = changes.map(|light| 100.0 * (light - 1.0).abs());
        let hardly = Standing::LowStimulus.phrase().unwrap_or_default();
        let said = crate::figure::extent(changes).map(|[low, high]| match range(low, high) {
            one if !one.contains(' ') => format!("light changed by {one} %: {hardly}"),
            _ => format!(
                "light changed by {} % to {} %: {hardly} in at least one scene",
                numeral(low),
                numeral(high)
            ),
        });
        Some(said.unwrap_or_else(|| hardly.to_owned()))
    }
}

/// Effect of light on each study, regardless of standing: the texts of `errors` and `low_stimulus` after its name. Empty for metrics other than
/// lighting robustness.
pub(crate) fn words(studies: &[Study], names: &[String], metric: &str, channel: &str) -> String {
    let of_one = |(study, name): (&Study, &String)| {
        let light = Light::of(study.score(metric, channel)?);
        let parts = [light.errors(), light.low_stimulus()];
        let parts: Vec<String> = parts.into_iter().flatten().collect();
        (!parts.is_empty()).then(|| format!("{name}: {}", parts.join("; ")))
    };
    let said: Vec<String> = studies.iter().zip(names).filter_map(of_one).collect();
    match metric == METRIC && !said.is_empty() {
        true => format!("{}.", said.join(". ")),
        false => String::new(),
    }
}

/// Range as text: `66 to 325`, or a single number if both round to the same three digits.
fn range(low: f64, high: f64) -> String {
    let [low, high] = [low, high].map(numeral);
    match low == high {
        true => low,
        false => format!("{low} to {high}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A study with `scenes` as pairs of light and error ratio.
    fn study(scenes: &[[f64; 2]], more: &str) -> Study {
        let rows: Vec<String> = (1..=scenes.len()).map(|at| format!("\"S{at}\"")).collect();
        let values: Vec<String> = scenes.iter().map(|row| format!("{row:?}")).collect();
        let text = format!(
            r#"{{"schema": "taceva.evaluation/1.0", "subject": {{"sensor": "x"}}, "metrics": {{"r_light": {{"Fz": {{"value": 0.1, "unit": "1"{more},
                "scenes": {{"rows": [{}], "columns": ["intensity_ratio", "error_ratio"], "values": [{}], "unit": "1"}}}}}}}}}}"#,
            rows.join(", "),
            values.join(", ")
        );
        crate::results::unsealed(&text).expect("a result").remove(0)
    }

    fn said(study: Study) -> String {
        words(&[study], &["x".to_owned()], "r_light", "Fz")
    }

    #[test]
    fn what_light_does_is_said_from_the_least_to_the_greatest_ratio() {
        let grown = study(&[[1.4, 66.4], [2.8, 325.0]], "");
        let expected = "x: errors of unbounded predictions become 66.4 to 325 times as large in the lit scenes.";
        assert_eq!(said(grown), expected);
        let one = study(&[[1.4, 0.5]], "");
        let expected =
            "x: errors of unbounded predictions become 0.5 times as large in the lit scene.";
        assert_eq!(said(one), expected);
    }

    #[test]
    fn light_that_hardly_changes_is_said_with_how_little_it_changed() {
        let dim = study(
            &[[0.99991, 1.25], [1.1, 20.0]],
            r#", "flags": ["low stimulus"]"#,
        );
        let expected = "x: errors of unbounded predictions become 1.25 to 20 times as large in the lit scenes; light changed by 0.009 % to 10 %: stimulus hardly changed in at least one scene.";
        assert_eq!(said(dim), expected);
    }

    #[test]
    fn of_results_without_scenes_and_of_other_metrics_nothing_is_said() {
        assert_eq!(said(study(&[], "")), "");
        let lit = study(&[[1.4, 66.4]], "");
        assert_eq!(words(&[lit], &["x".to_owned()], "mae", "Fz"), "");
    }
}
