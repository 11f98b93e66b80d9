//! Emulated devices over one gel, and the running program.

use std::io::Read;
use std::net::Ipv4Addr;
use std::process::{Child, Command, Stdio};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use taceva_core::{Deadline, Millimetre, Rig, Robot, Speed};
use taceva_drivers::{Drivers, open};
use taceva_wire::{Arm, Base, BenchOptions, WallBench, mjpeg, sri, xarm};

use crate::support::{Bench, Ran};

const PATIENCE: Deadline = Deadline::after(Duration::from_secs(20));

/// Emulated arm, force transducer and camera over one gel.
pub(crate) struct Emulated {
    pub(crate) bench: WallBench,
    arm: xarm::Emulator,
    force: sri::Emulator,
    camera: mjpeg::Emulator,
}

impl Emulated {
    pub(crate) fn new() -> Emulated {
        Emulated::over(&BenchOptions::noisy(7))
    }

    pub(crate) fn over(options: &BenchOptions) -> Emulated {
        let bench = WallBench::start(options).expect("a bench");
        let host = Ipv4Addr::LOCALHOST;
        Emulated {
            arm: xarm::Emulator::start(&bench, xarm::Ports::ANY).expect("an arm"),
            force: sri::Emulator::start(&bench, host, 0).expect("a box"),
            camera: mjpeg::Emulator::start(&bench, host, 0, mjpeg::Style::Usual).expect("a camera"),
            bench,
        }
    }

    pub(crate) fn sensor(&self) -> String {
        format!("camera/mjpeg:url={}", self.camera.url())
    }

    /// Selector of the camera, with timestamps of a clock that is too fast by `ppm` parts per million.
    pub(crate) fn drifting_sensor(&self, ppm: f64) -> String {
        format!(
            "camera/mjpeg:url={};clock=server",
            self.camera.drifting_url(ppm)
        )
    }

    pub(crate) fn force(&self) -> String {
        self.force.selector()
    }

    /// Unplugs the camera.
    pub(crate) fn without_camera(self) {
        drop(self.camera);
    }

    /// Rig file of the force transducer and the camera, without a robot.
    pub(crate) fn rig(&self) -> String {
        let axes = Base::AXES;
        format!(
            "rig_version = 1\nsimulated = true\n\n[force]\ndriver = {:?}\naxes = {axes:?}\nlatency_ms = 0.0\n\n[sensor]\ndriver = {:?}\nlatency_ms = 0.0\n",
            self.force(),
            self.sensor()
        )
    }

    /// Rig file of the force transducer, the camera and the robot.
    pub(crate) fn rig_with_robot(&self) -> String {
        format!(
            "{}\n[robot]\ndriver = {:?}\ncarries = \"indenter\"\norigin_mm = {:?}\naxes = {:?}\n\n[limits]\nspeed_max_mm_s = 20.0\n",
            self.rig(),
            self.arm.selector(),
            Base::ORIGIN_MM,
            Base::AXES
        )
    }

    /// Robot that presses in place of a hand.
    pub(crate) fn robot(&self) -> Box<dyn Robot> {
        let drivers = Drivers::builtin().expect("drivers");
        let selector = self.arm.selector().parse().expect("a selector");
        open(&drivers.robots, &selector, &mut Rig::new()).expect("an arm")
    }

    /// Presses at `place`, mm in the frame of the sensor, to a depth, and calls `held` there.
    pub(crate) fn press(
        &self,
        robot: &mut Box<dyn Robot>,
        [x, y]: [f64; 2],
        depth_mm: f64,
        held: impl FnOnce(),
    ) {
        let (mut pose, _) = robot.pose(PATIENCE).expect("a pose");
        pose.position.x = Millimetre(300.0 + x);
        pose.position.y = Millimetre(-y);
        let speed = |mm_s| Speed::try_new(mm_s).expect("above 0");
        let mut to = |height_mm: f64, mm_s: f64| {
            pose.position.z = Millimetre(251.3 + height_mm);
            robot.move_to(pose, speed(mm_s), PATIENCE).expect("moved");
        };
        to(1.0, 50.0);
        to(-depth_mm, 5.0);
        held();
        to(1.0, 20.0);
        std::thread::sleep(Duration::from_millis(150));
    }
}

/// Running process of `taceva`, with its messages.
pub(crate) struct Running {
    child: Child,
    said: Arc<Mutex<String>>,
    reader: Option<std::thread::JoinHandle<()>>,
}

impl Running {
    pub(crate) fn start(bench: &Bench, words: &str) -> Running {
        Running::of(bench.command(words))
    }

    pub(crate) fn of(mut command: Command) -> Running {
        let mut child = command
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the program starts");
        let mut stderr = child.stderr.take().expect("piped");
        let said = Arc::new(Mutex::new(String::new()));
        let heard = Arc::clone(&said);
        let reader = std::thread::spawn(move || {
            let mut bytes = [0; 4096];
            while let Ok(count @ 1..) = stderr.read(&mut bytes) {
                let text = String::from_utf8_lossy(&bytes[..count]);
                heard.lock().expect("whole").push_str(&text);
            }
        });
        Running {
            child,
            said,
            reader: Some(reader),
        }
    }

    pub(crate) fn said(&self) -> String {
        self.said.lock().expect("whole").clone()
    }

    pub(crate) fn until_it_says(&self, words: &str) {
        let began = Instant::now();
        while !self.said().contains(words) {
            assert!(
                began.elapsed() < Duration::from_secs(60),
                "expected `{words}` in: {}",
                self.said()
            );
            std::thread::sleep(Duration::from_millis(5));
        }
    }

    /// Sends a signal by its name.
    pub(crate) fn signal(&self, name: &str) {
        let sent = Command::new("kill")
            .args([&format!("-{name}"), &self.child.id().to_string()])
            .status()
            .expect("there is kill");
        assert!(sent.success());
    }

    pub(crate) fn interrupt(&self) {
        self.signal("INT");
    }

    pub(crate) fn has_ended(&mut self) -> bool {
        self.child.try_wait().expect("it is a child").is_some()
    }

    pub(crate) fn ended(mut self) -> Ran {
        let status = self.child.wait().expect("it ends");
        if let Some(reader) = self.reader.take() {
            reader.join().expect("read");
        }
        Ran {
            code: status.code().expect("not ended by a signal"),
            out: String::new(),
            err: self.said(),
        }
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        // The program may have ended by itself.
        drop(self.child.kill());
        drop(self.child.wait());
    }
}
