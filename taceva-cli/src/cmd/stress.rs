//! `taceva stress`.

use std::path::Path;

use anyhow::Context as _;
use taceva_core::{InputInfo, shown};
use taceva_evaluate::{DataPart, EvaluateError, Plan};
use taceva_report::{FaultResult, fault_page};
use taceva_stress::{
    By, Examples, OtherFaults, PictureFault, StressReport, StressRequest, add_reference,
    severities, stress_beside, stress_plan, usual_list,
};

use super::plugin_fault::{PluginFault, find, is_taken};
use super::{Context, Usage, kept_frames, open_seen, results};
use crate::args::{Format, Stress, StressBy, StressPart};
use crate::report::stress::{numbers, table};
use crate::{exit, output, stderr};

/// Refuses a model that is not a file: nothing is fitted here.
pub(super) fn check_model_file(path: &Path) -> anyhow::Result<()> {
    check_file_of("--model", path)
}

/// Refuses a model file of `option` that does not exist.
fn check_file_of(option: &str, path: &Path) -> anyhow::Result<()> {
    match path.is_file() {
        true => Ok(()),
        false => Err(Usage::error(format!(
            "{option} {}: no such file, expected a fitted model; `taceva fit DATASET --model fast --out m.taceva` writes one",
            shown(path)
        ))),
    }
}

pub(crate) fn run(args: &Stress, context: &Context) -> anyhow::Result<u8> {
    let files = args.output.path.iter().chain(&args.svg);
    output::check_all_free(files.chain(&args.page.path), args.output.force)?;
    check_model_file(&args.model)?;
    args.keep_frames
        .as_deref()
        .map_or(Ok(()), kept_frames::check_new)?;
    let reference = args.reference.as_deref();
    reference.map_or(Ok(()), |path| check_file_of("--reference", path))?;
    // The key of an estimator of a plugin has a slash, and no fault of the program has one.
    let names = args.faults.iter().map(|name| name.trim().to_owned());
    let (keys, names): (Vec<String>, Vec<String>) = names.partition(|name| name.contains('/'));
    let plugins = plugin_faults(&keys, args.seed.value, context)?;
    let foreign = plugins.iter().map(|fault| fault as &dyn PictureFault);
    let foreign: Vec<&dyn PictureFault> = foreign.collect();
    let mut request = StressRequest {
        faults: names,
        severities: severities(&args.severity)?,
        by: match args.by {
            StressBy::Stimulus => By::Stimulus,
            StressBy::Parameter => By::Parameter,
        },
        seed: args.seed.value,
        draws: args.draws,
        part: args.part.map(|part| match part {
            StressPart::Test => DataPart::Test,
            StressPart::All => DataPart::All,
        }),
        stops_at_no_skill: args.stop_at_no_skill,
        metrics: args.metrics.clone(),
    };
    let models = context.models()?;
    let model = models.open(&args.model)?;
    if args.faults.is_empty() {
        request.faults.push(usual_list(&model).to_owned());
    }
    let reads_signals = matches!(model.card().input, InputInfo::Signals(_));
    if let Some(folder) = args.keep_frames.as_deref().filter(|_| reads_signals) {
        return Err(Usage::error(format!(
            "--keep-frames {}: the model reads signals, so there is no picture to keep; leave the option out",
            shown(folder)
        )));
    }
    let reference = reference.map(|path| models.open(path)).transpose()?;
    let recordings = [args.dataset.clone()];
    let dataset = open_seen(&recordings, &args.view, Some(&model))?;
    let applied = || super::applied(&args.model, &recordings);
    let plan = || {
        let mut plan = stress_plan(&dataset, &model, &request, &foreign)?;
        if let Some(path) = &args.reference {
            let model = shown(path);
            let input = if reads_signals { "sample" } else { "frame" };
            plan.step(
                "predict",
                format!("the same with the model {model}, each {input} once more"),
            );
        }
        if let Some(folder) = &args.keep_frames {
            plan.step(
                "write",
                format!("{}: one picture of each cell", shown(folder)),
            );
        }
        Ok::<Plan, EvaluateError>(plan)
    };
    if args.explain.is_wanted {
        let plan = plan().with_context(applied)?;
        output::write(None, |out| write!(out, "{plan}"))?;
        return Ok(exit::DONE);
    }
    context.print_plan(plan)?;
    let others = OtherFaults {
        foreign: &foreign,
        ..OtherFaults::default()
    };
    let work = context.work(None);
    let mut found =
        stress_beside(&dataset, &model, &request, others, work).with_context(applied)?;
    if let (Some(model), Some(path)) = (&reference, &args.reference) {
        add_reference(&mut found, &dataset, model, &request, others, work)
            .with_context(|| super::applied(path, &recordings))?;
    }
    let written = match args.output.format {
        Format::Csv => numbers(&found),
        _ => table(&found),
    };
    let json = serde_json::to_string_pretty(&found)?;
    results::write(&written, &args.output, || format!("{json}\n"))?;
    if let Some(path) = &args.svg {
        let figure = FaultResult::read(&json)?.figure();
        output::write(Some(path), |out| out.write_all(figure.svg().as_bytes()))?;
    }
    if let Some(path) = &args.page.path {
        let page = fault_page(FaultResult::read(&json)?);
        output::write(Some(path), |out| out.write_all(page.as_bytes()))?;
    }
    if let Some(folder) = &args.keep_frames {
        let examples = Examples::of(&dataset, &found)?;
        kept_frames::write(folder, &examples)?;
        context.say(format_args!(
            "{}: sample {} with each fault",
            shown(folder),
            shown(examples.sample())
        ));
    }
    Ok(match say_failed(&found, "") {
        true => exit::DEVICE,
        false => exit::DONE,
    })
}

/// Prints the faults of plugins that failed, each with its reason. True if at least one failed.
pub(super) fn say_failed(report: &StressReport, before: &str) -> bool {
    for failed in &report.failed {
        stderr::say(format_args!(
            "{before}fault {} failed: {}",
            shown(&failed.fault),
            shown(&failed.reason)
        ));
    }
    !report.failed.is_empty()
}

/// Faults of the plugins whose estimators have `keys`. A fault has the name behind the slash.
///
/// # Errors
/// For a plugin that was not found, and for the name of another fault.
fn plugin_faults(
    keys: &[String],
    seed: u64,
    context: &Context,
) -> anyhow::Result<Vec<PluginFault>> {
    if keys.is_empty() {
        return Ok(Vec::new());
    }
    let estimators = context.plugins(None)?.models();
    let faults = keys.iter().enumerate().map(|(number, key)| {
        let refused = |words: String| Usage::error(format!("--faults {words}"));
        let name = own_name(key);
        let is_before = keys[..number].iter().any(|before| own_name(before) == name);
        if is_before || is_taken(name) {
            let words = format!(
                "`{}`: another fault is called `{}`; name the plugin in a scene by [[fault]], which gives it a name of its own",
                shown(key),
                shown(name)
            );
            return Err(refused(words));
        }
        let estimator = find(&estimators, key).map_err(refused)?;
        Ok(PluginFault::new(name.to_owned(), estimator, seed))
    });
    faults.collect()
}

/// Name of an estimator within its plugin.
fn own_name(key: &str) -> &str {
    key.rsplit('/').next().unwrap_or(key)
}
