//! The simulated bench under `taceva plugin check`.

use taceva_conformance::{CheckRequest, Outcome};
use tempfile::TempDir;

use crate::built::{Delivery, host, lay_bench};

pub(crate) fn every_device_of_the_bench_passes_every_check_of_plugins() {
    let folder = TempDir::new().expect("a folder");
    lay_bench(folder.path(), &[]);
    let host = host(folder.path(), Delivery::Child);
    let plugin = host.plugins().iter().next().expect("one plugin");
    let mut made = 0;
    let mut failed = Vec::new();
    taceva_conformance::check(&host, plugin, &CheckRequest::default(), &mut |result| {
        made += 1;
        if let Outcome::Failed(why) = &result.outcome {
            failed.push(format!("{} of {:?}: {why}", result.check, result.subject));
        }
    })
    .expect("it can be checked");
    assert!(failed.is_empty(), "{}", failed.join("\n"));
    assert!(made > 100, "{made} checks of seven devices");
}
