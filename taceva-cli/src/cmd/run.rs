//! `taceva run`.

pub(super) mod bench;
pub(super) mod faults;
mod stages;

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use taceva_core::{counted, shown};

use anyhow::Context as _;
use taceva_acquire::{AIR_MM, PlannedScene, Workshop, rehearse_scene};
use taceva_drivers::Drivers;
use taceva_evaluate::Cache;
use taceva_results::EvaluationReport;
use taceva_study::{Existing, RunFolder, RunSetup, check_models, run_scene};

use super::attendance::Attended;
use super::{Context, Usage, cache, scene, widths};
use crate::args::{Format, Run, TableScores};
use crate::{exit, output, progress, report};

/// Default parent folder of numbered runs.
const RUNS: &str = "runs";
/// Name of the file with every number of a run.
const RESULTS: &str = "results.json";

pub(crate) fn run(args: &Run, context: &Context) -> anyhow::Result<u8> {
    let table = super::table_scores(&args.table, args.format)?;
    let (drivers, models) = context.equipment(Path::new(&args.scene.scene))?;
    let planned = scene::to_run(args, &drivers)?;
    scene::check_metrics(&planned)?;
    check_models(&planned, &models)?;
    faults::check(&planned, &drivers)?;
    let estimators = match planned.scene.faults.is_empty() {
        true => Vec::new(),
        false => {
            let host = context.plugins(Some(Path::new(&args.scene.scene)))?;
            host.models()
        }
    };
    faults::plugin_faults(&planned, &estimators)?;
    let attended = Attended::open(args, &planned.scene.name)?;
    if attended.operator().is_none() {
        planned.check_unattended(&drivers)?;
    }
    let formats = formats(&planned)?;
    if args.format == Format::Csv && planned.studies.len() > 1 {
        return Err(Usage::error(format!(
            "--format csv: one table cannot hold the rows of {} sensors; write `formats = [\"csv\"]` under [report] of the scene for a file for each sensor, or use --format json",
            planned.studies.len()
        )));
    }
    if args.air {
        return rehearse(&planned, &drivers, &attended, context);
    }
    let existing = match (args.resume, args.force) {
        (true, _) => Existing::Resume,
        (_, true) => Existing::Replace,
        _ => Existing::Refuse,
    };
    let path = args
        .folder
        .clone()
        .unwrap_or_else(|| RunFolder::numbered(Path::new(RUNS), &planned.scene.name, existing));
    scene::print_cost(&planned, &path, context)?;
    faults::print_cost(&planned, context)?;
    scene::print_rigs(&planned, &drivers, context);
    scene::warn_of_few_points(&planned, context);
    widths::print_expected(&planned, args.scene.from.as_deref(), &drivers, context)?;
    let _held = planned.hold_rigs()?;
    let folder = RunFolder::open(&path, &planned, existing)?;
    match (args.resume, &args.folder) {
        (true, None) => context.say(format_args!(
            "run in {}, the last run of this scene; --out FOLDER resumes another run",
            shown(&path)
        )),
        _ => context.say(format_args!("run in {}", shown(&path))),
    }
    let cache = cache::of(&args.cache).map(Cache::of_run);
    let workshop = Workshop {
        drivers: &drivers,
        surroundings: &bench::surroundings,
        progress: &context.progress,
        operator: attended.operator(),
        viewer: attended.viewer(),
    };
    let setup = RunSetup {
        workshop,
        models: &models,
        cache: cache.as_ref(),
        jobs: context.jobs,
    };
    let studies = run_scene(&planned, &folder, setup);
    attended.ended(&match &studies {
        Ok(_) => "finished: writing the report".to_owned(),
        Err(_) if progress::is_stopped() => {
            "stopped; the terminal shows the command that continues the run".to_owned()
        }
        Err(error) => error.to_string(),
    });
    let studies = studies.with_context(|| match progress::is_stopped() {
        true => format!(
            "stopped; continue with: {}",
            resumption(args, &path, context)
        ),
        false if existing != Existing::Resume && folder.remove_if_untouched() => {
            format!("nothing was recorded: {} was removed", shown(&path))
        }
        false => format!(
            "run in {}, continued by `{}`",
            shown(&path),
            resumption(args, &path, context)
        ),
    })?;
    cache::note(cache.as_ref(), context);
    if let Some(cache) = &cache {
        stages::write(cache, &folder, context)?;
    }
    let tested = faults::TestedRun {
        estimators: &estimators,
        planned: &planned,
        folder: &folder,
        workshop,
        context,
    };
    let tested = faults::test(&tested, studies).with_context(|| match progress::is_stopped() {
        true => format!(
            "stopped; continue with: {}",
            resumption(args, &path, context)
        ),
        false => format!("run in {}", shown(&path)),
    })?;
    let mut reports = tested.reports;
    reports
        .iter_mut()
        .try_for_each(super::attachments::note_samples)?;
    widths::note_reached(&planned, &mut reports, context);
    write_files(&planned, &folder, &reports, &formats)?;
    let drawn = report::page::Page::of(&planned.scene.name, &reports)?;
    let drawn = drawn.with_faults(tested.faults);
    let page = drawn.write_files(folder.path(), &args.figure.style(), context)?;
    if planned.scene.report.like.is_some() {
        drawn.write_like_taceva(folder.path(), &args.figure.style(), context)?;
    }
    let results = folder.path().join(RESULTS);
    output::write_as(Format::Json, Some(&results), |out| {
        report::profiles(&reports, Format::Json, TableScores::All, out)
    })?;
    folder.close(&planned)?;
    output::write_as(args.format, None, |out| {
        report::profiles(&reports, args.format, table, out)
    })?;
    context.say(format_args!("reports are in {}", shown(&folder.reports())));
    context.say(format_args!("look at    {}", shown(&page)));
    Ok(match tested.has_failed {
        true => exit::DEVICE,
        false => exit::DONE,
    })
}

/// Command line that resumes the run in `path`.
fn resumption(args: &Run, path: &Path, context: &Context) -> String {
    let resume = (!args.resume).then_some(OsStr::new("--resume"));
    let out = args
        .folder
        .is_none()
        .then_some([OsStr::new("--out"), path.as_os_str()]);
    let options: Vec<&OsStr> = resume
        .into_iter()
        .chain(out.into_iter().flatten())
        .collect();
    context.invocation.with(&options, "--force")
}

/// Executes `taceva run --air`: visits all places without contact.
fn rehearse(
    planned: &PlannedScene,
    drivers: &Drivers,
    attended: &Attended,
    context: &Context,
) -> anyhow::Result<u8> {
    scene::print_rigs(planned, drivers, context);
    let _held = planned.hold_rigs()?;
    let workshop = Workshop {
        drivers,
        surroundings: &bench::surroundings,
        progress: &context.progress,
        operator: attended.operator(),
        viewer: attended.viewer(),
    };
    let visited = rehearse_scene(planned, workshop);
    attended.ended(&match &visited {
        Ok(_) => "finished: nothing was pressed".to_owned(),
        Err(error) => error.to_string(),
    });
    let visited = visited?;
    context.say(format_args!(
        "visited {}, {AIR_MM} mm above the height of travel; nothing was pressed or recorded",
        counted(visited, "place")
    ));
    Ok(exit::DONE)
}

/// Formats of the reports in the folder: text and JSON, and the formats of the scene.
fn formats(planned: &PlannedScene) -> anyhow::Result<Vec<(Format, &'static str)>> {
    let mut formats = vec![(Format::Json, "json"), (Format::Text, "txt")];
    for name in &planned.scene.report.formats {
        let format = match name.value.as_str() {
            "json" | "text" => continue,
            "csv" => (Format::Csv, "csv"),
            "md" => (Format::Md, "md"),
            "tex" => (Format::Tex, "tex"),
            // The page is always written.
            "html" => continue,
            other => {
                return Err(Usage::error(format!(
                    "[report] formats: `{}` is not supported, expected html, text, json, csv, md or tex",
                    shown(other)
                )));
            }
        };
        if !formats.contains(&format) {
            formats.push(format);
        }
    }
    Ok(formats)
}

/// Writes all reports of the run into its folder.
fn write_files(
    planned: &PlannedScene,
    folder: &RunFolder,
    reports: &[EvaluationReport],
    formats: &[(Format, &'static str)],
) -> anyhow::Result<()> {
    for (number, (study, written)) in planned.studies.iter().zip(reports).enumerate() {
        for (format, extension) in formats {
            let path: PathBuf = folder.report(number, &study.plan.name, extension);
            output::write_as(*format, Some(&path), |out| {
                report::evaluation(written, *format, TableScores::usual(*format), &[], out)
            })?;
        }
        if let Some(samples) = &written.samples {
            let path = folder.report(number, &study.plan.name, "samples.csv");
            output::write(Some(&path), |out| samples.write(out))?;
        }
    }
    Ok(())
}
