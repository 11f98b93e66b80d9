//! Accessibility checks by axe-core, for screen readers, keyboards and contrast.

use std::path::PathBuf;
use std::process::Command;

use serde_json::{Value, json};

use taceva_needs::Browser;

/// Source of axe-core, from the file in `TACEVA_AXE` or from node. The error states why there is none.
pub(crate) fn source() -> Result<String, String> {
    let path = match std::env::var_os("TACEVA_AXE") {
        Some(path) => PathBuf::from(path),
        None => found_by_node()?,
    };
    std::fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))
}

fn found_by_node() -> Result<PathBuf, String> {
    let script = "process.stdout.write(require.resolve('axe-core/axe.min.js'))";
    let ran = Command::new("node").args(["-e", script]).output();
    match ran {
        Ok(ran) if ran.status.success() => {
            Ok(PathBuf::from(String::from_utf8_lossy(&ran.stdout).as_ref()))
        }
        Ok(_) => Err(
            "node finds no axe-core; `npm install axe-core`, or name axe.min.js by TACEVA_AXE"
                .to_owned(),
        ),
        Err(error) => Err(format!("node: {error}")),
    }
}

/// Fails if axe-core finds a violation on the open page in light or dark mode, or does not find a planted violation.
pub(crate) fn assert_accessible(browser: &mut Browser, axe: &str, page: &str) {
    browser.evaluate(&format!("{axe};0"));
    for scheme in ["light", "dark"] {
        let features = json!([{"name": "prefers-color-scheme", "value": scheme}]);
        browser.call("Emulation.setEmulatedMedia", json!({"features": features}));
        assert_eq!(violations(browser), json!([]), "{page}, {scheme}");
    }
    browser.evaluate("document.querySelector('main').append(document.createElement('img'))");
    let planted = violations(browser);
    let planted = planted[0].as_str().unwrap_or_default();
    assert!(planted.starts_with("image-alt"), "{page}: {planted}");
}

/// Violated rules, each with its first elements.
fn violations(browser: &mut Browser) -> Value {
    browser.evaluate(
        "axe.run(document, {resultTypes: ['violations']}).then((found) => found.violations.map((one) =>
            `${one.id}: ${one.help}: ` + one.nodes.slice(0, 3).map((node) => node.html.slice(0, 160)).join(' | ')))",
    )
}
