//! `taceva capture` on emulated devices, through their sockets.

mod broken;
mod predictions;

use std::net::Ipv4Addr;
use std::time::Duration;

use crate::support::Bench;
use crate::support::emulated::{Emulated, Running};
use taceva_dataset::{Dataset, Source};
use taceva_wire::{Base, netft};

/// Depths of the presses of a capture, mm.
const DEPTHS_MM: [f64; 8] = [0.3, 0.5, 0.4, 0.6, 0.35, 0.55, 0.45, 0.5];

#[test]
fn presses_become_points_that_models_are_fitted_and_evaluated_on() {
    let emulated = Emulated::new();
    let bench = Bench::new();
    bench.write("hand.toml", &emulated.rig());
    let running = Running::start(&bench, "capture presses --rig hand.toml --for 120s");
    running.until_it_says("press; Ctrl-C");
    let mut robot = emulated.robot();
    let mut held_n = Vec::new();
    for (number, depth_mm) in DEPTHS_MM.into_iter().enumerate() {
        let place = f64::from(u8::try_from(number).expect("few")) * 0.8 - 2.8;
        emulated.press(&mut robot, [place, 0.5 * place], depth_mm, || {
            std::thread::sleep(Duration::from_millis(350));
            held_n.push(emulated.bench.truth().force_n[2]);
        });
    }
    running.interrupt();
    let ran = running.ended();
    // Stopped before the requested end.
    assert_eq!(ran.code, 5, "{}", ran.err);
    assert!(ran.err.contains("8 contacts"), "{}", ran.err);

    let dataset = Dataset::open(&bench.path("presses")).expect("whole");
    let header = dataset.header();
    assert_eq!(header.source, Source::Simulated, "the rig file says so");
    let names: Vec<&str> = header
        .channels
        .iter()
        .map(|channel| channel.name())
        .collect();
    assert_eq!(names, ["Fx", "Fy", "Fz"], "and no Pz");
    assert!(header.stream.expect("a stream").numbered);
    let table = dataset.table();
    let fz = table.channels().position("Fz").expect("measured");
    for (number, held_n) in held_n.into_iter().enumerate() {
        let point = format!("hand-{}", number + 1);
        let rows = (0..table.rows()).filter(|&row| table.point_id()[row].as_ref() == Some(&point));
        let greatest = rows
            .filter_map(|row| table.truth(fz).get(row))
            .fold(f64::NEG_INFINITY, f64::max);
        // Drift and crosstalk of the transducer change the force by some hundredths.
        assert!(
            (greatest - held_n).abs() < 0.15,
            "{point}: {greatest} N, held at {held_n} N"
        );
    }
    let checked = bench.run("check presses");
    assert!(checked.out.contains("TAC008"), "{}", checked.out);
    bench.ok("fit presses --model ridge --set size=8x6 --out m.taceva -q");
    let scores = bench.json("evaluate presses --model ridge --set size=8x6");
    assert_eq!(scores["provenance"]["model"]["name"], "ridge", "{scores}");
}

#[test]
fn a_capture_shows_the_laboratory_and_the_operator_of_its_rig_file() {
    let emulated = Emulated::new();
    let bench = Bench::new();
    let stated = "rig_version = 1\nlaboratory = \"Soft Robotics\"";
    let rig = emulated.rig().replacen("rig_version = 1", stated, 1);
    let operator = "[operator]\nname = \"A. Lovelace\"\n";
    bench.write("hand.toml", &format!("{rig}\n{operator}"));
    bench.ok("capture held --rig hand.toml --frames 12 -q");
    bench.ok("capture other --rig hand.toml --frames 12 --operator Grace -q");
    let sensor = emulated.sensor();
    bench.ok(&format!(
        "capture named --rig hand.toml --sensor {sensor} --frames 12 -q"
    ));
    for (name, person) in [
        ("held", "A. Lovelace"),
        ("other", "Grace"),
        ("named", "A. Lovelace"),
    ] {
        let shown = bench.ok(&format!("show {name}"));
        let by = format!("recorded  by {person}");
        let (before_settings, _) = shown.split_once("\nsetting").expect("settings");
        for line in ["recorded  at Soft Robotics", by.as_str()] {
            assert!(before_settings.lines().any(|own| own == line), "{shown}");
        }
    }
}

#[test]
fn a_capture_keeps_the_certificate_of_its_rig_file() {
    let emulated = Emulated::new();
    let bench = Bench::new();
    let certificate = "[force.certificate]\nnumber = \"D-K-1\"\nlaboratory = \"a laboratory\"\nissued = 2026-05-12\nserial = \"42\"\nk = 2.0\nU = { Fz = \"3.0 mN\" }\n";
    bench.write("hand.toml", &format!("{}\n{certificate}", emulated.rig()));
    bench.ok("capture held --rig hand.toml --frames 12 -q");
    let dataset = Dataset::open(&bench.path("held")).expect("whole");
    let [force] = dataset.header().traceability.as_slice() else {
        panic!("{:?}", dataset.header().traceability);
    };
    assert_eq!(force.driver.as_deref(), Some("sri/m8128"));
    let number = force.certificate.as_ref().map(|of| of.number.as_str());
    assert_eq!(number, Some("D-K-1"));
    let wrong = certificate.replace("3.0 mN", "3.0 um");
    bench.write("hand.toml", &format!("{}\n{wrong}", emulated.rig()));
    let ran = bench.run("capture other --rig hand.toml --frames 12 -q");
    assert!(
        ran.err.contains("[force.certificate]: `U.Fz`"),
        "{}",
        ran.err
    );
}

#[test]
fn the_drift_of_a_clock_of_a_camera_is_recorded_with_its_uncertainty() {
    let emulated = Emulated::new();
    let bench = Bench::new();
    // Far above what delays of frames on a busy machine look like: 2 s in 10 s.
    let sensor = emulated.drifting_sensor(200_000.0);
    bench.ok(&format!("capture drifting --sensor {sensor} --for 10s -q"));
    let dataset = Dataset::open(&bench.path("drifting")).expect("whole");
    let settings = &dataset.header().settings;
    let [ppm, u_ppm] = ["sensor_clock_drift_ppm", "sensor_clock_drift_u_ppm"]
        .map(|name| settings[name].parse::<f64>().expect("a number"));
    assert!((ppm - 200_000.0).abs() < 60_000.0, "{ppm} ± {u_ppm}");
    assert!(u_ppm > 0.0 && u_ppm < 60_000.0, "{ppm} ± {u_ppm}");
    let shown = bench.ok("show drifting");
    assert!(shown.contains("sensor_clock_drift_ppm"), "{shown}");
}

#[test]
fn a_sensor_alone_is_recorded_as_its_files_came() {
    let emulated = Emulated::new();
    let bench = Bench::new();
    let sensor = emulated.sensor();
    bench.ok(&format!(
        "capture alone --sensor {sensor} --frames 12 --name gel --serial 7 -q"
    ));
    let dataset = Dataset::open(&bench.path("alone")).expect("whole");
    let header = dataset.header();
    assert_eq!((header.table.rows, header.source), (12, Source::Recorded));
    assert!(header.recorded_on.is_some() && header.traceability.is_empty());
    assert_eq!(
        (header.sensor.model.as_str(), header.sensor.serial.as_str()),
        ("gel", "7")
    );
    assert!(header.channels.is_empty());
    let frames = header.frames.as_ref().expect("frames");
    assert!(
        frames.reference.is_some(),
        "the first is of the untouched gel"
    );
    let pack = std::fs::read(bench.path("alone/frames/0000.pack")).expect("a pack");
    assert!(pack.starts_with(b"\xff\xd8\xff"), "JPEG, as it was sent");
    for row in 0..12 {
        dataset.frame(row).expect("read").expect("a frame");
    }
    // An existing recording is not overwritten.
    bench.refused(
        &format!("capture alone --sensor {sensor} --frames 1"),
        3,
        "alone",
    );
}

#[test]
fn a_capture_says_what_ends_it() {
    let bench = Bench::new();
    for (name, end, said) in [
        (
            "frames",
            "--frames 30",
            "press; Ctrl-C ends the capture, or 30 frames",
        ),
        ("time", "--for 1s", "press; Ctrl-C ends the capture, or 1 s"),
    ] {
        let ran = bench.run(&format!(
            "capture {name} --sensor sim/gelsight:seed=3 {end}"
        ));
        assert!(ran.code == 0 && ran.err.contains(said), "{}", ran.err);
    }
}

#[test]
fn a_capture_that_awaits_no_further_frame_does_not_call_to_press() {
    let bench = Bench::new();
    let ran = bench.run("capture single --sensor sim/gelsight:seed=3 --frames 1");
    assert_eq!(ran.code, 0, "{}", ran.err);
    assert!(ran.err.contains("single: 1 frame"), "{}", ran.err);
    assert!(!ran.err.contains("press; Ctrl-C"), "{}", ran.err);
}

#[test]
fn simulated_and_recorded_sensors_are_captured_in_their_own_time() {
    let bench = Bench::new();
    let ran = bench.run("capture drawn --sensor sim/gelsight:seed=3 --frames 5");
    let said = "nothing here is measured: the devices are simulated";
    assert!(ran.code == 0 && ran.err.contains(said), "{}", ran.err);
    let dataset = Dataset::open(&bench.path("drawn")).expect("whole");
    assert_eq!(dataset.header().source, Source::Simulated);
    assert_eq!(dataset.header().stream.expect("a stream").lost(), 0);
    let emulated = Emulated::new();
    bench.refused(
        &format!(
            "capture mixed --sensor sim/gelsight --force {}",
            emulated.force()
        ),
        2,
        "omit --force",
    );
}

#[test]
fn without_an_end_ctrl_c_is_the_end() {
    let emulated = Emulated::new();
    let bench = Bench::new();
    let words = format!("capture endless --sensor {}", emulated.sensor());
    let running = Running::start(&bench, &words);
    running.until_it_says("press; Ctrl-C");
    std::thread::sleep(Duration::from_millis(300));
    running.interrupt();
    let ran = running.ended();
    assert_eq!(ran.code, 0, "{}", ran.err);
    let dataset = Dataset::open(&bench.path("endless")).expect("whole");
    assert!(dataset.table().rows() > 3);
}

#[test]
fn frames_that_nobody_took_in_time_are_counted_and_check_says_so() {
    let emulated = Emulated::new();
    let bench = Bench::new();
    let words = format!("capture stopped --sensor {} --for 4s", emulated.sensor());
    let running = Running::start(&bench, &words);
    running.until_it_says("press; Ctrl-C");
    // The process pauses for a second, as on a busy machine; the frames wait in the socket.
    running.signal("STOP");
    std::thread::sleep(Duration::from_secs(1));
    running.signal("CONT");
    let ran = running.ended();
    assert_eq!(ran.code, 0, "{}", ran.err);
    let dataset = Dataset::open(&bench.path("stopped")).expect("whole");
    let stream = dataset.header().stream.expect("a stream");
    assert!(stream.dropped > 0, "{stream:?}");
    let said = format!("{} were lost", stream.lost());
    assert!(ran.err.contains(&said), "{said} in {}", ran.err);
    let checked = bench.run("check stopped");
    assert!(checked.out.contains("TAC015"), "{}", checked.out);
}

#[test]
fn presses_on_a_reversed_transducer_print_the_axes_to_write() {
    let emulated = Emulated::new();
    let bench = Bench::new();
    let right = format!("axes = {:?}", Base::AXES);
    let rig = emulated
        .rig()
        .replace(&right, "axes = [\"x\", \"y\", \"z\"]");
    bench.write("hand.toml", &rig);
    let running = Running::start(&bench, "capture presses --rig hand.toml --for 120s");
    running.until_it_says("press; Ctrl-C");
    emulated.press(&mut emulated.robot(), [0.0, 0.0], 0.6, || {
        std::thread::sleep(Duration::from_millis(350));
    });
    running.interrupt();
    let ran = running.ended();
    let lines = format!("write `{right}` or `axes = [\"-x\", \"y\", \"-z\"]`, whichever makes");
    assert!(ran.err.contains(&lines), "{}", ran.err);
}

#[test]
fn what_a_transducer_says_of_itself_is_recorded_and_what_delays_it_is_a_warning() {
    let emulated = Emulated::new();
    let filtered = netft::Setup {
        filter: 8,
        ..netft::Setup::PLAIN
    };
    let host = Ipv4Addr::LOCALHOST;
    let force = netft::Emulator::set_up(&emulated.bench, host, 0, 0, filtered).expect("a box");
    let bench = Bench::new();
    let ran = bench.run(&format!(
        "capture out --sensor {} --force {} --frames 12",
        emulated.sensor(),
        force.selector()
    ));
    assert_eq!(ran.code, 0, "{}", ran.err);
    let warnings = ran.err.matches("warning: low pass 8 of the box").count();
    assert_eq!(warnings, 1, "{}", ran.err);
    assert!(ran.err.contains("Fz never exceeded 0.1 N"), "{}", ran.err);
    let dataset = Dataset::open(&bench.path("out")).expect("whole");
    let kept = &dataset.header().warnings;
    assert!(
        kept.len() == 1 && kept[0].starts_with("low pass 8 of the box"),
        "{kept:?}"
    );
    let settings = &dataset.header().settings;
    let serial = emulated.bench.serial();
    for (name, expected) in [
        ("force_serial", serial.as_str()),
        ("force_filter", "8"),
        ("force_frame", "own"),
        ("force_rate_hz", "500"),
        ("force_bias", "none"),
        ("force_unit", "N"),
        ("force_torque_unit", "N-m, converted at 1000 N·mm"),
    ] {
        let found = settings.get(name).map(String::as_str);
        assert_eq!(found, Some(expected), "{name} of {settings:?}");
    }
}
