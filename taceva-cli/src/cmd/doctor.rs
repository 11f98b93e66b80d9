//! `taceva doctor`.

use taceva_drivers::Drivers;
use taceva_drivers::doctor::{Diagnosis, Machine, State, examine, examine_plugins};
use taceva_host::PluginHost;

use super::Context;
use crate::args::{ListFormat, Output};
use crate::{exit, output, report};

pub(crate) fn run(args: &Output<ListFormat>, context: &Context) -> anyhow::Result<u8> {
    output::check_all_free(&args.path, args.force)?;
    let host = context.plugins(None)?;
    let drivers = Drivers::builtin()?.with_plugins(&host)?;
    let mut findings = examine(&drivers, &Machine::this());
    findings.extend(examine_plugins(&host));
    findings.extend(permissions(&host));
    output::write_as(args.format, args.path.as_deref(), |out| {
        report::devices::findings(&findings, args.format, out)
    })?;
    let is_problem = findings
        .iter()
        .any(|finding| finding.state == State::Problem);
    Ok(if is_problem {
        exit::CHECK_FAILED
    } else {
        exit::DONE
    })
}

/// Diagnosis of the plugins with needs that the user does not allow.
fn permissions(host: &PluginHost) -> Vec<Diagnosis> {
    let findings = host.plugins().iter().filter_map(|plugin| {
        let remedy = report::plugin::remedy(host, plugin)?;
        let needs = host.withheld(plugin);
        let needs: Vec<String> = needs.needs().iter().map(ToString::to_string).collect();
        Some(Diagnosis {
            code: "plugin-needs",
            state: State::Problem,
            subject: plugin.id().to_string(),
            detail: format!("needs {}, which is not allowed", needs.join(", ")),
            remedy: Some(remedy),
        })
    });
    findings.collect()
}
