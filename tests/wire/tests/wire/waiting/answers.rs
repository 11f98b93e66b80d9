//! Tests of controllers whose answers arrive byte by byte, twice or late, or in another version of the protocol.

use std::io::{Read, Write};
use std::net::{Shutdown, SocketAddr, TcpListener, TcpStream};
use std::time::Duration;

use taceva_core::{ErrorKind, Factory, Rig};
use taceva_drivers::ur::rtde::UrFactory;
use taceva_wire::Arm;
use taceva_wire::xarm::Port;

use crate::waiting::links::{TYPED, ur_setup, xarm_setup};
use crate::waiting::setup::Setup;
use crate::waiting::support::{PATIENCE, lower, speed};
#[cfg(unix)]
use crate::waiting::{grbl, marlin};

/// Change that a proxy makes to the answers of a controller.
#[derive(Clone, Copy, Debug)]
enum Arrival {
    /// Answers arrive in pieces of one byte.
    Bytewise,
    /// Each piece of an answer arrives twice.
    Twice,
    /// Answers arrive later by [`LATE`].
    Late,
}

const LATE: Duration = Duration::from_millis(15);
/// Time within which an arm stands after an error.
const STANDS: Duration = Duration::from_millis(300);

/// Starts a proxy in front of the server at `address`, and returns its port. It changes the server's answers as `arrival` states.
fn before(address: SocketAddr, arrival: Arrival) -> u16 {
    let listener = TcpListener::bind("127.0.0.1:0").expect("a port");
    let port = listener.local_addr().expect("bound").port();
    std::thread::spawn(move || {
        for driver in listener.incoming().flatten() {
            let controller = TcpStream::connect(address).expect("it listens");
            driver.set_nodelay(true).expect("a socket");
            let back = [&controller, &driver].map(|side| side.try_clone().expect("a socket"));
            std::thread::spawn(move || {
                pass(&driver, &controller, None);
                // The other side may have closed already.
                let _ = controller.shutdown(Shutdown::Both);
            });
            let [controller, driver] = back;
            std::thread::spawn(move || {
                pass(&controller, &driver, Some(arrival));
                let _ = driver.shutdown(Shutdown::Both);
            });
        }
    });
    port
}

/// Starts a proxy in front of the serial line at `path`, and returns its path. It changes the answers on the line as `arrival` states.
#[cfg(unix)]
fn before_line(path: &str, arrival: Arrival) -> String {
    use std::fs::File;

    use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
    use rustix::termios::{OptionalActions, tcgetattr, tcsetattr};

    let end = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY).expect("a pseudo-terminal");
    grantpt(&end).expect("granted");
    unlockpt(&end).expect("unlocked");
    let name = ptsname(&end, Vec::new()).expect("named");
    let name = name.to_string_lossy().into_owned();
    let mut settings = tcgetattr(&end).expect("a terminal");
    settings.make_raw();
    tcsetattr(&end, OptionalActions::Now, &settings).expect("raw");
    let open = |path: &str| {
        let line = File::options().read(true).write(true).open(path);
        line.expect("a line")
    };
    let (driver, machine) = (File::from(end), open(path));
    // The line exists while no driver has it open.
    let held = open(&name);
    let back = [&machine, &driver].map(|side| side.try_clone().expect("a file"));
    std::thread::spawn(move || pass(&driver, &machine, None));
    let [machine, driver] = back;
    std::thread::spawn(move || {
        pass(&machine, &driver, Some(arrival));
        drop(held);
    });
    name
}

fn pass(mut from: impl Read, mut to: impl Write, arrival: Option<Arrival>) {
    let mut bytes = vec![0; 1 << 16];
    while let Ok(count @ 1..) = from.read(&mut bytes) {
        let came = &bytes[..count];
        let sent = match arrival {
            Some(Arrival::Bytewise) => came.chunks(1).try_for_each(|byte| to.write_all(byte)),
            Some(Arrival::Twice) => to.write_all(came).and_then(|()| to.write_all(came)),
            Some(Arrival::Late) => {
                std::thread::sleep(LATE);
                to.write_all(came)
            }
            None => to.write_all(came),
        };
        if sent.is_err() {
            break;
        }
    }
}

impl<E: Arm> Setup<E> {
    /// Moves the robot while a proxy changes the answers from `address`. The motion must end at the target, or in a typed error with the robot at
    /// rest. Returns true if it arrived.
    fn arrives(&self, address: SocketAddr, arrival: Arrival) -> bool {
        let port = before(address, arrival);
        let direct = format!(";port={};", address.port());
        let proxied = self.arguments().replace(&direct, &format!(";port={port};"));
        assert_ne!(proxied, self.arguments());
        self.moves(&proxied, arrival)
    }

    /// As [`arrives`](Setup::arrives), for a machine on a serial line.
    #[cfg(unix)]
    fn arrives_by_line(&self, arrival: Arrival) -> bool {
        let (_, path) = self.arguments().split_once("port=").expect("a line");
        let proxied = format!("port={}", before_line(path, arrival));
        self.moves(&proxied, arrival)
    }

    fn moves(&self, proxied: &str, arrival: Arrival) -> bool {
        let moved = self.opened(proxied).and_then(|mut arm| {
            let (home, _) = arm.pose(PATIENCE)?;
            arm.move_to(lower(home, 4.0), speed(5.0), PATIENCE)
        });
        if let Err(error) = &moved {
            assert!(TYPED.contains(&error.kind()), "{arrival:?}: {error}");
            std::thread::sleep(STANDS);
        }
        let truth = self.bench.truth();
        assert!(!truth.is_moving, "{arrival:?}: {truth:?}");
        let apart_mm = (truth.tip_mm[2] + 16.0).abs();
        assert!(moved.is_err() || apart_mm < 0.05, "{arrival:?}: {truth:?}");
        moved.is_ok()
    }
}

#[test]
fn an_arm_whose_controller_answers_in_one_byte_pieces_arrives() {
    let setup = xarm_setup();
    assert!(setup.arrives(setup.emulator.address(Port::Command), Arrival::Bytewise));
    let setup = ur_setup();
    assert!(setup.arrives(setup.emulator.states_address(), Arrival::Bytewise));
}

#[test]
fn an_arm_whose_controller_answers_twice_arrives_or_stands_with_a_typed_error() {
    let setup = xarm_setup();
    setup.arrives(setup.emulator.address(Port::Command), Arrival::Twice);
    let setup = ur_setup();
    setup.arrives(setup.emulator.states_address(), Arrival::Twice);
}

#[test]
fn an_arm_whose_controller_answers_late_arrives_or_stands_with_a_typed_error() {
    let setup = xarm_setup();
    setup.arrives(setup.emulator.address(Port::Command), Arrival::Late);
    let setup = ur_setup();
    setup.arrives(setup.emulator.states_address(), Arrival::Late);
}

#[test]
fn a_controller_of_another_version_of_the_exchange_is_refused_by_that_version() {
    let listener = TcpListener::bind("127.0.0.1:0").expect("a port");
    let port = listener.local_addr().expect("bound").port();
    std::thread::spawn(move || {
        let serve = |mut stream: TcpStream| {
            let mut question = [0; 64];
            let _ = stream.read(&mut question);
            // The request for version 2 is not accepted.
            let _ = stream.write_all(&[0, 4, b'V', 0]);
            let _ = stream.read(&mut question);
        };
        for stream in listener.incoming().flatten() {
            std::thread::spawn(move || serve(stream));
        }
    });
    let factory = UrFactory::new().expect("a factory");
    let arguments = format!("host=127.0.0.1;port={port};script_port={port}");
    let args = factory.descriptor().args(&arguments).expect("good");
    let Err(error) = factory.open(&args, &mut Rig::new()) else {
        panic!("opened a controller of another version")
    };
    assert_eq!(error.kind(), ErrorKind::Unsupported, "{error}");
    assert!(error.to_string().contains("version 2"), "{error}");
}

#[cfg(unix)]
#[test]
fn a_machine_with_g_code_that_answers_in_one_byte_pieces_arrives() {
    assert!(grbl::setup().arrives_by_line(Arrival::Bytewise));
    assert!(marlin::setup().arrives_by_line(Arrival::Bytewise));
}

#[cfg(unix)]
#[test]
fn a_machine_with_g_code_that_answers_twice_arrives_or_stands_with_a_typed_error() {
    grbl::setup().arrives_by_line(Arrival::Twice);
    marlin::setup().arrives_by_line(Arrival::Twice);
}

#[cfg(unix)]
#[test]
fn a_machine_with_g_code_that_answers_late_arrives_or_stands_with_a_typed_error() {
    grbl::setup().arrives_by_line(Arrival::Late);
    marlin::setup().arrives_by_line(Arrival::Late);
}
