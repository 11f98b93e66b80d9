//! The simulated bench and the C example pass `taceva plugin check`.

use std::sync::Arc;

use taceva_conformance::{CheckRequest, Outcome};
use taceva_host::PluginHost;
use tempfile::TempDir;

use crate::built::{Delivery, host, lay_bench, lay_c};

/// Number of executed checks of the only plugin of `host`, and the failed checks with their reasons.
fn checked(host: &Arc<PluginHost>) -> (usize, Vec<String>) {
    let plugin = host.plugins().iter().next().expect("one plugin");
    let mut made = 0;
    let mut failed = Vec::new();
    let request = CheckRequest::default();
    taceva_conformance::check(host, plugin, &request, &mut |_| {}, &mut |result| {
        made += 1;
        if let Outcome::Failed(why) = &result.outcome {
            failed.push(format!("{} of {:?}: {why}", result.check, result.subject));
        }
    })
    .expect("it can be checked");
    (made, failed)
}

pub(crate) fn every_device_of_the_bench_passes_every_check_of_plugins() {
    let folder = TempDir::new().expect("a folder");
    lay_bench(folder.path(), &[]);
    let (made, failed) = checked(&host(folder.path(), Delivery::Child));
    assert!(failed.is_empty(), "{}", failed.join("\n"));
    assert!(made > 100, "{made} checks of seven devices");
}

pub(crate) fn one_of_each_kind_in_c_passes_every_check_of_plugins() {
    let folder = TempDir::new().expect("a folder");
    if !lay_c(&folder.path().join("c"), "plain", "cc", "-O2") {
        return;
    }
    let host = host(folder.path(), Delivery::Child);
    let plugin = host.plugins().iter().next().expect("one plugin");
    assert_eq!(plugin.manifest.drivers().count(), 5);
    let (made, failed) = checked(&host);
    assert!(failed.is_empty(), "{}", failed.join("\n"));
    assert!(made > 100, "{made} checks of five devices and an estimator");
}
