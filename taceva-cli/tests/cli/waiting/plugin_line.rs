//! The driver in `examples/plugins/line-transducer`, written by the guide alone: built, refused, allowed, checked and planned with.

#![cfg(target_os = "linux")]

use std::fs;
use std::io::Write;
use std::net::TcpListener;
use std::path::Path;
use std::thread;
use std::time::Duration;

use crate::support::Bench;

const KEY: &str = "org.example.line-transducer/line-transducer";

/// Starts a device on loopback that sends the text of `line` for each number, 200 times a second, to every client. Returns its port.
fn device(line: fn(u64) -> String) -> u16 {
    let listener = TcpListener::bind("127.0.0.1:0").expect("a port");
    let port = listener.local_addr().expect("bound").port();
    // The thread ends with the test.
    thread::spawn(move || {
        for stream in listener.incoming() {
            let mut stream = stream.expect("a connection");
            thread::spawn(move || {
                let mut number = 0;
                while stream.write_all(line(number).as_bytes()).is_ok() {
                    number += 1;
                    thread::sleep(Duration::from_millis(5));
                }
            });
        }
    });
    port
}

fn resting(number: u64) -> String {
    format!("{number};0.01;-0.02;1.5;0.001;0;0\n")
}

#[test]
fn the_example_is_allowed_checked_and_planned_with_and_says_what_is_wrong_with_its_device() {
    let bench = Bench::new();
    bench.make_example("force", "line-transducer");
    let folder = "--plugin-dir line-transducer";
    assert_eq!(bench.run("plugin manifest line-transducer").code, 0);

    // By a host name, which a confined process could not resolve.
    let port = device(resting);
    let check = format!(
        "plugin check {ID} {folder} --with {KEY}:host=localhost;port={port}",
        ID = "org.example.line-transducer"
    );
    let refused = bench.run(&check);
    assert_eq!(refused.code, 1, "{}", refused.out);
    assert_eq!(refused.out.matches("FAIL").count(), 1, "{}", refused.out);
    assert_eq!(bench.paste(&refused.out).code, 0);
    let checked = bench.ok(&format!(
        "{check} --only library/,driver/,force/reads,force/measures,force/stamps,force/numbers"
    ));
    assert!(
        checked.contains("pass") && checked.contains("force/numbers-its-readings"),
        "{checked}"
    );

    // The driver reports every invalid reading, whatever follows.
    for (line, words) in [
        (
            (|_| "hello\n".to_owned()) as fn(u64) -> String,
            "expected a number, three forces and three torques",
        ),
        (
            |_| "x".repeat(4096),
            "expected a number, three forces and three torques",
        ),
        (
            |number| format!("{number};NaN;0;0;0;0;0\n"),
            "expected a number, three forces and three torques",
        ),
        (
            |_| "7;0;0;1;0;0;0\n".to_owned(),
            "two readings have the number 7",
        ),
    ] {
        let port = device(line);
        bench.ok(&format!(
            "plugin allow org.example.line-transducer tcp:localhost:{port} {folder}"
        ));
        let check = format!(
            "plugin check org.example.line-transducer {folder} --with {KEY}:host=localhost;port={port}"
        );
        let failed = bench.run(&format!("{check} --only force/reads,force/numbers"));
        assert_eq!(failed.code, 1, "{}", failed.out);
        assert!(failed.out.contains(words), "{words}: {}", failed.out);
    }

    // A device that stops sending gives a late reading; its process is not killed.
    let port = device(|number| {
        if number > 3 {
            thread::sleep(Duration::from_secs(600));
        }
        resting(number)
    });
    bench.ok(&format!(
        "plugin allow org.example.line-transducer tcp:localhost:{port} {folder}"
    ));
    let silent = bench.run(&format!(
        "plugin check org.example.line-transducer {folder} --with {KEY}:host=localhost;port={port} --only force/reads"
    ));
    assert_eq!(silent.code, 1, "{}", silent.out);
    assert!(
        silent.out.contains("no reading came in time"),
        "{}",
        silent.out
    );

    // The plan opens nothing, and names what would be refused.
    let rig = format!(
        r#"rig_version = 1
simulated = true
[robot]
driver = "ufactory/xarm:host=127.0.0.1"
carries = "indenter"
origin_mm = [300.0, 0.0, 251.3]
axes = ["x", "-y", "-z"]
[force]
driver = "{KEY}:host=127.0.0.1;port={port}"
axes = ["x", "-y", "-z"]
[sensor]
driver = "camera/mjpeg:url=http://127.0.0.1:9/stream"
"#
    );
    bench.write("lab.toml", &rig);
    let scene = fs::read_to_string(
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/scenes/wire.toml"),
    )
    .expect("there");
    bench.write("wire.toml", &scene);
    let plan = format!("plan wire.toml --rig lab.toml {folder}");
    let refused = bench.run(&plan);
    assert_eq!(refused.code, 1, "{}{}", refused.out, refused.err);
    assert!(
        refused.err.contains(&format!("tcp:127.0.0.1:{port}")),
        "{}",
        refused.err
    );
    assert_eq!(bench.paste(&refused.err).code, 0);
    bench.ok(&plan);
}
