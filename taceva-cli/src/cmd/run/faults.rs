//! Faults of the pictures or signals of a run, tested after its studies with their own models.

use std::collections::BTreeSet;
use std::fs;
use std::sync::Arc;

use anyhow::Context as _;
use taceva_acquire::{PlannedScene, PlannedStudy, Workshop};
use taceva_core::{EstimatorFactory, Field, counted, shown};
use taceva_dataset::Dataset;
use taceva_drivers::Drivers;
use taceva_protocol::{Cancel, PlannedPress, SceneProblem};
use taceva_report::FaultResult;
use taceva_results::EvaluationReport;
use taceva_sim::GelFault;
use taceva_stress::{
    FAULTS, OtherFaults, PictureFault, SkippedFault, StressReport, StressRequest, TAXEL_FAULTS,
    WornFault, WornGel, select, stress_unseen, usual_list,
};
use taceva_study::{FinishedStudy, FittedStudy, RunFolder};

use super::Context;
use crate::args::Format;
use crate::cmd::plugin_fault::{PluginFault, find, is_taken};
use crate::cmd::scene::tested_presses;
use crate::cmd::stress::say_failed;
use crate::{output, progress};

/// Reason why a study without predictions has no errors to test.
const NO_PREDICTIONS: &str =
    "no wanted metric reads predictions; add one such as `mae` to `want` under [metrics]";

/// Reports of a run, and the result of the test with faults of each study; `None` for a study without test.
pub(super) struct Tested {
    pub(super) reports: Vec<EvaluationReport>,
    pub(super) faults: Vec<Option<FaultResult>>,
    /// True if a fault of a plugin failed.
    pub(super) has_failed: bool,
}

/// Refuses unknown faults under `[stress]` of a scene, and faults of a gel that is not simulated, before any press.
pub(in crate::cmd) fn check(planned: &PlannedScene, drivers: &Drivers) -> anyhow::Result<()> {
    let wanted = planned.scene.stress.iter();
    for fault in wanted.flat_map(|stress| stress.faults.iter().flatten()) {
        let refused = |words: String| {
            let problem = SceneProblem::Contradiction(words);
            anyhow::Error::from(planned.text.error(fault.at(), problem))
        };
        let Some(of_gel) = gel_fault(&fault.value) else {
            select(std::slice::from_ref(&fault.value))
                .map_err(|error| refused(error.to_string()))?;
            continue;
        };
        let mut studies = planned.studies.iter();
        let unknown = studies.find(|study| {
            let worn = study.worn(of_gel.name(), 1, &BTreeSet::new(), drivers);
            worn.is_none()
        });
        if let Some(study) = unknown {
            return Err(refused(format!(
                "fault `{}` changes a simulated gel, but the sensor of study `{}` is not simulated; remove the fault from `faults`",
                of_gel.name(),
                shown(&study.plan.name)
            )));
        }
    }
    Ok(())
}

/// Fault of a gel called `name`; `None` for other faults.
fn gel_fault(name: &str) -> Option<GelFault> {
    GelFault::from_name(name.trim())
}

/// Prints the cost of the faults of a scene: pictures or signals that are read once more.
///
/// # Errors
/// If a fault is unknown.
pub(in crate::cmd) fn print_cost(planned: &PlannedScene, context: &Context) -> anyhow::Result<()> {
    let Some(Wanted {
        request,
        is_usual,
        gels,
    }) = Wanted::of(planned)
    else {
        return Ok(());
    };
    let named = match request.faults.is_empty() {
        true => 0,
        false => select(&request.faults)?.len(),
    };
    let severities = by_severity(request.severities.len());
    for study in &planned.studies {
        let name = shown(&study.plan.name);
        let words = match samples(study) {
            None => format!("not tested: {NO_PREDICTIONS}"),
            Some(samples) => {
                let faults = match is_usual {
                    true => usual_faults(study),
                    false => counted(named, "fault"),
                };
                let again = gels.len() * request.severities.len() * tested(study).len();
                let again = match again {
                    0 => "no press and no fit is needed".to_owned(),
                    count => format!(
                        "{} again on worn gels, for {}; nothing is fitted",
                        counted(count, "press"),
                        counted(gels.len(), "fault")
                    ),
                };
                format!("{faults} of {severities} on {samples} once more; {again}")
            }
        };
        context.say(format_args!("faults: {name}: {words}"));
    }
    Ok(())
}

fn by_severity(count: usize) -> String {
    match count {
        1 => "1 severity".to_owned(),
        count => format!("{count} severities"),
    }
}

/// Number of default faults for `study`, as text. The input of a model file is unknown before the run.
fn usual_faults(study: &PlannedStudy) -> String {
    let (pictures, taxels) = (FAULTS.len(), TAXEL_FAULTS.len());
    let model = study.study.model.as_ref();
    let is_file = model.is_some_and(|model| model.file.is_some());
    let input = model.and_then(|model| model.set.get("input")?.as_str());
    match (input, is_file && study.study.sensor.dataset.is_some()) {
        (_, true) => format!(
            "{} of pictures or {taxels} of taxels",
            counted(pictures, "fault")
        ),
        (Some("signals"), false) => counted(taxels, "fault"),
        _ => counted(pictures, "fault"),
    }
}

/// Text that says which samples of `study` are read or decoded for each fault; `None` if no metric reads predictions.
fn samples(study: &PlannedStudy) -> Option<String> {
    let plan = &study.plan;
    let is_predicted = plan.fits.iter().any(|fit| fit.field == Field::Prediction);
    if !is_predicted {
        return None;
    }
    let presses = tested(study);
    let pictures = presses.iter().filter(|planned| planned.frames);
    let pictures: usize = pictures.map(|planned| planned.press.samples()).sum();
    Some(match pictures {
        _ if study.study.sensor.dataset.is_some() => {
            "the samples of the test part, each read".to_owned()
        }
        0 => "the pictures of the test part, each decoded".to_owned(),
        _ => format!(
            "about {} of the test part, each decoded",
            counted(pictures, "picture")
        ),
    })
}

/// Planned presses of the test part; empty if they are not known before the run.
fn tested(study: &PlannedStudy) -> Vec<&PlannedPress> {
    tested_presses(study).unwrap_or_default()
}

/// Faults of a scene.
struct Wanted {
    /// Request without the faults of a gel. It names no fault if only gels are tested.
    request: StressRequest,
    /// True if the scene names no fault.
    is_usual: bool,
    gels: Vec<GelFault>,
}

impl Wanted {
    /// Faults and severities of the scene; `None` without `[stress]`.
    fn of(planned: &PlannedScene) -> Option<Wanted> {
        let stress = planned.scene.stress.as_ref()?;
        let usual = StressRequest::default();
        let names = stress.faults.as_ref().map(|faults| {
            let names = faults.iter().map(|fault| fault.value.clone());
            names.collect()
        });
        let names: Vec<String> = names.unwrap_or(usual.faults);
        // Each fault once and in a fixed order, so that lists of the same faults are equal.
        let is_named = |gel: &GelFault| names.iter().any(|name| gel_fault(name) == Some(*gel));
        let gels = GelFault::ALL.into_iter().filter(is_named).collect();
        let pictures = names.into_iter().filter(|name| gel_fault(name).is_none());
        Some(Wanted {
            request: StressRequest {
                faults: pictures.collect(),
                severities: stress.severities(),
                draws: stress.draws(),
                seed: planned.scene.seed,
                ..usual
            },
            is_usual: stress.faults.is_none(),
            gels,
        })
    }
}

/// Run whose studies are tested.
pub(super) struct TestedRun<'a> {
    /// Estimators of plugins, which make faults of pictures.
    pub(super) estimators: &'a [Arc<dyn EstimatorFactory>],
    pub(super) planned: &'a PlannedScene,
    pub(super) folder: &'a RunFolder,
    pub(super) workshop: Workshop<'a>,
    pub(super) context: &'a Context,
}

/// Tests each of `studies` with the faults of its scene. Writes each result to `stress/N-NAME.json` in the folder of the run. If a study cannot be
/// tested, its report has a note with the reason.
///
/// # Errors
/// If a picture cannot be read, a press on a worn gel fails, or a file cannot be written.
pub(super) fn test(run: &TestedRun<'_>, studies: Vec<FinishedStudy>) -> anyhow::Result<Tested> {
    let TestedRun {
        planned,
        folder,
        context,
        ..
    } = *run;
    let wanted = Wanted::of(planned);
    let mut tested = Tested {
        reports: Vec::new(),
        faults: Vec::new(),
        has_failed: false,
    };
    for (number, study) in studies.into_iter().enumerate() {
        let FinishedStudy {
            mut report,
            dataset,
            fitted,
            ..
        } = study;
        let name = &planned.studies[number].plan.name;
        let mut faults = None;
        let mut notes = Vec::new();
        if let Some(wanted) = &wanted {
            match of_study(run, number, &dataset, fitted, wanted)? {
                Ok(found) => {
                    tested.has_failed |= say_failed(&found, &format!("{}: ", shown(name)));
                    faults = Some(write(&found, folder, number, name)?);
                }
                Err(reason) => notes.push(format!("faults are not tested: {reason}")),
            }
        }
        if faults.is_none() {
            // A run that was resumed with another [stress] may have left this file.
            drop(fs::remove_file(folder.stress(number, name)));
        }
        for note in &notes {
            context.say(format_args!("{}: {note}", shown(name)));
        }
        report.provenance.notes.extend(notes);
        tested.reports.push(report);
        tested.faults.push(faults);
    }
    Ok(tested)
}

/// Tests a study with faults; the inner error is the reason why it cannot be tested.
fn of_study(
    run: &TestedRun<'_>,
    number: usize,
    dataset: &Dataset,
    fitted: Option<FittedStudy>,
    wanted: &Wanted,
) -> anyhow::Result<Result<StressReport, String>> {
    let Some(FittedStudy { model, unseen, .. }) = fitted else {
        return Ok(Err(NO_PREDICTIONS.to_owned()));
    };
    let names = dataset.table().samples();
    let presses = unseen.rows.iter().map(|row| {
        let sample = names[*row].as_str();
        let press = sample.split_once('/').map_or(sample, |(press, _)| press);
        press.to_owned()
    });
    let presses: BTreeSet<String> = presses.collect();
    let severities = &wanted.request.severities;
    let worn = wanted.gels.iter();
    let worn = worn.map(|fault| press_worn(run, number, *fault, severities, &presses));
    let worn: Vec<WornFault> = worn.collect::<anyhow::Result<_>>()?;
    let work = run.context.work(None);
    let foreign = plugin_faults(run.planned, run.estimators)?;
    let foreign: Vec<&dyn PictureFault> = foreign
        .iter()
        .map(|fault| fault as &dyn PictureFault)
        .collect();
    let others = OtherFaults {
        worn: &worn,
        foreign: &foreign,
    };
    let mut request = wanted.request.clone();
    if wanted.is_usual {
        request.faults = vec![usual_list(&model).to_owned()];
    }
    match stress_unseen(dataset, &model, unseen, &request, others, work) {
        Ok(found) => Ok(Ok(found)),
        Err(error) if error.is_usage() => Ok(Err(error.to_string())),
        Err(error) => Err(error.into()),
    }
}

/// Picture faults of a scene that estimators of plugins make.
///
/// # Errors
/// For a plugin that was not found, and for the name of another fault.
pub(in crate::cmd) fn plugin_faults(
    planned: &PlannedScene,
    estimators: &[Arc<dyn EstimatorFactory>],
) -> anyhow::Result<Vec<PluginFault>> {
    let faults = planned.scene.faults.iter();
    let faults = faults.map(|fault| -> anyhow::Result<PluginFault> {
        let name = &fault.name.value;
        let refused = |at, words: String| {
            let problem = SceneProblem::Contradiction(words);
            anyhow::Error::from(planned.text.error(at, problem))
        };
        if is_taken(name) {
            let words = format!(
                "`{}`: a built-in fault has this name, choose another",
                shown(name)
            );
            return Err(refused(fault.name.at(), words));
        }
        let found = find(estimators, &fault.plugin.value);
        let estimator = found.map_err(|words| refused(fault.plugin.at(), words))?;
        let seed = planned.scene.seed;
        Ok(PluginFault::new(name.clone(), estimator, seed))
    });
    faults.collect()
}

/// Presses the test part of study `number` again on gels with `fault`, into folders next to the result of its fault test. A severity that the gel
/// cannot have is skipped.
fn press_worn(
    run: &TestedRun<'_>,
    number: usize,
    fault: GelFault,
    severities: &[u8],
    presses: &BTreeSet<String>,
) -> anyhow::Result<WornFault> {
    let study = &run.planned.studies[number];
    let folder = run.folder.stress(number, &study.plan.name);
    let folder = folder.with_extension("");
    fs::create_dir_all(&folder).with_context(|| format!("cannot make {}", shown(&folder)))?;
    let progress = run.workshop.progress;
    let mut gels = Vec::new();
    let mut skipped = Vec::new();
    for &severity in severities {
        let worn = study.worn(fault.name(), severity, presses, run.workshop.drivers);
        let worn = worn.context("faults of the gel need a simulated sensor")?;
        let path = folder.join(format!("{}-{severity}", fault.name()));
        progress.begin("press", Some(worn.plan.presses.len() as u64));
        let dataset = worn.acquire(&path, run.workshop, &Cancel::new());
        progress.end();
        match dataset {
            Ok(dataset) => gels.push(WornGel {
                severity,
                parameter: fault.amount(severity),
                dataset,
            }),
            Err(error) if progress::is_stopped() => return Err(error.into()),
            Err(error) => skipped.push(SkippedFault {
                fault: fault.name().to_owned(),
                reason: format!("severity {severity}: {error}"),
            }),
        }
    }
    Ok(WornFault {
        id: fault.name().to_owned(),
        title: fault.title().to_owned(),
        parameter: fault.parameter().to_owned(),
        severities: gels,
        skipped,
    })
}

/// Writes the fault test of study `number` as JSON, and returns it in the form that reports read.
fn write(
    found: &StressReport,
    folder: &RunFolder,
    number: usize,
    study: &str,
) -> anyhow::Result<FaultResult> {
    let path = folder.stress(number, study);
    let parent = taceva_files::parent_of(&path);
    fs::create_dir_all(parent).with_context(|| format!("cannot make {}", shown(parent)))?;
    let json = serde_json::to_string_pretty(found)?;
    output::write_as(Format::Json, Some(&path), |out| writeln!(out, "{json}"))?;
    Ok(FaultResult::read(&json)?)
}
