//! `taceva plugin manifest`: `plugin.toml` from the data in a library.

use std::fs;
use std::io;
use std::path::Path;

use anyhow::{Context as _, bail};
use taceva_core::shown;
use taceva_host::{Children, Image, LibraryFile, Manifest, Offer, platform};

use crate::args::PluginManifest;
use crate::{exit, output};

pub(super) fn run(args: &PluginManifest) -> anyhow::Result<u8> {
    let path = args.folder.join("plugin.toml");
    let text = match fs::read_to_string(&path) {
        Ok(text) => text,
        Err(error) if error.kind() == io::ErrorKind::NotFound => String::new(),
        Err(error) => return Err(error).with_context(|| shown(&path).to_string()),
    };
    if let Ok(manifest) = Manifest::parse(&text)
        && let Some(module) = manifest.module()
    {
        bail!(
            "{} is the manifest of a Python module: run `python -m taceva.plugin manifest {}`{}",
            shown(&path),
            module.name,
            if args.write { " with `--write`" } else { "" }
        );
    }
    let file = LibraryFile {
        path: library(args, &text, &path)?,
        sha256: None,
    };
    let image = Image::read(&args.folder, &file)?;
    let offer = Offer::of(&image, &Children::of_user())?;
    let library = LibraryFile {
        sha256: Some(image.digest()),
        ..file
    };
    let written = offer
        .manifest(&text, &library, args.license.as_deref())
        .with_context(|| shown(&path).to_string())?;
    let is_same = written == text;
    if !args.write {
        output::write(None, |out| out.write_all(written.as_bytes()))?;
        return Ok(if is_same {
            exit::DONE
        } else {
            exit::CHECK_FAILED
        });
    }
    if !is_same {
        write(&path, &written).with_context(|| format!("cannot write {}", shown(&path)))?;
    }
    let what = match (is_same, text.is_empty()) {
        (true, _) => "agrees with its library",
        (false, true) => "written",
        (false, false) => "updated from its library",
    };
    output::write(None, |out| writeln!(out, "{}: {what}", shown(&path)))?;
    Ok(exit::DONE)
}

/// Path of the library relative to the folder: from the argument, or from the manifest.
fn library(args: &PluginManifest, text: &str, manifest: &Path) -> anyhow::Result<String> {
    if let Some(given) = &args.library {
        let below = given.strip_prefix(&args.folder).unwrap_or(given);
        let is_below = below.is_relative()
            && below
                .components()
                .all(|part| matches!(part, std::path::Component::Normal(_)));
        return match below.to_str().filter(|_| is_below) {
            Some(below) => Ok(below.to_owned()),
            None => bail!(
                "--library {}: expected a file below {}",
                shown(given),
                shown(&args.folder)
            ),
        };
    }
    if text.is_empty() {
        bail!(
            "{} does not exist yet: name the library with `--library`",
            shown(manifest)
        );
    }
    let read = Manifest::parse(text);
    if let Ok(read) = &read
        && let Some(library) = read.library(&platform())
    {
        return Ok(library.path.clone());
    }
    match read {
        Err(error) => bail!(
            "{}, {error}; name the library with `--library`",
            shown(manifest)
        ),
        Ok(_) => bail!(
            "{}: no library for {}; name one with `--library`",
            shown(manifest),
            platform()
        ),
    }
}

fn write(path: &Path, text: &str) -> io::Result<()> {
    taceva_files::replace(path, |staged| fs::write(staged, text))
}
