//! `taceva import`.

use std::path::{Path, PathBuf};

use taceva_core::shown;
use taceva_dataset::{Addition, Decoders, ImportMap, ImportPlan, MapDraft, Preset, settle};

use super::{Context, Usage};
use crate::args::Import;
use crate::date::today;
use crate::disk_space::{self, Need};
use crate::{av1_child, exit, output};

pub(crate) fn run(args: &Import, context: &Context) -> anyhow::Result<u8> {
    if args.former.to.is_some() {
        context.note_former_name("--to", "--out");
    }
    let target = args.out.as_deref().or(args.former.to.as_deref());
    let target = target.or(args.extend.as_deref());
    if args.draft {
        return draft(args, target, context);
    }
    if let Some(target) = target {
        // What a kill left of an earlier one first: a dataset that was set aside stands in its place again.
        settle(target)?;
        match args.extend.is_some() {
            true => drop(super::open(target)?),
            false => output::check_free(target, args.force)?,
        }
    }
    let plan = ImportPlan::with_decoders(&args.source, &map(args)?, &decoders(args)?)?;
    let Some(target) = target.filter(|_| !args.explain.is_wanted) else {
        output::write(None, |out| write!(out, "{}", plan.summary()))?;
        return Ok(exit::DONE);
    };
    let bytes = plan.frame_bytes();
    let need = Need {
        at_least: bytes,
        at_most: bytes,
    };
    if let Some(room) = need.hold_against(disk_space::free(target), target)? {
        context.say(format_args!("disk: {room}"));
    }
    let (jobs, progress) = (context.jobs, &context.progress);
    let report = match (args.extend.is_some(), args.force) {
        (true, _) => {
            let added = Addition::new(today(), args.source.to_string_lossy());
            plan.extend(target, &added, jobs, progress)
        }
        (false, true) => plan.replace(target, jobs, progress),
        (false, false) => plan.run(target, jobs, progress),
    }?;
    let done = match args.extend.is_some() {
        true => "extended",
        false => "wrote   ",
    };
    output::write(None, |out| {
        write!(out, "{}", report.summary)?;
        writeln!(out, "{done} {}", shown(&report.path))?;
        writeln!(out, "digest   {}", report.digest)
    })?;
    Ok(exit::DONE)
}

/// Writes a first map for the folder.
fn draft(args: &Import, target: Option<&Path>, context: &Context) -> anyhow::Result<u8> {
    if let Some(target) = target {
        output::check_free(target, args.force)?;
        let former = std::fs::read_to_string(target).unwrap_or_default();
        if target.exists() && !former.contains("map_version") {
            return Err(Usage::error(format!(
                "{} is no map, which --force would replace: choose another place",
                shown(target)
            )));
        }
    }
    let draft = MapDraft::of(&args.source)?;
    output::write(target, |out| write!(out, "{}", draft.text()))?;
    if let Some(target) = target {
        let open = draft.text().matches(" = \"?\"").count();
        context.say(format_args!(
            "{}: a draft, in which {open} places are `\"?\"`; fill them in, then: taceva import {} --map {} --explain",
            shown(target),
            shown(&args.source),
            shown(target),
        ));
    }
    Ok(exit::DONE)
}

/// The programs that decode clips which are not decoded here.
fn decoders(args: &Import) -> anyhow::Result<Decoders> {
    let named = args.ffmpeg.clone();
    let named = named.or_else(|| std::env::var_os("TACEVA_FFMPEG").map(PathBuf::from));
    if let Some(program) = &named
        && !program.is_file()
        && on_path(program).is_none()
    {
        return Err(Usage::error(format!(
            "no program `{}` is there, neither as a file nor on the PATH: --ffmpeg, or TACEVA_FFMPEG, names ffmpeg 5.1 or later",
            shown(program)
        )));
    }
    Ok(Decoders {
        ffmpeg: named.or_else(|| on_path("ffmpeg".as_ref())),
        av1: av1_child::command(),
    })
}

/// The program of this name in a folder of PATH.
fn on_path(name: &Path) -> Option<PathBuf> {
    let folders = std::env::var_os("PATH")?;
    let mut programs = std::env::split_paths(&folders).map(|folder| folder.join(name));
    programs.find(|program| program.is_file())
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
            "no preset is called `{}`, expected one of {}",
            shown(name),
            known.join(", ")
        ))
    })?;
    Ok(preset.map(&args.source)?)
}
