//! `taceva rig check` without a weight.

use taceva_acquire::{HeldRigs, check_rig, read_rig};
use taceva_drivers::Drivers;
use taceva_protocol::Operator;

use crate::args::RigCheckArgs;
use crate::cmd::{Context, operator};
use crate::{exit, output, report};

pub(super) fn run(args: &RigCheckArgs, context: &Context) -> anyhow::Result<u8> {
    if let Some(path) = args.output.path.as_deref() {
        output::check_free(path, args.output.force)?;
    }
    if let Some(mass_g) = args.weight {
        return super::weight::run(args, mass_g, context);
    }
    let host = context.plugins(None)?;
    let drivers = Drivers::builtin()?.with_plugins(&host)?;
    let rig = read_rig(&args.rig)?;
    let _held = HeldRigs::of_file(&rig)?;
    let mut terminal = operator::terminal(None);
    if terminal.is_none() && !rig.simulated && rig.robot.is_some() {
        context.say(format_args!(
            "the halt is not timed: start `taceva rig check` from a terminal"
        ));
    }
    let asked = terminal
        .as_mut()
        .map(|terminal| terminal as &mut dyn Operator);
    let check = check_rig(&rig, &drivers, asked)?;
    output::write_as(args.output.format, args.output.path.as_deref(), |out| {
        report::rig::check(&check, args.output.format, out)
    })?;
    Ok(match check.problems.is_empty() {
        true => exit::DONE,
        false => exit::CHECK_FAILED,
    })
}
