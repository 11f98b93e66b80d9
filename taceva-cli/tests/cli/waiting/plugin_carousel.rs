//! The changer in `examples/plugins/carousel`, which is a plugin: refused, allowed, checked, and used in a run on an emulated bench. In the same
//! run it is also stuck, wrong, unresponsive and gone.

#![cfg(target_os = "linux")]

use std::collections::BTreeSet;
use std::io::{BufRead, BufReader, Write};
use std::net::{TcpListener, TcpStream};
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::Duration;

use crate::support::emulated::Emulated;
use crate::support::{Bench, Ran};
use taceva_core::{GratingKind, Nanometre};
use taceva_dataset::Dataset;
use taceva_wire::WallBench;

const ID: &str = "org.example.carousel";
const FOLDER: &str = "--plugin-dir carousel";
const HOLDS: &str = "sphere of radius 2 mm, line grating of 1 mm, line grating of 1.5 mm";

/// Behaviour of the emulated carousel when it turns to its second or third place.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Mood {
    Well,
    Stuck,
    BringsAnother,
    Silent,
    Gone,
}

/// Requested places, each with true if the arm was above the gel at the beginning and the end of the turn.
type Turns = Mutex<Vec<(usize, bool)>>;

/// Emulated carousel, to which the driver connects.
struct Carousel {
    port: u16,
    mood: Arc<Mutex<Mood>>,
    turns: Arc<Turns>,
}

impl Carousel {
    fn over(bench: &WallBench) -> Carousel {
        let listener = TcpListener::bind("127.0.0.1:0").expect("a port");
        let port = listener.local_addr().expect("bound").port();
        let mood = Arc::new(Mutex::new(Mood::Well));
        let turns = Arc::new(Mutex::new(Vec::new()));
        let shared = (bench.clone(), Arc::clone(&mood), Arc::clone(&turns));
        // The thread ends with the test.
        thread::spawn(move || {
            for stream in listener.incoming() {
                let (bench, mood, turns) = shared.clone();
                let stream = stream.expect("a connection");
                thread::spawn(move || serve(stream, &bench, (&mood, &turns)));
            }
        });
        Carousel { port, mood, turns }
    }

    fn is(&self, mood: Mood) {
        *self.mood.lock().expect("whole") = mood;
    }
}

fn stands_above(bench: &WallBench) -> bool {
    let truth = bench.truth();
    !truth.is_moving && truth.tip_mm[2] < -0.5
}

fn serve(stream: TcpStream, bench: &WallBench, (mood, turns): (&Mutex<Mood>, &Turns)) {
    let mut answers = stream.try_clone().expect("a second handle");
    for line in BufReader::new(stream).lines() {
        let Ok(line) = line else {
            return;
        };
        let place = line
            .strip_prefix("turn ")
            .expect("the only thing it is told");
        let place: usize = place.parse().expect("a number");
        let before = stands_above(bench);
        thread::sleep(Duration::from_millis(150));
        turns
            .lock()
            .expect("whole")
            .push((place, before && stands_above(bench)));
        let mood = match place {
            1 => Mood::Well,
            _ => *mood.lock().expect("whole"),
        };
        let answer = match mood {
            Mood::Well => {
                mount(bench, place);
                format!("at {place}\n")
            }
            Mood::Stuck => "fault the motor is hot\n".to_owned(),
            Mood::BringsAnother => "at 1\n".to_owned(),
            Mood::Silent => continue,
            Mood::Gone => return,
        };
        if answers.write_all(answer.as_bytes()).is_err() {
            return;
        }
    }
}

fn mount(bench: &WallBench, place: usize) {
    let mm = |length| Nanometre::from_millimetres(length).expect("a length");
    let mounted = match place {
        1 => taceva_sim::Mounted::ball(mm(2.0)),
        2 => taceva_sim::Mounted::board(GratingKind::Line, mm(1.0)),
        _ => taceva_sim::Mounted::board(GratingKind::Line, mm(1.5)),
    };
    bench
        .mount(mounted.expect("it has it"))
        .expect("it is away from the gel");
}

/// Scene with six presses of a ball, and four presses of each of two boards.
const SCENE: &str = r#"scene_version = 1
name = "wire"
seed = 7
sensor = { driver = "sim/gelsight", opaque = true, markers = true, footprint = { shape = "rect", half_x_mm = 8.0, half_y_mm = 10.0 } }
robot = { driver = "sim/robot" }
force = { driver = "sim/force-transducer" }
limits = { Pz_max_mm = 1.0, Fz_max_N = 1.8 }
model = { name = "ridge" }
metrics = { want = ["accuracy", "sr"] }
[protocol]
contact = { speed_mm_s = 2.0, threshold_N = 0.05 }
calibration = { points = 6, indentations = 1 }
gratings = { from_mm = 1.0, to_mm = 1.5, step_mm = 0.5, kinds = ["line"], presses = 4 }
"#;

/// Runs or resumes the scene until `is_done`, because a busy machine may end a run by the failure of another device.
fn run_until(bench: &Bench, is_done: impl Fn(&Ran) -> bool) -> Ran {
    let mut ran = None;
    for _ in 0..8 {
        let resume = match bench.path("r").exists() {
            true => " --resume",
            false => "",
        };
        let once = bench.run(&format!(
            "run scene.toml --rig lab.toml --out r {FOLDER}{resume}"
        ));
        let is_last = is_done(&once) || once.code != 4;
        ran = Some(once);
        if is_last {
            break;
        }
    }
    ran.expect("it ran")
}

#[test]
fn a_carousel_changes_what_an_emulated_bench_presses_with_and_its_failures_lose_nothing() {
    let bench = Bench::new();
    bench.make_example("changer", "carousel");
    assert_eq!(bench.run("plugin manifest carousel").code, 0);
    let emulated = Emulated::new();
    let carousel = Carousel::over(&emulated.bench);
    let selector = format!(
        "{ID}/carousel:host=localhost;port={};holds={HOLDS}",
        carousel.port
    );

    // Refused, allowed, checked.
    let check = |bench: &Bench| {
        let mut command = bench.command(&format!(
            "plugin check {ID} {FOLDER} --only driver/opens,changer/ --move --with"
        ));
        let output = command.arg(&selector).output().expect("the program starts");
        let said = String::from_utf8_lossy(&output.stdout).into_owned();
        (output.status.code(), said)
    };
    let (code, refused) = check(&bench);
    assert_eq!(code, Some(1), "{refused}");
    assert_eq!(bench.paste(&refused).code, 0);
    let (code, checked) = check(&bench);
    assert_eq!(code, Some(0), "{checked}");
    assert!(checked.contains("changer/brings-each-thing"), "{checked}");
    carousel.turns.lock().expect("whole").clear();

    bench.write("scene.toml", SCENE);
    let rig = emulated.rig_with_robot();
    bench.write(
        "lab.toml",
        &format!("{rig}\n[changers]\nspecimen = \"{selector}\"\npatience_s = 2.0\n"),
    );
    let plan = bench.run(&format!("plan scene.toml --rig lab.toml {FOLDER}"));
    assert_eq!(plan.code, 0, "{}{}", plan.out, plan.err);
    assert!(
        plan.err
            .contains("3 specimens are changed by `org.example.carousel/carousel"),
        "{}",
        plan.err
    );
    assert!(!plan.err.contains("changed by hand"), "{}", plan.err);

    // No operator. Each failure ends the run before the board is pressed; every press before it is kept.
    for (mood, said) in [
        (Mood::Stuck, "the motor is hot"),
        (
            Mood::BringsAnother,
            "the changer reports `sphere of radius 2 mm` in place, expected `line grating of ",
        ),
        (Mood::Silent, "it has not arrived"),
        (Mood::Gone, "it closed the connection"),
    ] {
        carousel.is(mood);
        let ran = run_until(&bench, |ran| ran.err.contains(said));
        assert_eq!(ran.code, 4, "{mood:?}: {}", ran.err);
        assert!(ran.err.contains(said), "{mood:?}: {}", ran.err);
        assert!(ran.err.contains("continued by `"), "{mood:?}: {}", ran.err);
        assert!(stands_above(&emulated.bench), "{mood:?}");
    }
    carousel.is(Mood::Well);
    let ran = run_until(&bench, |ran| ran.code == 0);
    assert_eq!(ran.code, 0, "{}", ran.err);
    let turns = carousel.turns.lock().expect("whole").clone();
    assert!(turns.iter().all(|(_, stood)| *stood), "{turns:?}");
    let places = turns.iter().map(|(place, _)| *place);
    assert_eq!(BTreeSet::from_iter(places), BTreeSet::from([1, 2, 3]));

    // Each of the 14 presses exactly once.
    let dataset = Dataset::open(&bench.path("r/recordings/1-wire")).expect("it is whole");
    let samples = dataset.table().samples();
    let ids: BTreeSet<&String> = samples.iter().collect();
    assert_eq!(ids.len(), samples.len(), "{ids:?}");
    assert!(samples.len() >= 14, "{ids:?}");
}
