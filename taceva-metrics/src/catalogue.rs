//! Catalogue of all metrics, with names, units, directions, definitions and texts.

mod agreement;
mod bias;
mod direction;
mod entry_points;
mod mae;
mod mae_euclid;
mod noise_equivalent_force;
mod r2;
mod repeatability;
mod rmse;
mod sensitivity;
mod signal_to_repeatability;
mod skill;
mod smape;
mod smape_gated;
mod tolerance_interval;
mod uniformity;
mod unknown_metric;
mod zero_error;

pub use unknown_metric::UnknownMetric;

use crate::evaluate::metric::Metric;
use crate::families::bias_level::BIAS_LEVEL;
use crate::families::crosstalk::CROSSTALK;
use crate::families::detection::DETECTION_LIMIT;
use crate::families::drift::DRIFT;
use crate::families::hysteresis::HYSTERESIS;
use crate::families::inter_sensor::INTER_SENSOR;
use crate::families::intrinsic::INTRINSIC;
use crate::families::lighting::R_LIGHT;
use crate::families::linearity::LINEARITY;
use crate::families::resolution::SR;
use crate::families::spatial::R_SPATIAL;
use crate::families::tolerance::TOLERANCE;

/// Every metric, in the order of reports.
pub static ALL: [&Metric; 28] = [
    &mae::MAE,
    &rmse::RMSE,
    &bias::BIAS,
    &r2::R2,
    &skill::SKILL,
    &smape::SMAPE,
    &smape_gated::SMAPE_GATED,
    &mae_euclid::MAE_EUCLID,
    &SR,
    &sensitivity::SENSITIVITY,
    &uniformity::UNIFORMITY,
    &R_SPATIAL,
    &R_LIGHT,
    &repeatability::REPEATABILITY,
    &HYSTERESIS,
    &INTER_SENSOR,
    &INTRINSIC,
    &noise_equivalent_force::NOISE_EQUIVALENT_FORCE,
    &zero_error::ZERO_ERROR,
    &DETECTION_LIMIT,
    &signal_to_repeatability::SIGNAL_TO_REPEATABILITY,
    &LINEARITY,
    &CROSSTALK,
    &BIAS_LEVEL,
    &TOLERANCE,
    &agreement::AGREEMENT,
    &tolerance_interval::TOLERANCE_INTERVAL,
    &DRIFT,
];

/// Groups of metrics, by name.
pub static GROUPS: [(&str, &[&Metric]); 2] = [
    ("accuracy", &[&mae::MAE, &r2::R2, &smape::SMAPE]),
    ("all", &ALL),
];

/// Former names of metrics, each with the present name.
const RENAMED: [(&str, &str); 1] = [("minimum_detectable_force", "noise_equivalent_force")];

/// Names of metrics in other programs, in lower case, each with the metric of most similar meaning.
const SYNONYMS: [(&str, &str); 9] = [
    ("mse", "rmse"),
    ("r^2", "r2"),
    ("r_squared", "r2"),
    ("rsquared", "r2"),
    ("r²", "r2"),
    ("sd", "repeatability"),
    ("std", "repeatability"),
    ("mape", "smape"),
    ("l1", "mae"),
];

/// The metric called `id`; `None` for an unknown name.
pub fn find(id: &str) -> Option<&'static Metric> {
    ALL.into_iter().find(|metric| metric.id == id)
}

/// Selects metrics by `names` of metrics or groups, each metric once, in the order of reports.
///
/// ```
/// use taceva_metrics::catalogue;
/// let ids: Vec<&str> = catalogue::select(["rmse", "accuracy"])?.iter().map(|metric| metric.id).collect();
/// assert_eq!(ids, ["mae", "rmse", "r2", "smape"]);
/// let error = catalogue::select(["smap"]).unwrap_err();
/// assert!(error.to_string().starts_with("`smap`: unknown metric, did you mean `smape`? Known are mae, "));
/// # Ok::<(), taceva_metrics::UnknownMetric>(())
/// ```
///
/// # Errors
/// [`UnknownMetric`] with the nearest name.
pub fn select<'a>(
    names: impl IntoIterator<Item = &'a str>,
) -> Result<Vec<&'static Metric>, UnknownMetric> {
    let mut wanted = Vec::new();
    for name in names {
        if let Some((_, new)) = RENAMED.into_iter().find(|(old, _)| *old == name) {
            return Err(UnknownMetric {
                name: name.to_owned(),
                nearest: Some(new),
            });
        }
        let group = GROUPS.into_iter().find(|(group, _)| *group == name);
        match (find(name), group) {
            (Some(metric), _) => wanted.push(metric.id),
            (None, Some((_, metrics))) => wanted.extend(metrics.iter().map(|metric| metric.id)),
            (None, None) => {
                let lower = name.to_lowercase();
                let mut synonyms = SYNONYMS.into_iter();
                let synonym = synonyms.find(|(other, _)| *other == lower);
                let synonym = synonym.map(|(_, metric)| metric);
                return Err(UnknownMetric {
                    name: name.to_owned(),
                    nearest: synonym.or_else(|| taceva_core::nearest(name, self::names())),
                });
            }
        }
    }
    let kept = ALL.into_iter().filter(|metric| wanted.contains(&metric.id));
    Ok(kept.collect())
}

/// All names that [`select`] accepts.
pub fn names() -> impl Iterator<Item = &'static str> {
    let groups = GROUPS.into_iter().map(|(group, _)| group);
    ALL.into_iter().map(|metric| metric.id).chain(groups)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_of_another_program_leads_to_the_metric_and_to_the_list() {
        for (other, metric) in SYNONYMS {
            assert!(find(metric).is_some() && find(other).is_none(), "{other}");
            let upper = other.to_uppercase();
            for name in [other, upper.as_str()] {
                let error = select([name]).expect_err("unknown");
                assert_eq!(error.nearest, Some(metric), "{name}");
                let said = error.to_string();
                assert!(
                    said.contains("Known are ") && said.contains("sensitivity"),
                    "{said}"
                );
            }
        }
    }

    #[test]
    fn every_metric_has_its_own_name_definition_and_text() {
        let mut names: Vec<&str> = names().collect();
        names.sort_unstable();
        let count = names.len();
        names.dedup();
        assert_eq!(names.len(), count);
        for metric in ALL {
            let version = metric.definition.strip_prefix(metric.id);
            let version = version.and_then(|rest| rest.strip_prefix('/')?.parse::<u32>().ok());
            assert!(
                version.is_some_and(|version| version > 0),
                "{}",
                metric.definition
            );
            assert!(metric.documentation.ends_with('.') && !metric.title.is_empty());
        }
    }

    #[test]
    fn a_name_near_none_lists_them_all() {
        let error = select(["colour"]).expect_err("unknown");
        assert_eq!(error.nearest, None);
        assert!(error.to_string().contains("mae, rmse, bias"), "{error}");
    }

    #[test]
    fn a_name_that_was_replaced_leads_to_the_new_one() {
        let error = select(["minimum_detectable_force"]).expect_err("renamed");
        assert_eq!(error.nearest, Some("noise_equivalent_force"));
    }
}
