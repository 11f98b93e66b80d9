//! `taceva rig`.

mod check;
mod tap;
mod teach;
mod weight;

use std::fs;
use std::io;
use std::path::Path;

use anyhow::Context as _;
use taceva_core::shown;

use super::Context;
use crate::args::{RigCommand, RigSubject};

pub(crate) fn run(args: &RigCommand, context: &Context) -> anyhow::Result<u8> {
    match &args.subject {
        RigSubject::Check(args) => check::run(args, context),
        RigSubject::Tap(args) => tap::run(args, context),
        RigSubject::Teach(args) => teach::run(args, context),
    }
}

/// Replaces the rig file at `path` by `text` atomically.
fn write_anew(path: &Path, text: &str) -> anyhow::Result<()> {
    let written =
        taceva_files::replace(path, |staged| -> io::Result<()> { fs::write(staged, text) });
    written.with_context(|| shown(path).to_string())
}
