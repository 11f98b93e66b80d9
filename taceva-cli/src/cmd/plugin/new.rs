//! `taceva plugin new` and `taceva plugin headers`: folders to start a plugin from.

use std::fs;
use std::io;
use std::path::Path;
use taceva_core::shown;

use anyhow::{Context as _, bail};
use taceva_files::Staged;
use taceva_template::{File, Sources};

use crate::args::{Language, NewKind, NewLibrary, PluginHeaders, PluginNew};
use crate::cmd::Context;
use crate::exit;

/// The default folder of headers.
const INCLUDE: &str = "include";

pub(super) fn project(args: &PluginNew, context: &Context) -> anyhow::Result<u8> {
    let takes_library =
        args.language == Language::Python && matches!(args.kind, NewKind::Estimator);
    if args.library.is_some() && !takes_library {
        bail!(
            "--with torch: expected `taceva plugin new estimator NAME --language python --with torch`"
        );
    }
    if args.language == Language::Python {
        return python_project(args, context);
    }
    let sources = if args.registry {
        Sources::Registry
    } else {
        Sources::Vendored
    };
    let (files, command) = match args.language {
        Language::C => (
            taceva_template::c_project(args.kind.into(), &args.name),
            "make",
        ),
        _ => (
            taceva_template::project(args.kind.into(), &args.name, sources),
            "cargo build --release",
        ),
    };
    let folder = Path::new(args.name.as_str());
    write_folder(folder, "", &files)?;
    context.say(format_args!(
        "{}: build it with `{command}`, then `taceva devices --plugin-dir {}`",
        shown(folder),
        shown(folder)
    ));
    Ok(exit::DONE)
}

fn python_project(args: &PluginNew, context: &Context) -> anyhow::Result<u8> {
    let files = match args.library {
        Some(NewLibrary::Torch) => taceva_template::torch_project(&args.name),
        None => taceva_template::python_project(args.kind.into(), &args.name),
    };
    let folder = Path::new(args.name.as_str());
    write_folder(folder, "", &files)?;
    context.say(format_args!(
        "{}: `pip install PATH/TO/dist/taceva-*.whl --editable {}` installs the plugin into an environment with `taceva`. `.ci/wheel dist` in a clone of TacEva builds the wheel of `taceva`. `taceva plugin check org.example.{} --python ENVIRONMENT/bin/python` checks the plugin",
        shown(folder),
        shown(folder),
        args.name
    ));
    Ok(exit::DONE)
}

pub(super) fn headers(args: &PluginHeaders, context: &Context) -> anyhow::Result<u8> {
    let folder = args.out.as_deref().unwrap_or(Path::new(INCLUDE));
    write_folder(folder, "include/", &taceva_template::headers())?;
    context.say(format_args!("{}: for `cc -I`", shown(folder)));
    Ok(exit::DONE)
}

/// Writes `files`, whose paths begin with `above`, to `folder`. Uses a temporary name first, so that `folder` is either absent or complete.
fn write_folder(folder: &Path, above: &str, files: &[File]) -> anyhow::Result<()> {
    if folder.symlink_metadata().is_ok() {
        bail!("{} exists already", shown(folder));
    }
    let written = Staged::beside(folder).and_then(|staged| {
        write_files(staged.path(), above, files)?;
        staged.put_in_place()
    });
    written.with_context(|| format!("cannot write {}", shown(folder)))
}

fn write_files(folder: &Path, above: &str, files: &[File]) -> io::Result<()> {
    for file in files {
        let path = folder.join(file.path.strip_prefix(above).unwrap_or(&file.path));
        fs::create_dir_all(path.parent().unwrap_or(folder))?;
        fs::write(path, &file.text)?;
    }
    Ok(())
}
