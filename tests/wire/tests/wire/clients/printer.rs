//! Tests that the Marlin driver works with OctoPrint's virtual printer.

use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use taceva_core::{Deadline, ErrorKind, Factory, Millimetre, Pose, Rig, Robot, Speed};
use taceva_drivers::gcode::marlin::MarlinFactory;
use taceva_needs::{Need, skip};

const PATIENCE: Deadline = Deadline::after(Duration::from_secs(20));
/// Python of OctoPrint, as `.ci/install` installs it.
const INSTALLED: &str = "../../target/printer/bin/python";

/// Process with a virtual printer, ended on drop.
struct Printer {
    process: Child,
    port: String,
}

impl Drop for Printer {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

/// Starts the virtual printer; `None` if it is not installed.
fn printer() -> Option<Printer> {
    let named = std::env::var_os("TACEVA_PRINTER").map(PathBuf::from);
    let python = named.unwrap_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join(INSTALLED));
    let started = Command::new(&python)
        .args(["-c", include_str!("printer.py")])
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn();
    let Ok(mut process) = started else {
        skip(
            Need::VirtualPrinter,
            format!("there is no {}", python.display()),
        );
        return None;
    };
    let output = process.stdout.take().expect("piped");
    let port = BufReader::new(output)
        .lines()
        .map_while(Result::ok)
        .find_map(|line| line.strip_prefix("= ").map(str::to_owned));
    let Some(port) = port else {
        let _ = process.wait();
        skip(
            Need::VirtualPrinter,
            format!("{} has no OctoPrint", python.display()),
        );
        return None;
    };
    Some(Printer { process, port })
}

fn opened(printer: &Printer) -> Box<dyn Robot> {
    let factory = MarlinFactory::new().expect("a factory");
    let args = factory.descriptor().args(&format!("port={}", printer.port));
    let args = args.expect("good");
    factory.open(&args, &mut Rig::new()).expect("a printer")
}

fn at(x: f64, y: f64, z: f64) -> Pose {
    let mut pose = Pose::default();
    (pose.position.x, pose.position.y, pose.position.z) =
        (Millimetre(x), Millimetre(y), Millimetre(z));
    pose
}

#[test]
fn the_virtual_printer_takes_motions_and_says_where_it_is() {
    let Some(virtual_printer) = printer() else {
        return;
    };
    let mut robot = opened(&virtual_printer);
    let (begins, _) = robot.pose(PATIENCE).expect("a place");
    assert_eq!(begins, Pose::default());
    let speed = Speed::try_new(10.0).expect("above 0");
    for target in [at(1.5, -2.25, 3.0), at(1.5, -2.25, 0.0), at(0.0, 0.0, 1.0)] {
        robot.move_to(target, speed, PATIENCE).expect("it arrives");
        assert_eq!(robot.pose(PATIENCE).expect("a place").0, target);
    }
}

#[test]
fn a_halt_at_the_virtual_printer_is_told_from_an_arrival() {
    let Some(virtual_printer) = printer() else {
        return;
    };
    let mut robot = opened(&virtual_printer);
    let handle = robot.halt_handle();
    let speed = Speed::try_new(1.0).expect("above 0");
    let moved = std::thread::scope(|scope| {
        scope.spawn(move || {
            std::thread::sleep(Duration::from_millis(300));
            handle.halt().expect("it is sent");
        });
        // A motion of ten seconds, which the virtual printer makes in a tenth of the time.
        robot.move_to(at(0.0, 0.0, 10.0), speed, PATIENCE)
    });
    assert_eq!(moved.expect_err("halted").kind(), ErrorKind::Interrupted);
    let again = robot.move_to(at(0.0, 0.0, 5.0), speed, PATIENCE);
    assert_eq!(again.expect_err("latched").kind(), ErrorKind::Interrupted);
    robot.clear_halt(PATIENCE).expect("nothing is wrong");
    let fast = Speed::try_new(20.0).expect("above 0");
    robot
        .move_to(at(0.0, 0.0, 5.0), fast, PATIENCE)
        .expect("it arrives");
}
