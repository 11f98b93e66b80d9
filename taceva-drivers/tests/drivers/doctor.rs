//! Tests that the doctor finds devices and problems from the files of a machine alone.

use std::fs;
use std::path::Path;

use taceva_drivers::Drivers;
use taceva_drivers::doctor::{Diagnosis, Machine, State, UsbDevice, examine};
use tempfile::TempDir;

/// Creates a machine from files with their texts.
fn machine(files: &[(&str, &str)]) -> TempDir {
    let root = tempfile::tempdir().expect("a folder");
    for (path, text) in files {
        let path = root.path().join(path);
        fs::create_dir_all(path.parent().expect("in a folder")).expect("made");
        fs::write(path, text).expect("written");
    }
    root
}

fn findings(root: &Path) -> Vec<Diagnosis> {
    let drivers = Drivers::builtin().expect("no contradiction");
    examine(&drivers, &Machine::at(root))
}

fn codes(findings: &[Diagnosis]) -> Vec<&str> {
    findings.iter().map(|finding| finding.code).collect()
}

/// User who owns no file of a test and is in no group of these files.
const STRANGER: &str =
    "Uid:\t987654 987654 987654 987654\nGid:\t987654 987654 987654 987654\nGroups:\t\n";

#[test]
fn a_bare_machine_has_drivers_and_says_what_is_absent() {
    let root = machine(&[("proc/self/status", STRANGER)]);
    let found = findings(root.path());
    assert_eq!(
        codes(&found),
        ["drivers", "camera-absent", "serial-absent", "hid-absent"]
    );
    assert!(found[0].detail.contains("sensor/replay"));
    assert!(
        found[1..]
            .iter()
            .all(|finding| finding.state == State::Absent)
    );
    assert_eq!(found[2].subject, "/dev/ttyACM*, /dev/ttyUSB*");
}

#[cfg(unix)]
fn permit(root: &Path, file: &str, mode: u32) {
    use std::os::unix::fs::PermissionsExt;
    fs::set_permissions(root.join(file), fs::Permissions::from_mode(mode)).expect("ours");
}

#[cfg(unix)]
fn group_of(root: &Path) -> u32 {
    use std::os::unix::fs::MetadataExt;
    fs::metadata(root.join("dev/video0")).expect("there").gid()
}

#[cfg(unix)]
#[test]
fn a_camera_that_is_not_permitted_says_which_group_to_join() {
    let root = machine(&[
        ("proc/self/status", STRANGER),
        ("dev/video0", ""),
        ("dev/video10", ""),
        ("dev/video2", ""),
        ("dev/video-notes", ""),
        (
            "sys/class/video4linux/video0/name",
            "DIGIT: DIGIT\u{1b}[2J\n",
        ),
    ]);
    let root = root.path();
    let group = group_of(root);
    fs::create_dir(root.join("etc")).expect("made");
    fs::write(root.join("etc/group"), format!("video:x:{group}:\n")).expect("written");
    permit(root, "dev/video0", 0o660);
    permit(root, "dev/video2", 0o600);
    permit(root, "dev/video10", 0o666);
    let found = findings(root);
    let cameras: Vec<(&str, &str)> = found[1..4]
        .iter()
        .map(|finding| (finding.subject.as_str(), finding.code))
        .collect();
    assert_eq!(
        cameras,
        [
            ("/dev/video0", "camera-denied"),
            ("/dev/video2", "camera-denied"),
            ("/dev/video10", "camera"),
        ]
    );
    let expected = match cfg!(all(feature = "v4l2", target_os = "linux")) {
        true => "DIGIT: DIGIT\\u{1b}[2J; opened by `camera/v4l2:device=/dev/video0`",
        false => "DIGIT: DIGIT\\u{1b}[2J",
    };
    assert_eq!(found[1].detail, expected);
    let remedy = |finding: &Diagnosis| finding.remedy.clone().unwrap_or_default();
    assert!(
        remedy(&found[1]).starts_with("join the group `video`"),
        "{}",
        remedy(&found[1])
    );
    assert!(
        remedy(&found[2]).starts_with("its mode is 600"),
        "{}",
        remedy(&found[2])
    );

    fs::write(root.join("etc/passwd"), "ann:x:987654:1::/:/bin/sh\n").expect("written");
    fs::write(root.join("etc/group"), format!("video:x:{group}:bob,ann\n")).expect("written");
    let found = findings(root);
    assert!(
        remedy(&found[1]).starts_with("log out and in again"),
        "{}",
        remedy(&found[1])
    );

    let member = STRANGER.replace("Groups:\t", &format!("Groups:\t5 {group}"));
    fs::write(root.join("proc/self/status"), member).expect("written");
    assert_eq!(findings(root)[1].code, "camera");
    let root_user = STRANGER.replace("987654", "0");
    fs::write(root.join("proc/self/status"), root_user).expect("written");
    assert!(
        findings(root)[1..4]
            .iter()
            .all(|finding| finding.state == State::Good)
    );
}

#[cfg(target_os = "linux")]
#[test]
fn a_known_sensor_on_the_usb_without_a_device_file_lacks_its_driver() {
    let found = |file: &str| {
        let root = machine(&[("proc/self/status", STRANGER), (file, "")]);
        let drivers = Drivers::builtin().expect("no contradiction");
        let devices = vec![
            UsbDevice::new("1-1", 0x1d6b, 0x0002),
            UsbDevice::new("1-2", 0x2833, 0x0209).with_serial("D20042"),
        ];
        let machine = Machine::at(root.path()).with_usb(devices);
        let found = examine(&drivers, &machine).pop();
        found.expect("the USB comes last")
    };
    let without = found("dev/null");
    assert_eq!(
        (without.code, without.state),
        ("usb-without-driver", State::Problem)
    );
    assert_eq!(without.subject, "USB 1-2");
    assert_eq!(without.detail, "DIGIT tactile sensor, serial number D20042");
    assert!(without.remedy.expect("known").contains("modprobe uvcvideo"));
    assert_eq!(found("dev/video3").code, "usb");
}

#[cfg(all(
    feature = "hid",
    feature = "marlin",
    feature = "grbl",
    target_os = "linux"
))]
#[test]
fn scales_and_serial_lines_are_named_with_what_opens_them() {
    let root = machine(&[
        ("proc/self/status", STRANGER),
        ("dev/hidraw0", ""),
        ("dev/hidraw1", ""),
        ("dev/ttyACM0", ""),
        (
            "sys/class/hidraw/hidraw0/device/uevent",
            "HID_NAME=Keyboard\n",
        ),
        (
            "sys/class/hidraw/hidraw1/device/uevent",
            "HID_NAME=Dymo M5\n",
        ),
    ]);
    let descriptor = root
        .path()
        .join("sys/class/hidraw/hidraw1/device/report_descriptor");
    fs::write(descriptor, [0x05, 0x8d, 0x09, 0x20, 0xa1, 0x01]).expect("written");
    let found = findings(root.path());
    let details: Vec<&str> = found[2..]
        .iter()
        .map(|finding| finding.detail.as_str())
        .collect();
    assert_eq!(
        details,
        [
            "serial port; opened by `gcode/grbl:port=/dev/ttyACM0` or `gcode/marlin:port=/dev/ttyACM0`",
            "Keyboard",
            "Dymo M5; opened by `hid/scale:device=/dev/hidraw1`",
        ]
    );
}

#[test]
fn a_system_that_does_not_say_who_runs_the_program_is_reported() {
    let root = machine(&[]);
    assert_eq!(codes(&findings(root.path()))[1], "user-unknown");
}

#[cfg(target_os = "linux")]
#[test]
fn this_machine_can_be_examined() {
    let drivers = Drivers::builtin().expect("no contradiction");
    let found = examine(&drivers, &Machine::this());
    assert_eq!(found[0].code, "drivers");
    assert!(!codes(&found).contains(&"user-unknown"), "{found:?}");
}

#[cfg(unix)]
#[test]
fn a_port_that_another_program_has_open_names_its_process() {
    let root = machine(&[
        ("proc/self/status", STRANGER),
        // Beyond the numbers of processes.
        ("proc/4200001/comm", "octoprint\n"),
        ("proc/4200002/comm", "editor\n"),
    ]);
    let root = root.path();
    for (name, target) in [
        ("dev/ttyUSB0", "/dev/null"),
        ("proc/4200001/fd/3", "/dev/null"),
        ("proc/4200002/fd/3", "/dev/zero"),
    ] {
        let path = root.join(name);
        fs::create_dir_all(path.parent().expect("in a folder")).expect("made");
        std::os::unix::fs::symlink(target, path).expect("linked");
    }
    let found = findings(root);
    let port = found
        .iter()
        .find(|finding| finding.subject == "/dev/ttyUSB0");
    let detail = &port.expect("it is there").detail;
    assert!(
        detail.ends_with("; open in process 4200001 (octoprint)"),
        "{detail}"
    );
}
