//! Gate that delays the messages of a driver on some of its connections.

use std::io::{Read, Write};
use std::net::{SocketAddr, TcpListener, TcpStream};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Condvar, Mutex};
use std::time::{Duration, Instant};

use taceva_core::{ErrorKind, Robot};
use taceva_wire::WallBench;

use crate::waiting::support::{PATIENCE, lower, speed};

/// Proxy between a driver and the port of an arm. While it is shut, messages of the driver wait on the selected connections.
pub(crate) struct Gate {
    is_shut: Mutex<bool>,
    opened: Condvar,
    /// Number of connections so far.
    count: AtomicUsize,
}

impl Gate {
    /// Starts an open gate in front of `address`. Returns the gate and its port. `holds` selects the connections on which messages may wait, by their
    /// number from 0.
    pub(crate) fn before(address: SocketAddr, holds: fn(usize) -> bool) -> (Arc<Gate>, u16) {
        let gate = Arc::new(Gate {
            is_shut: Mutex::new(false),
            opened: Condvar::new(),
            count: AtomicUsize::new(0),
        });
        let listener = TcpListener::bind("127.0.0.1:0").expect("a port");
        let port = listener.local_addr().expect("bound").port();
        let passing = Arc::clone(&gate);
        std::thread::spawn(move || {
            for (number, driver) in listener.incoming().flatten().enumerate() {
                let arm = TcpStream::connect(address).expect("it listens");
                let back = [&arm, &driver].map(|side| side.try_clone().expect("a socket"));
                let gate = Arc::clone(&passing);
                std::thread::spawn(move || pass(driver, arm, || gate.wait(holds(number))));
                let [arm, driver] = back;
                std::thread::spawn(move || pass(arm, driver, || {}));
                passing.count.fetch_add(1, Ordering::SeqCst);
            }
        });
        (gate, port)
    }

    pub(crate) fn shut(&self, is_shut: bool) {
        *self.is_shut.lock().expect("whole") = is_shut;
        self.opened.notify_all();
    }

    fn wait(&self, is_held: bool) {
        let is_shut = self.is_shut.lock().expect("whole");
        let waited = self.opened.wait_while(is_shut, |shut| *shut && is_held);
        drop(waited.expect("whole"));
    }

    /// Waits until the driver has made `count` connections.
    pub(crate) fn wait_for(&self, count: usize) {
        while self.count.load(Ordering::SeqCst) < count {
            std::thread::sleep(Duration::from_millis(2));
        }
    }
}

/// Halts `arm` during its descent while `gate` is shut. Returns the time at which it was shut.
pub(crate) fn halted_while_shut(gate: &Gate, bench: &WallBench, arm: &mut dyn Robot) -> Instant {
    let (home, _) = arm.pose(PATIENCE).expect("a pose");
    let handle = arm.halt_handle();
    let (shut, moved) = std::thread::scope(|scope| {
        let halting = scope.spawn(|| {
            while !bench.truth().is_moving {
                std::thread::yield_now();
            }
            let shut = Instant::now();
            gate.shut(true);
            handle.halt().expect("it is sent, by whichever connection");
            shut
        });
        let moved = arm.move_to(lower(home, 15.0), speed(2.0), PATIENCE);
        (halting.join().expect("no panic"), moved)
    });
    assert_eq!(moved.expect_err("halted").kind(), ErrorKind::Interrupted);
    shut
}

/// Forwards the data of `from` to `to` until its end. Waits for `may` to return before each part.
fn pass(mut from: TcpStream, mut to: TcpStream, may: impl Fn()) {
    let mut bytes = [0; 1024];
    while let Ok(count @ 1..) = from.read(&mut bytes) {
        may();
        if to.write_all(&bytes[..count]).is_err() {
            return;
        }
    }
    // The other side may have closed already.
    let _ = to.shutdown(std::net::Shutdown::Write);
}
