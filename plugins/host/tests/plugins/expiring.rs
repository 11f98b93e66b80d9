//! A plugin's robot stops an expiring motion after the plugin's process is killed. An ordinary motion to a target continues.

use std::io::{BufRead, BufReader, ErrorKind as IoErrorKind};
use std::net::{TcpListener, TcpStream};
use std::sync::{Arc, Mutex, MutexGuard};
use std::thread;
use std::time::{Duration, Instant};

use taceva_core::{Deadline, EXPIRES, Millimetre, Pose, Rig, Robot, Speed};
use taceva_host::{PluginConfig, PluginHost, Plugins, SearchPath};

use crate::cpp::{built, children};

/// Allowance for a busy test machine.
const SLACK: Duration = Duration::from_millis(60);
const LOOKING: Duration = Duration::from_millis(2);

/// Controller of an arm with one axis. It accepts a speed, which lasts 200 ms, or a target position.
#[derive(Clone, Default)]
struct Controller(Arc<Mutex<State>>);

#[derive(Default)]
struct State {
    process: Option<i32>,
    until: Option<Instant>,
    moved: Option<Instant>,
}

impl Controller {
    /// Listens for the plugin and returns the port.
    fn listening(&self) -> u16 {
        let listener = TcpListener::bind("127.0.0.1:0").expect("a port");
        let port = listener.local_addr().expect("bound").port();
        let controller = self.clone();
        thread::spawn(move || {
            let (stream, _) = listener.accept().expect("the plugin");
            controller.control(stream);
        });
        port
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.0.lock().expect("whole")
    }

    /// Simulates the arm, even without commands or a connection.
    fn control(&self, stream: TcpStream) {
        stream.set_read_timeout(Some(LOOKING)).expect("a time");
        let mut lines = BufReader::new(stream);
        let mut line = String::new();
        loop {
            match lines.read_line(&mut line) {
                Ok(0) => thread::sleep(LOOKING),
                Ok(_) => {
                    self.state().obey(line.trim_end());
                    line.clear();
                }
                Err(error) if error.kind() == IoErrorKind::WouldBlock => {}
                // A killed plugin leaves unread data, which gives an error.
                Err(_) => thread::sleep(LOOKING),
            }
            let mut state = self.state();
            let now = Instant::now();
            if state.until.is_some_and(|until| now < until) {
                state.moved = Some(now);
            }
        }
    }
}

impl State {
    fn obey(&mut self, line: &str) {
        let words: Vec<&str> = line.split(' ').collect();
        let number = |word: &str| word.parse::<f64>().expect("a number");
        self.until = match words[..] {
            ["process", process] => {
                self.process = process.parse().ok();
                None
            }
            ["speed", speed] => (number(speed) > 0.0).then(|| Instant::now() + EXPIRES),
            ["to", place, speed] => {
                let way = Duration::from_secs_f64(number(place) / number(speed));
                Some(Instant::now() + way)
            }
            _ => panic!("{line}"),
        };
    }
}

/// Time for which the arm keeps moving after its plugin is killed; `None` without a C++ compiler.
fn goes_on_without_its_plugin(is_expiring: bool) -> Option<Duration> {
    const PATIENCE: Deadline = Deadline::after(Duration::from_secs(20));
    let folder = built("expiring")?;
    let controller = Controller::default();
    let port = controller.listening();
    let path = SearchPath::empty().given([folder.path().to_owned()]);
    let mut config = PluginConfig::default();
    let id = "org.example.expiring".parse().expect("an id");
    let need = format!("tcp:127.0.0.1:{port}").parse().expect("a need");
    config.allow.insert(id, [need].into());
    let log = Arc::new(|_: &_, _, _: &str, _: &str| {});
    let host = PluginHost::with_children(Plugins::search(path, &[]), config, log, children());
    let arm = host.drivers::<dyn Robot>().swap_remove(0);
    let args = arm.descriptor().args(&format!("port={port}"));
    let opened = arm.open(&args.expect("its own"), &mut Rig::new());
    let mut robot = opened.unwrap_or_else(|error| panic!("{error}"));
    let mut target = Pose::default();
    target.position.x = Millimetre(10.0);
    let speed = Speed::try_new(5.0).expect("above 0");
    let mover = thread::spawn(move || match is_expiring {
        true => {
            let expiring = robot
                .expiring_motion()
                .expect("it derives from `can_expire`");
            expiring.move_expiring(target, speed, PATIENCE)
        }
        false => robot.move_to(target, speed, PATIENCE),
    });
    let patience = Instant::now() + Duration::from_secs(20);
    while controller.state().moved.is_none() {
        assert!(Instant::now() < patience, "it never moved");
        thread::sleep(LOOKING);
    }
    thread::sleep(Duration::from_millis(300));
    let process = controller.state().process.expect("it said so");
    let process = rustix::process::Pid::from_raw(process).expect("a process");
    rustix::process::kill_process(process, rustix::process::Signal::KILL).expect("killed");
    let killed = Instant::now();
    mover
        .join()
        .expect("whole")
        .expect_err("its process is gone");
    thread::sleep(Duration::from_millis(700));
    let moved = controller.state().moved.expect("it moved");
    Some(moved.saturating_duration_since(killed))
}

#[test]
fn an_arm_whose_plugin_is_killed_stands_by_expiry_and_one_on_its_way_to_a_place_goes_on() {
    let (Some(expiring), Some(way)) = (
        goes_on_without_its_plugin(true),
        goes_on_without_its_plugin(false),
    ) else {
        return;
    };
    assert!(expiring <= EXPIRES + SLACK, "{expiring:?}");
    assert!(way > Duration::from_millis(500), "{way:?}");
}
