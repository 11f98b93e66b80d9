//! `taceva man`.

use std::fs;
use std::path::Path;

use anyhow::Context as _;
use clap_mangen::Man;
use taceva_core::shown;
use taceva_dataset::internal::quoted;

use super::Context;
use crate::args::{Cli, ManArgs};
use crate::{exit, output};

pub(crate) fn run(args: &ManArgs, context: &Context) -> anyhow::Result<u8> {
    let command = Cli::documented();
    let Some(folder) = &args.folder else {
        output::write(None, |out| Man::new(command).render(&mut &mut *out))?;
        return Ok(exit::DONE);
    };
    let problem = || format!("cannot write manual pages into {}", shown(folder));
    fs::create_dir_all(folder).with_context(problem)?;
    let mut command = command.disable_help_subcommand(true);
    command.build();
    write_pages(&command, folder)?;
    let page = folder.join("taceva.1");
    context.say(format_args!(
        "wrote a page for every command; read one: man -l {}",
        quoted(&page)
    ));
    Ok(exit::DONE)
}

/// Writes the pages of `command` and of all its subcommands into `folder`. Replaces a symbolic link with the name of a page.
fn write_pages(command: &clap::Command, folder: &Path) -> anyhow::Result<()> {
    for below in command
        .get_subcommands()
        .filter(|below| !below.is_hide_set())
    {
        write_pages(below, folder)?;
    }
    let page = Man::new(command.clone());
    let path = folder.join(page.get_filename());
    output::write(Some(&path), |out| page.render(&mut &mut *out))
}
