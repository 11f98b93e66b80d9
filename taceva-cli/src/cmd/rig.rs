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

/// Fails if the rig file at `path` cannot be replaced, before the work whose result would replace it.
fn check_replaceable(path: &Path) -> anyhow::Result<()> {
    let staged = taceva_files::Staged::beside(path).map(drop);
    staged.with_context(|| {
        format!(
            "{}: cannot be replaced by the result, expected a folder in which you may write: copy the rig file to another folder",
            shown(path)
        )
    })
}

/// Replaces the rig file at `path` by `text` atomically.
fn write_anew(path: &Path, text: &str) -> anyhow::Result<()> {
    let written =
        taceva_files::replace(path, |staged| -> io::Result<()> { fs::write(staged, text) });
    written.with_context(|| shown(path).to_string())
}
