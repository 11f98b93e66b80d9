//! Driver of a six-axis transducer that writes a line for each reading to every TCP client: `number;Fx;Fy;Fz;Tx;Ty;Tz` in N and N m.
//!
//! A thread reads every line on arrival, so a late call gets the newest reading and never a queued reading.

use std::io::{BufRead, BufReader, Read};
use std::net::{TcpStream, ToSocketAddrs};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::Duration;

use taceva_core::{
    ArgSpec, ArgValue, Args, Axes, Deadline, Descriptor, DescriptorError, DescriptorSpec,
    DriverError, DriverKey, DriverSource, ErrorKind, Factory, Facts, ForceFacts, ForceTransducer,
    Hertz, Interrupt, Newton, NewtonMillimetre, Rig, Stamp, Wrench,
};
use taceva_plugin::Interruption;

const KEY: DriverKey = DriverKey::fixed("org.example.line-transducer/line-transducer");
/// Timeout of the connection.
const CONNECTING: Duration = Duration::from_secs(2);
/// Polling interval for a reading.
const LOOKING: Duration = Duration::from_millis(1);
/// Maximum length of a line, bytes.
const LINE_MAX: u64 = 256;

/// Factory of the transducer, with its descriptor.
pub(crate) fn factory() -> Result<Box<dyn Factory<dyn ForceTransducer>>, DescriptorError> {
    let facts = ForceFacts::default()
        .with_axes(Axes::SIX)
        .with_rate(Hertz(200.0))
        .with_force_max(Newton(200.0))
        .with_numbered(true);
    let spec = DescriptorSpec::new(KEY, "line transducer", DriverSource::Real, Facts::Force(facts));
    let host = ArgSpec::text("host").help("host name or address of the transducer");
    let port = ArgSpec::whole("port", 1, 65_535)
        .default(ArgValue::Whole(63_351))
        .help("TCP port of the transducer");
    let descriptor = spec.arguments([host, port]).check()?;
    Ok(Box::new(LineFactory { descriptor }))
}

struct LineFactory {
    descriptor: Descriptor,
}

impl Factory<dyn ForceTransducer> for LineFactory {
    fn descriptor(&self) -> &Descriptor {
        &self.descriptor
    }

    fn open(&self, args: &Args, _: &mut Rig) -> Result<Box<dyn ForceTransducer>, DriverError> {
        let failed = |kind, error: std::io::Error| {
            DriverError::new(kind, &KEY, "reach the transducer").because(error)
        };
        let port = u16::try_from(args.whole("port")).unwrap_or_default();
        let address = (args.text("host"), port)
            .to_socket_addrs()
            .map_err(|error| failed(ErrorKind::NotFound, error))?
            .next()
            .ok_or_else(|| DriverError::new(ErrorKind::NotFound, &KEY, "find its address"))?;
        let stream = TcpStream::connect_timeout(&address, CONNECTING).map_err(|error| {
            let kind = match error.kind() {
                std::io::ErrorKind::PermissionDenied => ErrorKind::PermissionDenied,
                _ => ErrorKind::NotFound,
            };
            failed(kind, error)
        })?;
        let newest = Arc::new(Mutex::new(Newest::default()));
        let lines = stream.try_clone().map_err(|error| failed(ErrorKind::Internal, error))?;
        let shared = Arc::clone(&newest);
        thread::spawn(move || listen(lines, &shared));
        Ok(Box::new(Transducer {
            stream,
            newest,
            last: None,
            interruption: Arc::default(),
        }))
    }
}

/// Newest reading, and the reason why no further reading arrives.
#[derive(Default)]
struct Newest {
    reading: Option<Reading>,
    ended: Option<(ErrorKind, String)>,
}

#[derive(Clone, Copy)]
struct Reading {
    number: u64,
    wrench: Wrench,
    stamp: Stamp,
}

/// Reads lines until the connection ends, and keeps only the newest reading.
fn listen(stream: TcpStream, newest: &Mutex<Newest>) {
    let mut lines = BufReader::new(stream);
    let ended = loop {
        let mut line = String::new();
        match lines.by_ref().take(LINE_MAX).read_line(&mut line) {
            Ok(0) => break (ErrorKind::Disconnected, "it closed the connection".to_owned()),
            Ok(_) => {}
            Err(error) => break (ErrorKind::Disconnected, error.to_string()),
        }
        let stamp = Stamp::at(taceva_plugin::now());
        let Some((number, wrench)) = parsed(line.trim_end()) else {
            break (ErrorKind::Protocol, format!("the line is {line:?}, expected a number, three forces and three torques"));
        };
        let reading = Reading { number, wrench, stamp };
        newest.lock().unwrap_or_else(PoisonError::into_inner).reading = Some(reading);
    };
    newest.lock().unwrap_or_else(PoisonError::into_inner).ended = Some(ended);
}

fn parsed(line: &str) -> Option<(u64, Wrench)> {
    let mut fields = line.split(';');
    let number = fields.next()?.parse().ok()?;
    let mut wrench = Wrench::default();
    for force in &mut wrench.force {
        *force = Newton(finite(fields.next()?)?);
    }
    for torque in &mut wrench.torque {
        *torque = NewtonMillimetre(1e3 * finite(fields.next()?)?);
    }
    fields.next().is_none().then_some((number, wrench))
}

fn finite(text: &str) -> Option<f64> {
    text.parse().ok().filter(|number: &f64| number.is_finite())
}

struct Transducer {
    stream: TcpStream,
    newest: Arc<Mutex<Newest>>,
    /// Last reading that was returned.
    last: Option<Reading>,
    interruption: Arc<Interruption>,
}

impl ForceTransducer for Transducer {
    fn axes(&self) -> Axes {
        Axes::SIX
    }

    fn read(&mut self, deadline: Deadline) -> Result<(Wrench, Stamp), DriverError> {
        let failed = |kind| DriverError::new(kind, &KEY, "read the force");
        let call = self.interruption.call();
        // A deadline is a length of time, which does not run down by itself.
        let until = taceva_plugin::now() + deadline.remaining();
        loop {
            {
                let newest = self.newest.lock().unwrap_or_else(PoisonError::into_inner);
                let seen = self.last.map(|last| last.stamp);
                if let Some(reading) = newest.reading.filter(|new| Some(new.stamp) != seen) {
                    self.last = Some(reading);
                    return Ok((reading.wrench, reading.stamp));
                }
                if let Some((kind, why)) = &newest.ended {
                    return Err(failed(*kind).because(why.clone()));
                }
            }
            let left = until.saturating_sub(taceva_plugin::now());
            if left.is_zero() {
                return Err(failed(ErrorKind::Timeout).because("no reading came in time"));
            }
            call.rest(LOOKING.min(left))
                .map_err(|interrupted| failed(ErrorKind::Interrupted).because(interrupted))?;
        }
    }

    fn sequence(&self) -> Option<u64> {
        self.last.map(|last| last.number)
    }

    fn interrupt_handle(&self) -> Option<Arc<dyn Interrupt>> {
        self.interruption.handle()
    }
}

impl Drop for Transducer {
    fn drop(&mut self) {
        // The reading thread ends with the connection.
        drop(self.stream.shutdown(std::net::Shutdown::Both));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_a_number_and_six_components_and_nothing_else_is() {
        let (number, wrench) = parsed("7;1;-2;3.5;0.001;0;-0.002").expect("a reading");
        assert_eq!((number, wrench.force[2].0), (7, 3.5));
        assert!((wrench.torque[0].0 - 1.0).abs() < 1e-12);
        for line in ["", "7", "7;1;2;3;4;5", "7;1;2;3;4;5;6;7", "x;1;2;3;4;5;6", "7;1;2;NaN;4;5;6"] {
            assert!(parsed(line).is_none(), "{line}");
        }
    }

    #[test]
    fn the_manifest_says_what_the_driver_says_of_itself() {
        let driver = factory().expect("it does not contradict itself");
        let table = taceva_plugin::provides_table(driver.descriptor());
        let table = table.replace("[[args]]", "[[provides.args]]");
        assert!(include_str!("../plugin.toml").contains(&table), "[[provides]]\n{table}");
    }
}
