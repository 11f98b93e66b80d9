//! Reads the named scene: a file or a built-in scene.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use taceva_acquire::{Overrides, PlannedScene, PlannedStudy, SceneText};
use taceva_core::{Field, SkipReason, by_count, counted, shown, whole_size};
use taceva_drivers::Drivers;
use taceva_metrics::LEAST_CLUSTERS;
use taceva_models::{SplitInput, SplitSpec};
use taceva_protocol::{
    BuiltinScene, DepthOrigin, PhaseKind, Plan, PlanReason, PlannedPress, RigLimits, Subject,
    calm_threshold_n,
};

use super::{Context, Usage};
use crate::args::{Run, SceneArgs};
use crate::disk_space::{self, Need};

/// Plans the scene of `args` with `drivers`.
pub(super) fn planned(args: &SceneArgs, drivers: &Drivers) -> anyhow::Result<PlannedScene> {
    let instead = Overrides {
        seed: args.seed,
        rig: args.rig.clone(),
        ..Overrides::default()
    };
    Ok(PlannedScene::with(text(&args.scene)?, drivers, &instead)?)
}

/// Plans the scene of a run, with the overrides of the arguments.
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
/// If the pictures exceed the free space on this disk.
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
        "time: {}, {:.0} min of motion on a rig; the simulated bench runs faster",
        counted(presses, "press"),
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
            "rig: {}: at most {} mm deep, {} N normal and {} N shear, {} mm/s in the air and {} mm/s in contact; overrun in contact up to {:.3} mm",
            shown(rig.name()),
            limits.depth_max.0,
            limits.normal_max.0,
            limits.shear_max.0,
            limits.speed_max_mm_s,
            study.plan.contact.speed_mm_s.value,
            limits.overshoot.healthy_mm,
        ));
        context.say(format_args!("rig: {}", threshold(&study.plan, limits)));
        if let Some(line) = late_zero(&study.plan) {
            context.say(format_args!("rig: {line}"));
        }
        if let Some(line) = shifted(&study.plan) {
            context.say(format_args!("rig: {line}"));
        }
        if let Some(wear) = &study.plan.wear {
            context.say(format_args!("rig: {wear}"));
        }
        if study.is_untaught(drivers) {
            context.say(format_args!(
                "rig: `origin_mm` and `axes` still have the values of a new file: run `taceva rig teach {}` before a run",
                shown(rig.name())
            ));
        }
        let by_changer = study.by_changer(drivers);
        for change in by_changer.into_iter().chain(study.by_hand(drivers)) {
            context.say(format_args!("rig: {change}"));
        }
        context.say(format_args!(
            "rig: taceva is not a safety function; the emergency stop and the guards of the site must work without it (docs/rig.md)"
        ));
    }
}

/// Text on the force that halts the robot in the air, compared with the noise of the transducer.
fn threshold(plan: &Plan, limits: &RigLimits) -> String {
    let threshold_n = plan.contact.threshold_n.value;
    let noise_n = limits.signals.force_noise_n;
    match calm_threshold_n(noise_n, threshold_n) {
        Some(calm_n) => format!(
            "5 times the stated noise of the transducer, {noise_n} N, exceeds `threshold_N` = {threshold_n}: write threshold_N = {calm_n} under [protocol.contact] of the scene"
        ),
        None => format!(
            "a force above `threshold_N` = {threshold_n} under [protocol.contact] halts the robot in the air; 5 times the noise that taceva rig check prints must be below it"
        ),
    }
}

/// Text for a plan whose depths start at the first contact force, below the surface; `None` if depths start at the surface.
fn late_zero(plan: &Plan) -> Option<String> {
    let contact = &plan.contact;
    (contact.depth_from.value == DepthOrigin::Contact).then(|| {
        format!(
            "depths and the limit of depth count from the first force above {} N, which can lie a step of {} mm or more below the surface. Write depth_from = \"surface\" under [protocol.contact] of the scene",
            contact.threshold_n.value, contact.step_mm.value
        )
    })
}

/// Text on the presses of `plan` with a lateral motion in contact; `None` without such presses.
fn shifted(plan: &Plan) -> Option<String> {
    let shears = plan.presses.iter();
    let shears = shears.map(|planned| planned.press.greatest_shear_mm());
    let shears: Vec<f64> = shears.filter(|shear_mm| *shear_mm > 0.0).collect();
    let greatest_mm = shears.iter().copied().fold(0.0, f64::max);
    (!shears.is_empty()).then(|| {
        format!(
            "after a sample straight down, {} {} sideways in contact, by up to {greatest_mm:.2} mm, for a second sample; `shear_mm` of the phase sets this distance, and 0 omits the motion",
            counted(shears.len(), "press"),
            by_count(shears.len(), "moves", "move")
        )
    })
}

/// Rejects a scene without any metric or task to measure.
///
/// # Errors
/// [`Usage`] with the missing line of the footprint, or otherwise the most frequent reason for a skipped metric.
pub(super) fn check_metrics(planned: &PlannedScene) -> anyhow::Result<()> {
    let studies = &planned.studies;
    let is_measured =
        |plan: &Plan| !plan.metrics.is_empty() || plan.phases.iter().any(|kind| kind.is_of_task());
    if studies.iter().any(|study| is_measured(&study.plan)) {
        return Ok(());
    }
    let mut reasons: BTreeMap<String, usize> = BTreeMap::new();
    for skip in studies.iter().flat_map(|study| &study.plan.skipped) {
        let is_wanted = skip.reason != PlanReason::Skip(SkipReason::NotWanted);
        if is_wanted && matches!(skip.subject, Subject::Metric(_)) {
            *reasons.entry(skip.reason.to_string()).or_default() += 1;
        }
    }
    // A missing footprint has priority, because its message names the line to write.
    let unwritten = PlanReason::Skip(SkipReason::FactAbsent("footprint")).to_string();
    let most = match reasons.remove_entry(&unwritten) {
        None => reasons.into_iter().max_by_key(|(_, metrics)| *metrics),
        written => written,
    };
    let reason = most.map_or_else(|| "no metric is requested".to_owned(), |(reason, _)| reason);
    Err(Usage::error(format!(
        "{}: no metric is kept, so nothing would be measured: {reason}",
        shown(&planned.text.name)
    )))
}

/// Prints a warning for each study whose test part has too few contact points for intervals.
pub(super) fn warn_of_few_points(planned: &PlannedScene, context: &Context) {
    for study in &planned.studies {
        let Some(points) = tested_points(study).filter(|points| *points < LEAST_CLUSTERS) else {
            continue;
        };
        let enough = points_for(LEAST_CLUSTERS, study);
        context.say(format_args!(
            "{}: the test part has {}, and intervals need {LEAST_CLUSTERS}: raise `points` under [protocol.calibration] to {enough}, or score every point of the recording afterwards (taceva evaluate, --split cv:{LEAST_CLUSTERS})",
            shown(&study.plan.name),
            counted(points, "contact point")
        ));
    }
}

/// Number of contact points in the test part of the fit; `None` if no metric uses predictions of the test part, or if folds test every point.
fn tested_points(study: &PlannedStudy) -> Option<usize> {
    let plan = &study.plan;
    let mut metrics = plan.metrics.iter();
    if !has_test_part(plan) || !metrics.any(|metric| metric.phase == PhaseKind::Calibration) {
        return None;
    }
    let presses = tested_presses(study)?;
    let points = presses.iter().map(|planned| planned.press.point_id());
    Some(points.collect::<BTreeSet<String>>().len())
}

/// Presses of the test part of a fit; `None` if they cannot be divided. Their number does not depend on the seed.
pub(super) fn tested_presses(study: &PlannedStudy) -> Option<Vec<&PlannedPress>> {
    let plan = &study.plan;
    let presses: Vec<&PlannedPress> = plan.presses_of(PhaseKind::Calibration).collect();
    let points = presses.iter().map(|planned| planned.press.point_id());
    let points: Vec<String> = points.collect();
    let input = SplitInput {
        rows: points.len(),
        points: Some(&points),
        ..SplitInput::default()
    };
    // A run itself rejects presses that cannot be divided.
    let split = split_of(study)?.assign(&input, 0).ok()?;
    Some(split.test.iter().map(|row| presses[*row]).collect())
}

/// Split of the contact points for the model of `study`; `None` without a model.
fn split_of(study: &PlannedStudy) -> Option<SplitSpec> {
    let model = study.study.model.as_ref()?;
    let split = model.split.as_ref();
    split.map_or("by-point", |split| &split.value).parse().ok()
}

/// True if one model is fitted and scored on its test part alone.
pub(super) fn has_test_part(plan: &Plan) -> bool {
    let mut fits = plan.fits.iter();
    fits.any(|fit| fit.field == Field::Prediction && fit.folds.is_none())
}

/// Share of the contact points that are scored: the share of the test part, or 1 without a test part.
pub(super) fn test_share(study: &PlannedStudy) -> f64 {
    let split = split_of(study).filter(|_| has_test_part(&study.plan));
    split.map_or(1.0, |split| {
        let [_, _, test] = split.fractions.shares();
        test
    })
}

/// Number of contact points of `study` that are needed to score `tested` of them.
pub(super) fn points_for(tested: usize, study: &PlannedStudy) -> usize {
    // The share is rounded in binary64, which the subtraction allows for.
    whole_size((tested as f64 / test_share(study) - 1e-9).ceil())
}

/// Text of the scene `named`. A file with this name has priority over a built-in scene.
pub(super) fn text(named: &str) -> anyhow::Result<SceneText> {
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
