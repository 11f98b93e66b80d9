//! The named scene: a file or a built-in one.

use std::path::Path;

use taceva_acquire::{Overrides, PlannedScene, SceneText};
use taceva_core::shown;
use taceva_drivers::Drivers;
use taceva_protocol::BuiltinScene;

use super::{Context, Usage};
use crate::args::{Run, SceneArgs};
use crate::disk_space::{self, Need};

/// The scene of `args`, planned with `drivers`.
pub(super) fn planned(args: &SceneArgs, drivers: &Drivers) -> anyhow::Result<PlannedScene> {
    let instead = Overrides {
        seed: args.seed,
        rig: args.rig.clone(),
        ..Overrides::default()
    };
    Ok(PlannedScene::with(text(&args.scene)?, drivers, &instead)?)
}

/// The scene of a run, with its overrides.
pub(super) fn to_run(args: &Run, drivers: &Drivers) -> anyhow::Result<PlannedScene> {
    let instead = Overrides {
        seed: args.scene.seed,
        rig: args.scene.rig.clone(),
        model: args.model.clone(),
        set: args.set.clone(),
        seeds: args.seeds.clone().map_or_else(Vec::new, |seeds| seeds.0),
    };
    Ok(PlannedScene::with(
        text(&args.scene.scene)?,
        drivers,
        &instead,
    )?)
}

/// Prints the cost of a scene: presses, the time of their motion on a rig, and bytes on the disk of `target`.
///
/// # Errors
/// If its pictures exceed the free space there.
pub(super) fn print_cost(
    planned: &PlannedScene,
    target: &Path,
    context: &Context,
) -> anyhow::Result<()> {
    let costs = || planned.studies.iter().map(|study| study.plan.cost);
    let presses: u64 = costs().map(|cost| cost.presses).sum();
    if presses == 0 {
        return Ok(());
    }
    let minutes: f64 = costs().map(|cost| cost.minutes).sum();
    context.say(format_args!(
        "time: {presses} presses, {:.0} min of motion on a rig; the simulated bench runs faster",
        minutes.ceil()
    ));
    let bytes = costs().filter_map(|cost| cost.bytes).sum();
    let need = Need::of_pictures(bytes);
    if let Some(room) = need.hold_against(disk_space::free(target), target)? {
        context.say(format_args!("disk: {room}"));
    }
    Ok(())
}

/// Prints the limits and the manual steps of real rigs, before any motion.
pub(super) fn print_rigs(planned: &PlannedScene, drivers: &Drivers, context: &Context) {
    for study in &planned.studies {
        let (Some(rig), Some(limits)) = (study.rig(), &study.plan.limits) else {
            continue;
        };
        context.say(format_args!(
            "rig: {}: at most {} mm deep, {} N normal and {} N shear, {} mm/s in the air and {} mm/s in contact, where the tip may overrun by {:.3} mm",
            shown(rig.name()),
            limits.depth_max.0,
            limits.normal_max.0,
            limits.shear_max.0,
            limits.speed_max_mm_s,
            study.plan.contact.speed_mm_s.value,
            limits.overshoot.healthy_mm,
        ));
        let by_changer = study.by_changer(drivers);
        for change in by_changer.into_iter().chain(study.by_hand(drivers)) {
            context.say(format_args!("rig: {change}"));
        }
        context.say(format_args!(
            "rig: taceva is no safety function; the emergency stop and the guards of the site must hold without it (docs/rig.md)"
        ));
    }
}

/// The text of a scene; a file of that name comes first, so that a built-in scene never hides it.
fn text(named: &str) -> anyhow::Result<SceneText> {
    let path = Path::new(named);
    if path.is_file() {
        return Ok(SceneText::read(path)?);
    }
    if let Some(builtin) = BuiltinScene::from_name(named) {
        return Ok(SceneText::builtin(builtin));
    }
    if path.extension().is_none() && path.components().count() == 1 {
        let known = BuiltinScene::ALL.map(BuiltinScene::name).join(", ");
        return Err(Usage::error(format!(
            "`{}`: no such scene, expected a file or one of {known}",
            taceva_core::shown(named)
        )));
    }
    Ok(SceneText::read(path)?)
}
