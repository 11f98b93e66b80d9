//! Driver of a carousel of specimens, controlled by lines over TCP. `turn N` turns it to place N, counted from 1. Once at rest, it answers
//! `at N`, with N from its own reader, or `fault` and a message. The carousel stops at once if the connection ends.

use std::io::{ErrorKind as IoErrorKind, Read, Write};
use std::net::{TcpStream, ToSocketAddrs};
use std::sync::Arc;
use std::time::{Duration, Instant};

use taceva_core::{
    ArgSpec, ArgValue, Args, Changer, ChangerFacts, Deadline, Descriptor, DescriptorError,
    DescriptorSpec, DriverError, DriverKey, DriverSource, ErrorKind, Factory, Facts, Interrupt, Rig,
};
use taceva_plugin::Interruption;

const KEY: DriverKey = DriverKey::fixed("org.example.carousel/carousel");
const DOING: &str = "turn the carousel";
/// Timeout of the connection.
const CONNECTING: Duration = Duration::from_secs(2);
/// Polling interval for an answer.
const LOOKING: Duration = Duration::from_millis(2);
/// Maximum length of an answer, bytes.
const LINE_MAX: usize = 256;

/// Factory of the carousel, with its descriptor.
pub(crate) fn factory() -> Result<Box<dyn Factory<dyn Changer>>, DescriptorError> {
    // The arguments state the items in the carousel.
    let facts = Facts::Changer(ChangerFacts::default());
    let spec = DescriptorSpec::new(KEY, "carousel", DriverSource::Real, facts);
    let host = ArgSpec::text("host").help("host name or address of the carousel");
    let port = ArgSpec::whole("port", 1, 65_535)
        .default(ArgValue::Whole(7_474))
        .help("TCP port of the carousel");
    let holds = ArgSpec::text("holds")
        .help("items in its places, in order, separated by commas")
        .changes_facts();
    let descriptor = spec.arguments([host, port, holds]).check()?;
    Ok(Box::new(CarouselFactory { descriptor }))
}

fn holds(args: &Args) -> Vec<String> {
    let places = args.text("holds").split(',');
    places.map(|name| name.trim().to_owned()).collect()
}

struct CarouselFactory {
    descriptor: Descriptor,
}

impl Factory<dyn Changer> for CarouselFactory {
    fn descriptor(&self) -> &Descriptor {
        &self.descriptor
    }

    fn describe(&self, args: &Args) -> Result<Descriptor, DescriptorError> {
        let mut spec = self.descriptor.to_spec();
        spec.facts = Facts::Changer(ChangerFacts::default().with_holds(holds(args)));
        spec.check()
    }

    /// Connects to the carousel. Opening moves nothing.
    fn open(&self, args: &Args, _: &mut Rig) -> Result<Box<dyn Changer>, DriverError> {
        let mut carousel = Carousel {
            host: args.text("host").to_owned(),
            port: u16::try_from(args.whole("port")).unwrap_or_default(),
            holds: holds(args),
            line: None,
            interruption: Arc::default(),
        };
        carousel.line = Some(carousel.connected()?);
        Ok(Box::new(carousel))
    }
}

struct Carousel {
    host: String,
    port: u16,
    holds: Vec<String>,
    /// Connection; `None` after a failed call, which closes it and so stops the carousel.
    line: Option<TcpStream>,
    interruption: Arc<Interruption>,
}

impl Carousel {
    fn connected(&self) -> Result<TcpStream, DriverError> {
        let failed = |kind, error: std::io::Error| {
            DriverError::new(kind, &KEY, "reach the carousel").because(error)
        };
        let address = (self.host.as_str(), self.port)
            .to_socket_addrs()
            .map_err(|error| failed(ErrorKind::NotFound, error))?
            .next()
            .ok_or_else(|| DriverError::new(ErrorKind::NotFound, &KEY, "find its address"))?;
        let line = TcpStream::connect_timeout(&address, CONNECTING).map_err(|error| {
            let kind = match error.kind() {
                IoErrorKind::PermissionDenied => ErrorKind::PermissionDenied,
                _ => ErrorKind::NotFound,
            };
            failed(kind, error)
        })?;
        line.set_nonblocking(true)
            .map_err(|error| failed(ErrorKind::Internal, error))?;
        Ok(line)
    }

    /// Sends `turn` and returns the answer.
    fn turned(&self, line: &mut TcpStream, place: usize, deadline: Deadline) -> Result<String, DriverError> {
        let failed = |kind| DriverError::new(kind, &KEY, DOING);
        let call = self.interruption.call();
        let until = Instant::now() + deadline.remaining();
        line.write_all(format!("turn {place}\n").as_bytes())
            .map_err(|error| failed(ErrorKind::Disconnected).because(error))?;
        let mut answer = Vec::new();
        loop {
            let mut block = [0; 64];
            match line.read(&mut block) {
                Ok(0) => return Err(failed(ErrorKind::Disconnected).because("it closed the connection")),
                Ok(length) => answer.extend(&block[..length]),
                Err(error) if error.kind() == IoErrorKind::WouldBlock => {}
                Err(error) => return Err(failed(ErrorKind::Disconnected).because(error)),
            }
            if let [words @ .., b'\n'] = answer.as_slice() {
                return Ok(String::from_utf8_lossy(words).into_owned());
            }
            if answer.len() > LINE_MAX {
                return Err(failed(ErrorKind::Protocol).because("an answer without an end"));
            }
            let left = until.saturating_duration_since(Instant::now());
            if left.is_zero() {
                return Err(failed(ErrorKind::Timeout).because("it has not arrived"));
            }
            call.rest(LOOKING.min(left))
                .map_err(|interrupted| failed(ErrorKind::Interrupted).because(interrupted))?;
        }
    }

    /// Name of the item at the place that `answer` states.
    fn named(&self, answer: &str) -> Result<String, DriverError> {
        let failed = |kind| DriverError::new(kind, &KEY, DOING);
        if let Some(words) = answer.strip_prefix("fault ") {
            return Err(failed(ErrorKind::DeviceFault).because(words.to_owned()));
        }
        let place = answer.strip_prefix("at ").and_then(|place| place.parse::<usize>().ok());
        let held = place.and_then(|place| self.holds.get(place.checked_sub(1)?));
        held.cloned().ok_or_else(|| {
            let why = format!("the answer is {answer:?}, expected `at` and the number of a place");
            failed(ErrorKind::Protocol).because(why)
        })
    }
}

impl Changer for Carousel {
    fn holds(&self) -> &[String] {
        &self.holds
    }

    fn bring(&mut self, name: &str, deadline: Deadline) -> Result<String, DriverError> {
        let Some(place) = self.holds.iter().position(|held| held == name) else {
            let why = format!("{name:?}: expected one of `{}`", self.holds.join("`, `"));
            let refused = DriverError::new(ErrorKind::InvalidArgument, &KEY, DOING);
            return Err(refused.because(why));
        };
        let mut line = match self.line.take() {
            Some(line) => line,
            None => self.connected()?,
        };
        // On failure the connection is dropped, which stops the carousel.
        let answer = self.turned(&mut line, place + 1, deadline)?;
        let there = self.named(&answer)?;
        self.line = Some(line);
        Ok(there)
    }

    fn interrupt_handle(&self) -> Option<Arc<dyn Interrupt>> {
        self.interruption.handle()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_answer_is_a_place_that_it_has_or_a_fault_and_nothing_else() {
        let carousel = Carousel {
            host: String::new(),
            port: 1,
            holds: vec!["a".to_owned(), "b".to_owned()],
            line: None,
            interruption: Arc::default(),
        };
        assert_eq!(carousel.named("at 2").expect("a place"), "b");
        for answer in ["at 0", "at 3", "at", "at x", "2", ""] {
            let error = carousel.named(answer).expect_err(answer);
            assert_eq!(error.kind(), ErrorKind::Protocol);
        }
        let fault = carousel.named("fault the motor is hot").expect_err("a fault");
        assert_eq!(fault.kind(), ErrorKind::DeviceFault);
    }

    #[test]
    fn the_manifest_says_what_the_driver_says_of_itself() {
        let driver = factory().expect("it does not contradict itself");
        let table = taceva_plugin::provides_table(driver.descriptor());
        let table = table.replace("[[args]]", "[[provides.args]]");
        assert!(include_str!("../plugin.toml").contains(&table), "[[provides]]\n{table}");
    }
}
