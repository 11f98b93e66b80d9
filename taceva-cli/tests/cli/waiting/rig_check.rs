//! `taceva rig check` on emulated devices: certificates are compared with the devices, the day and their files.

use std::net::Ipv4Addr;

use taceva_wire::{BenchOptions, WallBench, netft};

use crate::support::Bench;

const CERTIFICATE: &str = r#"[force.certificate]
number = "D-K-1"
laboratory = "a laboratory"
issued = 2020-05-12
valid_until = 2021-05-12
serial = "FT12345"
k = 2.0
U = { Fz = "3.0 mN" }
file = "certificate.pdf"
sha256 = "2c26b46b68ffc68ff99b453c1d30413413422d706483bfa0f98a5e886266e7ae"
"#;

#[test]
fn a_check_of_a_rig_compares_certificates_with_the_device_the_day_and_their_files() {
    let emulated = WallBench::start(&BenchOptions::quiet(7)).expect("a bench");
    let force = netft::Emulator::start(&emulated, Ipv4Addr::LOCALHOST, 0, 0).expect("a box");
    let bench = Bench::new();
    let rig = |certificate: &str| {
        format!(
            "rig_version = 1\nsimulated = true\n[force]\ndriver = {:?}\naxes = [\"x\", \"y\", \"z\"]\n{certificate}",
            force.selector()
        )
    };
    bench.write("lab.toml", &rig(CERTIFICATE));
    let ran = bench.run("rig check lab.toml");
    assert_eq!(ran.code, 1, "{}{}", ran.out, ran.err);
    let serial = emulated.serial();
    let other = format!(
        "problem the certificate D-K-1 of the force transducer is for serial number FT12345, but the driver read {serial}: write the certificate of this device"
    );
    for part in [
        "force   problem: ",
        &other,
        "warning the certificate D-K-1 of the force transducer was valid until 2021-05-12, but the measurement was made on ",
        "warning [force.certificate]: `file` is `certificate.pdf`, expected a file beside the rig file (certificate.pdf: no such file)",
    ] {
        assert!(ran.out.contains(part), "no `{part}` in {}", ran.out);
    }
    let valid = CERTIFICATE
        .replace("FT12345", &serial)
        .replace("2021-05-12", "2920-05-12");
    bench.write("lab.toml", &rig(&valid));
    // SHA-256 of `foo`.
    bench.write("certificate.pdf", "foo");
    let ran = bench.run("rig check lab.toml");
    for part in ["certificate", "serial number"] {
        assert!(!ran.out.contains(part), "`{part}` in {}", ran.out);
    }
    bench.write("certificate.pdf", "another");
    let ran = bench.run("rig check lab.toml");
    let part = "warning [force.certificate]: `sha256` is `2c26b46b";
    assert!(ran.out.contains(part), "no `{part}` in {}", ran.out);
}

#[test]
fn a_capture_warns_of_a_certificate_of_another_transducer() {
    let emulated = crate::support::emulated::Emulated::new();
    let force = netft::Emulator::start(&emulated.bench, Ipv4Addr::LOCALHOST, 0, 0);
    let force = force.expect("a box");
    let bench = Bench::new();
    let rig = emulated.rig().replace(&emulated.force(), &force.selector());
    bench.write("hand.toml", &format!("{rig}\n{CERTIFICATE}"));
    let ran = bench.run("capture out --rig hand.toml --frames 12");
    assert_eq!(ran.code, 0, "{}", ran.err);
    for part in [
        "warning: the certificate D-K-1 of the force transducer is for serial number FT12345",
        "warning: the certificate D-K-1 of the force transducer was valid until 2021-05-12",
    ] {
        assert_eq!(ran.err.matches(part).count(), 1, "{part}: {}", ran.err);
    }
    // The recording answers with what it was measured, and calibrated by whom.
    let shown = bench.ok("show out");
    for part in [
        "measured  force: certificate D-K-1 of a laboratory, 2020-05-12, serial FT12345",
        "; read by ati/netft, which read the serial number ",
        "setting   force_filter = 0",
        "setting   force_axes = [\"x\", \"-y\", \"-z\"]",
        "setting   force_latency_ms = 0",
    ] {
        assert!(shown.contains(part), "no `{part}` in\n{shown}");
    }
}
