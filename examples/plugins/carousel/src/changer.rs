//! A carousel of specimens that is driven by lines over TCP: `turn N` has it turn to place N, from 1, and once it stands it answers `at N` with the
//! number that its own reader sees there, or `fault` and words. Where its connection ends it stands at once.

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
/// How long a connection may take.
const CONNECTING: Duration = Duration::from_secs(2);
/// How often it is looked whether an answer has come.
const LOOKING: Duration = Duration::from_millis(2);
/// No answer is longer, in bytes.
const LINE_MAX: usize = 256;

/// What opens the carousel, and says everything about it that is known before.
pub(crate) fn factory() -> Result<Box<dyn Factory<dyn Changer>>, DescriptorError> {
    // What it holds is known from its arguments alone.
    let facts = Facts::Changer(ChangerFacts::default());
    let spec = DescriptorSpec::new(KEY, "carousel", DriverSource::Real, facts);
    let host = ArgSpec::text("host").help("its address or name");
    let port = ArgSpec::whole("port", 1, 65_535)
        .default(ArgValue::Whole(7_474))
        .help("where it listens");
    let holds = ArgSpec::text("holds")
        .help("what stands at its places, in their order, with a comma between")
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

    /// Nothing moves.
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
    /// Absent after a call that failed: then the carousel stands.
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

    /// The answer to `turn`, waited for until `deadline`.
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

    /// The name of what stands at the place that `answer` names.
    fn named(&self, answer: &str) -> Result<String, DriverError> {
        let failed = |kind| DriverError::new(kind, &KEY, DOING);
        if let Some(words) = answer.strip_prefix("fault ") {
            return Err(failed(ErrorKind::DeviceFault).because(words.to_owned()));
        }
        let place = answer.strip_prefix("at ").and_then(|place| place.parse::<usize>().ok());
        let held = place.and_then(|place| self.holds.get(place.checked_sub(1)?));
        held.cloned().ok_or_else(|| {
            let why = format!("what came is no place: {answer:?}");
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
        // Where this fails the connection ends, and with it whatever it was doing.
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
