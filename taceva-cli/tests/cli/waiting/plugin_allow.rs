//! Permissions by the program: a refusal, the remedy in its last line, and the same command again.

#![cfg(target_os = "linux")]

use std::fs;
use std::net::TcpListener;

use crate::support::Bench;

/// Creates the sensor of the template, with a connection that is open while the sensor is open.
fn connecting_sensor(bench: &Bench) {
    bench.ok("plugin new sensor my-eye");
    let path = bench.path("my-eye/src/sensor.rs");
    let mut text = fs::read_to_string(&path).expect("there");
    for (before, after) in [
        (
            "spec.arguments([brightness])",
            "spec.arguments([brightness, ArgSpec::text(\"host\").help(\"the camera\"), ArgSpec::whole(\"port\", 1, 65535).help(\"of the camera\")])",
        ),
        (
            "        let brightness = u8::try_from",
            "        let peer = std::net::TcpStream::connect(format!(\"{}:{}\", args.text(\"host\"), args.whole(\"port\")));\n        let peer = peer.map_err(|error| DriverError::new(ErrorKind::Disconnected, &KEY, \"reach the camera\").because(error))?;\n        let brightness = u8::try_from",
        ),
        (
            "        Ok(Box::new(Bar {",
            "        Ok(Box::new(Bar { _peer: peer,",
        ),
        ("struct Bar {", "struct Bar { _peer: std::net::TcpStream,"),
    ] {
        assert!(text.contains(before), "{before}");
        text = text.replacen(before, after, 1);
    }
    fs::write(&path, text).expect("written");
    let path = bench.path("my-eye/plugin.toml");
    let manifest = fs::read_to_string(&path).expect("there");
    let arguments = "\n[[provides.args]]\nkey = \"host\"\ntype = \"text\"\n\n[[provides.args]]\nkey = \"port\"\ntype = \"whole\"\nrange = [1, 65535]\n";
    fs::write(&path, format!("{manifest}{arguments}")).expect("written");
    bench.build_plugin("my-eye");
}

/// Makes `need` the only need of the manifest.
fn needs(bench: &Bench, need: &str) {
    let path = bench.path("my-eye/plugin.toml");
    let manifest = fs::read_to_string(&path).expect("there");
    let lines = manifest.lines().filter(|line| !line.starts_with("needs"));
    let rest: Vec<&str> = lines.collect();
    let needs = format!("needs = [\"{need}\"]\n{}\n", rest.join("\n"));
    fs::write(&path, needs).expect("written");
}

#[test]
fn the_line_that_a_refusal_prints_makes_the_next_run_pass() {
    let bench = Bench::new();
    connecting_sensor(&bench);
    let listener = TcpListener::bind("127.0.0.1:0").expect("a port");
    let port = listener.local_addr().expect("bound").port();

    // A need without arguments: the plugin itself meets the refusal.
    needs(&bench, &format!("tcp:127.0.0.1:{port}"));
    let check = format!(
        "plugin check org.example.my-eye --plugin-dir my-eye --only driver/opens --with org.example.my-eye/my-eye:host=127.0.0.1;port={port}"
    );
    let refused = bench.run(&check);
    assert_eq!(refused.code, 1, "{}{}", refused.out, refused.err);
    // Three checks open the plugin; one reports why none can.
    assert_eq!(refused.out.matches("FAIL").count(), 1, "{}", refused.out);
    let looked = bench.run("doctor --plugin-dir my-eye");
    assert_eq!(looked.code, 1, "{}", looked.out);
    assert!(
        looked.out.contains("remedy: allow it: taceva plugin allow"),
        "{}",
        looked.out
    );
    let allowed = bench.paste(&refused.out);
    assert_eq!(allowed.code, 0, "{}{}", allowed.out, allowed.err);
    assert!(
        allowed
            .out
            .contains(&format!("may reach tcp:127.0.0.1:{port}")),
        "{}",
        allowed.out
    );
    bench.ok(&check);
    let looked = bench.run("doctor --plugin-dir my-eye");
    assert!(!looked.out.contains("allow it"), "{}", looked.out);

    // The permission is revoked.
    bench.ok("plugin deny org.example.my-eye");
    assert_eq!(bench.run(&check).code, 1);
    // A trusted plugin needs no permission.
    bench.ok(&format!("{check} --trust org.example.my-eye"));

    // For an installed plugin the line needs no folder.
    let said = bench.ok("plugin install my-eye");
    let line = format!("allow it: taceva plugin allow org.example.my-eye tcp:127.0.0.1:{port}\n");
    assert!(said.ends_with(&line), "{said}");
    bench.refused("plugin install my-eye", 3, "`--force` replaces it");
    bench.ok("plugin install my-eye --force");
    let installed = bench.path("user-data/taceva/plugins");
    let left = crate::support::leftovers(&installed, &["org.example.my-eye"]);
    assert!(left.is_empty(), "{left:?}");
    let check_installed = check.replace(" --plugin-dir my-eye", "");
    let refused = bench.run(&check_installed);
    assert_eq!(refused.code, 1, "{}{}", refused.out, refused.err);
    assert_eq!(bench.paste(&refused.out).code, 0);
    bench.ok(&check_installed);
    bench.ok("plugin deny org.example.my-eye");
    fs::remove_dir_all(&installed).expect("removed");
    // An invalid library is not installed.
    let manifest = fs::read_to_string(bench.path("my-eye/plugin.toml")).expect("there");
    bench.write("broken/plugin.toml", &manifest);
    bench.write("broken/target/release/libmy_eye.so", "no library");
    assert_ne!(bench.run("plugin install broken").code, 0);
    assert!(!installed.join("org.example.my-eye").exists());

    // Needs by arguments, with a host name that a confined plugin could not resolve.
    needs(&bench, "tcp:{host}:{port}");
    let scene = format!(
        r#"scene_version = 1
name = "eye"
seed = 7
robot = {{ driver = "sim/robot:gel=gelsight" }}
force = {{ driver = "sim/force-transducer" }}
model = {{ name = "ridge", set = {{ size = "8x6" }} }}
sensor = {{ driver = "org.example.my-eye/my-eye:host=localhost;port={port}" }}
protocol = {{ calibration = {{ points = 6, indentations = 2 }} }}
metrics = {{ want = ["mae"] }}
"#
    );
    bench.write("eye.toml", &scene);
    let refused = bench.run("run eye.toml --plugin-dir my-eye --out first");
    assert_ne!(refused.code, 0);
    assert!(
        refused.err.contains(&format!(
            "taceva plugin allow org.example.my-eye tcp:localhost:{port} --plugin-dir"
        )),
        "{}",
        refused.err
    );
    let allowed = bench.paste(&refused.err);
    assert_eq!(allowed.code, 0, "{}{}", allowed.out, allowed.err);
    bench.ok("run eye.toml --plugin-dir my-eye --out second");
    let by_name = check.replace("host=127.0.0.1", "host=localhost");
    bench.ok(&by_name);
    bench.ok("plugin deny org.example.my-eye");
    let refused = bench.run(&by_name);
    assert_eq!(refused.code, 1, "{}", refused.out);
    assert_eq!(
        refused.out.matches("allow it: ").count(),
        1,
        "{}",
        refused.out
    );
    assert_eq!(bench.paste(&refused.out).code, 0);
    bench.ok(&by_name);
    // Another port is another permission.
    let other = port.wrapping_add(1).max(1);
    bench.write(
        "eye.toml",
        &scene.replace(&format!("port={port}"), &format!("port={other}")),
    );
    let refused = bench.run("run eye.toml --plugin-dir my-eye --out third");
    assert!(refused.err.contains("allow it: "), "{}", refused.err);
}

#[test]
fn what_a_manifest_does_not_ask_for_is_not_allowed_and_settings_stay_as_they_are() {
    let bench = Bench::new();
    bench.ok("plugin new sensor my-eye");
    fs::create_dir_all(bench.path("my-eye/target/release")).expect("created");
    fs::write(
        bench.path("my-eye/target/release/libmy_eye.so"),
        "never opened",
    )
    .expect("written");
    needs(&bench, "serial:/dev/ttyUSB*");
    let settings = "# of this machine\n[plugins]\nprefer = [] # none\n";
    bench.write("user-config/taceva/config.toml", settings);
    let allow = "plugin allow org.example.my-eye --plugin-dir my-eye";
    bench.refused(
        &format!("{allow} usb"),
        2,
        "it requests `serial:/dev/ttyUSB*`",
    );
    bench.refused(
        &format!("{allow} serial:/dev/ttyS0"),
        2,
        "does not request this access",
    );
    bench.refused(
        "plugin allow org.example.my-eyes usb --plugin-dir my-eye",
        3,
        "did you mean",
    );
    let path = bench.path("user-config/taceva/config.toml");
    assert_eq!(fs::read_to_string(&path).expect("there"), settings);

    let said = bench.ok(&format!("{allow} serial:/dev/ttyUSB0"));
    assert!(said.contains("may reach serial:/dev/ttyUSB0 ("), "{said}");
    let expected = format!(
        "{settings}\n[plugins.allow]\n\"org.example.my-eye\" = [\"serial:/dev/ttyUSB0\"]\n"
    );
    assert_eq!(fs::read_to_string(&path).expect("there"), expected);
    bench.refused(
        "plugin deny org.example.my-eye usb",
        2,
        "may reach serial:/dev/ttyUSB0",
    );
    let said = bench.ok("plugin deny org.example.my-eye");
    assert!(said.contains("has no access outside its process"), "{said}");
    let left = crate::support::leftovers(&bench.path("user-config/taceva"), &["config.toml"]);
    assert!(left.is_empty(), "{left:?}");
}
