//! `taceva import`.

use std::path::{Path, PathBuf};

use taceva_core::{by_count, counted, shown};
use taceva_dataset::internal::quoted;
use taceva_dataset::settle;
use taceva_files::parent_of;
use taceva_import::internal::open_places;
use taceva_import::{
    Addition, Decoders, ImportError, ImportMap, ImportPlan, MapDraft, Preset, SourceSums,
    UnpackedArchive,
};

use super::{Context, Usage};
use crate::args::Import;
use crate::date::today;
use crate::disk_space::{self, Need};
use crate::report::presets;
use crate::{av1_child, exit, output};

pub(crate) fn run(args: &Import, context: &Context) -> anyhow::Result<u8> {
    let target = args.out.as_deref();
    let target = target.or(args.extend.as_deref());
    if args.presets {
        output::write_as(args.format, None, |out| {
            presets::list(args.format, line(), out)
        })?;
        return Ok(exit::DONE);
    }
    if args.map.is_none() && args.preset.is_none() && !args.draft {
        let folder = args.source.as_deref().unwrap_or(Path::new("FOLDER"));
        return Err(Usage::error(format!(
            "no map: `{}` writes one, and `taceva import --presets` lists layouts that need none",
            map_command(folder, Path::new("map.toml"))
        )));
    }
    let source = Source::open(args, target, context)?;
    if let Some(list) = &args.verify {
        let sums = SourceSums::read(list)?;
        let verified = sums.verify(source.folder(), context.jobs, &context.progress);
        source.named(verified)?;
        context.say(format_args!(
            "{}: {} verified",
            shown(list),
            counted(sums.files(), "file")
        ));
    }
    if args.draft {
        let draft = source.named(MapDraft::of(source.drafted(args)))?;
        return map_written(draft.text(), args, target, context);
    }
    if args.print {
        let text = preset(args)?.map(|preset| preset.text(source.folder()));
        return map_written(
            &source.named(text.transpose())?.unwrap_or_default(),
            args,
            target,
            context,
        );
    }
    if let Some(target) = target {
        // Recovers an interrupted replacement first: a dataset that was set aside is restored.
        settle(target)?;
        match args.extend.is_some() {
            true => drop(super::open(target)?),
            false => output::check_free(target, args.force)?,
        }
    }
    let plan = source.named(ImportPlan::with_decoders(
        source.folder(),
        &map(args, &source)?,
        &decoders(args)?,
    ))?;
    let Some(target) = target.filter(|_| !args.explain.is_wanted) else {
        let summary = source.said(plan.summary());
        output::write(None, |out| write!(out, "{summary}"))?;
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
            let named = args.source.as_deref().unwrap_or(source.folder());
            let added = Addition::new(today(), named.to_string_lossy())
                .with_new_certificate(args.new_certificate);
            plan.extend(target, &added, jobs, progress)
        }
        (false, true) => plan.replace(target, jobs, progress),
        (false, false) => plan.run(target, jobs, progress),
    };
    let report = source.named(report)?;
    let summary = source.said(&report.summary);
    let done = match args.extend.is_some() {
        true => "extended",
        false => "wrote   ",
    };
    output::write(None, |out| {
        write!(out, "{summary}")?;
        writeln!(out, "{done} {}", shown(&report.path))?;
        writeln!(out, "digest   {}", report.digest)
    })?;
    Ok(exit::DONE)
}

/// Maximum length of a printed line, characters. Also the length without a terminal.
const LINE: usize = 110;

/// Length of a printed line, characters, by the width of the terminal.
fn line() -> usize {
    output::terminal_width().map_or(LINE, |width| width.min(LINE))
}

/// Source of an import: a folder, or the unpacked content of an archive.
enum Source {
    Folder(PathBuf),
    Archive(UnpackedArchive),
}

impl Source {
    fn open(args: &Import, target: Option<&Path>, context: &Context) -> anyhow::Result<Source> {
        let path = args.source.as_deref().ok_or_else(|| {
            Usage::error("no folder or file is named, expected `taceva import FOLDER`")
        })?;
        if !UnpackedArchive::is_archive(path) {
            return Ok(Source::Folder(folder_of(path).to_owned()));
        }
        // On the disk of the dataset, which needs as much space.
        let beside = match target.filter(|_| !args.explain.is_wanted) {
            Some(target) => parent_of(target).to_owned(),
            None => std::env::temp_dir(),
        };
        let unpacked = UnpackedArchive::open(path, &beside, &context.progress)?;
        Ok(Source::Archive(unpacked))
    }

    fn folder(&self) -> &Path {
        match self {
            Source::Folder(path) => path,
            Source::Archive(archive) => archive.folder(),
        }
    }

    /// Path for which a draft is written: the folder, or the named file in the folder.
    fn drafted<'a>(&'a self, args: &'a Import) -> &'a Path {
        match (self, args.source.as_deref()) {
            (Source::Folder(_), Some(named)) => named,
            _ => self.folder(),
        }
    }

    /// Replaces the unpacked path in an error by the name of the archive member.
    fn named<T>(&self, outcome: Result<T, ImportError>) -> Result<T, ImportError> {
        outcome.map_err(|error| match self {
            Source::Folder(_) => error,
            Source::Archive(archive) => archive.named(error),
        })
    }

    /// Replaces the unpacked path in a message by the name of the archive member.
    fn said(&self, what: &impl std::fmt::Display) -> String {
        match self {
            Source::Folder(_) => what.to_string(),
            Source::Archive(archive) => archive.text_named(&what.to_string()),
        }
    }
}

/// Folder of a recording, from the path of the folder or of one of its files. Returns an archive unchanged.
pub(super) fn folder_of(source: &Path) -> &Path {
    match source.is_file() && !UnpackedArchive::is_archive(source) {
        true => parent_of(source),
        false => source,
    }
}

/// Writes a map for the folder and prints the next steps.
fn map_written(
    text: &str,
    args: &Import,
    target: Option<&Path>,
    context: &Context,
) -> anyhow::Result<u8> {
    if let Some(target) = target {
        output::check_free(target, args.force)?;
        let former = std::fs::read_to_string(target).unwrap_or_default();
        if target.exists() && !former.contains("map_version") {
            return Err(Usage::error(format!(
                "{} is not a map, and --force replaces only maps: choose another path",
                shown(target)
            )));
        }
    }
    output::write(target, |out| write!(out, "{text}"))?;
    if let (Some(target), Some(source)) = (target, &args.source) {
        let open = open_places(text);
        let state = match (args.draft, open) {
            (true, open) => {
                let [are, them] = by_count(open, ["is", "it"], ["are", "them"]);
                let places = counted(open, "place");
                format!("a draft, in which {places} {are} `\"?\"`; fill {them} in, then: ")
            }
            (false, _) => "the map of the preset; adapt it, then: ".to_owned(),
        };
        context.say(format_args!(
            "{}: {state}taceva import {} --map {} --explain",
            shown(target),
            quoted(folder_of(source)),
            quoted(target),
        ));
    }
    Ok(exit::DONE)
}

/// Programs that decode clips of unsupported formats.
fn decoders(args: &Import) -> anyhow::Result<Decoders> {
    let named = args.ffmpeg.clone();
    let named = named.or_else(|| std::env::var_os("TACEVA_FFMPEG").map(PathBuf::from));
    if let Some(program) = &named
        && !program.is_file()
        && on_path(program).is_none()
    {
        return Err(Usage::error(format!(
            "program `{}` is neither a file nor on the PATH: name ffmpeg 5.1 or later with --ffmpeg or TACEVA_FFMPEG",
            shown(program)
        )));
    }
    Ok(Decoders {
        ffmpeg: named.or_else(|| on_path("ffmpeg".as_ref())),
        av1: av1_child::command(),
    })
}

/// Path of the program called `name` on PATH; `None` if not found.
fn on_path(name: &Path) -> Option<PathBuf> {
    let folders = std::env::var_os("PATH")?;
    let mut programs = std::env::split_paths(&folders).map(|folder| folder.join(name));
    programs.find(|program| program.is_file())
}

/// Command that writes a map for the folder or archive at `source` to `map`.
fn map_command(source: &Path, map: &Path) -> String {
    let (folder, out) = (quoted(source), quoted(map));
    match source.is_file() {
        true => format!("taceva import {folder} --draft --out {out}"),
        false => format!("taceva init recording {folder} --out {out}"),
    }
}

fn map(args: &Import, source: &Source) -> anyhow::Result<ImportMap> {
    if let Some(preset) = preset(args)? {
        return Ok(source.named(preset.map(source.folder()))?);
    }
    let path = args
        .map
        .as_deref()
        .ok_or_else(|| Usage::error("neither --map nor --preset is given: add one of them"))?;
    if !path.exists() {
        anyhow::bail!(
            "{}: no such map: `{}` writes one",
            shown(path),
            map_command(args.source.as_deref().unwrap_or(source.folder()), path)
        );
    }
    Ok(ImportMap::read(path)?)
}

/// Preset that the arguments name; `None` without a name.
fn preset(args: &Import) -> anyhow::Result<Option<Preset>> {
    let Some(name) = &args.preset else {
        return Ok(None);
    };
    let found = Preset::from_name(name).ok_or_else(|| {
        let known: Vec<&str> = Preset::all().map(|preset| preset.name()).collect();
        Usage::error(format!(
            "no preset is called `{}`, expected one of {}",
            shown(name),
            known.join(", ")
        ))
    });
    found.map(Some)
}
