//! `taceva import`.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::Context as _;
use taceva_dataset::{Dataset, ImportMap, ImportPlan, ImportReport, Preset};

use super::{Context, Usage};
use crate::args::Import;
use crate::{exit, output};

pub(crate) fn run(args: &Import, context: &Context) -> anyhow::Result<u8> {
    let target = args.to.as_deref();
    if let Some(target) = target {
        output::check_free(target, args.force)?;
    }
    let plan = ImportPlan::new(&args.source, &map(args)?)?;
    let Some(target) = target.filter(|_| !args.explain) else {
        output::write(None, |out| write!(out, "{}", plan.summary()))?;
        return Ok(exit::DONE);
    };
    let replaced = set_aside(target)?;
    let report = plan.run(target, context.jobs, &context.progress);
    let report = settle(target, replaced, report.map_err(Into::into))?;
    output::write(None, |out| {
        write!(out, "{}", report.summary)?;
        writeln!(out, "wrote    {}", report.path.display())?;
        writeln!(out, "digest   {}", report.digest)
    })?;
    Ok(exit::DONE)
}

fn map(args: &Import) -> anyhow::Result<ImportMap> {
    let Some(name) = &args.preset else {
        let path = args
            .map
            .as_deref()
            .ok_or_else(|| Usage::error("either --map or --preset is needed"))?;
        return Ok(ImportMap::read(path)?);
    };
    let preset = Preset::from_name(name).ok_or_else(|| {
        let known: Vec<&str> = Preset::ALL.iter().map(|preset| preset.name()).collect();
        Usage::error(format!(
            "no preset is called `{name}`, expected one of {}",
            known.join(", ")
        ))
    })?;
    Ok(preset.map(&args.source)?)
}

/// Moves what `--force` replaces out of the way. Only a dataset is ever replaced.
fn set_aside(target: &Path) -> anyhow::Result<Option<PathBuf>> {
    if !target.exists() {
        return Ok(None);
    }
    Dataset::open(target)
        .with_context(|| format!("{}: --force replaces datasets only", target.display()))?;
    let name = target
        .file_name()
        .with_context(|| format!("{} names no folder", target.display()))?;
    let mut hidden = std::ffi::OsString::from(".");
    hidden.push(name);
    hidden.push(format!(".{}.replaced", std::process::id()));
    let aside = target.with_file_name(hidden);
    fs::rename(target, &aside).with_context(|| format!("cannot set {} aside", target.display()))?;
    Ok(Some(aside))
}

/// Removes what was replaced, or puts it back if the import failed.
fn settle(
    target: &Path,
    replaced: Option<PathBuf>,
    report: anyhow::Result<ImportReport>,
) -> anyhow::Result<ImportReport> {
    let Some(aside) = replaced else {
        return report;
    };
    if report.is_ok() {
        fs::remove_dir_all(&aside).with_context(|| format!("cannot remove {}", aside.display()))?;
    } else {
        fs::rename(&aside, target)
            .with_context(|| format!("cannot put {} back", aside.display()))?;
    }
    report
}
