//! `taceva rig check --weight`.

use taceva_acquire::{HeldRigs, read_rig, weigh_rig};
use taceva_core::shown;

use crate::args::RigCheckArgs;
use crate::cmd::{Context, Usage, operator};
use crate::{exit, output, report};

pub(super) fn run(args: &RigCheckArgs, mass_g: f64, context: &Context) -> anyhow::Result<u8> {
    let (drivers, _) = context.equipment(&args.rig)?;
    let rig = read_rig(&args.rig)?;
    super::check_replaceable(&args.rig)?;
    let Some(mut terminal) = operator::terminal(None) else {
        return Err(Usage::error(
            "--weight asks a person to hang the weight on the transducer: start `taceva rig check --weight` from a terminal",
        ));
    };
    let _held = HeldRigs::of_file(&rig)?;
    let found = weigh_rig(&rig, &drivers, &mut terminal, mass_g)?;
    output::write_as(args.output.format, args.output.path.as_deref(), |out| {
        report::rig::weight(&found, args.output.format, out)
    })?;
    if found.problem.is_some() {
        return Ok(exit::CHECK_FAILED);
    }
    let rig = shown(&args.rig);
    let Some(text) = &found.text else {
        anyhow::bail!(
            "{rig}: cannot write `weighing` after the `driver` of [force]; give the transducer its own table [force], delete any table [force.weighing], and weigh again"
        );
    };
    super::write_anew(&args.rig, text)?;
    context.say(format_args!("{rig}: written"));
    Ok(exit::DONE)
}
