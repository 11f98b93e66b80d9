//! `taceva plugin install`: a plugin that was built or unpacked, copied to where every later command finds it.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use taceva_core::shown;
use taceva_host::{CheckOutcome, CheckRequest, Place, Plugin, PluginHost, Plugins, SearchPath};

use crate::args::PluginInstall;
use crate::cmd::Context;
use crate::{exit, output, report};

/// The checks that a library must pass before it is installed: it loads, and is what its manifest says.
const CHECKS: &str = "library/";

pub(super) fn run(args: &PluginInstall, context: &Context) -> anyhow::Result<u8> {
    let source =
        std::path::absolute(&args.folder).with_context(|| shown(&args.folder).to_string())?;
    let found = Plugins::search(SearchPath::empty().given([source.clone()]), &[]);
    if let Some(rejection) = found.rejections.first() {
        bail!("{rejection}");
    }
    let [plugin] = found.iter().collect::<Vec<_>>()[..] else {
        bail!("{}: {} plugins, expected one", shown(&source), found.len());
    };
    let plugin = plugin.clone();
    let user = SearchPath::of_process();
    let user = user.folders().find(|(place, _)| *place == Place::User);
    let (_, user) = user.context("no folder for plugins: neither XDG_DATA_HOME nor HOME is set")?;
    let target = user.join(plugin.id().as_str());
    if target.symlink_metadata().is_ok() && !args.force {
        bail!(
            "{} is installed already, `--force` replaces it",
            shown(&target)
        );
    }
    let config = context.plugins(None)?.config().clone();
    let host = PluginHost::new(found, config, std::sync::Arc::new(|_, _, _, _| {}));
    check(&host, &plugin)?;
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

/// Loads the library in a confined process.
fn check(host: &PluginHost, plugin: &Plugin) -> anyhow::Result<()> {
    let request = CheckRequest {
        only: vec![CHECKS.to_owned()],
        ..CheckRequest::default()
    };
    let mut failed = None;
    host.check(plugin, &request, &mut |result| {
        if let CheckOutcome::Failed(why) = result.outcome {
            failed.get_or_insert(format!("{}: {}: {why}", plugin.id(), result.check));
        }
    })?;
    failed.map_or(Ok(()), |why| Err(anyhow::anyhow!(why)))
}

/// Copies the manifest, the library of this machine and the licences beside `target`, then exchanges the names.
fn replace(plugin: &Plugin, target: &Path) -> io::Result<()> {
    let above = taceva_durable::parent_of(target);
    fs::create_dir_all(above)?;
    let name = target.file_name().unwrap_or_default().display();
    let beside = |word: &str| above.join(format!(".{name}.{}.{word}", std::process::id()));
    let (partial, former) = (beside("partial"), beside("former"));
    let copied = copy(plugin, &partial).and_then(|()| {
        let was_there = target.symlink_metadata().is_ok();
        if was_there {
            fs::rename(target, &former)?;
        }
        fs::rename(&partial, target).inspect_err(|_| {
            if was_there {
                // The error that counts is the one that is returned.
                drop(fs::rename(&former, target));
            }
        })
    });
    // What is left of either is of no use to anybody.
    drop(fs::remove_dir_all(&partial));
    drop(fs::remove_dir_all(&former));
    copied?;
    taceva_durable::sync_folder(above)
}

fn copy(plugin: &Plugin, into: &Path) -> io::Result<()> {
    let library = Path::new(&plugin.library.path);
    let mut files = vec![PathBuf::from("plugin.toml"), library.to_owned()];
    for entry in fs::read_dir(&plugin.folder)? {
        let entry = entry?;
        let name = entry.file_name();
        let is_licence = name.to_str().is_some_and(|name| {
            ["LICENSE", "LICENCE", "COPYING", "NOTICE"]
                .iter()
                .any(|word| name.starts_with(word))
        });
        if is_licence && entry.path().is_file() {
            files.push(PathBuf::from(name));
        }
    }
    for file in files {
        let to = into.join(&file);
        fs::create_dir_all(taceva_durable::parent_of(&to))?;
        fs::copy(plugin.folder.join(&file), &to)?;
        fs::File::open(&to)?.sync_all()?;
    }
    Ok(())
}
