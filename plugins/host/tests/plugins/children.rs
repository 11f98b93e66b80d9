//! A plugin in its child: log lines, discovery and isolation.

use std::path::PathBuf;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use taceva_core::{Args, Deadline, Factory, Fault, ForceTransducer, FrameMut, Robot, Sensor};
use taceva_host::{Children, Keeping, PluginConfig, PluginHost, Trust};

use crate::fixture::Fixture;

type Lines = Arc<Mutex<Vec<String>>>;

/// Creates a host with the child program; also returns its log lines.
fn host(fixture: &Fixture) -> (Arc<PluginHost>, Lines) {
    let children = Children {
        program: Some(PathBuf::from(env!("CARGO_BIN_EXE_taceva-host-child"))),
        quarantine: None,
    };
    let lines = Lines::default();
    let told = Arc::clone(&lines);
    let log = Arc::new(move |id: &_, level, target: &str, message: &str| {
        let line = format!("{id} {level:?} {target}: {message}");
        told.lock().expect("whole").push(line);
    });
    let host = PluginHost::with_children(fixture.found(), PluginConfig::default(), log, children);
    (host, lines)
}

fn eye(host: &Arc<PluginHost>) -> Box<dyn Factory<dyn Sensor>> {
    let mut eyes = host.drivers::<dyn Sensor>();
    eyes.swap_remove(0)
}

/// Waits for `count` log lines and returns all.
fn told(lines: &Lines, count: usize) -> Vec<String> {
    let begun = Instant::now();
    loop {
        let told = lines.lock().expect("whole").clone();
        if told.len() >= count {
            return told;
        }
        assert!(begun.elapsed() < Duration::from_secs(20), "{told:?}");
        std::thread::yield_now();
    }
}

#[test]
fn what_a_plugin_logs_comes_while_it_runs_with_control_characters_written_out() {
    let Some(fixture) = Fixture::built(&["LOGS=\"\\033[2Jgone\\nthe next\""]) else {
        return;
    };
    let (host, lines) = host(&fixture);
    let eye = eye(&host);
    let args = Args::default();
    let open = eye.open(&args, &mut taceva_core::Rig::new());
    let open = open.unwrap_or_else(|error| panic!("{error}"));
    let expected = [
        "org.example.fixture Info fixture: begins",
        "org.example.fixture Error fixture: \\u{1b}[2Jgone\\nthe next",
    ];
    assert_eq!(told(&lines, 2), expected);
    drop(open);
}

#[test]
fn numbers_of_frames_cross_to_the_host_with_the_gaps_of_lost_frames() {
    const SECOND: Deadline = Deadline::after(Duration::from_secs(1));
    let macros = ["FRAME_FLAGS=TACEVA_FRAME_NUMBERED", "FRAME_STEP=3"];
    let Some(fixture) = Fixture::built(&macros) else {
        return;
    };
    let (host, _) = host(&fixture);
    let mut rig = taceva_core::Rig::new();
    let mut eye = eye(&host).open(&Args::default(), &mut rig).expect("opens");
    assert_eq!(eye.sequence(), None);
    eye.start(SECOND).expect("starts");
    let info = eye.frame_info();
    let mut pixels = vec![0; info.byte_len().expect("small")];
    for number in 1..4 {
        let into = FrameMut::new(info, &mut pixels).expect("fits");
        eye.capture(into, SECOND).expect("a frame");
        assert_eq!(eye.sequence(), Some(3 * number));
    }
}

#[test]
fn numbers_and_losses_of_readings_and_faults_of_a_robot_cross_to_the_host() {
    const SECOND: Deadline = Deadline::after(Duration::from_secs(1));
    let macros = [
        "NUMBERED",
        "LOST",
        "FAULT=TACEVA_FAULT_COLLISION",
        "FAULT_WORDS=\"\"",
    ];
    let Some(fixture) = Fixture::built(&macros) else {
        return;
    };
    let fixture = fixture.with_manifest("tare = true", "tare = true\nnumbered = true");
    let (host, _) = host(&fixture);
    let mut rig = taceva_core::Rig::new();
    let wrist = host.drivers::<dyn ForceTransducer>().swap_remove(0);
    let mut wrist = wrist.open(&Args::default(), &mut rig).expect("opens");
    assert_eq!((wrist.sequence(), wrist.lost()), (None, None));
    wrist.start(SECOND).expect("starts");
    for number in 1..4 {
        wrist.read(SECOND).expect("reads");
        assert_eq!(wrist.sequence(), Some(number));
        assert_eq!(wrist.lost(), Some(2 * number));
    }
    let arm = host.drivers::<dyn Robot>().swap_remove(0);
    let mut arm = arm.open(&Args::default(), &mut rig).expect("opens");
    let fast = taceva_core::Speed::try_new(100.0).expect("above 0");
    let mut above = taceva_core::Pose::default();
    above.position.z = taceva_core::Millimetre(1.0);
    let error = arm
        .move_to(above, fast, SECOND)
        .expect_err("it struck something");
    assert_eq!(error.fault(), Some(Fault::Collision), "{error}");
    assert!(error.to_string().ends_with(": collision"), "{error}");
}

#[test]
fn a_device_that_never_closes_is_told_of_and_waited_for_a_few_seconds() {
    let Some(fixture) = Fixture::built(&["CLOSE_HANGS"]) else {
        return;
    };
    let (host, lines) = host(&fixture);
    let open = eye(&host).open(&Args::default(), &mut taceva_core::Rig::new());
    let open = open.unwrap_or_else(|error| panic!("{error}"));
    let begun = Instant::now();
    drop(open);
    assert!(begun.elapsed() < Duration::from_secs(10));
    let expected = "org.example.fixture Warn host: closed late: its process was ended because it did not close the device within 5s; \
                    recordings are not affected";
    // A line about the host's waiting time may come first.
    let said = told(&lines, 1);
    let said = if said.iter().any(|line| line == expected) {
        said
    } else {
        told(&lines, 2)
    };
    assert!(said.iter().any(|line| line == expected), "{said:?}");
}

#[test]
fn a_flood_of_lines_is_cut_and_counted_and_stops_nobody() {
    let Some(fixture) = Fixture::built(&["FLOODS=100000"]) else {
        return;
    };
    let (host, lines) = host(&fixture);
    let begun = Instant::now();
    let open = eye(&host).open(&Args::default(), &mut taceva_core::Rig::new());
    drop(open.unwrap_or_else(|error| panic!("{error}")));
    let seconds = usize::try_from(begun.elapsed().as_secs()).expect("short");
    let told = lines.lock().expect("whole").clone();
    // Each passed line may be followed by one that reports dropped lines.
    assert!(
        told.len() < 2 * (110 + 20 * seconds),
        "{} lines",
        told.len()
    );
    let lost: usize = told
        .iter()
        .filter_map(|line| line.split_once("lines left out: ")?.1.parse::<usize>().ok())
        .sum();
    let passed = told.iter().filter(|line| line.ends_with("begins")).count();
    assert_eq!(passed + lost, 100_001, "{told:?}");
}

#[test]
fn devices_are_found_by_the_library_with_what_tells_them_apart() {
    let Some(fixture) = Fixture::built(&["LOOKS=\"serial=SN-2\""]) else {
        return;
    };
    let (host, _) = host(&fixture);
    let found = eye(&host)
        .discover()
        .unwrap_or_else(|error| panic!("{error}"));
    let arguments: Vec<&str> = found.iter().map(|found| &*found.arguments).collect();
    assert_eq!(arguments, ["serial=SN-1", "serial=SN-2"]);
    let Some(fixture) = Fixture::built(&["LOOKS=\"serial=\\033[2J\""]) else {
        return;
    };
    let (host, _) = self::host(&fixture);
    let error = eye(&host).discover().expect_err("no serial number");
    assert!(
        error.to_string().contains("has a control character"),
        "{error}"
    );
}

#[test]
fn one_that_looks_for_ever_costs_its_time_once_and_is_named() {
    let Some(fixture) = Fixture::built(&["LOOKS_FOR_EVER"]) else {
        return;
    };
    let (host, _) = host(&fixture);
    let begun = Instant::now();
    let error = eye(&host).discover().expect_err("it hangs");
    let took = begun.elapsed();
    assert!(
        took > Duration::from_secs(9) && took < Duration::from_secs(20),
        "{took:?}"
    );
    let words = error.to_string();
    assert!(words.contains("org.example.fixture/eye"), "{words}");
    assert!(
        words.contains("did not look for devices within 10s"),
        "{words}"
    );
    // The process has ended, so the next call fails at once.
    let begun = Instant::now();
    assert!(eye(&host).discover().is_err());
    assert!(
        begun.elapsed() < Duration::from_secs(2),
        "{:?}",
        begun.elapsed()
    );
}

#[test]
fn how_a_plugin_is_isolated_is_found_out_by_doing_it_and_loads_nothing() {
    let Some(fixture) = Fixture::built(&["INIT_FAILS"]) else {
        return;
    };
    let (host, lines) = host(&fixture);
    let Keeping::Confined(words) = host.keeping(&fixture.plugin()) else {
        panic!("{:?}", host.keeping(&fixture.plugin()));
    };
    assert!(words.contains("closed by Landlock"), "{words}");
    assert!(words.contains("system calls allowed"), "{words}");
    assert!(lines.lock().expect("whole").is_empty());
    let (trusted, _) = fixture.trusted();
    let keeping = trusted.keeping(&fixture.plugin());
    assert_eq!(keeping, Keeping::Trusted(Trust::CommandLine));
    let nobody = Children {
        program: Some(PathBuf::from("/nonexistent/child")),
        quarantine: None,
    };
    let config = PluginConfig::default();
    let log = Arc::new(|_: &_, _, _: &str, _: &str| {});
    let host = PluginHost::with_children(fixture.found(), config, log, nobody);
    let keeping = host.keeping(&fixture.plugin());
    assert!(!keeping.is_possible(), "{keeping}");
    assert!(keeping.to_string().starts_with("cannot run: "), "{keeping}");
}
