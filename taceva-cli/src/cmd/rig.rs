//! `taceva rig`.

mod check;
mod teach;

use super::Context;
use crate::args::{RigCommand, RigSubject};

pub(crate) fn run(args: &RigCommand, context: &Context) -> anyhow::Result<u8> {
    match &args.subject {
        RigSubject::Check(args) => check::run(args, context),
        RigSubject::Teach(args) => teach::run(args, context),
    }
}
