//! The manifest equals the descriptions of the drivers. `TACEVA_BLESS=1` rewrites it.

use std::fs;
use std::path::Path;

use taceva_core::{Descriptor, Factory};
use taceva_plugin::provides_table;
use taceva_sim::{ForceTransducerFactory, LightingFactory, Model, RobotFactory, SensorFactory};

const HEAD: &str = r#"manifest_version = 1
id = "org.taceva.sim"
name = "the simulated bench"
version = "{version}"
license = "MIT OR Apache-2.0"
abi = { major = 1, minor = 0 }

[library]
linux-x86_64 = { path = "libtaceva_sim_plugin.so" }
linux-aarch64 = { path = "libtaceva_sim_plugin.so" }
macos-x86_64 = { path = "libtaceva_sim_plugin.dylib" }
macos-aarch64 = { path = "libtaceva_sim_plugin.dylib" }
windows-x86_64 = { path = "taceva_sim_plugin.dll" }
"#;

fn descriptors() -> Vec<Descriptor> {
    let mut list: Vec<Descriptor> = Model::ALL
        .map(|model| {
            SensorFactory::new(model)
                .expect("a driver")
                .descriptor()
                .clone()
        })
        .into();
    list.push(RobotFactory::new().expect("a driver").descriptor().clone());
    list.push(
        ForceTransducerFactory::new()
            .expect("a driver")
            .descriptor()
            .clone(),
    );
    list.push(
        LightingFactory::new()
            .expect("a driver")
            .descriptor()
            .clone(),
    );
    list
}

pub(crate) fn the_manifest_says_what_the_drivers_say_of_themselves() {
    let mut expected = HEAD.replace("{version}", env!("CARGO_PKG_VERSION"));
    for descriptor in descriptors() {
        let table = provides_table(&descriptor).replace("\n[[args]]", "\n[[provides.args]]");
        expected.push_str("\n[[provides]]\n");
        expected.push_str(&table);
    }
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("plugin.toml");
    if std::env::var_os("TACEVA_BLESS").is_some() {
        fs::write(&path, &expected).expect("write the manifest");
    }
    assert_eq!(fs::read_to_string(&path).expect("the manifest"), expected);
}
