//! `taceva-wire`: serves the simulated bench over sockets, until it is interrupted or its standard input ends.

use std::io::Read;
use std::net::Ipv4Addr;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use taceva_sim::Model;
use taceva_wire::{BenchOptions, ForceKind, RobotKind, ServeOptions, Served, WireError, netft};

/// Serves a simulated gel behind the sockets of emulated devices: a robot, a force transducer and a camera. Every server listens on
/// loopback only.
#[derive(Debug, Parser)]
#[command(name = "taceva-wire", version)]
struct Arguments {
    /// Robot over the gel.
    #[arg(long, value_enum, default_value_t = RobotKind::Xarm)]
    robot: RobotKind,
    /// Device that measures the force.
    #[arg(long, value_enum, default_value_t = ForceKind::Sri)]
    force: ForceKind,
    /// Gel: vitactip, magictac, gelsight or gelsight-wm.
    #[arg(long, default_value = "gelsight", value_parser = model)]
    model: Model,
    /// Seed of all random errors.
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// Camera pixels per frame pixel, along x and y.
    #[arg(long, default_value_t = 20, value_parser = clap::value_parser!(u32).range(1..=64))]
    reduction: u32,
    /// No errors, drift or relaxation, as with `quiet` of the simulated sensors, and lossless pictures. Use it for comparisons with a study simulated
    /// in the program.
    #[arg(long)]
    quiet: bool,
    /// Stream PNG, which is lossless.
    #[arg(long)]
    png: bool,
    /// Loopback address to listen on.
    #[arg(long, default_value_t = Ipv4Addr::LOCALHOST)]
    host: Ipv4Addr,
    /// Use the ports that public clients expect (502, 30001 to 30003, 4008) instead of any free ones.
    #[arg(long)]
    usual_ports: bool,
    /// Firmware version that the xArm controller reports.
    #[arg(long, default_value = "2.7.0", value_parser = firmware)]
    firmware: Firmware,
    /// Tool frame of the Net F/T box: displacement along x, y, z in mm and rotation about them in degrees, separated by semicolons.
    #[arg(long, default_value = "0;0;0;0;0;0", value_parser = tool)]
    tool: Tool,
    /// Number of the Net F/T box's low pass filter: 0 for none, up to 8 for 5 Hz.
    #[arg(long, default_value_t = 0, value_parser = clap::value_parser!(u8).range(0..=8))]
    filter: u8,
    /// Drift of the Net F/T box's zero, in N per minute.
    #[arg(long, default_value_t = 0.0)]
    drift: f64,
    /// File to write the rig file to.
    #[arg(long)]
    write: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug)]
struct Firmware([u32; 3]);

/// Tool frame of a Net F/T box.
#[derive(Clone, Copy, Debug)]
struct Tool([f64; 6]);

fn tool(text: &str) -> Result<Tool, String> {
    let numbers: Result<Vec<f64>, _> = text.split(';').map(str::parse).collect();
    let six: Option<[f64; 6]> = numbers.ok().and_then(|numbers| numbers.try_into().ok());
    let tool = six.filter(|six| six.iter().all(|number| number.is_finite()));
    tool.map(Tool)
        .ok_or_else(|| "expected six numbers such as 0;0;0;90;0;0".to_owned())
}

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
    let served = Served::start(&ServeOptions {
        bench: BenchOptions {
            model: arguments.model,
            seed: arguments.seed,
            is_quiet: arguments.quiet,
            reduction: arguments.reduction,
        },
        robot: arguments.robot,
        force: arguments.force,
        netft: netft::Setup {
            tool: arguments.tool.0,
            filter: arguments.filter,
            drift_n_min: arguments.drift,
            ..netft::Setup::PLAIN
        },
        host: arguments.host,
        uses_usual_ports: arguments.usual_ports,
        firmware: arguments.firmware.0,
        is_lossless: arguments.png || arguments.quiet,
    })?;
    print!("{}", served.rig_file());
    if let Some(path) = &arguments.write {
        served.write_rig_file(path)?;
        println!("\n# written to {}", path.display());
    }
    println!("# It runs until it is interrupted, or its standard input ends.");
    // The content of standard input has no meaning; its end does.
    let _ = std::io::stdin().read_to_end(&mut Vec::new());
    Ok(())
}
