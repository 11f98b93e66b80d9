//! Distribution of a plugin: its manifest from its library, packed into one file, and installed from it.

#![cfg(target_os = "linux")]

use std::fs;

use crate::support::Bench;

const ID: &str = "org.example.my-scale";

#[test]
fn a_manifest_is_written_from_the_library_and_the_plugin_packed_and_installed() {
    let bench = Bench::new();
    bench.ok("plugin new force my-scale");
    // The driver changes and declares a need; the manifest lacks both.
    let source = bench.path("my-scale/src/force.rs");
    let text = fs::read_to_string(&source).expect("there");
    let faster = text.replace("Hertz(200.0)", "Hertz(250.0)");
    assert_ne!(text, faster);
    fs::write(&source, faster).expect("written");
    let library = bench.path("my-scale/src/lib.rs");
    let text = fs::read_to_string(&library).expect("there");
    let needy = text.replace("drivers: [", "needs: [\"hid\"],\n    drivers: [");
    fs::write(&library, needy).expect("written");
    let manifest = bench.path("my-scale/plugin.toml");
    let text = fs::read_to_string(&manifest).expect("there");
    let noted = text.replace("rate_hz = 200.0", "rate_hz = 200.0 # as measured");
    fs::write(&manifest, &noted).expect("written");
    bench.build_plugin("my-scale");

    // The library differs from its manifest, so it is neither packed nor installed.
    let refused = bench.run("plugin pack my-scale");
    assert_eq!(refused.code, 3, "{}", refused.err);
    assert!(refused.err.contains("rate_hz"), "{}", refused.err);
    assert!(!bench.path("org.example.my-scale-0.1.0.tar").exists());
    // Without `--write` the exit code reports the difference, and the file stays.
    let printed = bench.run("plugin manifest my-scale");
    assert_eq!(printed.code, 1, "{}", printed.err);
    assert!(
        printed.out.contains("rate_hz = 250.0 # as measured"),
        "{}",
        printed.out
    );
    assert!(printed.out.contains("needs = [\"hid\"]"), "{}", printed.out);
    assert_eq!(fs::read_to_string(&manifest).expect("there"), noted);
    bench.ok("plugin manifest my-scale --write");
    assert_eq!(fs::read_to_string(&manifest).expect("there"), printed.out);
    let again = bench.ok("plugin manifest my-scale --write");
    assert!(again.contains("agrees with its library"), "{again}");
    assert_eq!(bench.run("plugin manifest my-scale").code, 0);
    bench.ok("plugin check org.example.my-scale --plugin-dir my-scale --only library/");
    let left = crate::support::leftovers(
        &bench.path("my-scale"),
        &[
            "Cargo.lock",
            "Cargo.toml",
            "README.md",
            ".gitignore",
            "plugin.toml",
            "src",
            "target",
            "vendor",
        ],
    );
    assert!(left.is_empty(), "{left:?}");

    // A missing manifest is created.
    fs::rename(&manifest, bench.path("kept.toml")).expect("moved");
    bench.refused(
        "plugin manifest my-scale",
        3,
        "name the library with `--library`",
    );
    let library = "--library target/release/libmy_scale.so";
    bench.refused(
        &format!("plugin manifest my-scale {library}"),
        3,
        "--license",
    );
    bench.refused(
        "plugin manifest my-scale --library ../kept.toml",
        3,
        "expected a file below",
    );
    bench.ok(&format!(
        "plugin manifest my-scale {library} --license MIT --write"
    ));
    bench.ok("plugin check org.example.my-scale --plugin-dir my-scale --only library/");
    fs::rename(bench.path("kept.toml"), &manifest).expect("moved back");

    // Packed, and installed from the file.
    fs::write(bench.path("my-scale/LICENSE"), "as is").expect("written");
    let said = bench.ok("plugin pack my-scale");
    assert_eq!(
        said,
        "org.example.my-scale-0.1.0.tar: plugin.toml, SHA256SUMS, LICENSE, target/release/libmy_scale.so\n"
    );
    bench.refused("plugin pack my-scale", 3, "org.example.my-scale-0.1.0.tar");
    bench.ok("plugin pack my-scale --out other.tar");
    let bytes = |name: &str| fs::read(bench.path(name)).expect("there");
    assert_eq!(bytes("other.tar"), bytes("org.example.my-scale-0.1.0.tar"));
    let said = bench.ok("plugin install other.tar");
    assert!(
        said.contains("allow it: taceva plugin allow org.example.my-scale hid\n"),
        "{said}"
    );
    let installed = bench.path("user-data/taceva/plugins");
    assert_eq!(
        crate::support::leftovers(&installed, &[ID]),
        Vec::<String>::new()
    );
    bench.ok("plugin check org.example.my-scale --only library/");
    let file = installed.join(ID).join("LICENSE");
    assert_eq!(fs::read_to_string(file).expect("there"), "as is");

    // A changed file is not installed, and the installed plugin stays.
    bench.refused("plugin install other.tar", 3, "`--force` replaces it");
    let mut damaged = bytes("other.tar");
    let place = damaged.len() - 4096;
    damaged[place] ^= 1;
    fs::write(bench.path("damaged.tar"), damaged).expect("written");
    bench.refused("plugin install damaged.tar --force", 3, "its sha256 is");
    fs::write(bench.path("none.tar"), "no archive").expect("written");
    assert_eq!(bench.run("plugin install none.tar --force").code, 3);
    assert_eq!(bench.run("plugin install absent.tar").code, 3);
    assert_eq!(
        crate::support::leftovers(&installed, &[ID]),
        Vec::<String>::new()
    );
    bench.ok("plugin check org.example.my-scale --only library/");
    bench.ok("plugin install other.tar --force");

    // The remains of an interrupted installation are ignored: the plugin is listed once.
    let cut_off = installed.join(".taceva-staged-a1b2c3");
    fs::create_dir(&cut_off).expect("made");
    fs::copy(&manifest, cut_off.join("plugin.toml")).expect("copied");
    let listed = bench.ok("plugin list");
    assert!(listed.ends_with("1 plugin, 0 not used\n"), "{listed}");

    // Removal deletes the whole plugin. Its granted access stays and is reported.
    bench.ok("plugin allow org.example.my-scale hid");
    let said = bench.ok("plugin uninstall org.example.my-scale");
    assert!(
        said.ends_with("revoke them: taceva plugin deny org.example.my-scale\n"),
        "{said}"
    );
    assert!(!installed.join(ID).exists());
    let listed = bench.ok("plugin list");
    assert!(listed.ends_with("0 plugins, 0 not used\n"), "{listed}");
    bench.refused("plugin uninstall org.example.my-scale", 3, "does not exist");
}
