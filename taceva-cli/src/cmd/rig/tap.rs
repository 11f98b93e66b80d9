//! `taceva rig tap`.

use std::sync::Mutex;

use taceva_acquire::{HeldRigs, Workshop, read_rig, tap_rig};
use taceva_core::shown;
use taceva_protocol::Operator;

use crate::args::RigTapArgs;
use crate::cmd::run::bench;
use crate::cmd::{Context, Usage, operator};
use crate::{exit, output, report};

pub(super) fn run(args: &RigTapArgs, context: &Context) -> anyhow::Result<u8> {
    output::check_all_free(&args.output.path, args.output.force)?;
    let (drivers, _) = context.equipment(&args.rig)?;
    let rig = read_rig(&args.rig)?;
    if !args.dry_run {
        super::check_replaceable(&args.rig)?;
    }
    let terminal: Option<Box<Mutex<dyn Operator + Send>>> = match operator::terminal(None) {
        Some(terminal) => Some(Box::new(Mutex::new(terminal))),
        None if rig.simulated => None,
        None => {
            return Err(Usage::error(
                "a person permits the motion by typing the name of the robot: start `taceva rig tap` from a terminal",
            ));
        }
    };
    let held = HeldRigs::of_file(&rig)?;
    let workshop = Workshop {
        drivers: &drivers,
        surroundings: &bench::surroundings,
        progress: &context.progress,
        operator: terminal.as_deref(),
        viewer: None,
    };
    let tapped = tap_rig(&args.rig, workshop)?;
    drop(held);
    output::write_as(args.output.format, args.output.path.as_deref(), |out| {
        report::rig::tap(&tapped, args.output.format, out)
    })?;
    if args.dry_run {
        context.say(format_args!("{}: not written", shown(&args.rig)));
        return Ok(exit::DONE);
    }
    let Some(text) = &tapped.text else {
        let rig = shown(&args.rig);
        anyhow::bail!(
            "{rig}: cannot add a line after the `driver` of a device; write each latency_ms by hand, or write every device as its own table, such as [force]"
        );
    };
    super::write_anew(&args.rig, text)?;
    context.say(format_args!("{}: written", shown(&args.rig)));
    Ok(exit::DONE)
}
