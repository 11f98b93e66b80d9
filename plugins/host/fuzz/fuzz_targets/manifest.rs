//! Fuzzes the parsers of manifests, library descriptions and plugin settings: `cargo +nightly fuzz run manifest`.

#![no_main]

use taceva_host::{Manifest, PluginConfig, PluginId, Provided};

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let Ok(text) = std::str::from_utf8(bytes) else {
        return;
    };
    if let Ok(manifest) = Manifest::parse(text) {
        // Each key of an accepted manifest begins with the id of the plugin.
        for provided in &manifest.provides {
            assert!(provided.key().as_str().starts_with(manifest.id.as_str()));
        }
    }
    let id: PluginId = "org.example.fuzz".parse().expect("an id");
    let _ = Provided::parse(text, &id);
    let _ = PluginConfig::parse(text);
});
