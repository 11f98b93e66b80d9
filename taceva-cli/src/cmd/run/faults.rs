//! Faults of the pictures of a run, tested after its studies with their own models.

use std::fs;

use anyhow::Context as _;
use taceva_acquire::{PlannedScene, PlannedStudy};
use taceva_core::{Field, counted, shown};
use taceva_dataset::Dataset;
use taceva_protocol::SceneProblem;
use taceva_report::FaultResult;
use taceva_results::EvaluationReport;
use taceva_stress::{StressReport, StressRequest, select, stress_unseen};
use taceva_study::{FinishedStudy, FittedStudy, RunFolder};

use super::Context;
use crate::args::Format;
use crate::cmd::scene::tested_presses;
use crate::output;

/// Reason why a study without predictions has no errors to test.
const NO_PREDICTIONS: &str =
    "no wanted metric reads predictions; add one such as `mae` to `want` under [metrics]";

/// Reports of a run, and the errors with faults of each study that was tested.
pub(super) struct Tested {
    pub(super) reports: Vec<EvaluationReport>,
    pub(super) faults: Vec<Option<FaultResult>>,
}

/// Refuses unknown faults under `[stress]` of a scene, before any press.
pub(in crate::cmd) fn check(planned: &PlannedScene) -> anyhow::Result<()> {
    let wanted = planned.scene.stress.iter();
    for fault in wanted.flat_map(|stress| stress.faults.iter().flatten()) {
        if let Err(error) = select(std::slice::from_ref(&fault.value)) {
            let problem = SceneProblem::Contradiction(error.to_string());
            return Err(planned.text.error(fault.at(), problem).into());
        }
    }
    Ok(())
}

/// Prints the cost of the faults of a scene: pictures that are decoded once more.
///
/// # Errors
/// If a fault is unknown.
pub(in crate::cmd) fn print_cost(planned: &PlannedScene, context: &Context) -> anyhow::Result<()> {
    let Some(request) = request(planned) else {
        return Ok(());
    };
    let faults = counted(select(&request.faults)?.len(), "fault");
    let severities = by_severity(request.severities.len());
    for study in &planned.studies {
        let name = shown(&study.plan.name);
        let words = match pictures(study) {
            None => format!("not tested: {NO_PREDICTIONS}"),
            Some(pictures) => format!(
                "{faults} of {severities} on {pictures}, each decoded once more; nothing is pressed or fitted for them"
            ),
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

/// Pictures of `study` for the faults, as text; `None` if no metric reads predictions.
fn pictures(study: &PlannedStudy) -> Option<String> {
    let plan = &study.plan;
    let is_predicted = plan.fits.iter().any(|fit| fit.field == Field::Prediction);
    if !is_predicted {
        return None;
    }
    let presses = tested_presses(plan).unwrap_or_default();
    let pictures = presses.iter().filter(|planned| planned.frames);
    let pictures: usize = pictures.map(|planned| planned.press.samples()).sum();
    Some(match pictures {
        0 => "the pictures of the test part".to_owned(),
        _ => format!("about {} of the test part", counted(pictures, "picture")),
    })
}

/// Faults and severities of the scene; `None` without `[stress]`.
fn request(planned: &PlannedScene) -> Option<StressRequest> {
    let stress = planned.scene.stress.as_ref()?;
    let usual = StressRequest::default();
    let faults = stress.faults.as_ref().map(|faults| {
        let names = faults.iter().map(|fault| fault.value.clone());
        names.collect()
    });
    Some(StressRequest {
        faults: faults.unwrap_or(usual.faults),
        severities: stress.severities(),
        draws: stress.draws(),
        seed: planned.scene.seed,
        by: usual.by,
        part: None,
    })
}

/// Tests each of `studies` with the faults of its scene, and writes the errors to `stress/N-NAME.json` in `folder`. A study that cannot be tested has
/// a note with the reason in its report.
///
/// # Errors
/// If a picture cannot be read, or a file cannot be written.
pub(super) fn test(
    planned: &PlannedScene,
    folder: &RunFolder,
    studies: Vec<FinishedStudy>,
    context: &Context,
) -> anyhow::Result<Tested> {
    let request = request(planned);
    let mut tested = Tested {
        reports: Vec::new(),
        faults: Vec::new(),
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
        if let Some(request) = &request {
            match of_study(&dataset, fitted, request, context)? {
                Ok(found) => faults = Some(write(&found, folder, number, name)?),
                Err(reason) => notes.push(format!("faults are not tested: {reason}")),
            }
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

/// Errors of a study with faults, or the reason why it cannot be tested.
fn of_study(
    dataset: &Dataset,
    fitted: Option<FittedStudy>,
    request: &StressRequest,
    context: &Context,
) -> anyhow::Result<Result<StressReport, String>> {
    let Some(FittedStudy { model, unseen, .. }) = fitted else {
        return Ok(Err(NO_PREDICTIONS.to_owned()));
    };
    let work = context.work(None);
    match stress_unseen(dataset, &model, unseen, request, work) {
        Ok(found) => Ok(Ok(found)),
        Err(error) if error.is_usage() => Ok(Err(error.to_string())),
        Err(error) => Err(error.into()),
    }
}

/// Writes the errors of study `number`, and returns them as others read them.
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
