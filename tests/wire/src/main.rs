//! `taceva-wire`: the simulated bench behind sockets, until it is interrupted or its standard input ends.

use std::io::Read;
use std::net::Ipv4Addr;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;

use clap::{Parser, ValueEnum};
use taceva_sim::Model;
use taceva_wire::control::Control;
use taceva_wire::{Arm, BenchOptions, RigFile, WallBench, WireError, mjpeg, netft, sri, ur, xarm};

/// Serves a simulated gel behind the sockets of devices that exist. Nothing is real; everything listens on loopback alone.
#[derive(Debug, Parser)]
#[command(name = "taceva-wire", version)]
struct Arguments {
    /// The robot over the gel.
    #[arg(long)]
    robot: Option<RobotKind>,
    /// What measures the force.
    #[arg(long)]
    force: Option<ForceKind>,
    /// The camera behind the gel.
    #[arg(long)]
    camera: Option<CameraKind>,
    /// The gel: vitactip, magictac, gelsight or gelsight-wm.
    #[arg(long, default_value = "gelsight", value_parser = model)]
    model: Model,
    /// What every error is drawn from.
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// Pixels of the camera, along x and along y, that make one of a frame.
    #[arg(long, default_value_t = 20, value_parser = clap::value_parser!(u32).range(1..=64))]
    reduction: u32,
    /// No error of the robot, no drift, no relaxation: for comparisons with a study that is simulated in the program.
    #[arg(long)]
    quiet: bool,
    /// Stream PNG, which loses nothing.
    #[arg(long)]
    png: bool,
    /// The address of loopback to listen on.
    #[arg(long, default_value_t = Ipv4Addr::LOCALHOST)]
    host: Ipv4Addr,
    /// Listen on the ports that public clients expect (502, 30001 to 30003, 4008), and not on any free ones.
    #[arg(long)]
    usual_ports: bool,
    /// What the controller calls its firmware.
    #[arg(long, default_value = "2.7.0", value_parser = firmware)]
    firmware: Firmware,
    /// Where to write the rig file.
    #[arg(long)]
    write: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum RobotKind {
    /// An arm of UFACTORY.
    Xarm,
    /// An arm of Universal Robots.
    Ur,
    /// A machine with GRBL, on a pseudo-terminal.
    #[cfg(unix)]
    Grbl,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum ForceKind {
    /// A box of SRI.
    Sri,
    /// A Net F/T box of ATI.
    Netft,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum CameraKind {
    /// A camera that streams over HTTP.
    Mjpeg,
}

#[derive(Clone, Copy, Debug)]
struct Firmware([u32; 3]);

fn model(key: &str) -> Result<Model, String> {
    let known = || Model::ALL.map(Model::key).join(", ");
    Model::from_key(key).ok_or_else(|| format!("expected one of {}", known()))
}

fn firmware(text: &str) -> Result<Firmware, String> {
    let numbers: Result<Vec<u32>, _> = text.split('.').map(str::parse).collect();
    match numbers.as_deref() {
        Ok(&[major, minor, revision]) => Ok(Firmware([major, minor, revision])),
        _ => Err("expected three numbers such as 2.7.0".to_owned()),
    }
}

#[expect(clippy::print_stderr, reason = "a program says why it ends")]
fn main() -> ExitCode {
    match serve(&Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

#[expect(clippy::print_stdout, reason = "a program says where it listens")]
fn serve(arguments: &Arguments) -> Result<(), WireError> {
    let bench = WallBench::start(&BenchOptions {
        model: arguments.model,
        seed: arguments.seed,
        is_quiet: arguments.quiet,
        reduction: arguments.reduction,
    })?;
    let host = arguments.host;
    let usual = arguments.usual_ports;
    let ports = xarm::Ports {
        host,
        firmware: arguments.firmware.0,
        ..if usual {
            xarm::Ports::USUAL
        } else {
            xarm::Ports::ANY
        }
    };
    let robot: Option<Arc<dyn Arm>> = match arguments.robot {
        Some(RobotKind::Xarm) => Some(Arc::new(xarm::Emulator::start(&bench, ports)?)),
        Some(RobotKind::Ur) => {
            let ports = if usual { ur::USUAL_PORTS } else { [0, 0] };
            Some(Arc::new(ur::Emulator::start(&bench, host, ports)?))
        }
        #[cfg(unix)]
        Some(RobotKind::Grbl) => Some(Arc::new(taceva_wire::grbl::Emulator::start(&bench)?)),
        None => None,
    };
    // Kept until the end: a device that is dropped is unplugged.
    let (sri, netft) = match arguments.force {
        Some(ForceKind::Sri) => {
            let port = if usual { sri::USUAL_PORT } else { 0 };
            (Some(sri::Emulator::start(&bench, host, port)?), None)
        }
        Some(ForceKind::Netft) => {
            let port = if usual { netft::USUAL_PORT } else { 0 };
            (None, Some(netft::Emulator::start(&bench, host, port, 0)?))
        }
        None => (None, None),
    };
    let camera = match arguments.camera {
        Some(CameraKind::Mjpeg) => {
            let style = mjpeg::Style::Usual;
            Some(mjpeg::Emulator::start(&bench, host, 0, style)?)
        }
        None => None,
    };
    let control = Control::start(&bench, robot.clone(), host, 0)?;
    let url = |camera: &mjpeg::Emulator| match arguments.png {
        true => camera.png_url(),
        false => camera.url(),
    };
    let rig = RigFile {
        bench: &bench,
        robot: robot.as_ref().map(|arm| arm.selector()),
        force: sri
            .as_ref()
            .map(sri::Emulator::selector)
            .or(netft.as_ref().map(netft::Emulator::selector)),
        sensor: camera
            .as_ref()
            .map(|camera| format!("camera/mjpeg:url={}", url(camera))),
        control: &control,
    };
    print!("{}", rig.text());
    if let Some(path) = &arguments.write {
        rig.write(path)?;
        println!("\n# written to {}", path.display());
    }
    println!("# It runs until it is interrupted, or its standard input ends.");
    // What comes there means nothing; that it ends does.
    let _ = std::io::stdin().read_to_end(&mut Vec::new());
    Ok(())
}
