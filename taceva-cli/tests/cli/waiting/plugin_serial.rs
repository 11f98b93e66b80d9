//! The transducer in `examples/plugins/serial-line-c`: built as its page says, allowed, and read through a port to which the test writes.

#![cfg(target_os = "linux")]

use std::fs::{self, File};
use std::io::Write;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::process::Command;
use std::thread;
use std::time::Duration;

use crate::support::Bench;
use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
use taceva_needs::{Need, skip};

const KEY: &str = "org.example.serial-line-c/line";

/// A port to which `line` comes every 10 ms.
fn port(line: &str) -> String {
    let line = line.to_owned();
    let master = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY).expect("a terminal");
    grantpt(&master).expect("ours");
    unlockpt(&master).expect("ours");
    let name = ptsname(&master, Vec::new()).expect("it has a name");
    let name = name.to_str().expect("plain").to_owned();
    fs::set_permissions(&name, fs::Permissions::from_mode(0o666)).expect("ours");
    // Held open, so that the port does not close with its first user.
    let held = File::options().write(true).open(&name).expect("a port");
    // The thread ends with the test.
    thread::spawn(move || {
        let _held = held;
        let mut master = File::from(master);
        while master.write_all(line.as_bytes()).is_ok() {
            thread::sleep(Duration::from_millis(10));
        }
    });
    name
}

#[test]
fn a_transducer_on_a_serial_port_in_c_is_built_as_its_page_says_and_keeps_its_promises() {
    if let Err(error) = Command::new("cc").arg("--version").output() {
        skip(Need::CCompiler, format!("`cc`: {error}"));
        return;
    }
    let bench = Bench::new();
    let example = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/plugins/serial-line-c");
    let read = |file: &str| fs::read_to_string(example.join(file)).expect(file);
    bench.write("line/line.c", &read("line.c"));
    bench.write("line/plugin.toml", &read("plugin.toml"));
    let page = read("README.md");
    let commands = page.split("```").nth(1).expect("commands").trim();
    let built = bench.shell(&format!("cd line && {}", commands.replace('\n', " && ")));
    assert_eq!(built.code, 0, "{}{}", built.out, built.err);

    let check = |port: &str, only: &str| {
        format!(
            "plugin check org.example.serial-line-c --plugin-dir line --only {only} --with {KEY}:port={port}"
        )
    };
    let sound = port("1.234\r\n");
    let refused = bench.run(&check(&sound, "driver/opens"));
    assert_eq!(refused.code, 1, "{}", refused.out);
    assert_eq!(bench.paste(&refused.out).code, 0);
    let only = "library/,driver/,force/reads,force/measures,force/stamps,force/keeps-deadlines";
    let checked = bench.json(&check(&sound, only));
    let results = checked["results"].as_array().expect("a list");
    for name in [
        "force/reads",
        "force/measures-what-it-says",
        "force/stamps-by-the-clock",
        "force/keeps-deadlines",
    ] {
        let found = results.iter().find(|result| result["check"] == name);
        let found = found.expect(name);
        assert_eq!(found["outcome"], "passed", "{found}");
    }

    let endless = "1.234 ".repeat(100);
    for (line, words) in [
        ("hello\n", "10 lines in a row are no number"),
        (endless.as_str(), "4096 bytes without a line feed"),
        ("", "no line came in time"),
    ] {
        let port = port(line);
        bench.ok(&format!(
            "plugin allow org.example.serial-line-c serial:{port} --plugin-dir line"
        ));
        let failed = bench.run(&check(&port, "force/reads"));
        assert_eq!(failed.code, 1, "{}", failed.out);
        assert!(failed.out.contains(words), "{words}: {}", failed.out);
    }
}
