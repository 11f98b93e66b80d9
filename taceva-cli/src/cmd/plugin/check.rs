//! `taceva plugin check`.

use std::collections::BTreeMap;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::thread;
use std::time::Duration;

use taceva_conformance::{CheckRequest, Outcome};
use taceva_core::DriverKey;
use taceva_drivers::Selector;

use crate::args::{ListFormat, PluginCheck};
use crate::cmd::{Context, Usage};
use crate::{exit, output, report, stderr};

/// Time after which the name of a check that still runs is printed.
const LONG: Duration = Duration::from_secs(10);

pub(super) fn run(args: &PluginCheck, context: &Context) -> anyhow::Result<u8> {
    let to = &args.output;
    output::check_all_free(&to.path, to.force)?;
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
    let (running, names) = mpsc::channel();
    if !context.quiet {
        // Where no thread can be started, the results alone are shown.
        drop(thread::Builder::new().spawn(move || name_long_checks(&names)));
    }
    // Without a receiver nothing is named.
    let mut begin = |name: &str| drop(running.send(Some(name.to_owned())));
    taceva_conformance::check(&host, plugin, &request, &mut begin, &mut |result| {
        drop(running.send(None));
        if is_watched {
            // A closed standard output is reported by the summary.
            let _ = output::write(None, |out| report::plugin_check::line(&result, out));
        }
        results.push(result);
    })?;
    if results.is_empty() {
        return Err(Usage::error(format!(
            "--only {}: expected the beginning of the name of a check; run without --only to list all checks",
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

/// Prints the name of each check that runs for long, until the sender is dropped. The sender sends the name of a check at its start, and `None` at
/// its end.
fn name_long_checks(names: &Receiver<Option<String>>) {
    let mut running = None;
    loop {
        match names.recv_timeout(LONG) {
            Ok(name) => running = name,
            Err(RecvTimeoutError::Timeout) => {
                if let Some(name) = running.take() {
                    stderr::say(format_args!(
                        "still checking {name}; `--limit SECONDS` sets the time that a check may take"
                    ));
                }
            }
            Err(RecvTimeoutError::Disconnected) => return,
        }
    }
}
