//! `taceva plugin check`.

use std::collections::BTreeMap;
use std::time::Duration;

use taceva_conformance::{CheckRequest, Outcome};
use taceva_core::DriverKey;
use taceva_drivers::Selector;

use crate::args::{ListFormat, PluginCheck};
use crate::cmd::{Context, Usage};
use crate::{exit, output, report};

pub(super) fn run(args: &PluginCheck, context: &Context) -> anyhow::Result<u8> {
    let to = &args.output;
    if let Some(path) = to.path.as_deref() {
        output::check_free(path, to.force)?;
    }
    let host = context.plugins(None)?;
    let plugin = host.plugins().get(&args.id)?;
    let mut arguments = BTreeMap::new();
    for words in &args.arguments {
        let selector: Selector = words
            .parse()
            .map_err(|error| Usage::error(format!("--with {words}: {error}")))?;
        let key: DriverKey = (selector.driver().parse())
            .map_err(|error| Usage::error(format!("--with {words}: {error}")))?;
        arguments.insert(key, selector.arguments().to_owned());
    }
    let request = CheckRequest {
        seed: args.seed.value,
        only: args.only.clone(),
        arguments,
        moves: args.moves,
        limit: Duration::from_secs(args.limit),
    };
    // On standard output each check is printed when it is finished; JSON and files are written at the end.
    let is_watched = to.format == ListFormat::Text && to.path.is_none();
    let mut results = Vec::new();
    taceva_conformance::check(&host, plugin, &request, &mut |result| {
        if is_watched {
            // A closed standard output is reported by the summary.
            let _ = output::write(None, |out| report::plugin_check::line(&result, out));
        }
        results.push(result);
    })?;
    if results.is_empty() {
        return Err(Usage::error(format!(
            "--only {}: no check of this plugin has such a name",
            args.only.join(",")
        )));
    }
    output::write_as(to.format, to.path.as_deref(), |out| {
        report::plugin_check::write(
            &args.id,
            args.seed.value,
            &results,
            is_watched,
            to.format,
            out,
        )
    })?;
    let failed = |outcome: &Outcome| matches!(outcome, Outcome::Failed(_));
    Ok(if results.iter().any(|result| failed(&result.outcome)) {
        exit::CHECK_FAILED
    } else {
        exit::DONE
    })
}
