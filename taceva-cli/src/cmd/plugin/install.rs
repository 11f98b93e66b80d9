//! `taceva plugin install`: copies a built or unpacked plugin to the search path of later commands.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use anyhow::{Context as _, bail};
use taceva_conformance::{CheckRequest, Outcome};
use taceva_core::shown;
use taceva_files::{STAGED, Staged, TemporaryFolder};
use taceva_host::{Place, Plugin, PluginHost, Plugins, SearchPath};

use crate::args::PluginInstall;
use crate::cmd::Context;
use crate::{exit, output, report};

/// Folder for an unpacked plugin, inside a temporary folder.
const UNPACKED: &str = "unpacked";
/// Checks that a library must pass before it is installed: it loads, and matches its manifest.
const CHECKS: &str = "library/";

pub(super) fn run(args: &PluginInstall, context: &Context) -> anyhow::Result<u8> {
    let user = folder_of_user()?;
    let unpacked = match args.plugin.is_dir() {
        true => None,
        false => Some(unpack(&args.plugin, &user)?),
    };
    let source = match &unpacked {
        Some(unpacked) => &unpacked.path().join(UNPACKED),
        None => &args.plugin,
    };
    let (host, plugin) = checked(source, context)?;
    let target = user.join(plugin.id().as_str());
    if target.symlink_metadata().is_ok() && !args.force {
        bail!(
            "{} is installed already, `--force` replaces it",
            shown(&target)
        );
    }
    replace(&plugin, &target).with_context(|| format!("cannot write {}", shown(&target)))?;
    let remedy = report::plugin::remedy(&host, &plugin);
    output::write(None, |out| {
        writeln!(
            out,
            "{} {} ({})",
            plugin.id(),
            plugin.manifest.version,
            shown(&target)
        )?;
        match remedy
            .as_deref()
            .and_then(|line| line.split_once(" --plugin-dir "))
        {
            Some((line, _)) => writeln!(out, "{line}"),
            None => Ok(()),
        }
    })?;
    Ok(exit::DONE)
}

/// The folder for plugins of this user.
pub(super) fn folder_of_user() -> anyhow::Result<PathBuf> {
    let search = SearchPath::of_process();
    let user = search.folders().find(|(place, _)| *place == Place::User);
    let (_, user) = user.context("no folder for plugins: set HOME or XDG_DATA_HOME")?;
    Ok(user.to_owned())
}

/// Returns the plugin in `folder`. Fails unless its library loads in a confined process and matches its manifest.
pub(super) fn checked(
    folder: &Path,
    context: &Context,
) -> anyhow::Result<(Arc<PluginHost>, Plugin)> {
    let folder = std::path::absolute(folder).with_context(|| shown(folder).to_string())?;
    let found = Plugins::search(SearchPath::empty().given([folder.clone()]), &[]);
    if let Some(rejection) = found.rejections.first() {
        bail!("{rejection}");
    }
    let [plugin] = found.iter().collect::<Vec<_>>()[..] else {
        bail!("{}: {} plugins, expected one", shown(&folder), found.len());
    };
    let plugin = plugin.clone();
    if let Some(module) = plugin.module() {
        bail!(
            "{} is the Python package `{}`: install it into an environment with `pip install`; `taceva plugin list --python ENVIRONMENT/bin/python` then finds it",
            plugin.id(),
            module.name
        );
    }
    let config = context.plugins(None)?.config().clone();
    let host = PluginHost::new(found, config, Arc::new(|_, _, _, _| {}));
    check(&host, &plugin)?;
    Ok((host, plugin))
}

/// Unpacks a file of `taceva plugin pack` to a temporary folder next to the user's plugins, which is not searched.
fn unpack(file: &Path, user: &Path) -> anyhow::Result<TemporaryFolder> {
    let named = || shown(file).to_string();
    // Checked before opening, because opening a pipe would wait for a writer.
    if !fs::metadata(file).with_context(named)?.is_file() {
        bail!(
            "{}: expected a folder, or a file that `taceva plugin pack` wrote",
            shown(file)
        );
    }
    let archive = fs::File::open(file).with_context(named)?;
    fs::create_dir_all(user).with_context(|| shown(user).to_string())?;
    let folder = TemporaryFolder::create(user, STAGED).with_context(|| shown(user).to_string())?;
    let content = folder.path().join(UNPACKED);
    fs::create_dir(&content).with_context(|| shown(&content).to_string())?;
    taceva_host::unpack(io::BufReader::new(archive), &content).with_context(named)?;
    Ok(folder)
}

/// Checks that the library loads in a confined process and matches its manifest.
fn check(host: &PluginHost, plugin: &Plugin) -> anyhow::Result<()> {
    let request = CheckRequest {
        only: vec![CHECKS.to_owned()],
        ..CheckRequest::default()
    };
    let mut failed = None;
    taceva_conformance::check(host, plugin, &request, &mut |_| {}, &mut |result| {
        if let Outcome::Failed(why) = result.outcome {
            failed.get_or_insert(format!("{}: {}: {why}", plugin.id(), result.check));
        }
    })?;
    failed.map_or(Ok(()), |why| Err(anyhow::anyhow!(why)))
}

/// Replaces `target` by a copy of the manifest, the library for this machine and the licences. Copies to a temporary name first.
fn replace(plugin: &Plugin, target: &Path) -> io::Result<()> {
    fs::create_dir_all(taceva_files::parent_of(target))?;
    let staged = Staged::beside(target)?;
    copy(plugin, staged.path())?;
    staged.put_in_place()
}

fn copy(plugin: &Plugin, into: &Path) -> io::Result<()> {
    for file in plugin.files()? {
        let to = into.join(&file);
        fs::create_dir_all(taceva_files::parent_of(&to))?;
        fs::copy(plugin.folder.join(&file), &to)?;
        fs::File::open(&to)?.sync_all()?;
    }
    Ok(())
}
