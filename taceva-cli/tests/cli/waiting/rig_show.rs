//! `taceva show` of a run on emulated devices: the instruments of its labels, also those without a certificate.

use crate::support::emulated::Emulated;
use crate::support::{Bench, Ran};

const SCENE: &str = r#"scene_version = 1
name = "wire"
seed = 7
sensor = { driver = "sim/gelsight", opaque = true, markers = true, footprint = { shape = "rect", half_x_mm = 8.0, half_y_mm = 10.0 } }
robot = { driver = "sim/robot" }
force = { driver = "sim/force-transducer" }
limits = { Pz_max_mm = 1.0, Fz_max_N = 1.8 }
model = { name = "ridge" }
metrics = { want = ["accuracy"] }
[protocol]
contact = { speed_mm_s = 2.0, threshold_N = 0.05 }
calibration = { points = 6, indentations = 1 }
"#;

/// Runs the scene to its end, or resumes it if a busy machine ended it.
fn run(bench: &Bench) -> Ran {
    for _ in 0..5 {
        let resume = match bench.path("r").exists() {
            true => " --resume",
            false => "",
        };
        let ran = bench.run(&format!("run scene.toml --rig lab.toml --out r{resume}"));
        let signs = ["ms old", "halted", "frames are late"];
        if !signs.iter().any(|sign| ran.err.contains(sign)) {
            return ran;
        }
    }
    panic!("the machine is too busy");
}

#[test]
fn show_of_a_run_names_its_instruments_and_says_that_the_robot_has_no_certificate() {
    let emulated = Emulated::new();
    let bench = Bench::new();
    let certificate = "number = \"D-K-1\"\nlaboratory = \"a laboratory\"\nissued = 2026-05-12\nserial = \"42\"\nk = 2.0\nU = { Fz = \"3.0 mN\" }\n";
    let rig = emulated.rig_with_robot();
    bench.write(
        "lab.toml",
        &format!("{rig}\n[force.certificate]\n{certificate}"),
    );
    bench.write("scene.toml", SCENE);
    let ran = run(&bench);
    assert_eq!(ran.code, 0, "{}", ran.err);
    let shown = bench.ok("show r/recordings/1-wire");
    for line in [
        "measured  force: certificate D-K-1 of a laboratory, 2026-05-12, serial 42; read by sri/m8128",
        "measured  robot: no certificate; read by ufactory/xarm",
        "setting   force_latency_ms = 0",
        "setting   robot_Fz_max_N = 1.8",
        "setting   sensor_driver = camera/mjpeg",
    ] {
        let is_there = shown.lines().any(|shown| shown.starts_with(line));
        assert!(is_there, "no `{line}` in\n{shown}");
    }
}
