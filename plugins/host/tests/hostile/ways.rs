//! Kinds of misbehaviour, and the host's reaction to each.

use std::error::Error;
use std::time::{Duration, Instant};

use taceva_core::{Args, DriverError, ErrorKind, Pose, Speed};
use taceva_host::{ChildError, ChildSession, Fate, Patience, Session};

use crate::plugin::{FORCE, LONG, Plugin, ROBOT, capture, sensor};

/// Action on the plugin.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Do {
    /// Loads the plugin only.
    Load,
    /// Opens the sensor and closes it again.
    Open,
    /// Takes two frames.
    Capture,
    /// Interrupts the sensor, and takes a frame.
    Interrupt,
    /// Reads the force.
    Read,
    /// Reads the pose of the robot.
    Pose,
    /// Moves the robot, and halts it during the motion.
    Halt,
}

/// Expected result. Texts are parts of the message.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Then {
    /// The plugin is rejected. Its process lives until the host ends it.
    Refused(&'static str),
    /// The process ended, with this fate.
    Gone(&'static str),
    /// One call fails, and the process lives.
    Fails(ErrorKind, &'static str),
    /// Nothing happens.
    Nothing,
}
use Then::{Fails, Gone, Nothing, Refused};

/// Short timeouts for hanging plugins.
const SHORT: Patience = Patience {
    start: Duration::from_millis(1500),
    open: Duration::from_millis(400),
    close: Duration::from_millis(400),
    grace: Duration::from_millis(200),
    urgent: Duration::from_millis(200),
    end: Duration::from_millis(400),
};

/// Maximum delay until the host notices the end of a process.
const SEEN: Duration = Duration::from_millis(50);

macro_rules! ways {
    ($($name:ident: $way:literal $([$define:literal])?, $do:expr => $then:expr;)*) => {$(
        #[test]
        fn $name() {
            let defines: &[&str] = &[$($define)?];
            check($way, defines, $do, $then);
        }
    )*};
}

ways! {
    a_plugin_that_behaves: "good", Do::Capture => Nothing;

    // Before any check of the host.
    a_constructor_that_crashes: "constructor_segv", Do::Load => Gone("signal 11");
    a_constructor_that_exits: "constructor_exit", Do::Load => Gone("exited by itself with code 0");
    a_constructor_that_aborts: "constructor_abort", Do::Load => Gone("signal 6");
    a_constructor_that_hangs: "constructor_hang", Do::Load => Gone("did not start within 1.5s");
    a_constructor_that_closes_every_file: "constructor_closes_files", Do::Load => Gone("");

    // Faults of the exported symbol.
    no_symbol: "good" ["-DNO_SYMBOL"], Do::Load => Refused("taceva_plugin_v1");
    a_symbol_that_is_its_magic_alone: "good" ["-DMAGIC_ONLY"], Do::Load => Refused("");
    a_wrong_magic: "good" ["-DWRONG_MAGIC"], Do::Load => Refused("0x12345678");
    a_newer_major_version: "good" ["-DNEWER"], Do::Load => Refused("version 2");
    a_struct_that_is_too_small: "good" ["-DSMALL"], Do::Load => Refused("24 bytes");
    another_id_than_the_manifest: "good" ["-DOTHER_ID"], Do::Load => Refused("org.example.other");
    a_version_that_lies_nowhere: "good" ["-DID_NOWHERE"], Do::Load => Refused("");

    // During initialisation and description.
    an_init_that_fails: "init_fails", Do::Load => Refused("no licence was found");
    an_init_that_crashes: "init_segv", Do::Load => Gone("signal 11");
    an_init_that_hangs: "init_hang", Do::Load => Gone("did not start within");
    an_init_that_overwrites_the_host: "init_throws_away", Do::Capture => Nothing;
    a_factory_that_crashes: "factory_segv", Do::Load => Gone("signal 11");
    a_factory_that_is_null: "factory_null", Do::Load => Refused("sensor");
    a_factory_that_lies_nowhere: "factory_nowhere", Do::Load => Gone("signal 11");
    a_description_that_lies: "describe_lies", Do::Load => Refused("as in its factory");
    a_description_without_bytes: "describe_null", Do::Load => Refused("a text that is NULL");
    a_description_that_is_no_text: "describe_no_text", Do::Load => Refused("UTF-8");
    a_description_without_end: "describe_endless", Do::Load => Gone("did not start within");
    a_description_whose_length_overflows: "describe_length_overflows", Do::Load => Refused("1 MiB of text");
    a_description_that_hangs: "describe_hang", Do::Load => Gone("did not start within");
    a_description_that_crashes: "describe_segv", Do::Load => Gone("signal 11");

    // During open and close of a device.
    an_open_that_crashes: "open_segv", Do::Open => Gone("signal 11");
    an_open_that_exits: "open_exit", Do::Open => Gone("exited by itself with code 0");
    an_open_that_hangs: "open_hang", Do::Open => Gone("did not open the sensor within 400ms");
    calls_that_are_null: "open_no_calls", Do::Open => Fails(ErrorKind::Abi, "");
    calls_that_lie_nowhere: "open_calls_nowhere", Do::Open => Gone("signal 11");
    calls_that_are_misaligned: "open_calls_misaligned", Do::Open => Fails(ErrorKind::Abi, "");
    calls_that_are_too_few: "open_calls_small", Do::Open => Fails(ErrorKind::Unsupported, "`close` is NULL");
    calls_without_functions: "open_calls_null", Do::Capture => Fails(ErrorKind::Unsupported, "");
    an_extension_that_lies_nowhere: "extension_nowhere", Do::Read => Gone("signal 11");
    an_extension_that_is_misaligned: "extension_misaligned", Do::Read => Fails(ErrorKind::Abi, "");
    a_start_that_hangs: "start_hang", Do::Capture => Gone("did not start within 400ms");
    a_stop_that_hangs: "stop_hang", Do::Capture => Gone("");
    a_close_that_crashes: "close_segv", Do::Open => Gone("signal 11");
    a_close_that_hangs: "close_hang", Do::Open => Gone("did not close the device within 400ms");

    // During a capture.
    a_crash: "capture_segv", Do::Capture => Gone("signal 11");
    an_abort: "capture_abort", Do::Capture => Gone("signal 6");
    an_exit: "capture_exit", Do::Capture => Gone("exited by itself with code 0");
    an_exit_at_once: "capture_exit_now", Do::Capture => Gone("exited by itself with code 7");
    a_hang: "capture_hang", Do::Capture => Gone("did not capture a frame within 400ms");
    a_loop_without_end: "capture_spin", Do::Capture => Gone("did not capture a frame within 400ms");
    a_jump_out_of_the_call: "capture_longjmp", Do::Capture => Gone("");
    a_stack_that_overflows: "capture_stack_overflow", Do::Capture => Gone("signal");
    a_kill_of_itself: "capture_kills_itself", Do::Capture => Gone("signal 9");
    an_impossible_division: "capture_divides", Do::Capture => Gone("signal 8");
    signals_that_are_all_blocked: "signal_games", Do::Capture => Gone("did not capture a frame within 400ms");
    every_file_of_the_process_closed: "closes_files", Do::Capture => Gone("");
    garbage_on_every_socket: "garbage_on_files", Do::Capture => Gone("violated the protocol");
    answers_that_nobody_asked_for: "early_answers", Do::Capture => Gone("violated the protocol");
    a_leak_of_files: "leaks_files", Do::Capture => Nothing;
    ten_gibibytes: "takes_memory", Do::Capture => Nothing;
    threads_without_end: "starts_threads", Do::Capture => Nothing;
    a_fork_bomb: "fork_bomb", Do::Capture => Nothing;
    writes_to_standard_output: "prints", Do::Capture => Nothing;
    output_without_end: "fills_output", Do::Capture => Nothing;
    output_that_floods_its_host: "floods_output", Do::Capture => Gone("it printed more than 64 MiB");
    escapes_for_a_terminal: "prints_escapes", Do::Capture => Gone("\\u{1b}]52;c;");
    a_frame_longer_than_its_buffer: "frame_longer", Do::Capture => Fails(ErrorKind::Protocol, "in 18432 bytes, expected 9216");
    a_frame_shorter_than_its_size: "frame_shorter", Do::Capture => Fails(ErrorKind::Protocol, "in 4608 bytes, expected 9216");
    a_length_that_overflows: "frame_length_overflows", Do::Capture => Fails(ErrorKind::Protocol, "");
    a_frame_of_another_size: "frame_other_size", Do::Capture => Fails(ErrorKind::Protocol, "a frame of 256×12 rgb8, expected 64×48 rgb8");
    an_unknown_pixel_format: "frame_unknown_format", Do::Capture => Fails(ErrorKind::Unsupported, "");
    a_frame_without_pixels: "frame_null", Do::Capture => Fails(ErrorKind::Protocol, "");
    a_frame_from_nowhere: "frame_from_nowhere", Do::Capture => Gone("signal 11");
    a_frame_struct_that_shrinks: "frame_struct_smaller", Do::Capture => Nothing;
    a_buffer_written_far_beyond_its_end: "buffer_overrun", Do::Capture => Gone("signal");
    a_frame_released_twice: "lent_released_twice", Do::Capture => Gone("signal 6");
    a_lent_frame_that_changes: "lent_changed", Do::Capture => Nothing;
    a_frame_that_changes_after_it_was_given: "changes_after", Do::Capture => Nothing;
    a_write_into_a_frame_after_its_sensor_was_closed: "writes_after_close", Do::Capture => Gone("signal 11");
    a_release_that_crashes: "release_crash", Do::Capture => Gone("signal 11");
    a_release_that_hangs: "release_hang", Do::Capture => Gone("did not capture a frame within 400ms");
    a_stamp_of_the_far_future: "stamp_far_future", Do::Capture => Nothing;
    an_unknown_status: "status_unknown", Do::Capture => Fails(ErrorKind::Abi, "-7777");
    a_status_above_0: "status_positive", Do::Capture => Fails(ErrorKind::Abi, "5");
    a_message_without_end: "message_endless", Do::Capture => Fails(ErrorKind::DeviceFault, "mmmm");
    a_message_that_is_no_text: "message_no_text", Do::Capture => Fails(ErrorKind::DeviceFault, "\u{FFFD}");
    a_message_with_escapes: "message_escapes", Do::Capture => Fails(ErrorKind::DeviceFault, "\\u{1b}]0;owned");
    an_error_written_far_beyond_its_end: "error_overrun", Do::Capture => Gone("");
    a_process_that_is_changed: "changes_the_process", Do::Capture => Fails(ErrorKind::Internal, "it could not");

    // During calls of other threads.
    an_interrupt_that_hangs: "interrupt_hang", Do::Interrupt => Gone("did not close the device within 400ms");
    an_interrupt_that_crashes: "interrupt_segv", Do::Interrupt => Gone("signal 11");
    a_halt_that_hangs: "halt_hang", Do::Halt => Gone("did not halt within 200ms");
    a_robot_that_never_arrives: "robot_never_arrives", Do::Halt => Fails(ErrorKind::Interrupted, "halted");
    a_robot_that_ignores_halts: "robot_ignores_halts", Do::Halt => Gone("after an interrupt");

    // Invalid numbers.
    a_force_that_is_no_number: "wrench_nan", Do::Read => Fails(ErrorKind::DeviceFault, "NaN");
    a_torque_that_is_infinite: "wrench_infinite", Do::Read => Fails(ErrorKind::DeviceFault, "inf");
    a_stamp_that_stands_still: "stamp_stale", Do::Read => Nothing;
    a_place_that_is_no_number: "pose_nan", Do::Pose => Fails(ErrorKind::DeviceFault, "NaN");
    a_rotation_of_no_length: "pose_no_rotation", Do::Pose => Fails(ErrorKind::DeviceFault, "");

    // At the end.
    threads_that_run_at_the_end: "threads_at_the_end", Do::Capture => Nothing;
    a_thread_local_whose_end_aborts: "thread_local_end", Do::Capture => Gone("signal 6");
    a_function_at_exit_that_hangs: "atexit_hang", Do::Capture => Nothing;
    a_function_at_exit_that_aborts: "atexit_abort", Do::Capture => Nothing;
    a_destructor_that_crashes: "destructor_segv", Do::Capture => Nothing;
    a_destructor_that_hangs: "destructor_hang", Do::Capture => Nothing;
    a_deinit_that_crashes: "deinit_segv", Do::Load => Nothing;
    a_deinit_that_hangs: "deinit_hang", Do::Load => Nothing;
}

/// Makes a plugin misbehave, and checks that the result is as expected and other plugins are unharmed.
fn check(way: &str, defines: &[&str], action: Do, expected: Then) {
    let other = Plugin::build("good", &[]);
    let other = other.start(Patience::default(), None).expect("a good one");
    let mut unharmed = sensor(&other).expect("a good sensor");

    let defines: Vec<String> = defines.iter().map(ToString::to_string).collect();
    let plugin = Plugin::build(way, &defines);
    let is_late = matches!(expected, Gone(how) if how.contains("within") || how.contains("after"))
        || way.contains("hang")
        // The interrupt is sent only after the call has begun.
        || action == Do::Interrupt;
    let patience = if is_late { SHORT } else { Patience::default() };
    let began = Instant::now();
    match plugin.start(patience, None) {
        Err(error) => of_start(&error, expected),
        Ok(session) => {
            let began = Instant::now();
            let done = act(&session, action);
            of_call(&session, done, expected, began.elapsed(), is_late);
        }
    }
    assert!(
        began.elapsed() < Duration::from_secs(15),
        "it took too long"
    );

    let frame = capture(&mut *unharmed).expect("another process");
    assert!(frame.iter().all(|byte| *byte == 1), "another's frame");
    assert_eq!(other.child().fate(), None);
}

fn of_start(error: &ChildError, expected: Then) {
    let text = error.to_string();
    match (expected, error) {
        (Refused(why), ChildError::Refused { .. }) => assert!(text.contains(why), "{text}"),
        (Gone(how), ChildError::Gone { .. }) => assert!(text.contains(how), "{text}"),
        _ => panic!("expected {expected:?}, found {error:?}"),
    }
}

fn of_call(
    session: &ChildSession,
    done: Result<(), DriverError>,
    expected: Then,
    took: Duration,
    is_late: bool,
) {
    let fate = session.child().fate();
    match (expected, done) {
        (Nothing, Ok(())) => assert_eq!(fate, None),
        (Fails(kind, why), Err(error)) => {
            assert_eq!(error.kind(), kind, "{error}");
            assert!(error.to_string().contains(why), "{error}");
            assert_eq!(fate, None, "its process lives");
        }
        (Gone(how), done) => {
            let fate = fate.or_else(|| end_of(session));
            let fate = fate.expect("its process is gone");
            // Closing a device returns no error; only the fate of the process shows the fault.
            let said = done.err().map(|error| {
                assert_eq!(error.kind(), ErrorKind::Disconnected, "{error}");
                let gone = error.source().and_then(|source| source.downcast_ref());
                assert!(matches!(gone, Some(ChildError::Gone { .. })), "{error:?}");
                error.to_string()
            });
            let said = format!("{fate} {}", said.unwrap_or_default());
            assert!(said.contains(how), "{said}");
            let is_slow = is_late || how.contains("more than");
            assert!(is_slow || took < SEEN, "seen after {took:?}");
            let process = format!("/proc/{}", session.child().process());
            assert!(!std::path::Path::new(&process).exists(), "{process}");
        }
        (expected, done) => panic!("expected {expected:?}, found {done:?}, {fate:?}"),
    }
}

/// Waits up to 5 s for the end of a process, such as after its device was closed.
fn end_of(session: &ChildSession) -> Option<Fate> {
    let began = Instant::now();
    while began.elapsed() < Duration::from_secs(5) {
        if let Some(fate) = session.child().fate() {
            return Some(fate);
        }
        std::thread::sleep(Duration::from_millis(1));
    }
    None
}

fn act(session: &ChildSession, action: Do) -> Result<(), DriverError> {
    match action {
        Do::Load => Ok(()),
        Do::Open => sensor(session).map(drop),
        Do::Capture => {
            let mut sensor = sensor(session)?;
            capture(&mut *sensor)?;
            capture(&mut *sensor)?;
            sensor.stop()
        }
        Do::Interrupt => {
            let mut sensor = sensor(session)?;
            let interrupt = sensor.interrupt_handle().expect("it has one");
            interrupt.interrupt();
            interrupt.interrupt();
            // Long enough for the call to begin, also on a busy machine.
            std::thread::sleep(Duration::from_millis(100));
            capture(&mut *sensor).map(drop)
        }
        Do::Read => {
            let mut force = session.force(&FORCE, &Args::default())?;
            force.start(LONG)?;
            force.read(LONG).map(drop)
        }
        Do::Pose => {
            let mut robot = session.robot(&ROBOT, &Args::default())?;
            robot.pose(LONG).map(drop)
        }
        Do::Halt => {
            let mut robot = session.robot(&ROBOT, &Args::default())?;
            let halt = robot.halt_handle();
            let speed = Speed::try_new(1.0).expect("positive");
            let patience = taceva_core::Deadline::after(Duration::from_secs(20));
            std::thread::scope(|scope| {
                let mover = scope.spawn(|| robot.move_to(Pose::default(), speed, patience));
                // Long enough for the motion to begin, also on a busy machine.
                std::thread::sleep(Duration::from_millis(100));
                let halted = halt.halt();
                let moved = mover.join().expect("whole");
                moved.map(drop).and(halted)
            })
        }
    }
}
