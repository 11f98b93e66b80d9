//! The program `taceva-wire`, as a person starts it.

use std::io::{BufRead, BufReader, Write};
use std::net::TcpStream;
use std::process::{Child, Command, Stdio};

use serde_json::Value;
use taceva_core::{Deadline, ErrorKind, Rig};
use taceva_drivers::{Drivers, open};

/// The program, which is ended with this.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

fn asked(control: &mut BufReader<TcpStream>, request: &str) -> Value {
    let line = format!("{request}\n");
    control.get_mut().write_all(line.as_bytes()).expect("sent");
    let mut answer = String::new();
    control.read_line(&mut answer).expect("answered");
    serde_json::from_str(&answer).expect("JSON")
}

#[test]
fn its_rig_file_opens_every_device_its_control_port_breaks_them_and_it_ends_with_its_input() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("rig.toml");
    let mut program = Command::new(env!("CARGO_BIN_EXE_taceva-wire"))
        .args(["--quiet", "--seed", "7", "--write"])
        .arg(&file)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .map(Running)
        .expect("it starts");
    let said = BufReader::new(program.0.stdout.take().expect("piped"));
    let said: Vec<String> = said
        .lines()
        .map(|line| line.expect("text"))
        .take_while(|line| !line.starts_with("# It runs"))
        .collect();
    assert!(said[0].contains("simulated: TACEVA-SIM0007"), "{said:?}");

    let text = std::fs::read_to_string(&file).expect("it was written");
    let rig: toml::Table = text.parse().expect("TOML");
    let selector = |section: &str| {
        let driver = rig[section]["driver"].as_str().expect("a selector");
        driver.parse().expect("a selector")
    };
    let drivers = Drivers::builtin().expect("drivers");
    let mut shared = Rig::new();
    let patience = Deadline::after(std::time::Duration::from_secs(3));
    let mut robot = open(&drivers.robots, &selector("robot"), &mut shared).expect("an arm");
    let mut force = open(&drivers.forces, &selector("force"), &mut shared).expect("a box");
    open(&drivers.sensors, &selector("sensor"), &mut shared).expect("a camera");
    let (pose, _) = robot.pose(patience).expect("a pose");
    force.start(patience).expect("it starts");
    force.read(patience).expect("a reading");

    let (_, address) = said[0].rsplit_once(' ').expect("an address");
    let control = TcpStream::connect(address.trim_end_matches('.')).expect("it listens");
    let mut control = BufReader::new(control);
    let truth = asked(&mut control, "\"truth\"");
    assert_eq!(truth["ok"], true);
    assert_eq!(truth["tip_mm"][2], -20.0);
    let refused = asked(&mut control, "{\"mount\": {\"ball_mm\": 3}}");
    assert_eq!(refused["ok"], false);
    let stopped = asked(
        &mut control,
        "{\"inject\": {\"fault\": \"emergency-stop\"}}",
    );
    assert_eq!(stopped["ok"], true);
    let speed = taceva_core::Speed::try_new(5.0).expect("above 0");
    let mut target = pose;
    target.position.z.0 -= 1.0;
    let moved = robot.move_to(target, speed, patience).expect_err("stopped");
    assert_eq!(moved.kind(), ErrorKind::DeviceFault, "{moved}");

    drop(program.0.stdin.take());
    assert!(program.0.wait().expect("it ended").success());
}
