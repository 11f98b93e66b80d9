//! Driver of a lamp on a DMX512 universe, behind an interface with framed packets on a serial port (ENTTEC's DMX USB Pro).
//!
//! A packet consists of `7E`, the label 6, the payload length in two bytes (low byte first), the start code 0, a level for each of 512 channels, and
//! `E7`. Levels are 0, 85, 170 and 255. The line discipline of a terminal changes none of these bytes, so the port needs no setup.

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
/// Light scenes with their lamp levels, the scene of the calibration first.
const SCENES: [(&str, u8); 4] = [("dark", 0), ("low", 85), ("high", 170), ("full", 255)];
/// Number of channels of a universe.
const CHANNELS: usize = 512;

/// Factory of the lamp, with its descriptor.
pub(crate) fn factory() -> Result<Box<dyn Factory<dyn Lighting>>, DescriptorError> {
    let facts = Facts::Lighting(LightingFacts::default().with_scenes(scenes()));
    let spec = DescriptorSpec::new(KEY, "DMX light", DriverSource::Real, facts);
    let port = ArgSpec::path("port").help("the serial port of the interface, such as /dev/ttyUSB0");
    let channel = ArgSpec::whole("channel", 1, 512)
        .default(ArgValue::Whole(1))
        .help("DMX channel of the lamp");
    let settle = ArgSpec::whole("settle", 0, 60_000)
        .unit("ms")
        .default(ArgValue::Whole(500))
        .help("time until the lamp is steady");
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

    /// Opens the serial port. Opening changes no light.
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
    /// Channel of the lamp, counted from 1.
    channel: usize,
    settle: Duration,
    scenes: Vec<String>,
    /// Result of a packet that is still being written. A full port blocks its writer, and must not block the run.
    writing: Option<Receiver<std::io::Result<()>>>,
}

impl Dmx {
    /// Waits until the current packet is written.
    fn written(&mut self, deadline: Deadline) -> Result<(), DriverError> {
        let failed = |kind| DriverError::new(kind, &KEY, "set the light");
        let Some(writing) = &self.writing else {
            return Ok(());
        };
        let written = match writing.recv_timeout(deadline.remaining()) {
            Err(RecvTimeoutError::Timeout) => {
                return Err(failed(ErrorKind::Timeout).because("the port accepts no bytes"));
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

    /// Sets the lamp, and waits until it is probably steady. The lamp reports no state.
    fn set(&mut self, scene: &str, deadline: Deadline) -> Result<(), DriverError> {
        let failed = |kind| DriverError::new(kind, &KEY, "set the light");
        let known = SCENES.iter().find(|(known, _)| *known == scene);
        let Some((_, level)) = known else {
            let why = format!("{scene:?}: expected one of `{}`", self.scenes.join("`, `"));
            return Err(failed(ErrorKind::InvalidArgument).because(why));
        };
        if deadline.remaining() < self.settle {
            let why = format!("the lamp needs {} ms to become steady, more than the deadline allows", self.settle.as_millis());
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

/// Packet that sets `channel`, counted from 1, to `level` and all other channels to 0.
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
