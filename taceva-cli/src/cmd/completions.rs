//! `taceva completions`.

use crate::args::{Cli, Completions};
use crate::{exit, output};

pub(crate) fn run(args: &Completions) -> anyhow::Result<u8> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut Cli::documented(), "taceva", &mut script);
    output::write(None, |out| out.write_all(&script))?;
    Ok(exit::DONE)
}
