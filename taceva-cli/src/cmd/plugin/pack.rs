//! `taceva plugin pack`: a plugin as one file for `taceva plugin install`.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::Context as _;
use taceva_core::shown;
use taceva_host::{PackageError, pack};

use super::install::checked;
use crate::args::PluginPack;
use crate::cmd::Context;
use crate::{exit, output};

pub(super) fn run(args: &PluginPack, context: &Context) -> anyhow::Result<u8> {
    let (_, plugin) = checked(&args.folder, context)?;
    let named = || PathBuf::from(format!("{}-{}.tar", plugin.id(), plugin.manifest.version));
    let path = args.out.clone().unwrap_or_else(named);
    output::check_free(&path, args.force)?;
    let mut names = Vec::new();
    taceva_files::replace(&path, |staged: &Path| -> Result<(), Failed> {
        let mut file = fs::File::create_new(staged)?;
        names = pack(&plugin, &mut file)?;
        Ok(())
    })
    .map_err(|failed| failed.0)
    .with_context(|| format!("cannot write {}", shown(&path)))?;
    output::write(None, |out| {
        writeln!(out, "{}: {}", shown(&path), names.join(", "))
    })?;
    Ok(exit::DONE)
}

/// Error of packing a plugin, including errors of the disk.
struct Failed(anyhow::Error);

impl From<std::io::Error> for Failed {
    fn from(error: std::io::Error) -> Failed {
        Failed(error.into())
    }
}

impl From<PackageError> for Failed {
    fn from(error: PackageError) -> Failed {
        Failed(error.into())
    }
}
