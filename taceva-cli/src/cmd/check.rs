//! `taceva check`.

use std::path::Path;

use taceva_check::{CheckRequest, Severity, check, check_plan};
use taceva_core::{by_count, counted, shown};
use taceva_dataset::Dataset;
use taceva_import::{SourceSums, UnpackedArchive};

use super::{Context, Usage, open};
use crate::args::{Check, Format};
use crate::output::Form;
use crate::{exit, output, report};

pub(crate) fn run(args: &Check, context: &Context) -> anyhow::Result<u8> {
    output::check_all_free(&args.output.path, args.output.force)?;
    let is_table = matches!(args.output.format, Format::Csv | Format::Tex);
    if is_table && args.datasets.len() > 1 {
        return Err(Usage::error(
            "--format csv and --format tex write one recording: name one dataset, or use text, md or json",
        ));
    }
    let request = CheckRequest {
        only: args.only.clone(),
        split: args.split.split.clone(),
        seed: args.split.seed.value,
        jobs: context.jobs,
    };
    let mut recordings = Vec::new();
    for path in &args.datasets {
        recordings.push(open(path)?);
    }
    if let Some(folder) = &args.source {
        return compared(&recordings, folder, context);
    }
    if args.explain.is_wanted {
        for dataset in &recordings {
            let plan = check_plan(dataset, &request)?;
            output::write(None, |out| write!(out, "{plan}"))?;
        }
        return Ok(exit::DONE);
    }
    let mut found = Vec::new();
    for dataset in &recordings {
        let name = shown(dataset.path()).to_string();
        found.push((name, check(dataset, &request, &context.progress)?));
    }
    output::write_as(args.output.format, args.output.path.as_deref(), |out| {
        report::findings(&found, args.output.format, out)
    })?;
    // Recordings that cannot be joined are rejected after each was checked.
    Dataset::joined(recordings)?;
    let worst = found.iter().filter_map(|(_, report)| report.worst()).max();
    Ok(match worst {
        Some(Severity::Error) => exit::CHECK_FAILED,
        _ => exit::DONE,
    })
}

/// Compares `folder` with the files that each recording was imported from.
fn compared(recordings: &[Dataset], folder: &Path, context: &Context) -> anyhow::Result<u8> {
    let archive = UnpackedArchive::is_archive(folder)
        .then(|| UnpackedArchive::open(folder, &std::env::temp_dir(), &context.progress))
        .transpose()?;
    let source = archive.as_ref().map_or(folder, UnpackedArchive::folder);
    let mut has_differences = false;
    for dataset in recordings {
        let name = shown(dataset.path());
        let Some(sums) = SourceSums::of_dataset(dataset)? else {
            anyhow::bail!(
                "{name} stores no digests of its sources, because it was recorded or imported by an older version; import its folder again with `--force`"
            );
        };
        let differences = sums.differences(source, context.jobs, &context.progress)?;
        has_differences |= !differences.is_empty();
        output::write_as(Form::Words, None, |out| {
            for difference in &differences {
                writeln!(out, "{name}: {}: {difference}", shown(folder))?;
            }
            match differences.len() {
                0 => writeln!(out, "{name}: {} matches the imported files", shown(folder)),
                count => writeln!(
                    out,
                    "{name}: {} of {} {}",
                    counted(count, "file"),
                    shown(folder),
                    by_count(
                        count,
                        "differs from the imported file",
                        "differ from the imported files"
                    )
                ),
            }
        })?;
    }
    Ok(match has_differences {
        true => exit::CHECK_FAILED,
        false => exit::DONE,
    })
}
