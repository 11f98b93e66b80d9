//! `taceva bundle`.

use std::num::NonZeroUsize;

use taceva_bundle::{
    BundleError, BundleRequest, Level, Outcome, ScoredTables, Verification, VerifyRequest, compare,
    make, verify_with,
};
use taceva_core::{Progress, counted, shown};

use super::{Context, Usage};
use crate::args::{
    Bundle, BundleDiff, BundleMake, BundleSubject, BundleVerify, LevelArg, WithPart, WithoutPart,
};
use crate::{date, exit, output, report};

pub(crate) fn run(args: &Bundle, context: &Context) -> anyhow::Result<u8> {
    match &args.subject {
        None => made(&args.make, context),
        Some(BundleSubject::Verify(args)) => verified(args, context),
        Some(BundleSubject::Diff(args)) => compared(args),
    }
}

fn made(args: &BundleMake, context: &Context) -> anyhow::Result<u8> {
    let (Some(result), Some(out)) = (&args.result, &args.out) else {
        return Err(Usage::error("a result and --out BUNDLE are required"));
    };
    if !args.draft && (args.authors.is_empty() || args.licence.is_none()) {
        return Err(Usage::error(
            "a bundle states who made it and how it may be used: add --author \"NAME <ORCID>\" and --licence SPDX, or make a draft with --draft",
        ));
    }
    output::check_free(out, args.force)?;
    let day = args.date.clone().unwrap_or_else(date::today);
    let mut request = BundleRequest::new(result, &day);
    request.name.clone_from(&args.name);
    request.authors.clone_from(&args.authors);
    request.organization.clone_from(&args.organization);
    request.licence.clone_from(&args.licence);
    request.states.clone_from(&args.states);
    if let (Some(truth), Some(prediction)) = (&args.truth, &args.prediction) {
        request.tables = Some(ScoredTables::new(truth, prediction, args.key.as_deref()));
    }
    request.datasets.clone_from(&args.datasets);
    request.texts.clone_from(&args.texts);
    request.models.clone_from(&args.models);
    request.adds_models = args.with.contains(&WithPart::Model);
    request.adds_frames = args.with.contains(&WithPart::Frames);
    request.withholds_predictions = args.without == Some(WithoutPart::Predictions);
    request.redactions.clone_from(&args.redact);
    request.jobs = context.jobs;
    let made = make(&request, out)?;
    for note in &made.notes {
        context.say(format_args!("{}", shown(note)));
    }
    let manifest = &made.manifest;
    output::write(None, |stream| {
        writeln!(
            stream,
            "wrote    {}: {}, {}",
            shown(out),
            counted(manifest.files.len() as u64 + 1, "file"),
            counted(manifest.claims.len() as u64, "claim")
        )?;
        report::bundle::levels(&manifest.claims, stream)
    })?;
    let mut claims = manifest.claims.iter();
    if args.states.is_empty() && claims.all(|claim| claim.level <= Level::Form) {
        context.say(format_args!(
            "no claim can be computed again without a state: add --state STATE (written by --state-out), or pack the folder of a run"
        ));
    }
    Ok(exit::DONE)
}

/// Verification that `args` request.
///
/// # Errors
/// [`BundleError`] if the bundle cannot be read.
pub(crate) fn verification(
    args: &BundleVerify,
    jobs: NonZeroUsize,
    progress: &dyn Progress,
) -> Result<Verification, BundleError> {
    let mut request = VerifyRequest::new(&args.bundle);
    request.level = args.level.map(Into::into);
    request.tolerance = args.tolerance;
    request.most = args.most;
    request.datasets.clone_from(&args.datasets);
    request.jobs = jobs;
    verify_with(&request, progress)
}

fn verified(args: &BundleVerify, context: &Context) -> anyhow::Result<u8> {
    let to = &args.output;
    let files = to.path.iter().chain(&args.page.path);
    output::check_all_free(files, to.force)?;
    if args.level == Some(LevelArg::Fit) {
        context.say(format_args!(
            "each model is fitted again, which takes as long as its first fit"
        ));
    }
    let found = verification(args, context.jobs, &context.progress)?;
    if context.progress.is_cancelled() {
        anyhow::bail!("stopped before the verification ended");
    }
    output::write_as(to.format, to.path.as_deref(), |out| {
        report::bundle::verification(&found, to.format, out)
    })?;
    if let Some(path) = &args.page.path {
        let page = report::verification_page::page(&found);
        output::write(Some(path), |out| out.write_all(page.as_bytes()))?;
    }
    Ok(match found.outcome() {
        Outcome::Verified => exit::DONE,
        Outcome::Damaged => exit::BAD_INPUT,
        _ => exit::CHECK_FAILED,
    })
}

fn compared(args: &BundleDiff) -> anyhow::Result<u8> {
    let to = &args.output;
    if let Some(path) = to.path.as_deref() {
        output::check_free(path, to.force)?;
    }
    let found = compare(&args.one, &args.other)?;
    output::write_as(to.format, to.path.as_deref(), |out| {
        report::bundle::comparison(&found, to.format, out)
    })?;
    Ok(exit::DONE)
}
