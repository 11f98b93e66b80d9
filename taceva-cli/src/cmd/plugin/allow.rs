//! `taceva plugin allow` and `taceva plugin deny`: access of plugins, in the user's settings.

use std::collections::BTreeSet;
use std::fs;
use std::io;
use std::path::Path;

use anyhow::Context as _;
use taceva_core::shown;
use taceva_host::{Need, PluginConfig, PluginId, user_config_file};

use crate::args::{PluginAllow, PluginDeny};
use crate::cmd::{Context, Usage};
use crate::{exit, output};

pub(super) fn allow(args: &PluginAllow, context: &Context) -> anyhow::Result<u8> {
    let host = context.plugins(None)?;
    let plugin = host.plugins().get(&args.id)?;
    let asked = &plugin.manifest.needs;
    for need in &args.needs {
        if asked.iter().any(|asked| asked.asks_for(need)) {
            continue;
        }
        let asked: Vec<String> = asked.iter().map(|need| format!("`{need}`")).collect();
        let asks = match asked.as_slice() {
            [] => "nothing".to_owned(),
            asked => asked.join(", "),
        };
        let problem = format!(
            "`{need}`: the plugin `{}` does not request this access; it requests {asks}",
            args.id
        );
        return Err(Usage::error(problem));
    }
    change(plugin.id(), |allowed| {
        allowed.extend(args.needs.iter().cloned());
        Ok(())
    })
}

pub(super) fn deny(args: &PluginDeny) -> anyhow::Result<u8> {
    change(&args.id, |allowed| {
        for need in &args.needs {
            if !allowed.remove(need) {
                let problem = format!("`{need}`: not allowed to `{}`, {}", args.id, reach(allowed));
                return Err(Usage::error(problem));
            }
        }
        if args.needs.is_empty() {
            allowed.clear();
        }
        Ok(())
    })
}

/// Changes the access of the plugin `id`, and prints the new access.
fn change(
    id: &PluginId,
    change: impl FnOnce(&mut BTreeSet<Need>) -> anyhow::Result<()>,
) -> anyhow::Result<u8> {
    let path = user_config_file().context("no folder for settings: set HOME or XDG_CONFIG_HOME")?;
    let text = match fs::read_to_string(&path) {
        Ok(text) => text,
        Err(error) if error.kind() == io::ErrorKind::NotFound => String::new(),
        Err(error) => return Err(error).with_context(|| shown(&path).to_string()),
    };
    let config = PluginConfig::parse(&text).with_context(|| shown(&path).to_string())?;
    let before = config.allow.get(id).cloned().unwrap_or_default();
    let mut after = before.clone();
    change(&mut after)?;
    if after != before {
        let edited =
            PluginConfig::edited(&text, id, &after).with_context(|| shown(&path).to_string())?;
        write(&path, &edited).with_context(|| format!("cannot write {}", shown(&path)))?;
    }
    output::write(None, |out| {
        writeln!(out, "{id} {} ({})", reach(&after), shown(&path))
    })?;
    Ok(exit::DONE)
}

fn reach(allowed: &BTreeSet<Need>) -> String {
    let needs: Vec<String> = allowed.iter().map(ToString::to_string).collect();
    match needs.as_slice() {
        [] => "has no access outside its process".to_owned(),
        needs => format!("may reach {}", needs.join(", ")),
    }
}

/// Writes the settings atomically. Keeps a symbolic link and the permissions of the file.
fn write(path: &Path, text: &str) -> io::Result<()> {
    let path = path.canonicalize().unwrap_or_else(|_| path.to_owned());
    let folder = taceva_files::parent_of(&path);
    fs::create_dir_all(folder)?;
    taceva_files::replace(&path, |staged| {
        fs::write(staged, text)?;
        match fs::metadata(&path) {
            Ok(metadata) => fs::set_permissions(staged, metadata.permissions()),
            Err(_) => Ok(()),
        }
    })
}
