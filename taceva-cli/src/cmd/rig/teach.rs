//! `taceva rig teach`.

use taceva_acquire::{HeldRigs, read_rig, teach_rig};
use taceva_core::shown;
use taceva_drivers::Drivers;

use crate::args::RigTeachArgs;
use crate::cmd::{Context, Usage, operator};
use crate::exit;

pub(super) fn run(args: &RigTeachArgs, context: &Context) -> anyhow::Result<u8> {
    let host = context.plugins(None)?;
    let drivers = Drivers::builtin()?.with_plugins(&host)?;
    let rig = read_rig(&args.rig)?;
    super::check_replaceable(&args.rig)?;
    let Some(mut terminal) = operator::terminal(None) else {
        return Err(Usage::error(
            "a person confirms each jog of the robot: start `taceva rig teach` from a terminal",
        ));
    };
    let _held = HeldRigs::of_file(&rig)?;
    let (taught, text) = teach_rig(&rig, &drivers, &mut terminal)?;
    super::write_anew(&args.rig, &text)?;
    let [x, y, z] = taught.origin_mm;
    context.say(format_args!(
        "{}: origin_mm = [{x:?}, {y:?}, {z:?}], axes = {}; both jogs ended within {:.2} mm of an axis",
        shown(&args.rig),
        taught.axes,
        taught.residual_mm
    ));
    context.say(format_args!(
        "now raise the tip by a centimetre, then run taceva rig check {}. `axes` of [force] are not taught: the gentle touch at the start of rig tap or run checks them and prints the line to write",
        shown(&args.rig)
    ));
    Ok(exit::DONE)
}
