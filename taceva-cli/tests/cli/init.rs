//! `taceva init`: initial files, written from the answers to questions.

use std::fs;

use crate::support::Bench;

fn read(bench: &Bench, name: &str) -> String {
    fs::read_to_string(bench.path(name)).expect(name)
}

/// Test folder with a lab's folder whose table states neither unit nor sensor.
fn lab() -> Bench {
    let bench = Bench::new();
    bench.lab();
    let labels = read(&bench, "lab/labels.csv");
    let labels = labels.replace("place_mm", "Px").replace("force_N", "Fz");
    bench.write("lab/labels.csv", &labels);
    bench
}

#[test]
fn a_recording_gets_a_map_by_questions_that_imports_and_evaluates() {
    let bench = lab();
    // An invalid unit is asked for again.
    let ran = bench.answered(
        "init recording lab --out lab.toml",
        "mm\nnewton\nN\nmy gel\n",
    );
    assert_eq!(ran.code, 0, "{}{}", ran.out, ran.err);
    assert!(ran.err.contains("unknown unit `newton`"), "{}", ran.err);
    let map = read(&bench, "lab.toml");
    assert!(
        !map.lines()
            .any(|line| !line.starts_with('#') && line.contains("\"?\"")),
        "{map}"
    );
    assert!(!ran.out.contains("fill in"), "{}", ran.out);
    for line in ran
        .out
        .lines()
        .filter(|line| line.starts_with("  taceva import"))
    {
        let imported = bench.shell(line.trim());
        assert_eq!(imported.code, 0, "{line}: {}", imported.err);
    }
    let evaluated = bench.json("evaluate my-dataset --set epochs=2");
    let model = evaluated["provenance"]["model"].to_string();
    assert!(model.contains("cnn"), "{model}");
}

#[test]
fn a_recording_without_answers_keeps_its_open_places_with_yes() {
    let bench = lab();
    let said = bench.ok("init recording lab --yes --out first.toml");
    assert!(said.contains("fill in the 2 places"), "{said}");
    let contacts = "if several rows show one contact";
    assert!(said.contains(contacts), "{said}");
    assert!(said.contains("  taceva check my-dataset\n"), "{said}");
    let map = read(&bench, "first.toml");
    assert!(map.contains("unit = \"?\""), "{map}");
    // The name of the sensor has a default.
    assert!(map.contains("\nmodel = \"unknown\"\n"), "{map}");
    bench.refused(
        "init recording lab --yes",
        3,
        "map.toml exists already; --force replaces it",
    );
}

#[test]
fn a_file_stands_for_its_folder_in_drafts_and_in_the_commands_that_follow() {
    let bench = lab();
    let said = bench.ok("init recording lab/labels.csv --yes --out first.toml");
    assert!(
        said.contains("taceva import lab --map first.toml --explain"),
        "{said}"
    );
    let map = read(&bench, "first.toml");
    assert!(map.contains("column = \"file\""), "{map}");
    assert_eq!(
        bench.ok("import --draft lab/labels.csv"),
        bench.ok("import --draft lab")
    );
    let ran = bench.run("import --draft lab/labels.csv --out second.toml");
    let places = "second.toml: a draft, in which 3 places are `\"?\"`; fill them in, then: taceva import lab --map second.toml";
    assert!(ran.err.contains(places), "{}", ran.err);
}

#[test]
fn a_channel_is_left_out_by_none_and_a_named_column_keeps_the_reason_against_it() {
    let bench = Bench::new();
    let rows = (0..8).map(|row| format!("{0}.5,{0}.25,{0}.75,0.0\n", row * row % 7));
    let table = format!("fz_raw,fz_filtered,fz_cmd,fx\n{}", rows.collect::<String>());
    bench.write("lab/labels.csv", &table);
    // The answers for Fz, its unit, Fx (left out) and the sensor.
    let ran = bench.answered("init recording lab --out map.toml", "fz_cmd\nN\n\nmy gel\n");
    assert_eq!(ran.code, 0, "{}{}", ran.out, ran.err);
    let map = read(&bench, "map.toml");
    let named = "Fz = { from = \"fz_cmd\", unit = \"N\" }   # named by you, though `cmd` means commanded, not measured\n";
    assert!(map.contains(named), "{map}");
    assert!(map.contains("\n# Left out: Fx = "), "{map}");
    let against = "the draft does not treat \"fz_cmd\" as a channel";
    assert!(ran.err.contains(against), "{}", ran.err);
    assert!(!ran.out.contains("fill in"), "{}", ran.out);
    bench.ok("import lab --map map.toml --explain");
}

#[test]
fn a_folder_without_labels_is_followed_by_predictions() {
    let bench = lab();
    fs::remove_file(bench.path("lab/labels.csv")).expect("it was there");
    let said = bench.ok("init recording lab --yes --out first.toml");
    assert!(
        said.contains("taceva predict my-dataset --with MODEL"),
        "{said}"
    );
    assert!(!said.contains("taceva evaluate"), "{said}");
}

#[test]
fn an_import_without_pictures_warns_and_its_evaluation_names_the_remedy() {
    let bench = Bench::new();
    bench.lab();
    let map = read(&bench, "map.toml");
    let frame = "[frame]\ncolumn = \"file\"\nchannel_order = \"gray\"\nreference = \"unknown\"\n";
    assert!(map.contains(frame), "{map}");
    bench.write("bare.toml", &map.replace(frame, ""));
    let done = bench.ok("import lab --map bare.toml --out bare");
    assert!(
        done.contains("no-pictures: the map has no [frame]"),
        "{done}"
    );
    bench.refused(
        "evaluate bare",
        2,
        "the dataset has neither pictures nor signals: name the pictures by [frame] of its map",
    );
}

#[test]
fn an_import_without_a_map_names_the_command_that_writes_one() {
    let bench = lab();
    bench.refused(
        "import lab --out data",
        2,
        "no map: `taceva init recording lab --out map.toml` writes one, and `taceva import --presets` lists layouts that need none",
    );
    bench.refused(
        "import lab --map none.toml --out data",
        3,
        "none.toml: no such map: `taceva init recording lab --out none.toml` writes one",
    );
}

#[test]
fn answers_that_end_are_refused_with_the_question_and_the_earlier_ones_are_kept() {
    let bench = lab();
    let ran = bench.answered("init recording lab --out first.toml", "mm\n");
    assert_eq!(ran.code, 2, "{}", ran.err);
    assert!(
        ran.err
            .contains("standard input ended before an answer to: unit of Fz"),
        "{}",
        ran.err
    );
    assert!(
        ran.err.contains("first.toml has the answers so far"),
        "{}",
        ran.err
    );
    let map = read(&bench, "first.toml");
    assert!(
        map.contains("Px = { from = \"Px\", unit = \"mm\" }"),
        "{map}"
    );
    assert!(
        map.contains("Fz = { from = \"Fz\", unit = \"?\" }"),
        "{map}"
    );
    let ran = bench.answered("init recording lab --out second.toml", "");
    assert_eq!(ran.code, 2, "{}", ran.err);
    assert!(!bench.path("second.toml").exists());
}

#[cfg(unix)]
#[test]
fn a_signal_ends_the_questions_and_the_earlier_answers_are_kept() {
    use std::io::{Read as _, Write as _};
    use std::process::{Command, Stdio};
    let bench = lab();
    let mut child = bench
        .command("init recording lab --out first.toml")
        .stdin(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("starts");
    let mut answers = child.stdin.take().expect("a pipe");
    answers.write_all(b"mm\n").expect("written");
    let mut questions = child.stderr.take().expect("a pipe");
    let mut asked = Vec::new();
    while !String::from_utf8_lossy(&asked).contains("unit of Fz") {
        let mut byte = [0];
        questions.read_exact(&mut byte).expect("a question");
        asked.extend(byte);
    }
    let kill = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status();
    assert!(kill.is_ok(), "kill is there");
    questions.read_to_end(&mut asked).expect("read");
    let status = child.wait().expect("ended");
    let asked = String::from_utf8_lossy(&asked);
    assert_eq!(status.code(), Some(5), "{asked}");
    assert!(
        asked.contains("stopped before an answer to: unit of Fz"),
        "{asked}"
    );
    let map = read(&bench, "first.toml");
    assert!(
        map.contains("Px = { from = \"Px\", unit = \"mm\" }"),
        "{map}"
    );
}

#[test]
fn a_scene_of_defaults_is_planned_and_of_two_sensors_has_a_study_each() {
    let bench = Bench::new();
    bench.ok("init scene --yes --out one.toml");
    assert!(bench.ok("plan one.toml").contains("200 presses"));
    let answers = "two gels\n\nsim/gelsight, sim/gelsight-wm\n20\n2\nridge\nall\n1\n";
    let ran = bench.answered("init scene --out two.toml", answers);
    assert_eq!(ran.code, 0, "{}", ran.err);
    assert_eq!(read(&bench, "two.toml").matches("[[study]]").count(), 2);
    bench.ok("plan two.toml");
    let wrong = bench.answered("init scene --out three.toml", "x\nsimulated\nsim/none\n");
    assert!(
        wrong.err.contains("`sim/none` is not a simulated sensor"),
        "{}",
        wrong.err
    );
}

#[test]
fn a_rig_asks_for_devices_their_addresses_and_limits() {
    let bench = Bench::new();
    let answers = "ufactory/xarm\n192.168.1.200\nindenter\nati/netft\n192.168.1.1\ncamera/v4l2\n/dev/video0\n-1\n1.5\n2\n0.5\n\n";
    let ran = bench.answered("init rig --out lab.toml", answers);
    assert_eq!(ran.code, 0, "{}{}", ran.out, ran.err);
    let rig = read(&bench, "lab.toml");
    for line in [
        "driver = \"ufactory/xarm:host=192.168.1.200\"",
        "driver = \"ati/netft:host=192.168.1.1\"",
        "driver = \"camera/v4l2:device=/dev/video0\"",
        "Pz_max_mm = 1.5",
        "Fz_max_N = 2.0",
        "Fxy_max_N = 0.5",
        "speed_max_mm_s = 20.0",
    ] {
        assert!(rig.contains(line), "no `{line}` in\n{rig}");
    }
    assert!(
        ran.err.contains("expected a number from 0.01 to 50"),
        "{}",
        ran.err
    );
    bench.ok("init scene --yes --out scene.toml");
    let planned = bench.run("plan scene.toml --rig lab.toml");
    assert!(!planned.err.contains("lab.toml, line"), "{}", planned.err);
    // No driver of a camera knows the gel, so the plan names the missing line.
    assert_eq!(planned.code, 2, "{}", planned.err);
    let line = "write `footprint = { shape = \"disc\", radius_mm = … }`";
    assert!(planned.err.contains(line), "{}", planned.err);
    bench.refused("run scene.toml --rig lab.toml", 2, line);
    let answers = "my gel\nrig\nround\nrect 16 18\n24\n1\nridge\naccuracy\n7\n";
    let asked = bench.answered("init scene --out stated.toml", answers);
    assert_eq!(asked.code, 0, "{}", asked.err);
    assert!(
        asked.err.contains("expected `disc RADIUS` or"),
        "{}",
        asked.err
    );
    let next = [
        "taceva plan stated.toml --rig rig.toml",
        "taceva run stated.toml --rig rig.toml --air",
        "taceva rig tap rig.toml",
        "taceva run stated.toml --rig rig.toml\n",
    ];
    for line in next {
        assert!(asked.out.contains(line), "no `{line}` in {}", asked.out);
    }
    let stated = read(&bench, "stated.toml");
    let line = "footprint = { shape = \"rect\", half_x_mm = 16.0, half_y_mm = 18.0 }";
    assert!(stated.contains(line), "{stated}");
    let zero = "[protocol.contact]\ndepth_from = \"surface\"";
    assert!(
        stated.contains(zero),
        "a rig has no bench to match: {stated}"
    );
    assert!(
        !stated.contains("sim/"),
        "the rig file names the devices: {stated}"
    );
    let planned = bench.run("plan stated.toml --rig lab.toml");
    assert_eq!(planned.code, 0, "{}", planned.err);
    assert!(planned.out.contains("24 presses"), "{}", planned.out);
    let few = "the test part has 2 contact points, and intervals need 5";
    assert!(planned.err.contains(few), "{}", planned.err);
    for line in [
        "2 N normal and 0.5 N shear",
        "`threshold_N` = 0.02 under [protocol.contact]",
        "24 presses move sideways in contact, by up to ",
    ] {
        assert!(planned.err.contains(line), "no `{line}` in {}", planned.err);
    }
    let untaught = "run `taceva rig teach lab.toml` before a run";
    assert!(planned.err.contains(untaught), "{}", planned.err);
    bench.refused(
        "init rig --yes --out other.toml",
        2,
        "no default for: driver of the robot, alone or with arguments such as",
    );
}

#[test]
fn a_rig_of_addresses_on_this_machine_asks_if_its_devices_are_emulated() {
    let bench = Bench::new();
    let devices = "ufactory/xarm:host=127.0.0.1;port=40001\nindenter\nsri/m8128:host=127.0.0.1\ncamera/mjpeg:url=http://127.0.0.1:40003/\n";
    for (answer, is_stated) in [("yes", true), ("no", false)] {
        let answers = format!("{devices}\n{answer}\n1\n2\n1\n\n");
        let ran = bench.answered("init rig --out wire.toml --force", &answers);
        assert_eq!(ran.code, 0, "{}{}", ran.out, ran.err);
        let question = "an address is on this machine: are the devices emulated";
        assert!(ran.err.contains(question), "{}", ran.err);
        // A robot of this file would move without a typed name.
        assert!(ran.err.contains("an answer is needed here"), "{}", ran.err);
        let rig = read(&bench, "wire.toml");
        let line = "rig_version = 1\nsimulated = true ";
        assert_eq!(rig.contains(line), is_stated, "{rig}");
    }
}

#[test]
fn a_rig_of_a_hand_has_no_robot_and_no_limits_and_names_the_capture() {
    let bench = Bench::new();
    let answers =
        "none\nnone\nsri/m8128:host=192.168.0.108\ncamera/mjpeg:url=http://192.168.1.20:8080/\n";
    let ran = bench.answered("init rig --out hand.toml", answers);
    assert_eq!(ran.code, 0, "{}{}", ran.out, ran.err);
    for words in [
        "or `none` if a hand presses",
        // A hand replaces no transducer.
        "expected one of ",
    ] {
        assert!(ran.err.contains(words), "no `{words}` in {}", ran.err);
    }
    let rig = read(&bench, "hand.toml");
    assert!(
        rig.contains("[force]\ndriver = \"sri/m8128:host=192.168.0.108\""),
        "{rig}"
    );
    for table in ["[robot]", "[limits]", "simulated"] {
        assert!(!rig.contains(table), "{rig}");
    }
    let next = "taceva capture presses --rig hand.toml --for 5min";
    assert!(ran.out.contains(next), "{}", ran.out);
}

#[test]
fn without_a_subject_it_asks_which() {
    let bench = Bench::new();
    let ran = bench.answered("init", "scene\n\n\n\n\n\n\n\n\n");
    assert_eq!(ran.code, 0, "{}", ran.err);
    assert!(bench.path("scene.toml").exists());
}
