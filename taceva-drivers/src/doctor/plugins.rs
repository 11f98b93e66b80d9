//! Diagnosis of the isolation of plugins.

use std::sync::Arc;

use taceva_host::{Keeping, PluginHost};

use super::{Diagnosis, State};

/// Reports the isolation in which each plugin of `host` would run, and each plugin in quarantine. Loads no plugin.
pub fn examine_plugins(host: &Arc<PluginHost>) -> Vec<Diagnosis> {
    let findings = host.plugins().iter().map(|plugin| {
        let id = plugin.id();
        let keeping = host.keeping(plugin);
        let (state, detail, remedy) = match &keeping {
            Keeping::Trusted(_) | Keeping::Apart(_) | Keeping::Confined(_) => {
                (State::Good, format!("runs {keeping}"), None)
            }
            Keeping::Refused(_) => {
                let place = match (plugin.library(), &plugin.interpreter) {
                    (Some(_), _) => Some("in this process"),
                    (None, Some(_)) => Some("in a process of its own"),
                    (None, None) => None,
                };
                let remedy =
                    place.map(|place| format!("`--trust {id}` runs it unconfined, {place}"));
                (State::Problem, keeping.to_string(), remedy)
            }
        };
        let finding = Diagnosis {
            code: "plugin-isolation",
            state,
            subject: id.to_string(),
            detail,
            remedy,
        };
        let quarantined = host.quarantined(plugin).map(|reason| Diagnosis {
            code: "plugin-quarantined",
            state: State::Problem,
            subject: id.to_string(),
            detail: format!("is in quarantine and does not start: {reason}"),
            remedy: Some(format!("`taceva plugin release {id}` lets it start again")),
        });
        [Some(finding), quarantined]
    });
    findings.flatten().flatten().collect()
}
