//! `taceva plugin`.

mod allow;
mod check;
mod install;
mod manifest;
mod new;
mod pack;
mod uninstall;

use super::Context;
use crate::args::{Plugin, PluginInfo, PluginList, PluginRelease};
use crate::{exit, output, report};

pub(crate) fn run(which: &Plugin, context: &Context) -> anyhow::Result<u8> {
    match which {
        Plugin::List(args) => list(args, context),
        Plugin::Info(args) => info(args, context),
        Plugin::New(args) => new::project(args, context),
        Plugin::Headers(args) => new::headers(args, context),
        Plugin::Check(args) => check::run(args, context),
        Plugin::Manifest(args) => manifest::run(args),
        Plugin::Pack(args) => pack::run(args, context),
        Plugin::Install(args) => install::run(args, context),
        Plugin::Uninstall(args) => uninstall::run(args),
        Plugin::Allow(args) => allow::allow(args, context),
        Plugin::Deny(args) => allow::deny(args),
        Plugin::Release(args) => release(args, context),
    }
}

fn list(args: &PluginList, context: &Context) -> anyhow::Result<u8> {
    let to = &args.output;
    output::check_all_free(&to.path, to.force)?;
    let host = context.plugins(None)?;
    output::write_as(to.format, to.path.as_deref(), |out| {
        report::plugin::list(&host, args.all, to.format, out)
    })?;
    Ok(exit::DONE)
}

fn info(args: &PluginInfo, context: &Context) -> anyhow::Result<u8> {
    let to = &args.output;
    output::check_all_free(&to.path, to.force)?;
    let host = context.plugins(None)?;
    let plugin = host.plugins().get(&args.id)?;
    output::write_as(to.format, to.path.as_deref(), |out| {
        report::plugin::info(&host, plugin, to.format, out)
    })?;
    Ok(exit::DONE)
}

fn release(args: &PluginRelease, context: &Context) -> anyhow::Result<u8> {
    let released = context.plugins(None)?.release(&args.id)?;
    output::write(None, |out| match released {
        0 => writeln!(out, "`{}` is not in quarantine", args.id),
        _ => writeln!(out, "`{}` may start again", args.id),
    })?;
    Ok(exit::DONE)
}
