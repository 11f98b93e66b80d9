//! The dashboard: questions and commands as lines of text.

use std::io::{self, Write};
use std::net::TcpStream;

use super::controller::Controller;
use crate::fault::ArmFault;
use crate::server::{End, read};

const GREETING: &str = "Connected: Universal Robots Dashboard Server\n";
/// Maximum length of a command, bytes.
const COMMAND_MAX: usize = 256;

/// Answers lines until the client closes or quits.
pub(super) fn serve(mut stream: TcpStream, controller: &Controller, end: &End) -> io::Result<()> {
    stream.write_all(GREETING.as_bytes())?;
    let mut waiting: Vec<u8> = Vec::new();
    let mut bytes = [0; 256];
    loop {
        match read(&mut stream, &mut bytes, end) {
            None => continue,
            Some(0) => return Ok(()),
            Some(count) => waiting.extend_from_slice(&bytes[..count]),
        }
        while let Some(length) = waiting.iter().position(|byte| *byte == b'\n') {
            let line: Vec<u8> = waiting.drain(..=length).collect();
            let command = String::from_utf8_lossy(&line).trim().to_owned();
            let answer = answer(controller, &command);
            stream.write_all(format!("{answer}\n").as_bytes())?;
            if command == "quit" {
                return Ok(());
            }
        }
        if waiting.len() > COMMAND_MAX {
            return Ok(());
        }
    }
}

fn answer(controller: &Controller, command: &str) -> String {
    let fault = controller.fault();
    let [major, minor] = controller.version;
    let said = match command.to_ascii_lowercase().as_str() {
        "polyscopeversion" => return format!("URSoftware {major}.{minor}.0.108249 (Jul 05 2021)"),
        // Since 5.6.
        "is in remote control" if controller.version >= [5, 6] => "true",
        "robotmode" => "Robotmode: RUNNING",
        "safetymode" | "safetystatus" => {
            let name = if command.eq_ignore_ascii_case("safetymode") {
                "Safetymode"
            } else {
                "Safetystatus"
            };
            let mode = match fault {
                None => "NORMAL",
                Some(ArmFault::Collision) => "PROTECTIVE_STOP",
                Some(ArmFault::EmergencyStop) => "ROBOT_EMERGENCY_STOP",
            };
            return format!("{name}: {mode}");
        }
        "running" if controller.is_running() => "Program running: true",
        "running" => "Program running: false",
        "programstate" if controller.is_running() => "PLAYING taceva",
        "programstate" => "STOPPED taceva",
        // A public client refuses a serial number with letters.
        "get serial number" => {
            let seed = controller.bench.options().seed % 10_000;
            return format!("2023550{seed:04}");
        }
        "get robot model" => "UR5",
        "get loaded program" => "No program loaded",
        "stop" => {
            controller.stop();
            "Stopped"
        }
        "unlock protective stop" => {
            controller.unlock();
            "Protective stop releasing"
        }
        "close safety popup" => "closing safety popup",
        "power on" => "Powering on",
        "brake release" => "Brake releasing",
        "play" => "Failed to execute: play",
        "quit" => "Disconnected",
        _ => return format!("could not understand: '{command}'"),
    };
    said.to_owned()
}
