//! Commands of the documents that move an emulated tip in place of a hand or a pendant.

use std::process::Command;
use std::time::Duration;

use taceva_core::{Deadline, Rig};
use taceva_dataset::{Dataset, Source};
use taceva_drivers::{Drivers, open};
use taceva_protocol::{Carried, Jogged, RigFile};
use taceva_wire::{Base, BenchOptions, ServeOptions, Served};

use crate::support::Bench;
use crate::support::emulated::Running;

const PATIENCE: Deadline = Deadline::after(Duration::from_secs(20));

/// Commands of `page` from the opening of the control port on, with the number of the port.
fn commands(page: &str, served: &Served) -> String {
    let (_, rest) = page.split_once("exec 3<>").expect("a port");
    let block = rest.split("```").next().expect("an end");
    let port = served.control_address().port().to_string();
    format!("exec 3<>{}", block.replace("PORT", &port))
}

/// Types `words` in bash.
fn typed(words: &str) {
    let done = Command::new("bash").args(["-c", words]).output();
    let done = done.expect("bash starts");
    let said = String::from_utf8_lossy(&done.stdout);
    let problem = String::from_utf8_lossy(&done.stderr);
    assert!(
        done.status.success() && !said.contains("false"),
        "{said}{problem}"
    );
}

#[test]
fn presses_typed_as_on_the_page_of_captures_become_twelve_contacts() {
    // A busy machine may lose a contact of half a second.
    let mut said = String::new();
    for _ in 0..4 {
        let (bench, err) = captured();
        if err.contains("12 contacts") {
            let dataset = Dataset::open(&bench.path("presses")).expect("whole");
            assert_eq!(dataset.header().source, Source::Simulated);
            return;
        }
        said = err;
    }
    panic!("{said}");
}

/// Captures the presses that the commands of docs/capture.md make. Returns the test folder and the output.
fn captured() -> (Bench, String) {
    let served = Served::start(&ServeOptions {
        is_lossless: false,
        ..ServeOptions::over(BenchOptions::noisy(7))
    });
    let served = served.expect("devices");
    let bench = Bench::new();
    bench.write("hand.toml", served.rig_file());
    let running = Running::start(&bench, "capture presses --rig hand.toml --for 120s");
    running.until_it_says("press; Ctrl-C");
    typed(&commands(
        include_str!("../../../../docs/capture.md"),
        &served,
    ));
    running.interrupt();
    let ran = running.ended();
    (bench, ran.err)
}

#[test]
fn jogs_typed_as_on_the_page_of_rigs_teach_the_frame_of_the_emulated_gel() {
    let page = include_str!("../../../../docs/rig.md");
    let served = Served::start(&ServeOptions::over(BenchOptions::quiet(7))).expect("devices");
    let rig = RigFile::parse("rig.toml", served.rig_file()).expect("a rig file");
    let driver = rig.robot.expect("a robot").driver.value;
    let selector = driver.parse().expect("a selector");
    let drivers = Drivers::builtin().expect("drivers");
    let mut robot = open(&drivers.robots, &selector, &mut Rig::new()).expect("an arm");
    let function = commands(page, &served);
    let mut jogged = |words: &str| {
        assert!(page.contains(&format!("`{words}`")), "no `{words}`");
        typed(&format!("{function}\n{words}"));
        // Until the next report of the arm.
        std::thread::sleep(Duration::from_millis(200));
        robot.pose(PATIENCE).expect("a pose").0
    };
    let [middle, along_x, along_y] = ["jog 0 0 20", "jog 8 0 -0.2", "jog -8 8 0"].map(&mut jogged);
    let jogged_to = Jogged {
        middle,
        along_x,
        along_y,
    };
    let taught = jogged_to.taught(Carried::Indenter).expect("a frame");
    assert_eq!(taught.axes.to_string(), r#"["x", "-y", "-z"]"#);
    for (taught_mm, known_mm) in taught.origin_mm.into_iter().zip(Base::ORIGIN_MM) {
        assert!(
            (taught_mm - known_mm).abs() < 0.01,
            "{taught_mm}, {known_mm}"
        );
    }
    let above = jogged("jog 0 -8 -9.8");
    assert!((above.position.z.0 - Base::ORIGIN_MM[2] - 10.0).abs() < 0.01);
}
