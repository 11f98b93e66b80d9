//! `taceva man`.

use std::fs;

use anyhow::Context as _;
use clap_mangen::{Man, generate_to};
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
    generate_to(command, folder).with_context(problem)?;
    let page = folder.join("taceva.1");
    context.say(format_args!(
        "wrote a page for every command; read one: man -l {}",
        quoted(&page)
    ));
    Ok(exit::DONE)
}
