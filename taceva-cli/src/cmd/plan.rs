//! `taceva plan`.

use std::collections::BTreeSet;
use std::path::Path;

use taceva_acquire::PlannedScene;
use taceva_drivers::{Drivers, Selector};
use taceva_host::PluginHost;
use taceva_study::check_models;

use super::plugins::models_with;
use super::{Context, run, scene, widths};
use crate::args::PlanArgs;
use crate::{exit, output, report, stderr};

pub(crate) fn run(args: &PlanArgs, context: &Context) -> anyhow::Result<u8> {
    let to = &args.output;
    output::check_all_free(&to.path, to.force)?;
    let host = context.plugins(Some(Path::new(&args.scene.scene)))?;
    let drivers = Drivers::builtin()?.with_plugins(&host)?;
    let planned = scene::planned(&args.scene, &drivers)?;
    check_models(&planned, &models_with(&host))?;
    run::faults::check(&planned, &drivers)?;
    run::faults::plugin_faults(&planned, &host.models())?;
    scene::print_cost(&planned, Path::new("."), context)?;
    run::faults::print_cost(&planned, context)?;
    scene::print_rigs(&planned, &drivers, context);
    scene::warn_of_few_points(&planned, context);
    widths::print_expected(&planned, args.scene.from.as_deref(), &drivers, context)?;
    output::write_as(to.format, to.path.as_deref(), |out| {
        report::plan::write(&planned, to.format, out)
    })?;
    if say_withheld(&planned, &host) {
        return Ok(exit::CHECK_FAILED);
    }
    scene::check_metrics(&planned)?;
    Ok(exit::DONE)
}

/// Prints each device of the scene with needs that the user does not allow. True if there is such a device.
fn say_withheld(planned: &PlannedScene, host: &PluginHost) -> bool {
    let mut said = BTreeSet::new();
    for (_, device) in planned.scene.drivers() {
        let Ok(selector) = device.value.parse::<Selector>() else {
            continue;
        };
        let Some(withheld) = host.withheld_from(selector.driver(), selector.arguments()) else {
            continue;
        };
        let needs: Vec<String> = withheld.needs().iter().map(ToString::to_string).collect();
        if !needs.is_empty() {
            let (driver, needs) = (selector.driver(), needs.join(", "));
            said.insert(format!(
                "{driver}: needs {needs}, which is not allowed; {withheld}"
            ));
        }
    }
    for line in &said {
        stderr::say(format_args!("{line}"));
    }
    !said.is_empty()
}
