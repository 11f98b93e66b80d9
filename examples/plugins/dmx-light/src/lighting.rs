//! A lamp on a DMX512 universe, behind an interface that takes framed packets on a serial port (that of ENTTEC's DMX USB Pro).
//!
//! A packet is `7E`, the label 6, the length of what follows in two bytes, low one first, a start code 0, a level for each of 512 channels, and
//! `E7`. No byte of it is one that a terminal's line discipline changes, so the port needs no setting up: levels are 0, 85, 170 and 255.

use std::fs::{File, OpenOptions};
use std::io::Write;
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use taceva_core::{
    ArgSpec, ArgValue, Args, Deadline, Descriptor, DescriptorError, DescriptorSpec, DriverError,
    DriverKey, DriverSource, ErrorKind, Factory, Facts, Lighting, LightingFacts, Rig,
};

const KEY: DriverKey = DriverKey::fixed("org.example.dmx-light/dmx-light");
/// The scenes, that of the calibration first, and the level of the lamp in each.
const SCENES: [(&str, u8); 4] = [("dark", 0), ("low", 85), ("high", 170), ("full", 255)];
/// Channels of a universe.
const CHANNELS: usize = 512;

/// What opens the lamp, and says everything about it that is known before.
pub(crate) fn factory() -> Result<Box<dyn Factory<dyn Lighting>>, DescriptorError> {
    let facts = Facts::Lighting(LightingFacts::default().with_scenes(scenes()));
    let spec = DescriptorSpec::new(KEY, "DMX light", DriverSource::Real, facts);
    let port = ArgSpec::path("port").help("the serial port of the interface, such as /dev/ttyUSB0");
    let channel = ArgSpec::whole("channel", 1, 512)
        .default(ArgValue::Whole(1))
        .help("of the lamp");
    let settle = ArgSpec::whole("settle", 0, 60_000)
        .unit("ms")
        .default(ArgValue::Whole(500))
        .help("how long the lamp takes until it is steady");
    let descriptor = spec.arguments([port, channel, settle]).check()?;
    Ok(Box::new(DmxFactory { descriptor }))
}

fn scenes() -> Vec<String> {
    SCENES.map(|(scene, _)| scene.to_owned()).into()
}

struct DmxFactory {
    descriptor: Descriptor,
}

impl Factory<dyn Lighting> for DmxFactory {
    fn descriptor(&self) -> &Descriptor {
        &self.descriptor
    }

    /// No light changes.
    fn open(&self, args: &Args, _: &mut Rig) -> Result<Box<dyn Lighting>, DriverError> {
        let failed = |error: std::io::Error| {
            let kind = match error.kind() {
                std::io::ErrorKind::PermissionDenied => ErrorKind::PermissionDenied,
                _ => ErrorKind::NotFound,
            };
            DriverError::new(kind, &KEY, "open the port").because(error)
        };
        let port = OpenOptions::new().write(true).open(args.text("port")).map_err(failed)?;
        Ok(Box::new(Dmx {
            port,
            channel: usize::try_from(args.whole("channel")).unwrap_or(1),
            settle: Duration::from_millis(args.whole("settle").unsigned_abs()),
            scenes: scenes(),
            writing: None,
        }))
    }
}

struct Dmx {
    port: File,
    /// From 1.
    channel: usize,
    settle: Duration,
    scenes: Vec<String>,
    /// A packet that is not through yet: a port that is full keeps its writer waiting, and must not keep the run.
    writing: Option<Receiver<std::io::Result<()>>>,
}

impl Dmx {
    /// Waits until the packet under way is through.
    fn written(&mut self, deadline: Deadline) -> Result<(), DriverError> {
        let failed = |kind| DriverError::new(kind, &KEY, "set the light");
        let Some(writing) = &self.writing else {
            return Ok(());
        };
        let written = match writing.recv_timeout(deadline.remaining()) {
            Err(RecvTimeoutError::Timeout) => {
                return Err(failed(ErrorKind::Timeout).because("the port takes nothing"));
            }
            Err(RecvTimeoutError::Disconnected) => Ok(()),
            Ok(written) => written,
        };
        self.writing = None;
        written.map_err(|error| failed(ErrorKind::Disconnected).because(error))
    }
}

impl Lighting for Dmx {
    fn scenes(&self) -> &[String] {
        &self.scenes
    }

    /// Returns once the lamp had time to become steady; it reports nothing, so that it is is not known.
    fn set(&mut self, scene: &str, deadline: Deadline) -> Result<(), DriverError> {
        let failed = |kind| DriverError::new(kind, &KEY, "set the light");
        let known = SCENES.iter().find(|(known, _)| *known == scene);
        let Some((_, level)) = known else {
            let why = format!("{scene:?}: expected one of `{}`", self.scenes.join("`, `"));
            return Err(failed(ErrorKind::InvalidArgument).because(why));
        };
        if deadline.remaining() < self.settle {
            let why = format!("{} ms until it is steady, there is less time", self.settle.as_millis());
            return Err(failed(ErrorKind::Timeout).because(why));
        }
        self.written(deadline)?;
        let packet = packet(self.channel, *level);
        let mut port = self
            .port
            .try_clone()
            .map_err(|error| failed(ErrorKind::Internal).because(error))?;
        let (tell, writing) = channel();
        thread::spawn(move || tell.send(port.write_all(&packet)));
        self.writing = Some(writing);
        self.written(deadline)?;
        thread::sleep(self.settle);
        Ok(())
    }
}

/// What sets `channel`, from 1, to `level` and all others to 0.
fn packet(channel: usize, level: u8) -> Vec<u8> {
    let mut levels = [0; CHANNELS];
    levels[channel - 1] = level;
    // 513 bytes: the start code and the channels.
    let mut packet = vec![0x7e, 6, 0x01, 0x02, 0];
    packet.extend(levels);
    packet.push(0xe7);
    packet
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_packet_sets_one_channel_and_no_byte_of_it_is_a_line_feed() {
        let packet = packet(512, 170);
        assert_eq!(packet.len(), 4 + 513 + 1);
        assert_eq!((packet[4 + 512], packet[517]), (170, 0xe7));
        for (_, level) in SCENES {
            assert!(!super::packet(3, level).contains(&b'\n'));
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
