//! Widths of intervals that a scene wants: expected before the first press, and reached by a run.

use std::collections::BTreeSet;
use std::path::Path;
use std::time::Duration;

use taceva_acquire::{PlannedScene, PlannedStudy};
use taceva_core::{counted, shown, whole_size};
use taceva_drivers::Drivers;
use taceva_metrics::LEAST_CLUSTERS;
use taceva_models::{Auto, Preset};
use taceva_protocol::{PhaseKind, Plan, PlannedPress, WantedWidth};
use taceva_results::EvaluationReport;
use taceva_study::{ScoredWidth, TestedPoints};

use super::{Context, Usage, results, scene};
use crate::progress::spoken;

/// Prints the expected width of each wanted interval, and the points and the time that the wanted width needs. Predicts them from the results `from`.
///
/// # Errors
/// If the scene wants no width, or `from` cannot be read or has only results of other studies.
pub(super) fn print_expected(
    planned: &PlannedScene,
    from: Option<&Path>,
    drivers: &Drivers,
    context: &Context,
) -> anyhow::Result<()> {
    let wanted = planned.scene.metrics.wanted_widths();
    let reports = from.map(|path| reports(path, &wanted)).transpose()?;
    let partners = match (from, &reports) {
        (Some(path), Some(reports)) => Some(partners(path, planned, reports)?),
        _ => None,
    };
    for (number, study) in planned.studies.iter().enumerate() {
        let pilot = partners.as_ref().map(|partners| partners[number]);
        if let (Some(None), Some(reports), Some(_)) = (pilot, &reports, tested(study)) {
            if wanted.iter().any(|wanted| study.plan.scores(wanted)) {
                context.say(format_args!(
                    "width: {}: not predicted, because the earlier run has no result of this study on unit {}, only of {}",
                    shown(&study.plan.name),
                    shown(study.plan.units.first().map_or("none", String::as_str)),
                    names(reports)
                ));
            }
            continue;
        }
        let outlook = Outlook {
            planned,
            number,
            pilot: pilot.flatten(),
            drivers,
        };
        for wanted in wanted.iter().filter(|wanted| study.plan.scores(wanted)) {
            context.say(format_args!(
                "width: {}: {wanted}: {}",
                shown(&study.plan.name),
                outlook.words(wanted)
            ));
        }
    }
    Ok(())
}

/// Prints the reached width of each wanted interval, and adds it to the notes of its report.
pub(super) fn note_reached(
    planned: &PlannedScene,
    reports: &mut [EvaluationReport],
    context: &Context,
) {
    let wanted = planned.scene.metrics.wanted_widths();
    for (study, report) in planned.studies.iter().zip(reports) {
        for wanted in wanted.iter().filter(|wanted| study.plan.scores(wanted)) {
            let reached = match ScoredWidth::reached(report, wanted) {
                Ok(width) => format!("{} reached{}", percent(width), points_of(report, wanted)),
                Err(error) => format!("none reached: {error}"),
            };
            let note = format!(
                "width of the interval of {wanted}: {} wanted, {reached}; the number of points was fixed in advance",
                percent(wanted.width)
            );
            context.say(format_args!("{}: {note}", shown(&study.plan.name)));
            report.provenance.notes.push(note);
        }
    }
}

/// Number of tested contact points of the score `wanted`, in words; empty for samples without contact points.
fn points_of(report: &EvaluationReport, wanted: &WantedWidth) -> String {
    let scored = ScoredWidth::of(report, wanted).ok();
    let points = scored.map(|scored| scored.tested().points);
    points.map_or_else(String::new, |points| {
        format!(" with {}", counted(points, "tested contact point"))
    })
}

/// Evaluation reports of the result at `path`. Fails if the scene wants no width.
fn reports(path: &Path, wanted: &[WantedWidth]) -> anyhow::Result<Vec<EvaluationReport>> {
    if wanted.is_empty() {
        return Err(Usage::error(format!(
            "--from {}: the scene names no `want_width` under [metrics], so there is no width to predict",
            shown(path)
        )));
    }
    Ok(results::reports(path)?.reports)
}

/// Result of the run `path` for each study of `planned`; `None` for a study without a result.
///
/// A single result is used for a single study even if their sensors differ: a run on the bench predicts a width on a rig.
fn partners<'a>(
    path: &Path,
    planned: &PlannedScene,
    reports: &'a [EvaluationReport],
) -> anyhow::Result<Vec<Option<&'a EvaluationReport>>> {
    if let ([_], [one]) = (&planned.studies[..], reports) {
        return Ok(vec![Some(one)]);
    }
    let studies = planned.studies.iter();
    let partners: Vec<_> = studies.map(|study| partner(study, reports)).collect();
    let presses = |study: &PlannedStudy| tested(study).is_some();
    if partners.iter().all(Option::is_none) && planned.studies.iter().any(presses) {
        return Err(Usage::error(format!(
            "--from {}: the run has no result of a study of this scene, only of {}; name a run of this scene, or a pilot with fewer points",
            shown(path),
            names(reports)
        )));
    }
    Ok(partners)
}

/// Result for the sensor and the first unit of `study`. For a stage of wear, it is the result at the position of this stage.
fn partner<'a>(
    study: &PlannedStudy,
    reports: &'a [EvaluationReport],
) -> Option<&'a EvaluationReport> {
    let plan = &study.plan;
    let sensor = plan.wear.as_ref().map_or(&plan.name, |wear| &wear.sensor);
    let stage = study.study.wear.as_ref().map_or(0, |stage| stage.number);
    let unit = plan.units.first().map(String::as_str);
    let mut same = reports.iter().filter(|report| {
        let subject = &report.subject;
        subject.sensor == *sensor && subject.serial.split(", ").next() == unit
    });
    same.nth(usize::try_from(stage).ok()?)
}

/// Sensors and units of `reports` in words.
fn names(reports: &[EvaluationReport]) -> String {
    let names = reports.iter().map(|report| {
        let subject = &report.subject;
        format!(
            "`{}` on unit {}",
            shown(&subject.sensor),
            shown(&subject.serial)
        )
    });
    names.collect::<Vec<_>>().join("; ")
}

/// Study whose widths are predicted.
struct Outlook<'a> {
    planned: &'a PlannedScene,
    number: usize,
    /// Results of the same study in an earlier run, if any.
    pilot: Option<&'a EvaluationReport>,
    drivers: &'a Drivers,
}

impl Outlook<'_> {
    /// Expected width of `wanted` and its cost in words.
    fn words(&self, wanted: &WantedWidth) -> String {
        let width = percent(wanted.width);
        let Some(tested) = tested(&self.planned.studies[self.number]) else {
            return format!("{width} wanted; the recording has a fixed number of points");
        };
        let points = counted(tested.points, "tested contact point");
        let Some(pilot) = self.pilot else {
            return match tested.points < LEAST_CLUSTERS {
                true => format!(
                    "{width} cannot be reached with {points}: an interval needs {LEAST_CLUSTERS}"
                ),
                false => format!(
                    "{width} wanted; `--from RUN` predicts the width from a run of this scene, or from a pilot with fewer points"
                ),
            };
        };
        let scored = match ScoredWidth::of(pilot, wanted) {
            Ok(scored) => scored,
            Err(error) => return format!("{width} wanted; the earlier run predicts none: {error}"),
        };
        let expected = scored.expected(tested);
        let begin = match expected {
            Some(expected) => format!("{} expected with {points}", percent(expected)),
            None => format!("no interval with {points}"),
        };
        let end = match expected {
            Some(expected) if expected <= wanted.width => String::new(),
            _ => self.remedy(wanted, &scored, tested),
        };
        format!(
            "{begin}, {width} wanted{end}; predicted from {}{}",
            counted(
                scored.tested().points,
                &format!("{} point", shown(&pilot.subject.source))
            ),
            model_of(pilot, &self.planned.studies[self.number])
        )
    }

    /// Points and time that the wanted width needs, or the width that can be reached.
    fn remedy(&self, wanted: &WantedWidth, scored: &ScoredWidth, tested: TestedPoints) -> String {
        let study = &self.planned.studies[self.number];
        let calibration = &self.planned.scene.protocol.calibration;
        let most = calibration.points_max.value.max(calibration.points.value);
        let most_tested = whole_size(f64::from(most) * scene::test_share(study) + 1e-9);
        let Some(needed) = scored.needed(wanted.width, tested.samples, most_tested) else {
            let best = scored.expected(TestedPoints {
                points: most_tested,
                ..tested
            });
            let best = best.map_or_else(|| "no interval".to_owned(), percent);
            return format!(
                ": it cannot be reached with `points_max = {most}`, which gives {best}"
            );
        };
        let points = scene::points_for(needed, study);
        let points = u32::try_from(points).unwrap_or(most);
        let cost = match self.planned.plans_with(points, self.drivers) {
            Ok(plans) => format!(
                "{} of motion on a rig in place of {}",
                motion(&plans[self.number]),
                motion(&study.plan)
            ),
            Err(error) => format!("which cannot be planned: {error}"),
        };
        let endless = scored.expected(TestedPoints {
            samples: f64::INFINITY,
            ..tested
        });
        let places = endless.filter(|endless| *endless > wanted.width);
        let places = places.map_or_else(String::new, |endless| {
            format!(
                "; more presses at the same places do not bring the width below {}",
                percent(endless)
            )
        });
        format!(": it needs `points = {points}`, {cost}{places}")
    }
}

/// Time of motion of `plan` in words.
fn motion(plan: &Plan) -> String {
    spoken(Duration::from_secs_f64(60.0 * plan.cost.minutes))
}

/// Scored contact points of `study`; `None` if it has no calibration presses.
fn tested(study: &PlannedStudy) -> Option<TestedPoints> {
    let all: Vec<&PlannedPress> = study.plan.presses_of(PhaseKind::Calibration).collect();
    let samples = all.iter().map(|planned| planned.press.samples());
    let samples: usize = samples.sum();
    let count = |presses: &[&PlannedPress]| {
        let points = presses.iter().map(|planned| planned.press.point_id());
        points.collect::<BTreeSet<String>>().len()
    };
    (!all.is_empty()).then(|| TestedPoints {
        points: match scene::has_test_part(&study.plan) {
            // If there are too few points to divide, the test part is empty.
            true => count(&scene::tested_presses(study).unwrap_or_default()),
            false => count(&all),
        },
        samples: samples as f64 / count(&all) as f64,
    })
}

/// Model of `report` in words, and the model that `study` names if it differs. `auto` and presets count as the model that they choose.
fn model_of(report: &EvaluationReport, study: &PlannedStudy) -> String {
    let Some(fitted) = &report.provenance.model else {
        return String::new();
    };
    let named = study.study.model.as_ref();
    let named = named.and_then(|model| Some(model.name.as_ref()?.value.as_str()));
    let named = named.filter(|named| *named != Auto::INFO.name);
    let named = named.map(|named| Preset::named(named).map_or(named, |preset| preset.model));
    let other = named.filter(|named| *named != fitted.name);
    let other = other.map_or_else(String::new, |named| {
        format!(", and the scene names {}", shown(named))
    });
    format!(" with {}{other}", shown(&fitted.name))
}

/// Width as a percentage.
fn percent(width: f64) -> String {
    format!("{:.1} %", 100.0 * width)
}
