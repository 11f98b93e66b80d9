//! `taceva rig check --weight` at a terminal. The tip of an emulated robot presses in place of a weight.

use std::fs::{self, File};
use std::io::{Read, Write};
use std::process::{Child, Stdio};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
use taceva_core::Robot;
use taceva_wire::BenchOptions;

use crate::support::Bench;
use crate::support::emulated::Emulated;

const FREE_FALL_M_S2: f64 = 9.80665;
const DEPTH_MM: f64 = 0.5;
const PATIENCE: Duration = Duration::from_secs(60);

/// A person at a terminal: everything that programs print there, and keys.
struct Person {
    keys: File,
    terminal: String,
    seen: Arc<Mutex<String>>,
}

impl Person {
    fn new() -> Person {
        let master = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY).expect("a terminal");
        grantpt(&master).expect("ours");
        unlockpt(&master).expect("ours");
        let terminal = ptsname(&master, Vec::new()).expect("it has a name");
        let terminal = terminal.to_str().expect("plain").to_owned();
        let keys = File::from(master);
        let mut screen = keys.try_clone().expect("the same terminal");
        // Held open, so that the terminal does not close with its first program.
        let held = File::options().write(true).open(&terminal).expect("open");
        let seen = Arc::new(Mutex::new(String::new()));
        let reading = Arc::clone(&seen);
        std::thread::spawn(move || {
            let _held = held;
            let mut bytes = [0; 4096];
            while let Ok(count @ 1..) = screen.read(&mut bytes) {
                let text = String::from_utf8_lossy(&bytes[..count]);
                reading.lock().expect("whole").push_str(&text);
            }
        });
        Person {
            keys,
            terminal,
            seen,
        }
    }

    fn seat(&self) -> Stdio {
        let terminal = File::options().read(true).write(true).open(&self.terminal);
        Stdio::from(terminal.expect("open"))
    }

    fn seen(&self) -> String {
        self.seen.lock().expect("whole").clone()
    }

    /// Waits for a question, and presses Enter.
    fn answer(&mut self, question: &str) {
        self.wait_for(question);
        self.keys.write_all(b"\n").expect("typed");
    }

    fn wait_for(&self, words: &str) {
        let began = Instant::now();
        while !self.seen().contains(words) {
            assert!(began.elapsed() < PATIENCE, "no `{words}`: {}", self.seen());
            std::thread::sleep(Duration::from_millis(5));
        }
    }
}

/// Compares the force with the weight of `mass_g`. Returns the exit code, the output and the person at the terminal.
fn weighed(
    bench: &Bench,
    emulated: &Emulated,
    robot: &mut Box<dyn Robot>,
    mass_g: f64,
) -> (i32, String, Person) {
    let mut person = Person::new();
    let mut child = bench
        .command(&format!("rig check lab.toml --weight {mass_g:.3}g"))
        .stdin(person.seat())
        .stderr(person.seat())
        .stdout(Stdio::piped())
        .spawn()
        .expect("the program starts");
    person.answer("take every load off the force transducer");
    person.wait_for("on the force transducer, or lay the weight on it");
    let mut code = None;
    emulated.press(robot, [0.0, 0.0], DEPTH_MM, || {
        person.answer("on the force transducer, or lay the weight on it");
        code = Some(end_of(&mut child));
    });
    let mut out = String::new();
    let mut stdout = child.stdout.take().expect("piped");
    stdout.read_to_string(&mut out).expect("text");
    (code.expect("it was pressed"), out, person)
}

fn end_of(child: &mut Child) -> i32 {
    let status = child.wait().expect("it ends");
    status.code().expect("not ended by a signal")
}

#[test]
fn a_person_at_a_terminal_compares_a_weight_and_a_mistaken_unit_leaves_the_file_as_it_was() {
    let emulated = Emulated::over(&BenchOptions::quiet(7));
    let mut robot = emulated.robot();
    let mut force_n = 0.0;
    emulated.press(&mut robot, [0.0, 0.0], DEPTH_MM, || {
        std::thread::sleep(Duration::from_millis(300));
        force_n = emulated.bench.truth().force_n[2].abs();
    });
    assert!(force_n > 0.1, "{force_n} N");
    let mass_g = 1e3 * force_n / FREE_FALL_M_S2;
    let bench = Bench::new();
    let rig = emulated.rig();
    bench.write("lab.toml", &rig);
    let (code, out, person) = weighed(&bench, &emulated, &mut robot, 4.448_222 * mass_g);
    assert_eq!(code, 1, "{out}{}", person.seen());
    assert!(out.contains("pounds-force (lbf)"), "{out}");
    let read = || fs::read_to_string(bench.path("lab.toml")).expect("there");
    assert_eq!(read(), rig);
    let (code, out, person) = weighed(&bench, &emulated, &mut robot, mass_g);
    assert_eq!(code, 0, "{out}{}", person.seen());
    assert!(out.contains("force   ok: Fz changed by"), "{out}");
    person.wait_for("lab.toml: written");
    assert!(read().contains("\nweighing = { mass_g = "), "{}", read());
}
