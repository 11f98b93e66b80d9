//! Tests of the program `taceva-wire`, started as a user starts it.

use std::io::{BufRead, BufReader, Write};
use std::net::TcpStream;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use clap::ValueEnum;
use serde_json::Value;
use taceva_core::{Deadline, ErrorKind, Rig};
use taceva_drivers::{Drivers, Selector, open};
use taceva_wire::RobotKind;

/// The running program, ended on drop.
struct Running {
    process: Child,
    /// First line that the program printed.
    said: String,
    /// Content of the rig file that the program wrote.
    rig: toml::Table,
}

impl Running {
    /// Starts the program with `words`, and waits until it serves.
    fn start(words: &[&str]) -> Running {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("rig.toml");
        let mut process = Command::new(env!("CARGO_BIN_EXE_taceva-wire"))
            .args(["--quiet", "--seed", "7"])
            .args(words)
            .arg("--write")
            .arg(&file)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .expect("it starts");
        let said = BufReader::new(process.stdout.take().expect("piped"));
        let said: Vec<String> = said
            .lines()
            .map(|line| line.expect("text"))
            .take_while(|line| !line.starts_with("# It runs"))
            .collect();
        let text = std::fs::read_to_string(&file).expect("it was written");
        Running {
            process,
            said: said[0].clone(),
            rig: text.parse().expect("TOML"),
        }
    }

    /// Driver selector in `section` of the rig file.
    fn selector(&self, section: &str) -> Selector {
        let driver = self.rig[section]["driver"].as_str().expect("a selector");
        driver.parse().expect("a selector")
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

const PATIENCE: Deadline = Deadline::after(Duration::from_secs(3));

fn asked(control: &mut BufReader<TcpStream>, request: &str) -> Value {
    let line = format!("{request}\n");
    control.get_mut().write_all(line.as_bytes()).expect("sent");
    let mut answer = String::new();
    control.read_line(&mut answer).expect("answered");
    serde_json::from_str(&answer).expect("JSON")
}

#[test]
fn its_rig_file_opens_every_device_its_control_port_breaks_them_and_it_ends_with_its_input() {
    let mut program = Running::start(&[]);
    assert!(
        program.said.contains("simulated: TACEVA-SIM0007"),
        "{}",
        program.said
    );
    let drivers = Drivers::builtin().expect("drivers");
    let mut shared = Rig::new();
    let mut robot = open(&drivers.robots, &program.selector("robot"), &mut shared).expect("an arm");
    let mut force = open(&drivers.forces, &program.selector("force"), &mut shared).expect("a box");
    open(&drivers.sensors, &program.selector("sensor"), &mut shared).expect("a camera");
    let (pose, _) = robot.pose(PATIENCE).expect("a pose");
    force.start(PATIENCE).expect("it starts");
    force.read(PATIENCE).expect("a reading");

    let (_, address) = program.said.rsplit_once(' ').expect("an address");
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
    let moved = robot.move_to(target, speed, PATIENCE).expect_err("stopped");
    assert_eq!(moved.kind(), ErrorKind::DeviceFault, "{moved}");

    drop(program.process.stdin.take());
    assert!(program.process.wait().expect("it ended").success());
}

#[test]
fn a_box_has_the_frame_filter_and_drift_of_the_command_line() {
    let bent = [
        "--force",
        "netft",
        "--tool",
        "0;0;0;90;0;0",
        "--filter",
        "8",
        "--drift",
        "0.02",
    ];
    let program = Running::start(&bent);
    let drivers = Drivers::builtin().expect("drivers");
    let selector = program.selector("force");
    let refused = open(&drivers.forces, &selector, &mut Rig::new());
    assert!(refused.is_err(), "its frame is turned");
    let accepted: Selector = format!("{selector};frame=tool")
        .parse()
        .expect("a selector");
    let force = open(&drivers.forces, &accepted, &mut Rig::new()).expect("a box");
    let settings = force.settings();
    assert_eq!(settings["frame"], "tool 0;0;0;90;0;0 (mm, degrees)");
    assert_eq!(settings["filter"], "8");
}

#[test]
fn every_robot_that_it_names_moves_by_the_driver_of_its_rig_file() {
    let drivers = Drivers::builtin().expect("drivers");
    for robot in RobotKind::value_variants() {
        let name = robot.to_possible_value().expect("each has a name");
        let program = Running::start(&["--robot", name.get_name()]);
        let mut opened =
            open(&drivers.robots, &program.selector("robot"), &mut Rig::new()).expect("a robot");
        let (home, _) = opened.pose(PATIENCE).expect("a pose");
        let mut target = home;
        target.position.z.0 -= 2.0;
        let speed = taceva_core::Speed::try_new(10.0).expect("above 0");
        opened.move_to(target, speed, PATIENCE).expect("it arrives");
        let (at, _) = opened.pose(PATIENCE).expect("a pose");
        let apart_mm = at.position.z.0 - target.position.z.0;
        // A printer reports positions in steps of 0.01 mm.
        assert!(apart_mm.abs() <= 0.01, "{robot:?}: {apart_mm}");
    }
}
