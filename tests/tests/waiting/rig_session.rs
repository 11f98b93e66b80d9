//! Tests of the program on emulated controllers, over sockets. A rig with wrong axes, and a second run on the same rig, are rejected.

use std::fs;
use std::time::{Duration, Instant};

use taceva_tests::wire::{OnTheWire, RUN, UnderWay, finished, scene_of};
use taceva_wire::{BenchOptions, ServeOptions};

const SEED: u64 = 7;
/// Maximum number of restarts of a run that was halted because a busy machine delayed readings.
const PATIENCE: usize = 5;
const RIGHT: &str = "axes = [\"x\", \"-y\", \"-z\"]";

fn served() -> OnTheWire {
    let options = ServeOptions::over(BenchOptions::quiet(SEED));
    OnTheWire::new(&options, &scene_of(6))
}

#[test]
fn wrong_axes_of_the_transducer_end_a_session_with_their_line_before_anything_is_pressed() {
    let on = served();
    let file = on.folder().join("rig.toml");
    let text = fs::read_to_string(&file).expect("written");
    let (robot, force) = text.split_once("[force]").expect("a transducer");
    assert!(force.contains(RIGHT), "{text}");
    // `[force]` begins a line, and its axes are two lines below.
    let line = robot.lines().count() + 3;
    for wrong in ["[\"x\", \"y\", \"z\"]", "[\"-x\", \"y\", \"-z\"]"] {
        let turned = force.replacen(RIGHT, &format!("axes = {wrong}"), 1);
        fs::write(&file, format!("{robot}[force]{turned}")).expect("written");
        let mut said = String::new();
        for _ in 0..PATIENCE {
            // Nothing was pressed: restart the run.
            let _ = fs::remove_dir_all(on.folder().join(RUN));
            said = finished(on.study()).expect_err("the axes are wrong");
            if !said.contains("ms old") {
                break;
            }
        }
        let place = format!("line {line}: `axes` of [force]: ");
        assert!(said.contains(&place), "{said}");
        assert!(said.contains(&format!("write {RIGHT}")), "{said}");
        // At most half of the allowed depth, and out again.
        let truth = on.served.bench().truth();
        assert!(
            truth.deepest_mm < 0.75 && truth.tip_mm[2] < -0.9,
            "{truth:?}"
        );
    }
}

#[test]
fn a_second_run_on_the_same_rig_is_refused_while_the_first_goes_on() {
    let on = served();
    let mut first = UnderWay::begin(on.study());
    let patience = Instant::now() + Duration::from_secs(60);
    while !on.folder().join(RUN).exists() {
        assert!(Instant::now() < patience, "it never began");
        std::thread::sleep(Duration::from_millis(20));
    }
    let said = finished(on.study()).expect_err("the devices are taken");
    first.kill();
    assert!(said.contains("is in use by another run"), "{said}");
}
