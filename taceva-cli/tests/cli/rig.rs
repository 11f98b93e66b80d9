//! Devices and rigs, before any measurement.

use crate::support::Bench;

#[test]
fn the_drivers_of_the_simulated_bench_are_linked_in_and_say_that_they_are_simulated() {
    let devices = Bench::new().json("devices");
    assert_eq!(devices["schema"], "taceva.devices/1");
    let drivers = devices["drivers"].as_array().expect("a list");
    let simulated: Vec<&str> = drivers
        .iter()
        .filter(|driver| driver["source"] == "simulated")
        .filter_map(|driver| driver["key"].as_str())
        .collect();
    assert_eq!(
        simulated,
        [
            "sim/gelsight",
            "sim/gelsight-wm",
            "sim/magictac",
            "sim/vitactip",
            "sim/robot",
            "sim/force-transducer",
            "sim/lighting",
        ]
    );
}

#[test]
fn the_list_for_people_names_facts_and_arguments() {
    let out = Bench::new().ok("devices");
    let gelsight = out
        .lines()
        .skip_while(|line| !line.starts_with("sim/gelsight "));
    let lines: Vec<&str> = gelsight.take(4).collect();
    assert!(lines[0].ends_with(" simulated: GelSight"), "{out}");
    assert!(lines[1].contains("opaque, markers, Pz up to 1 mm"), "{out}");
    assert!(lines[2].trim().starts_with("rig "), "{out}");
    let camera = |line: &&str| line.starts_with("camera/v4l2 ");
    let camera = out.lines().skip_while(|line| !camera(line));
    let lines: Vec<&str> = camera
        .take_while(|line| !line.starts_with("sim/"))
        .collect();
    assert!(
        lines[0].ends_with(" real: a camera of this machine"),
        "{out}"
    );
    let exposure = lines
        .iter()
        .find(|line| line.trim().starts_with("exposure_ms "));
    let device = lines.iter().find(|line| line.trim().starts_with("device "));
    let (exposure, device) = (exposure.expect("listed"), device.expect("listed"));
    let value = exposure.find("a number").expect("what it takes");
    assert!(
        device[..value].ends_with(' ') && !device[value..].starts_with(' '),
        "{out}"
    );
}

#[test]
fn the_pedal_is_listed_as_an_enabling_switch_and_refused_as_a_device_with_the_key_of_its_place() {
    let bench = Bench::new();
    let listed = bench.json("devices");
    assert_eq!(listed["switches"][0]["key"], "hid/pedal");
    let out = bench.ok("devices");
    let pedal = out.lines().find(|line| line.starts_with("hid/pedal "));
    let pedal = pedal.expect("listed");
    assert!(
        pedal.contains(" switch ") && pedal.contains("`enable` under [operator]"),
        "{pedal}"
    );
    bench.write(
        "lab.toml",
        "rig_version = 1\n[sensor]\ndriver = \"hid/pedal:usb=0c45:7403\"\n",
    );
    let refused = "lab.toml, line 3: `hid/pedal` is an enabling switch and measures nothing: write it as `enable` under [operator]";
    bench.refused("rig check lab.toml", 3, refused);
}

#[test]
fn the_doctor_says_what_was_looked_at_and_its_exit_code_follows() {
    let bench = Bench::new();
    let ran = bench.run("doctor --format json");
    let found: serde_json::Value = serde_json::from_str(&ran.out).expect("JSON");
    let findings = found["findings"].as_array().expect("a list");
    assert_eq!(findings[0]["code"], "drivers");
    let is_problem = findings.iter().any(|finding| finding["state"] == "problem");
    assert_eq!(ran.code, i32::from(is_problem));
    assert_eq!(bench.run("doctor").code, ran.code);
}

#[test]
fn a_check_of_a_rig_goes_on_after_a_device_that_does_not_open_and_names_each_with_its_remedy() {
    let bench = Bench::new();
    bench.write(
        "lab.toml",
        r#"rig_version = 1
[robot]
driver = "gcode/grbl:port=/dev/tty-of-nobody"
carries = "indenter"
origin_mm = [0.0, 0.0, 0.0]
axes = ["x", "y", "z"]
[sensor]
driver = "camera/v4l2:device=/dev/video-of-nobody"
"#,
    );
    let ran = bench.run("rig check lab.toml");
    assert_eq!(ran.code, 1, "{}", ran.err);
    for part in [
        "force   is not in the rig file",
        "robot   error: lab.toml: robot: gcode/grbl",
        "`taceva doctor` missing permissions",
        "sensor  error: lab.toml: sensor: camera/v4l2",
        "`taceva devices` lists cameras",
        "halt    skipped: nothing moves, because the robot failed",
    ] {
        assert!(ran.out.contains(part), "no `{part}` in {}", ran.out);
    }
    assert!(!ran.out.contains("study"), "{}", ran.out);
}

#[test]
fn a_weight_needs_a_mass_with_its_unit_and_a_person_at_a_terminal() {
    let bench = Bench::new();
    let force = "[force]\ndriver = \"ati/netft:host=127.0.0.1\"\naxes = [\"x\", \"y\", \"z\"]\n";
    bench.write("lab.toml", &format!("rig_version = 1\n{force}"));
    for mass in ["100", "1lb", "0g", "NaNg", "101kg"] {
        let expected = "expected a mass in mg, g or kg, such as 100g, up to 100kg";
        bench.refused(&format!("rig check lab.toml --weight {mass}"), 2, expected);
    }
    let expected = "--weight asks a person to hang the weight on the transducer: start `taceva rig check --weight` from a terminal";
    bench.refused("rig check lab.toml --weight 0.1kg", 2, expected);
}

#[cfg(target_os = "linux")]
#[test]
fn a_rig_file_that_cannot_be_replaced_is_refused_before_anybody_works_for_its_result() {
    let bench = Bench::new();
    let force = "[force]\ndriver = \"ati/netft:host=127.0.0.1\"\naxes = [\"x\", \"y\", \"z\"]\n";
    let text = format!("rig_version = 1\nsimulated = true\n{force}");
    // Nothing can be created in the folder of this name.
    let rig = "/proc/self/fd/0";
    let expected = format!("{rig}: cannot be replaced by the result");
    for words in [
        format!("rig check {rig} --weight 100g"),
        format!("rig tap {rig}"),
        format!("rig teach {rig}"),
    ] {
        let ran = bench.answered(&words, &text);
        assert_eq!(ran.code, 3, "{words}: {}", ran.err);
        assert!(ran.err.contains(&expected), "{words}: {}", ran.err);
    }
    let dry = bench.answered(&format!("rig tap {rig} --dry-run"), &text);
    assert!(!dry.err.contains(&expected), "{}", dry.err);
}

#[test]
fn a_wrong_argument_in_a_rig_file_is_refused_with_its_line_before_a_device_is_opened() {
    let bench = Bench::new();
    let sensor = "[sensor]\ndriver = \"camera/v4l2:device=/dev/video-of-nobody\"\n";
    let force = "[force]\ndriver = \"ati/netft:hots=10.0.0.9\"\naxes = [\"x\", \"y\", \"z\"]\n";
    bench.write("lab.toml", &format!("rig_version = 1\n{sensor}{force}"));
    bench.refused("rig check lab.toml", 3, "lab.toml, line 5: ");
    bench.refused("rig check lab.toml", 3, "`hots`");
}

#[test]
fn a_run_in_the_air_refuses_a_folder_and_whatever_concerns_one() {
    let bench = Bench::new();
    for (words, other) in [
        ("run scene.toml --air --out x", "--out <FOLDER>"),
        ("run scene.toml --air --resume", "--resume"),
        ("run scene.toml --air --force", "--force"),
    ] {
        let expected = format!("the argument '--air' cannot be used with '{other}'");
        bench.refused(words, 2, &expected);
    }
}
