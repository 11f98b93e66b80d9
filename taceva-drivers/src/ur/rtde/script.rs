//! Script programs, and the connection that sends them. The connection discards everything that the controller sends.

use std::io::{self, Read, Write};
use std::net::{Shutdown, SocketAddr, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use super::message::STOP_REGISTER;
use crate::link::{LinkError, connect};

/// Program that moves the tool in a straight line to `pose`: position in m, rotation vector in rad.
pub(super) fn move_line(pose: [f64; 6], speed_m_s: f64, acceleration_m_s2: f64) -> String {
    let [x, y, z, rx, ry, rz] = pose;
    format!(
        "def taceva_move():\n  movel(p[{x:.9}, {y:.9}, {z:.9}, {rx:.9}, {ry:.9}, {rz:.9}], a={acceleration_m_s2:.6}, v={speed_m_s:.9})\nend\n"
    )
}

/// Program that moves the tool at the velocity (x, y, z), m/s, for `lasts_s`, then brakes.
pub(super) fn cruise(
    [x, y, z]: [f64; 3],
    lasts_s: f64,
    [acceleration_m_s2, deceleration_m_s2]: [f64; 2],
) -> String {
    format!(
        "def taceva_cruise():\n  speedl([{x:.9}, {y:.9}, {z:.9}, 0, 0, 0], a={acceleration_m_s2:.6}, t={lasts_s:.3})\n  stopl({deceleration_m_s2:.6})\nend\n"
    )
}

/// Program that replaces the running program and brakes.
pub(super) fn stop(deceleration_m_s2: f64) -> String {
    format!("def taceva_stop():\n  stopl({deceleration_m_s2:.6})\nend\n")
}

/// Same as [`stop`], but the program first writes `number` to the register [`STOP_REGISTER`].
pub(super) fn numbered_stop(number: i32, deceleration_m_s2: f64) -> String {
    format!(
        "def taceva_stop():\n  write_output_integer_register({STOP_REGISTER}, {number})\n  stopl({deceleration_m_s2:.6})\nend\n"
    )
}

/// Connection to the port that accepts script programs.
#[derive(Debug)]
pub(super) struct ScriptLine {
    stream: Mutex<TcpStream>,
    address: SocketAddr,
    is_over: Arc<AtomicBool>,
    reader: Option<JoinHandle<()>>,
}

/// Timeout for writing a program.
const WRITING: Duration = Duration::from_millis(40);

impl ScriptLine {
    /// Connects to `port` of `host`.
    pub(super) fn open(host: &str, port: u16) -> Result<ScriptLine, LinkError> {
        let (stream, address) = connect(host, port)?;
        let broken = |source: io::Error| LinkError::Broken { address, source };
        stream.set_write_timeout(Some(WRITING)).map_err(broken)?;
        let mut reading = stream.try_clone().map_err(broken)?;
        let is_over = Arc::new(AtomicBool::new(false));
        let over = Arc::clone(&is_over);
        let reader = std::thread::Builder::new()
            .name("ur script".to_owned())
            .spawn(move || {
                // Read and discard, so that the receive buffer does not fill up.
                let mut bytes = [0; 4096];
                while !matches!(reading.read(&mut bytes), Ok(0) | Err(_)) {}
                over.store(true, Ordering::Release);
            })
            .map_err(broken)?;
        Ok(ScriptLine {
            stream: Mutex::new(stream),
            address,
            is_over,
            reader: Some(reader),
        })
    }

    /// True until the reader detects the end of the connection.
    pub(super) fn is_alive(&self) -> bool {
        !self.is_over.load(Ordering::Acquire)
    }

    /// Sends a program. The controller does not confirm its arrival.
    pub(super) fn send(&self, program: &str) -> Result<(), LinkError> {
        let address = self.address;
        if !self.is_alive() {
            return Err(LinkError::Closed { address });
        }
        let mut stream = self.stream.lock().unwrap_or_else(PoisonError::into_inner);
        stream
            .write_all(program.as_bytes())
            .map_err(|source| LinkError::Broken { address, source })
    }
}

impl Drop for ScriptLine {
    fn drop(&mut self) {
        let stream = self
            .stream
            .get_mut()
            .unwrap_or_else(PoisonError::into_inner);
        let _ = stream.shutdown(Shutdown::Both);
        if let Some(reader) = self.reader.take() {
            let _ = reader.join();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn programs_hold_every_number_as_fine_as_a_nanometre() {
        let program = move_line([0.3, -0.000_000_001, 0.25, 3.125, 0.0, 0.0], 0.005, 0.5);
        assert_eq!(
            program,
            "def taceva_move():\n  movel(p[0.300000000, -0.000000001, 0.250000000, 3.125000000, 0.000000000, 0.000000000], a=0.500000, v=0.005000000)\nend\n"
        );
        assert_eq!(
            cruise([0.0, 0.000_000_001, -0.005], 0.2, [0.5, 2.0]),
            "def taceva_cruise():\n  speedl([0.000000000, 0.000000001, -0.005000000, 0, 0, 0], a=0.500000, t=0.200)\n  stopl(2.000000)\nend\n"
        );
        assert_eq!(stop(2.0), "def taceva_stop():\n  stopl(2.000000)\nend\n");
        assert_eq!(
            numbered_stop(42, 2.0),
            "def taceva_stop():\n  write_output_integer_register(24, 42)\n  stopl(2.000000)\nend\n"
        );
    }
}
