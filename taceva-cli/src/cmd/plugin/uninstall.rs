//! `taceva plugin uninstall`: removes the files that `taceva plugin install` copied.

use std::fs;
use std::io;
use std::path::Path;

use anyhow::{Context as _, bail};
use taceva_core::shown;
use taceva_files::{STAGED, TemporaryFolder};
use taceva_host::{PluginConfig, user_config_file};

use super::install;
use crate::args::PluginUninstall;
use crate::{exit, output};

pub(super) fn run(args: &PluginUninstall) -> anyhow::Result<u8> {
    let PluginUninstall { id } = args;
    let user = install::folder_of_user()?;
    let target = user.join(id.as_str());
    if target.symlink_metadata().is_err() {
        bail!(
            "{} does not exist; plugins in other folders are not removed: `taceva plugin list` shows where they are",
            shown(&target)
        );
    }
    remove(&target).with_context(|| format!("cannot remove {}", shown(&target)))?;
    // Settings that cannot be read grant no access.
    let settings = user_config_file().map(|path| PluginConfig::read(&path));
    let is_allowed = settings.is_some_and(|settings| {
        settings.is_ok_and(|config| config.allow.get(id).is_some_and(|needs| !needs.is_empty()))
    });
    output::write(None, |out| {
        writeln!(out, "{id} is no longer installed ({})", shown(&target))?;
        match is_allowed {
            true => writeln!(
                out,
                "its permissions are kept for another version; to revoke them: taceva plugin deny {id}"
            ),
            false => Ok(()),
        }
    })?;
    Ok(exit::DONE)
}

/// Removes a plugin atomically for other processes: first renames the folder to a name that is not searched.
fn remove(target: &Path) -> io::Result<()> {
    let above = taceva_files::parent_of(target);
    let removed = TemporaryFolder::create(above, STAGED)?;
    fs::rename(target, removed.path().join("removed"))?;
    taceva_files::sync_folder(above)
}
